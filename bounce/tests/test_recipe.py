"""Settings of MuJoCo for a bounce: what is pasted bounces as it says."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math

import mujoco
import pytest

from cointoss_bounce import solref
from cointoss_bounce.bodies import BALL, body_of
from cointoss_bounce.contact import ContactSettings, one_step_solref
from cointoss_bounce.drops import SPEED, drops_of
from cointoss_bounce.errors import DeepContactWarning
from cointoss_bounce.recipe import recipe_of
from two_geoms import rebound, thrown


@pytest.mark.slow_after_first
@pytest.mark.parametrize("restitution", [0.1, 0.8, 1.0])
@pytest.mark.parametrize("spring", [False, True])
def test_the_model_bounces_as_it_says(restitution, spring):
    found = solref(restitution, 5e-4, spring=spring)
    model = mujoco.MjModel.from_xml_string(found.model)
    # It touches at 3 m/s, where weight takes less than at the 2 m/s of the measurement.
    assert rebound(model, 0.01, 0.5) == pytest.approx(restitution, abs=found.error_with_weight + 1e-3)
    assert found.error < (0.02 if spring else 5.1e-4)


@pytest.mark.parametrize("restitution", [0.0, 0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("speed", [0.3, 3.0, 3.1])
def test_without_weight_a_contact_of_one_step_rebounds_by_the_closed_form(restitution, speed):
    """v' = -e v: the constraint's reference takes (1 + e) v away within the step."""
    exact = ContactSettings(
        solref=one_step_solref(restitution, 5e-4), timestep=5e-4, integrator="implicitfast"
    )
    left = [data.qvel[2] / speed for data in thrown(BALL.compiled(exact, 0.51), speed, 0.01, 0.51)]
    assert left == pytest.approx([restitution] * 8, abs=1e-11)


@pytest.mark.parametrize("restitution", [0.0, 0.8, 0.9995])
def test_the_stiffness_beside_it_costs_half_of_its_part(restitution):
    """v' = -(e - p/2) v + p x/dt, where the touch is x deep, from 0 to v dt, and p = k dt²."""
    found = solref(restitution, 2e-3)
    part = -found.solref[0] * 2e-3**2
    assert part == pytest.approx(min(1e-3, 1 - restitution), rel=1e-9)
    # 16 phases, the outermost of which is half a phase from its end; what does not leave takes another step.
    expected = part / 2 * 15 / 16 if restitution else part * 31 / 32
    assert found.error == pytest.approx(expected, rel=1e-3, abs=1e-9)
    assert -found.solref[1] * 2e-3 == pytest.approx(1 + restitution - part / 2, rel=1e-12)


def test_what_is_told_of_weight_holds_for_another_gravity_and_mass():
    found = solref(0.8, 2e-3, gravity=50.0, mass=2.0)
    assert found.rest.depth == pytest.approx(1e-4 * 50 / 250, rel=1e-3)
    assert found.creep == pytest.approx(50 / 9.81 * solref(0.8, 2e-3).creep)
    assert found.error_with_weight < found.error + found.weight_cost * 50 * 2e-3 / 2
    assert found.error_with_weight > solref(0.8, 2e-3).error_with_weight
    model = mujoco.MjModel.from_xml_string(found.model)
    assert (model.opt.gravity[2], model.body_mass[1]) == (-50, 2)


@pytest.mark.parametrize("height", [0.2, 0.05])
@pytest.mark.parametrize("e", [0.4, 0.8, 1.0])
def test_a_ball_that_is_dropped_loses_to_its_weight_what_the_closed_form_says(e, height):
    """√(h'/h) is e + ((1 - e)/2 - s (1/e - e)) g dt/v, s from 0 to 1 with the phase of the touch."""
    found, dt = solref(e, 2e-3), 2e-3
    v, model = (2 * 9.81 * height) ** 0.5, mujoco.MjModel.from_xml_string(found.model)
    rebounds = [rebound(model, 0.01, height + part / 20 * v * dt) for part in range(20)]
    costs, stiffness = 9.81 * dt / v, min(1e-3, 1 - e) / 2
    assert found.weight_cost == pytest.approx(1 / e - e - (1 - e) / 2)
    lowest, highest = e - found.weight_cost * costs, e + (1 - e) / 2 * costs
    # Half of the stiffness's part either way; second order in g dt/v, 0.02 at most, over e².
    rest = stiffness + 3 * costs**2 / e**2
    assert lowest - rest < min(rebounds) < lowest + rest
    assert highest - rest < max(rebounds) < highest + rest
    # What is printed is the plain drop's.
    if height == 0.2:
        assert found.error_with_weight == pytest.approx(max(abs(e - r) for r in rebounds), abs=1e-3)


def test_the_depth_is_that_of_a_spring_or_of_a_step():
    one, stiff, soft = (
        drops_of(recipe_of(e, 1e-3, n)).depth / SPEED for e, n in ((0.5, None), (1.0, 20), (1.0, 40))
    )
    assert one == pytest.approx(1e-3, rel=0.1)
    assert soft == pytest.approx(40 * 1e-3 / 3.141593, rel=0.05)
    assert soft / stiff == pytest.approx(2, rel=0.05)


def test_a_body_thinner_than_its_contact_is_deep_is_warned_of():
    with pytest.warns(DeepContactWarning, match="deep, and the body is"):
        thin = solref(0.8, 2e-3, spring=True, body="box 0.1 0.1 0.002")
    # v √(e/k) by theory, with k = (π/(40 dt))²
    assert thin.depth == pytest.approx(0.8**0.5 * 40 * 2e-3 / math.pi, rel=0.03)
    solref(0.8, 2e-3, body="box 0.1 0.1 0.005")  # 3.9 mm deep at 2 m/s


@pytest.mark.parametrize("body", ["sphere 0.02", "box 0.1 0.1 0.005"])
def test_a_floor_lets_a_body_through_whose_contact_is_deeper_than_half_of_both(body):
    """By 40 steps of 2 ms at 2 m/s 46 mm: floors of up to 51 and 82 mm; and no plane."""
    with pytest.warns(DeepContactWarning, match="a floor thicker than"):
        found = solref(0.8, 2e-3, spring=True, body=body)
    half = body_of(body).thinnest
    assert found.thickest_passed == pytest.approx(2 * (2 * found.depth - half))
    plane = 'type="plane" size="0 0 1"'
    for part in (0.05, 0.97, 1.03, math.inf):
        thick = part * found.thickest_passed / 2
        box = f'type="box" size="1 1 {thick!r}" pos="0 0 {-thick!r}"'
        text = body_of(body).model(found.contact, half + 0.01)
        model = mujoco.MjModel.from_xml_string(text if part == math.inf else text.replace(plane, box))
        model.opt.gravity[:] = 0
        data = mujoco.MjData(model)
        data.qvel[2] = -SPEED
        mujoco.mj_step(model, data, nstep=100)
        assert (data.qpos[2] < 0) == (part < 1), part
