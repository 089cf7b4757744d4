"""How a ball bounces in Newton with what `cointoss solref --backend newton` prints.

    cointoss solref --restitution 0.8 --dt 0.002 --backend newton --json | python -m adapters.bounces

prints the lowest and the highest restitution of touches at four phases of a step, without gravity.
"""

import json
import re
import sys
from ast import literal_eval
from collections.abc import Callable, Iterator
from math import pi
from typing import Any

RADIUS, MASS, SPEED, PHASES, LONGEST = 0.01, 0.01, 2.0, 4, 400
DENSITY = MASS / (4 / 3 * pi * RADIUS**3)


def newton(found: dict[str, Any], steps: list[float]) -> Iterator[float]:
    """Yield the speed after each touch that begins so many steps after the start, by SolverMuJoCo."""
    import newton
    import warp
    from newton.solvers import SolverMuJoCo

    solref, solimp = numbers(found["settings"])
    own = {"solref": solref, "solref_mode": 1, "geom_solimp": solimp, "geom_priority": 1, "condim": 1}
    with warp.ScopedDevice("cpu"):
        builder = newton.ModelBuilder(gravity=(0, 0, 0))
        SolverMuJoCo.register_custom_attributes(builder)
        builder.add_ground_plane()
        shape = newton.ModelBuilder.ShapeConfig(density=DENSITY)
        attributes = {f"mujoco:{name}": value for name, value in own.items()}
        builder.add_shape_sphere(builder.add_body(), radius=RADIUS, cfg=shape, custom_attributes=attributes)
        model = builder.finalize()
        solver = SolverMuJoCo(model, integrator=found["integrator"].lower())
        state, after, control = model.state(), model.state(), model.control()

        def step() -> tuple[float, float]:
            solver.step(state, after, control, None, found["timestep"])
            state.assign(after)
            return float(state.joint_q.numpy()[2]), float(state.joint_qd.numpy()[2])

        for flight in steps:
            state.joint_q.assign([0, 0, RADIUS + SPEED * flight * found["timestep"], 0, 0, 0, 1])
            state.joint_qd.assign([0, 0, -SPEED, 0, 0, 0])
            yield left(step)


def left(step: Callable[[], tuple[float, float]]) -> float:
    """Return the speed at which a ball leaves the floor, by steps that return height and speed; 0: never."""
    for _ in range(LONGEST):
        height, speed = step()
        if speed > 0 and height > RADIUS:
            return speed
    return 0.0


def numbers(settings: str) -> list[tuple[float, ...]]:
    """Return the lists of numbers in brackets of printed settings."""
    return [literal_eval(one) for one in re.findall(r"\([-\d.e, ]+,[-\d.e, ]+\)", settings)]


if __name__ == "__main__":
    asked = json.load(sys.stdin)
    rebounds = [v / SPEED for v in newton(asked, [2 + (n + 0.5) / PHASES for n in range(PHASES)])]
    print(f"{min(rebounds):.4f} to {max(rebounds):.4f}")
