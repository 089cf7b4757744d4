"""Stills of a toss, drawn by MuJoCo."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import Scenario, States
from cointoss.study import drawing_problem

HEIGHT, WIDTH = 150, 200


def stills(scenario: Scenario, states: States) -> NDArray[Any] | str:
    """Return pictures of a coin in several states, seen by one camera at rest, or why there are none.

    Args:
        scenario: what is tossed.
        states: of the coin, (n,).

    Returns:
        Red, green and blue, (n, height, width, 3) of uint8.
    """
    problem = drawing_problem()
    if problem is not None:
        return problem

    import mujoco

    from cointoss.study import add_shadow, build_visual_model

    r, low, high = scenario.coin.radius, states.position.min(axis=0), states.position.max(axis=0)
    span = float(np.linalg.norm(high - low)) + 4 * r
    model = build_visual_model(scenario, extent=span, tile=2 * r)
    data = mujoco.MjData(model)
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (low + high) / 2
    camera.distance, camera.azimuth, camera.elevation = 1.1 * span, 90, -25
    drawn = []
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        for qpos in states.to_mujoco(scenario)[0]:
            data.qpos[:] = qpos
            mujoco.mj_forward(model, data)
            renderer.update_scene(data, camera)
            add_shadow(renderer.scene, data, scenario.coin)
            drawn.append(renderer.render())
    return np.array(drawn)
