"""A body at rest: what holds it lies still where the closed form says, what holds nothing sinks."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import replace

import mujoco
import pytest

from cointoss_bounce.bodies import body_of
from cointoss_bounce.contact import ContactSettings, one_step_solref, spring_solref
from cointoss_bounce.recipe import recipe_of
from cointoss_bounce.rest import depth_at_rest, rest_of


@pytest.mark.parametrize(("e", "dt"), [(0.0, 2e-3), (0.8, 1e-5)])
def test_without_a_stiffness_a_body_sinks_for_ever(e, dt):
    """A contact cancels all but 1 - d of the weight: v = (1 - d) g dt/(1 + e)."""
    contact = ContactSettings(solref=one_step_solref(e, dt), timestep=dt, integrator="implicitfast")
    assert rest_of(contact).sinking == pytest.approx(1e-4 * 9.81 * dt / (1 + e), rel=1e-3)


@pytest.mark.parametrize(
    ("e", "dt", "steps", "body", "near"),
    [
        (0.0, 2e-3, None, "sphere 0.01", 1e-3),
        (0.8, 2e-3, None, "sphere 0.01", 1e-3),
        # More contacts than one share its weight.
        (0.0, 2e-3, None, "box 0.1 0.1 0.05", 1.0),
        (0.8, 2e-3, None, "box 0.1 0.1 0.05", 1.0),
        (0.1, 1e-3, 40, "sphere 0.01", 1e-3),
        (0.8, 1e-3, 10, "sphere 0.01", 1e-3),
    ],
)
def test_a_recipe_rests_where_the_closed_form_says(e, dt, steps, body, near):
    """(1 - d) g/k, of one step k = 1e-3/dt²: 3.9 µm at 2 ms."""
    contact = recipe_of(e, dt, steps)
    soft = 1 - float(contact.solimp.split()[0])
    k = -contact.solref[0] if steps else 1e-3 / dt**2
    found = rest_of(contact, body_of(body))
    assert (found.hop, found.sinking) == (0, 0)
    assert found.depth == pytest.approx(soft * 9.81 / k, rel=near)


@pytest.mark.parametrize(
    ("body", "e", "dt", "steps"),
    [
        ("box 0.1 0.1 0.002", 0.1, 5e-4, None),
        ("box 0.1 0.2 0.05", 0.5, 2e-3, None),
        ("box 0.1 0.1 0.05", 0.8, 2e-3, 40),
        ("cylinder 0.05 0.02", 0.95, 5e-3, None),
        ("cylinder 0.05 0.02", 0.8, 2e-3, 40),
        ("capsule 0.02 0.1", 0.8, 2e-3, 40),
        ("ellipsoid 0.1 0.08 0.05", 0.3, 1e-3, None),
    ],
)
def test_a_body_on_several_points_lies_as_deep_as_the_masses_that_they_meet_say(body, e, dt, steps):
    """Plain steps until what is deeper has risen, and the closed form of a box and of a cylinder."""
    contact, shape = recipe_of(e, dt, steps), body_of(body)
    stiffness, damping = (-number for number in contact.solref)
    model = shape.compiled(contact, shape.height)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=round(max(12 * damping / stiffness, 8) / dt))
    found = depth_at_rest(contact, shape)
    assert shape.height - data.qpos[2] == pytest.approx(found, rel=3e-3)
    one = (1 - float(contact.solimp.split()[0])) * 9.81 / stiffness
    if shape.kind == "box":
        x, y, z = (half**2 for half in shape.size)
        assert found / one == pytest.approx((1 + 3 * x / (x + z) + 3 * y / (y + z)) / 4, rel=1e-3)
    elif shape.kind == "cylinder":
        r, half = shape.size
        assert found / one == pytest.approx((1 + r**2 / (r**2 / 4 + half**2 / 3)) / 3, rel=1e-3)
    else:
        assert found == pytest.approx(one, rel=1e-9)


def test_without_the_flag_contacts_share_the_mass():
    contact = replace(recipe_of(0.8, 2e-3), exact=False)
    assert depth_at_rest(contact, body_of("box 0.1 0.1 0.05")) == pytest.approx(1e-4 * 9.81 / 250 / 4)


def test_the_hardest_spring_hops_for_ever():
    """As was recommended before: the contact carries all of the weight, and the spring pushes on."""
    contact = ContactSettings(solref=spring_solref(0.8, 1e-3, 40), timestep=1e-3, integrator="RK4")
    assert 2e-5 < rest_of(contact).hop < 1e-4
