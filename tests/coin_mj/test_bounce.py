"""Settings of MuJoCo for a bounce: what is pasted bounces as it says."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import pytest

from cointoss.coin_mj import solref


def rebound(model, lowest, *, weight=True, speed=0.0):
    """Return the speed after the first contact over that before, both at the floor, of a model's lone body.

    Args:
        model: a body over a plane.
        lowest: the height of its origin at which it touches.
        weight: whether it has some.
        speed: downward, of the release [m/s].
    """
    gravity = 9.81 if weight else 0.0
    model.opt.gravity[2] = -gravity
    data = mujoco.MjData(model)
    data.qvel[2] = -speed

    def at_floor():
        return (data.qvel[2] ** 2 + 2 * gravity * (data.qpos[2] - lowest)) ** 0.5

    before = at_floor()
    while data.ncon == 0:
        before = at_floor()
        mujoco.mj_step(model, data)
    for _ in range(1000):
        mujoco.mj_step(model, data)
        if data.ncon == 0 and data.qvel[2] > 0:
            return at_floor() / before
    return 0.0


@pytest.mark.parametrize("restitution", [0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("spring", [False, True])
def test_the_model_bounces_as_it_says(restitution, spring):
    found = solref(restitution, 5e-4, spring=spring)
    model = mujoco.MjModel.from_xml_string(found.model)
    # It touches at 3 m/s, where weight takes less than at the 2 m/s of the measurement.
    assert rebound(model, 0.01) == pytest.approx(restitution, abs=found.error_with_weight + 1e-3)
    assert found.error < (0.02 if spring else 1e-11)


@pytest.mark.parametrize("restitution", [0.0, 0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("speed", [0.3, 3.0, 3.1])
def test_without_weight_a_contact_of_one_step_rebounds_by_the_closed_form(restitution, speed):
    """v' = -e v: the constraint's reference takes (1 + e) v away within the step."""
    model = mujoco.MjModel.from_xml_string(solref(restitution, 5e-4).model)
    assert rebound(model, 0.01, weight=False, speed=speed) == pytest.approx(restitution, abs=1e-11)


def test_weight_takes_from_a_rebound_out_of_a_long_contact():
    long = solref(0.1, 1e-3, spring=True)
    assert long.error < 0.01
    assert long.error_with_weight == 0.1  # it does not leave the floor
    for restitution, spring, step in ((0.1, True, 1e-5), (0.8, False, 2e-3)):
        taken = [
            found.error_with_weight - found.error
            for found in (solref(restitution, step / part, spring=spring) for part in (1, 2))
        ]
        assert taken[1] > 1e-4
        assert taken[0] / taken[1] == pytest.approx(2, rel=0.1)  # first order in a contact's length


@pytest.mark.parametrize("body", ["sphere", "box"])
@pytest.mark.parametrize("mass", ["0.001", "50"])
def test_what_is_pasted_elsewhere_holds_for_another_body(body, mass):
    found = solref(0.6, 1e-3)
    size, lowest = {"sphere": ("0.1", 0.1), "box": ("0.1 0.2 0.05", 0.05)}[body]
    text = f"""<mujoco>{found.option}<worldbody><geom type="plane" size="0 0 1"/>
        <body pos="0 0 0.4"><freejoint/><geom type="{body}" size="{size}" mass="{mass}" {found.geom}/></body>
        </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    assert rebound(model, lowest) == pytest.approx(0.6, abs=found.error_with_weight)
    alone = mujoco.MjModel.from_xml_string(text.replace("solref", 'condim="1" solref'))
    # Contacts at four corners share a softness of 1 - 0.9999.
    exactly = {"sphere": 1e-11, "box": 1e-4}[body]
    assert rebound(alone, lowest, weight=False, speed=2.0) == pytest.approx(0.6, abs=exactly)


def test_the_depth_is_that_of_a_spring_or_of_a_step():
    assert solref(0.5, 1e-3).depth == pytest.approx(1e-3, rel=0.1)
    stiff, soft = (solref(1.0, 1e-3, spring=True, steps=n).depth for n in (20, 40))
    assert soft == pytest.approx(40 * 1e-3 / 3.141593, rel=0.05)
    assert soft / stiff == pytest.approx(2, rel=0.05)


@pytest.mark.parametrize(
    ("wrong", "named"),
    [
        (
            {"restitution": 1e-3, "spring": True},
            "restitution = 0.001: accepted: a number from 0.01 to 1 by a spring",
        ),
        ({"restitution": "x"}, 'restitution = "x": accepted: a number'),
        ({"restitution": True}, "restitution = True: accepted: a number"),
        ({"timestep": None}, "timestep = None: accepted: a number"),
        ({"steps": 7.5, "spring": True}, "steps = 7.5: accepted: a whole number from 5 to 500"),
        ({"timestep": float("nan")}, "timestep = nan: accepted"),
    ],
)
def test_what_cannot_be_is_refused(wrong, named):
    with pytest.raises(ValueError, match=named):
        solref(**{"restitution": 0.5, "timestep": 1e-3, **wrong})
