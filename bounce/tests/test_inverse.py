"""The restitution of given settings: closed forms, MuJoCo's mixing, and the recipes turned round."""

import math
from dataclasses import replace

import numpy as np
import pytest

from cointoss_bounce import solref, solref_of
from cointoss_bounce.contact import HARDEST, INTEGRATORS, ContactSettings
from cointoss_bounce.inverse import formula_of


def test_two_positive_pairs_of_numbers_are_mixed_by_their_mean():
    """0.2155 rather than the 0.39 of 0.01 0.37 alone, or the 0.7 that some expect of it."""
    found = solref_of((0.01, 0.37), 0.002, other=(0.02, 1))
    assert found.solref == pytest.approx((0.015, 0.685), rel=1e-12)
    assert found.formula is not None
    assert found.formula.restitution == pytest.approx(0.2155, abs=5e-5)
    # A contact of a dozen steps, whose onset falls inside a step.
    assert found.lowest < found.formula.restitution < found.highest
    assert found.restitution == pytest.approx(0.2155, abs=0.02)
    alone = solref_of((0.01, 0.37), 0.002)
    assert alone.solref == (0.01, 0.37)
    assert alone.restitution > 0.3


def test_of_two_direct_forms_the_smaller_numbers_hold():
    found = solref_of((-1000, -10), 0.002, other=(-500, -20))
    assert found.solref == (-1000, -20)
    assert solref_of((-1000, -10), 0.002, other=(0.02, 1)).solref == (-1000, -10)
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


@pytest.mark.parametrize("solref_given", [(0.02, 1.0), (-2000.0, -60.0)])
def test_the_depth_at_rest_is_that_of_the_weight_that_is_left(solref_given):
    found = solref_of(solref_given, 1e-3, solimp="0.9 0.9 0.001 0.5 2")
    assert found.formula is not None
    assert found.rest.sinking == 0
    assert found.rest.depth == pytest.approx(found.formula.rest, rel=1e-3)


def test_a_box_lies_a_quarter_as_deep_as_a_ball():
    found = solref_of((-2000.0, -60.0), 1e-3, solimp="0.9 0.9 0.001 0.5 2", body="box 0.1 0.1 0.002")
    assert found.rest.depth == pytest.approx(0.1 * 9.81 / 2000 / 4, rel=1e-3)


def test_on_the_moon_the_depth_at_rest_is_that_of_its_weight_for_every_mass():
    solimp, moon = "0.9 0.9 0.001 0.5 2", 1.62
    found = solref_of((-2000.0, -60.0), 1e-3, solimp=solimp, gravity=moon)
    assert found.rest.depth == pytest.approx(0.1 * moon / 2000, rel=1e-3)
    assert found.formula is not None
    assert found.formula.rest == pytest.approx(0.1 * moon / 2000, rel=1e-9)
    heavy = solref_of((-2000.0, -60.0), 1e-3, solimp=solimp, gravity=moon, mass=50.0)
    assert heavy.rest.depth == pytest.approx(found.rest.depth, rel=1e-6)
    less = [solref_of((-2000.0, -60.0), 1e-3, solimp=solimp, gravity=g) for g in (0.1, 0.2)]
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


@pytest.mark.long
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_every_integrator_is_measured(integrator):
    found = solref_of((0.02, 0.3), 1e-3, integrator=integrator)
    assert 0.2 < found.restitution < 0.6
