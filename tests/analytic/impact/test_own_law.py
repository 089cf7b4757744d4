"""A contact law of one's own: the named laws written again, what it may do, and what is refused."""

# ruff: noqa: ARG001

import math
import pickle
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.analytic import OwnLaw
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.analytic.impact import own_law
from cointoss.analytic.impact.own_law import rules_by
from cointoss.models.batch import rows_of
from cointoss.models.certificate import LAW
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.records import Ending, Outcome, UnsupportedError
from tests.helpers.draws import THIN, draw_coin, draw_release, scenario
from tests.helpers.many import assert_same_toss
from tests.helpers.own_laws import (
    FREE,
    REFUSED,
    errs,
    of,
    perfectly_rough,
    sharp_edge,
    sliding_friction,
    smooth,
    superball,
    written,
)

GAINED = "impacts: energy that this law adds, in all"
CALLS = "law(K, v_A, tau, chi, mu): return 0.0, 0.0, -decorated(chi) * v_A[2] / K[2][2]"
NO_LAWS = tomllib.loads(Path(__file__).with_name("refused_laws.toml").read_text(encoding="utf-8"))
TILTED = {"position": [0, 0, 0.1], "angles": [0, 0.5, 0]}
ROLLING = scenario(floor={"rolling_friction": 1e-4})
LIVELY = scenario(floor={"restitution": 0.81})


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("contact", "law", "allowed"),
    [
        ("smooth", smooth, {}),
        ("smooth", written(CALLS), {}),
        ("perfectly_rough", perfectly_rough, FREE),
        ("sharp_edge", sharp_edge, FREE),
        ("sliding_friction", sliding_friction, FREE),
    ],
)
def test_a_named_law_written_again_gives_the_same_tosses_to_the_bit(contact, law, allowed):
    """Up to the first sustained contact, into which no law of one's own is followed; many as one."""
    rng, own = np.random.default_rng(42), OwnLaw(law, **allowed)
    for number in range(12):
        floor = {"restitution": 0.7, "restitution_threshold": 0.05 * (number % 2), "friction": 0.2}
        parts = {"coin": draw_coin(rng), "release": draw_release(rng)}
        case = scenario(**parts, floor={**floor, "contact": contact})
        named, toss = analytic.toss(case), analytic.toss(case, law=own)
        n = min(np.sum(named.impacts.time < named.contacts[:, 0].min(initial=np.inf)), len(toss.impacts))
        for column in ("time", "impulse", "angular_velocity_after"):
            assert np.array_equal(getattr(named.impacts, column)[:n], getattr(toss.impacts, column)[:n])
        assert n >= 3
        assert min(toss.trusted_impacts, n) == min(named.trusted_impacts, n)
        assert of(toss, LAW) < 1e-12
        assert toss.ending in (Ending.SETTLED, Ending.PAPER, Ending.CHATTER)
        assert len(toss.contacts) == 0
        many = analytic.toss_rows(rows_of(case, 1), settings=analytic.FINE, law=own, trust="certain")
        assert_same_toss(many, 0, toss)
        assert (many.trusted_impacts, many.outcome_certain) == (toss.trusted_impacts, toss.outcome_certain)


@pytest.mark.parametrize(("given", "most"), [(None, MOST_LOSSLESS), (7, 7)])
def test_a_toss_by_a_law_is_given_up_as_where_impacts_may_take_no_energy(given, most):
    floor = {"restitution": 0.5, "contact": "coulomb", "friction": 0.3}
    case = scenario(floor=floor, ending={"max_impacts": given})
    assert rules_by(OwnLaw(smooth), case).max_impacts == most


def gains_when_slow(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -(2.1 if v_A[2] > -1 else 1.9) * v_A[2] / K[2][2]


@pytest.mark.parametrize(
    ("law", "allowed", "chi", "ending"),
    [
        (smooth, {}, 0.8, Ending.SETTLED),
        (smooth, {"may_add_energy": True}, 0.8, Ending.PAPER),
        (errs, {"max_restitution": 0.8}, 0.8, Ending.SETTLED),
        (errs, {"tolerance": 1e-8}, 0.3, Ending.PAPER),
        (errs, {"tolerance": 1e-8}, 1.0, Ending.MAX_IMPACTS),
        (gains_when_slow, {"may_add_energy": True}, 0.8, Ending.MAX_IMPACTS),
    ],
)
def test_a_law_that_may_add_energy_says_how_much_and_proves_no_face(law, allowed, chi, ending):
    case = scenario(floor={"restitution": chi}, release=TILTED, ending={"max_impacts": 200})
    toss = analytic.toss(case, law=OwnLaw(law, **allowed))
    weight = case.coin.mass * case.gravity * case.coin.radius
    gained = [np.maximum(toss.impacts.energy_change, 0).sum() / weight] * (ending != Ending.SETTLED)
    assert toss.ending == ending
    assert [line.value for line in toss.certificate if line.name == GAINED] == pytest.approx(gained, rel=1e-9)


@pytest.mark.slow_after_first
@pytest.mark.parametrize("law", NO_LAWS["made"])
def test_what_breaks_a_condition_or_is_no_law_is_refused_in_one_line_when_it_is_made(law):
    says = NO_LAWS["made"][law]
    with pytest.raises((ValueError, TypeError), match=f"^law law: {says}") as raised:
        OwnLaw(written(law))
    assert "\n" not in str(raised.value)
    assert isinstance(raised.value, TypeError) == says.startswith(("takes", "returns"))


@pytest.mark.parametrize("law", NO_LAWS["tossed"])
@pytest.mark.parametrize("tilt", [0.5, 0.0])
def test_a_law_that_breaks_a_condition_outside_the_sample_ends_the_toss_at_that_impact(law, tilt):
    fast = scenario(release={"position": [0, 0, 1.0], "velocity": [0, 0, -25.0], "angles": [0, tilt, 0]})
    toss = analytic.toss(fast, law=OwnLaw(written(law)))
    assert (toss.outcome, toss.ending, len(toss.impacts)) == (Outcome.UNDECIDED, Ending.NO_SOLUTION, 0)
    assert re.match(NO_LAWS["tossed"][law], of(toss, REFUSED))
    assert ("K = ((500, 0, 0), (0, 500, 0), (0, 0, 500)) 1/kg" in of(toss, REFUSED)) == (tilt == 0)


@pytest.mark.parametrize(
    ("given", "error", "says"),
    [
        ({"function": 3}, TypeError, r"law: of type int, accepted: a function \(K, v_A, tau, chi, mu\) "),
        ({"function": math.hypot}, TypeError, r"law: of type \w+, accepted: a function \(K, v_A, tau, "),
        ({"may_pull": "no"}, TypeError, "may_pull: of type str, accepted: True or False$"),
        ({"may_add_energy": "no"}, TypeError, "may_add_energy: of type str, accepted: True or False$"),
        ({"max_restitution": 1.1}, ValueError, "max_restitution = 1.1: accepted: a number from 0 to 1$"),
        ({"max_restitution": "1"}, TypeError, "max_restitution: of type str, accepted: a number from 0 to"),
        ({"tolerance": 0.0}, ValueError, "tolerance = 0.0: accepted: a number from 1e-10 to 0.001$"),
        ({"tolerance": float("nan")}, ValueError, "tolerance = nan: accepted: a number from 1e-10 to 0.0"),
        ({"tolerance": True}, TypeError, "tolerance: of type bool, accepted: a number from 1e-10 to 0.001"),
        ({"function": perfectly_rough, "may_pull": True}, ValueError, "law perfectly_rough: adds "),
        ({"function": perfectly_rough, "may_add_energy": True}, ValueError, "law perfectly_rough: pulls"),
        ({"function": errs, "tolerance": 5e-10}, ValueError, r"law errs: adds .*1, tolerance = 5e-10\)$"),
    ],
)
def test_what_a_law_may_do_and_how_far_it_is_meant_is_checked(given, error, says):
    with pytest.raises(error, match=f"^{says}"):
        OwnLaw(**{"function": smooth, **given})


@pytest.mark.parametrize(
    ("toss", "error", "says"),
    [
        (lambda law: cointoss.toss(LIVELY, "mujoco", law=law), UnsupportedError, "law: .* engine mujoco; "),
        (
            lambda law: analytic.toss(ROLLING, law=law),
            UnsupportedError,
            "floor.rolling_friction = 0.0001: accepted: 0 with the law smooth, ",
        ),
        (
            lambda law: analytic.toss(LIVELY, law=law),
            UnsupportedError,
            "floor.restitution = 0.81: accepted: up to max_restitution, 0.8, of the law smooth$",
        ),
        (
            lambda law: analytic.toss_rows(
                rows_of(ROLLING, 2, {"floor.rolling_friction": [0, 1e-4]}), law=law
            ),
            UnsupportedError,
            "floor.rolling_friction = 0.0001: accepted: 0 with the law smooth, ",
        ),
        (
            lambda _: analytic.toss(LIVELY, law="smooth"),  # pyright: ignore[reportArgumentType]
            TypeError,
            "law: of type str, accepted: a cointoss.OwnLaw; a named law is the scenario's floor.contact$",
        ),
        (
            lambda _: analytic.toss_rows(rows_of(LIVELY, 1), law=smooth),  # pyright: ignore[reportArgumentType]
            TypeError,
            "law: of type function, accepted: a cointoss.OwnLaw; ",
        ),
    ],
)
def test_a_toss_takes_a_law_by_the_analytic_engine_alone_and_on_a_floor_it_is_meant_for(toss, error, says):
    with pytest.raises(error, match=f"^{says}"):
        toss(OwnLaw(smooth, max_restitution=0.8))


def test_a_law_that_depends_on_more_than_its_arguments_is_found_out():
    """Compiled, a law keeps the numbers around it as they were: the certificate asks it as it is written."""
    factor = np.array([1.0])

    def drifting(K, v_A, tau, chi, mu):
        return 0.0, 0.0, -(1 + factor[0] * chi) * v_A[2] / K[2][2]

    law_now = OwnLaw(drifting)
    factor[0] = 0.5
    assert of(analytic.toss(scenario(release=TILTED, ending={"max_impacts": 2}), law=law_now), LAW) > 0.1


def test_a_law_is_pickled_by_its_function_and_made_anew():
    law = OwnLaw(errs, tolerance=1e-8, max_restitution=0.9, **FREE)
    again = pickle.loads(pickle.dumps(law))
    assert (again, again.code[1:]) == (law, law.code[1:])


def jumps(K, v_A, tau, chi, mu):
    return 0.0, 0.0, -(1 + chi * (1.0 if v_A[0] < 0.25 else 0.9)) * v_A[2] / K[2][2]


@pytest.mark.parametrize(("slip", "is_smooth"), [(0.1, True), (0.25 - 1e-9, False), (0.4, True)])
def test_beside_a_jump_of_a_law_nothing_is_trusted(slip, is_smooth):
    case = scenario(coin=THIN)
    y = np.zeros(STATE_SIZE)
    y[2], y[3], y[5], y[6:8] = 0.1, slip, -1.0, (math.cos(0.3), math.sin(0.3))
    touch = touch_derivatives(case.body, rules_by(OwnLaw(jumps), case), y)
    named = touch_derivatives(case.body, case.rules, y)
    assert np.isfinite(touch.impulse).all() == is_smooth
    assert (touch.impulse == pytest.approx(named.impulse, abs=1e-9)) == (slip == 0.1)


def test_without_numba_a_law_says_what_to_install(monkeypatch):
    monkeypatch.setattr(own_law, "find_spec", lambda _: None)
    with pytest.raises(ImportError, match=r'^OwnLaw: needs numba: pip install "cointoss-dynamics\[laws\]"$'):
        OwnLaw(superball(1, 1))
