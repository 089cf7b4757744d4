"""A body at rest: what holds it lies still where the closed form says, what holds nothing sinks."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from cointoss_bounce.bodies import BALL, body_of
from cointoss_bounce.contact import ContactSettings, one_step_solref, spring_solref
from cointoss_bounce.recipe import recipe_of
from cointoss_bounce.rest import depth_at_rest, rest_of


@pytest.mark.parametrize(("e", "dt"), [(0.0, 2e-3), (0.8, 1e-5)])
def test_without_a_stiffness_a_body_sinks_for_ever(e, dt):
    """A contact cancels all but 1 - d of the weight: v = (1 - d) g dt/(1 + e)."""
    contact = ContactSettings(solref=one_step_solref(e, dt), timestep=dt, integrator="implicitfast")
    assert rest_of(contact).sinking == pytest.approx(1e-4 * 9.81 * dt / (1 + e), rel=1e-3)


@pytest.mark.parametrize("body", ["sphere 0.01", "box 0.1 0.1 0.05"])
@pytest.mark.parametrize("e", [0.0, 0.8])
def test_the_recipe_of_one_step_rests_where_the_closed_form_says(e, body):
    """(1 - d) g/k, k = 1e-3/dt²: 3.9 µm at 2 ms. More contacts than one share a body's weight."""
    found = rest_of(recipe_of(e, 2e-3), body_of(body))
    assert (found.hop, found.sinking) == (0, 0)
    assert found.depth == pytest.approx(1e-4 * 9.81 / 250, rel=1e-3 if "sphere" in body else 1.0)


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


@pytest.mark.parametrize(("e", "steps"), [(0.1, 40), (0.8, 10)])
def test_the_recipe_of_a_spring_rests_where_the_closed_form_says(e, steps):
    contact = recipe_of(e, 1e-3, steps)
    soft = 1 - float(contact.solimp.split()[0])
    found = rest_of(contact)
    assert (found.hop, found.sinking) == (0, 0)
    assert found.depth == pytest.approx(soft * 9.81 / -contact.solref[0], rel=1e-3)


def test_the_hardest_spring_hops_for_ever():
    """As was recommended before: the contact carries all of the weight, and the spring pushes on."""
    contact = ContactSettings(solref=spring_solref(0.8, 1e-3, 40), timestep=1e-3, integrator="RK4")
    assert 2e-5 < rest_of(contact).hop < 1e-4


@pytest.mark.parametrize("force", [0.0, 500.0])
def test_a_body_that_is_pressed_lies_as_much_deeper(force):
    """1 kg under 500 N: 0.2 mm, where it sank 68 µm/s."""
    contact = recipe_of(0.5, 2e-3)
    model = BALL.compiled(contact, BALL.height)
    model.body_mass[1] = 1.0
    mujoco.mj_setConst(model, mujoco.MjData(model))
    data = mujoco.MjData(model)
    data.xfrc_applied[1, 2] = -force
    mujoco.mj_step(model, data, nstep=30_000)
    assert BALL.height - data.qpos[2] == pytest.approx(1e-4 * (9.81 + force) / 250, rel=1e-3)


@pytest.mark.parametrize("e", [0.0, 0.8])
def test_what_is_deeper_rises_with_the_damping_over_the_stiffness(e):
    """x' = -(k/b) x about its depth at rest: by 1/e in b/k, 3.6 s at e = 0.8 and 2 ms."""
    contact = recipe_of(e, 2e-3)
    k, b = (-number for number in contact.solref)
    data = mujoco.MjData(model := BALL.compiled(contact, BALL.height - 1e-3))
    mujoco.mj_step(model, data, nstep=round(b / k / 2e-3))
    at_rest = 1e-4 * 9.81 / k
    left = (BALL.height - data.qpos[2] - at_rest) / (1e-3 - at_rest)
    assert left == pytest.approx(np.exp(-1), rel=2e-3)
    assert b / k == pytest.approx((1 + e) * 2e-3 / 1e-3, rel=1e-3)
