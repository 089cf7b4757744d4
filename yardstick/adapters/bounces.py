"""How a ball bounces in Newton with what `cointoss solref --backend newton` prints.

    cointoss solref --restitution 0.8 --dt 0.002 --backend newton --json | python -m adapters.bounces

prints the lowest and the highest restitution of touches at four phases of a step, without gravity.
"""

import json
import sys
from collections.abc import Callable
from math import pi
from typing import Any

RADIUS, MASS, SPEED, PHASES, LONGEST = 0.01, 0.01, 2.0, 4, 400
DENSITY = MASS / (4 / 3 * pi * RADIUS**3)

Step = Callable[[], tuple[float, float]]
"""Takes a step, and returns the height of the ball [m] and its speed upwards [m/s]."""


def newton(found: dict[str, Any], height: float) -> Step:
    """Return the step of a ball that comes from a height, by SolverMuJoCo."""
    import newton
    import warp
    from newton.solvers import SolverMuJoCo

    before, call, rest = found["settings"].rpartition("SolverMuJoCo(model")
    warp.set_device("cpu")
    builder = newton.ModelBuilder(gravity=(0, 0, 0))
    printed = {"SolverMuJoCo": SolverMuJoCo, "builder": builder}
    exec(before, printed)
    builder.add_ground_plane()
    shape = newton.ModelBuilder.ShapeConfig(density=DENSITY)
    own = printed["custom_attributes"]
    builder.add_shape_sphere(builder.add_body(), radius=RADIUS, cfg=shape, custom_attributes=own)
    model = builder.finalize()
    solver = eval(call + rest, printed | {"model": model})
    state, after, control = model.state(), model.state(), model.control()
    state.joint_q.assign([0, 0, height, 0, 0, 0, 1])
    state.joint_qd.assign([0, 0, -SPEED, 0, 0, 0])

    def step() -> tuple[float, float]:
        solver.step(state, after, control, None, found["timestep"])
        state.assign(after)
        return float(state.joint_q.numpy()[2]), float(state.joint_qd.numpy()[2])

    return step


def left(step: Step) -> float:
    """Return the speed at which a ball leaves the floor; 0: never."""
    for _ in range(LONGEST):
        height, speed = step()
        if speed > 0 and height > RADIUS:
            return speed
    return 0.0


if __name__ == "__main__":
    asked = json.load(sys.stdin)
    heights = [RADIUS + SPEED * asked["timestep"] * (2 + (n + 0.5) / PHASES) for n in range(PHASES)]
    rebounds = [left(newton(asked, height)) / SPEED for height in heights]
    print(f"{min(rebounds):.4f} to {max(rebounds):.4f}")
