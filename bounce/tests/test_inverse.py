"""The restitution of given settings: closed forms, MuJoCo's mixing, and the recipes turned round."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cointoss_bounce import solref, solref_of
from cointoss_bounce.contact import HARDEST, ContactSettings
from cointoss_bounce.inverse import formula_of


@pytest.mark.parametrize(
    ("given", "other", "mixed"),
    [
        ((0.01, 0.37), (0.02, 1), (0.015, 0.685)),
        ((0.01, 0.37), None, (0.01, 0.37)),
        ((-1000, -10), (-500, -20), (-1000, -20)),
        ((-1000, -10), (0.02, 1), (-1000, -10)),
    ],
    ids=["their mean", "alone", "the smaller of two direct forms", "the direct form of two"],
)
def test_what_two_geoms_say_is_mixed_as_mujoco_does(given, other, mixed):
    assert solref_of(given, 0.002, other=other).solref == pytest.approx(mixed, rel=1e-12)


def test_a_mixed_contact_has_the_restitution_of_its_formula():
    """0.2155 rather than the 0.39 of 0.01 0.37 alone, or the 0.7 that some expect of it."""
    found = solref_of((0.01, 0.37), 0.002, other=(0.02, 1))
    assert found.formula is not None
    assert found.formula.restitution == pytest.approx(0.2155, abs=5e-5)
    # A contact of a dozen steps, whose onset falls inside a step.
    assert found.lowest < found.formula.restitution < found.highest
    assert found.restitution == pytest.approx(0.2155, abs=0.02)
    hard = solref_of((-1000, -10), 0.002, other=(0.02, 1), solimp=HARDEST)
    assert np.fromstring(hard.solimp, sep=" ")[:2] == pytest.approx([0.94995, 0.97495])


@pytest.mark.parametrize("zeta", [0.37, *(pytest.param(z, marks=pytest.mark.long) for z in (0.1, 1.0))])
def test_a_resolved_spring_does_what_the_formula_says(zeta):
    found = solref_of((0.02, zeta), 2e-4, integrator="RK4", solimp=HARDEST)
    theory = found.formula
    assert theory is not None
    # Touches fall inside a step: first order in dt √k, here 0.01/ζ.
    assert found.restitution == pytest.approx(theory.restitution, rel=0.02)
    assert found.duration == pytest.approx(theory.duration, rel=0.03)
    assert found.depth == pytest.approx(theory.depth, rel=0.02)


MOON = {"gravity": 1.62}
RESTS = {
    # Of a time constant and a damping ratio of 1 k is the reciprocal of their square.
    "ball": ((0.02, 1.0), {}, 0.1 * 9.81 * 0.02**2),
    "ball, direct": ((-2000.0, -60.0), {}, 0.1 * 9.81 / 2000),
    "ball on the moon": ((-2000.0, -60.0), MOON, 0.1 * 1.62 / 2000),
    "heavy ball on the moon": ((-2000.0, -60.0), {**MOON, "mass": 50.0}, 0.1 * 1.62 / 2000),
    "box": ((-2000.0, -60.0), {"body": "box 0.1 0.1 0.002"}, 0.1 * 9.81 / 2000 / 4),
}


@pytest.mark.parametrize(("given", "options", "depth"), RESTS.values(), ids=RESTS)
def test_the_depth_at_rest_is_that_of_the_weight_that_is_left(given, options, depth):
    """(1 - d) g/k, on each of its four points a quarter of it."""
    found = solref_of(given, 1e-3, solimp="0.9 0.9 0.001 0.5 2", **options)
    assert found.rest.sinking == 0
    assert found.rest.depth == pytest.approx(depth, rel=1e-3)
    assert found.formula is not None
    assert found.formula.rest == pytest.approx(depth * (4 if "body" in options else 1), rel=1e-9)


def test_weight_takes_from_a_rebound_in_proportion_to_it():
    less = [solref_of((-2000.0, -60.0), 1e-3, gravity=g) for g in (0.1, 0.2)]
    taken = [each.restitution - each.restitution_with_weight for each in less]
    assert taken[1] / taken[0] == pytest.approx(2, rel=0.05)


def test_an_impedance_that_grows_carries_more_of_a_larger_weight():
    depths = [solref_of((0.02, 1), 2e-3, gravity=g).rest.depth for g in (9.81, 98.1)]
    assert 1 < depths[1] / depths[0] < 10


@pytest.mark.parametrize(
    ("e", "spring", "near"), [(0.0, False, 1e-3), (0.8, False, 1e-9), (0.8, True, 1e-12)]
)
def test_the_recipes_turned_round_give_what_was_asked_for(e, spring, near):
    bounce = solref(e, 1e-3, spring=spring)
    found = solref_of(bounce.solref, 1e-3, integrator=bounce.integrator, solimp=bounce.solimp)
    assert found.restitution == pytest.approx(bounce.restitution, abs=max(bounce.error, 1e-12))
    assert found.rest == bounce.rest
    assert found.formula is not None
    assert found.formula.restitution == pytest.approx(bounce.restitution, abs=near)


def test_a_time_constant_below_two_steps_counts_as_two_steps():
    short, two = (solref_of((constant, 1.0), 2e-3) for constant in (1e-3, 4e-3))
    assert short.restitution == two.restitution
    assert short.formula == two.formula


def test_no_formula_is_claimed_for_one_step_of_another_integrator():
    contact = ContactSettings(solref=(0.0, -900.0), timestep=2e-3, integrator="RK4")
    assert formula_of(contact) is None
    one = formula_of(replace(contact, integrator="Euler"))
    assert one is not None
    assert one.restitution == pytest.approx(0.8, rel=1e-12)
    assert one.rest == math.inf
