"""What is printed is stepped by plain `mujoco`: a thousand bounces of every model."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import re
from pathlib import Path

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj import solref

PAGE = (Path(__file__).parents[3] / "docs" / "MUJOCO.md").read_text(encoding="utf-8")
MODELS = re.findall(r"```xml\n(<mujoco>.*?)```", PAGE, re.DOTALL)
BOUNCES = 1000
PRINTED = {
    f"e = {e:g}, {backend}{', spring' if spring else ''}": {
        "restitution": e,
        "backend": backend,
        "spring": spring,
    }
    for e, backend, spring in (
        (0.3, "mujoco", False),
        (0.8, "mujoco", False),
        (0.8, "mjx", False),
        (0.8, "warp", True),
    )
}


def rebounds(text, number=BOUNCES, speed=2.0):
    """Return the restitutions of a ball's touches at random phases of a step, without weight."""
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = 0
    data, radius, way = mujoco.MjData(model), model.geom_size[1, 0], speed * model.opt.timestep
    rng, found = np.random.default_rng(1), []
    for _ in range(number):
        mujoco.mj_resetData(model, data)
        data.qpos[2] = radius + way * (1 + rng.random())
        data.qvel[2] = -speed
        while data.qvel[2] < 0 or data.qpos[2] < radius:
            mujoco.mj_step(model, data)
        found.append(data.qvel[2] / speed)
    return np.array(found)


@pytest.mark.parametrize("name", PRINTED)
def test_a_thousand_bounces_of_what_is_printed(name):
    asked = PRINTED[name]
    found = solref(timestep=2e-3, **asked)
    assert ("diagexact" in found.option) == ("diagexact" in found.model) == (asked["backend"] == "mujoco")
    e = rebounds(found.model, BOUNCES if not asked["spring"] else 100)
    assert abs(e - asked["restitution"]).max() < 1.1 * found.error
    assert e.mean() == pytest.approx(asked["restitution"], abs=0.5 * found.error)


def test_a_thousand_bounces_in_a_row_lose_no_energy():
    """At e = 1 one step sends back what comes; flights of semi-implicit Euler err by no more than g dt v."""
    model = mujoco.MjModel.from_xml_string(solref(1.0, 2e-3).model)
    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    before, bounces, rising = data.energy.sum(), 0, False
    while bounces < BOUNCES:
        mujoco.mj_step(model, data)
        bounces += data.qvel[2] > 0 and not rising
        rising = data.qvel[2] > 0
    assert data.energy.sum() == pytest.approx(before, rel=0.1)


@pytest.mark.parametrize("text", MODELS)
def test_the_models_of_the_page_bounce_as_they_say(text):
    restitution = float(re.findall(r"<!-- e = ([\d.]+)", text)[0])
    assert rebounds(text, 200) == pytest.approx(restitution, abs=0.01)


def test_what_runs_on_no_backend_is_refused():
    with pytest.raises(ValueError, match='backend = "brax": accepted: mujoco, mjx, warp'):
        solref(0.5, 1e-3, backend="brax")
