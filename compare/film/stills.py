"""Stills of a toss by MuJoCo, drawn in a process of its own."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import os
import pickle
import subprocess
import sys
from typing import Any

import numpy as np
from numpy.typing import NDArray

from compare.film.back_end import UNKNOWN, drawing_problem
from models.records import Array, States
from models.scenario import Release, Scenario, euler_parameters, vector

Stills = NDArray[Any]
"""Red, green and blue, (n, height, width, 3) of uint8."""
HEIGHT, WIDTH = 150, 200
_CHILD = (
    "import pickle, sys; from compare.film.stills import draw; "
    "pickle.dump(draw(*pickle.load(sys.stdin.buffer)), sys.stdout.buffer)"
)


def stills(scenario: Scenario, states: States) -> Stills | str:
    """Draw a coin in several states, seen by one camera at rest.

    MuJoCo chooses how it draws when it is first imported, and may end the process where it cannot.

    Args:
        scenario: what is tossed.
        states: of the coin, (n,).

    Returns:
        The stills, or why there are none.
    """
    env = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    if env.get("MUJOCO_GL") == "disabled":
        # So `drawing_problem` leaves it where MuJoCo can't draw; the child is to say why.
        del env["MUJOCO_GL"]
    child = subprocess.run(
        [sys.executable, "-c", _CHILD],
        input=pickle.dumps((scenario, states.position, states.quaternion)),
        capture_output=True,
        check=False,
        env=env,
    )
    if child.returncode != 0:
        said = child.stderr.decode(errors="replace").strip().splitlines()
        return f"{UNKNOWN} ({said[-1] if said else f'ended by signal {-child.returncode}'})"
    return pickle.loads(child.stdout)


def draw(scenario: Scenario, positions: Array, quaternions: Array) -> Stills | str:
    """Draw a coin, in the process that calls it, before MuJoCo is first imported there.

    Args:
        scenario: what is tossed.
        positions: of C, space frame, (n, 3) [m].
        quaternions: Euler parameters, body to space, (n, 4).

    Returns:
        The stills, or why there are none.
    """
    problem = drawing_problem()
    if problem is not None:
        return problem

    import mujoco

    from coin_mj.model.state import of_release
    from compare.film.visual_model import build_painted

    body = scenario.body
    low, high = positions.min(axis=0), positions.max(axis=0)
    span = float(np.linalg.norm(high - low)) + 4 * body.radius
    # Shadows are ragged at the border of the scene, so that is put out of sight.
    model = build_painted(scenario, extent=4 * span, tile=2 * body.radius)
    data = mujoco.MjData(model)
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (low + high) / 2
    camera.distance, camera.azimuth, camera.elevation = 1.1 * span, 90, -25
    drawn = []
    with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:
        for x, e in zip(positions, quaternions, strict=True):
            release = Release(position=vector(x), quaternion=euler_parameters(e))
            data.qpos[:], data.qvel[:] = of_release(body, release)
            mujoco.mj_forward(model, data)
            renderer.update_scene(data, camera)
            drawn.append(renderer.render())
    return np.array(drawn)
