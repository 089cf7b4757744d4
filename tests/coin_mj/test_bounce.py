"""Settings of MuJoCo for a bounce: what is pasted bounces as it says."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import pytest

from coin_mj import solref


def first_bounce(model):
    """Return the speed when the first contact lets go over that before it, of the lone body of a model."""
    data = mujoco.MjData(model)
    before = 0.0
    while data.ncon == 0:
        before = data.qvel[2]
        mujoco.mj_step(model, data)
    while data.qfrc_constraint[2] > 0:
        mujoco.mj_step(model, data)
    return -data.qvel[2] / before


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("spring", [False, True])
def test_the_model_bounces_as_it_says(restitution, spring):
    found = solref(restitution, 5e-4, spring=spring)
    model = mujoco.MjModel.from_xml_string(found.model)
    weight = 9.81 * 5e-4 / 3  # of a step, on 3 m/s
    assert first_bounce(model) == pytest.approx(restitution, abs=found.error + 2 * weight)
    assert found.error < (0.02 if spring else 1e-11)


@pytest.mark.parametrize("body", ["sphere", "box"])
@pytest.mark.parametrize("mass", ["0.001", "50"])
def test_what_is_pasted_elsewhere_holds_for_another_body(body, mass):
    found = solref(0.6, 1e-3)
    size = {"sphere": "0.1", "box": "0.1 0.2 0.05"}[body]
    model = mujoco.MjModel.from_xml_string(
        f"""<mujoco>{found.option}<worldbody><geom type="plane" size="0 0 1"/>
        <body pos="0 0 0.4"><freejoint/><geom type="{body}" size="{size}" mass="{mass}" {found.geom}/></body>
        </worldbody></mujoco>"""
    )
    assert first_bounce(model) == pytest.approx(0.6, abs=0.02)


def test_the_depth_is_that_of_a_spring_or_of_a_step():
    assert solref(0.5, 1e-3).depth == pytest.approx(1e-3, rel=0.1)
    stiff, soft = (solref(1.0, 1e-3, spring=True, steps=n).depth for n in (20, 40))
    assert soft == pytest.approx(40 * 1e-3 / 3.141593, rel=0.05)
    assert soft / stiff == pytest.approx(2, rel=0.05)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        ({"restitution": 1.1}, "restitution = 1.1: accepted: a number from 0 to 1"),
        ({"restitution": 0, "spring": True}, "restitution = 0: accepted: more than 0 by a spring"),
        ({"timestep": 0}, "timestep = 0: accepted: from 1e-7 to 0.1 s"),
        ({"timestep": float("nan")}, "timestep = nan: accepted"),
        ({"steps": 2, "spring": True}, "steps = 2: accepted: a whole number from 5 to 500"),
    ],
)
def test_what_cannot_be_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        solref(**{"restitution": 0.5, "timestep": 1e-3, **wrong})
