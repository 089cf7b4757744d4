"""Outcomes that are called certain: no rounding changes one, and ties are never certain."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.entries import certainty_of
from cointoss.analytic.events import TossEnd
from cointoss.analytic.horizon.certainty import start_of
from cointoss.analytic.horizon.horizon import Horizon
from cointoss.analytic.runs import horizon_of, run
from cointoss.analytic.settings import MANY
from cointoss.analytic.toss import state_at_release
from cointoss.models.records import Ending, Outcome
from tests.helpers.bits import cases
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import AIR, THIN, ZLOTY, scenario

ROUNDING, MOVED = 2e-15, 6
"""The size of changes to a release, relative, and how many of them are tried."""


@pytest.mark.parametrize("count", [60, pytest.param(2000, marks=pytest.mark.long)])
def test_no_certain_outcome_changes_and_most_that_do_not_are_called_certain(count):
    """Tosses of all coins, floors and airs; in truth an outcome is certain that no moved release changes."""
    rng, called, in_truth = np.random.default_rng(12), 0, 0
    for number in range(count):
        case = draw_toss(rng, imperfect=number % 2 == 1)
        body, rules, start = case.body, case.rules, state_at_release(case.release)
        toss = run(body, rules, start, MANY)
        horizon = horizon_of(body, rules, toss)
        certain = certainty_of(body, rules, toss.rows, toss.started, toss.verdict, horizon).certain
        moved = (start * (1 + ROUNDING * rng.normal(size=len(start))) for _ in range(MOVED))
        same = all(run(body, rules, y, MANY).outcome == toss.outcome for y in moved)
        assert same or not certain
        called, in_truth = called + certain, in_truth + same
    assert called > in_truth / 2 > count / 4


TIES = {
    "its mass centre comes down exactly above its rim": (
        {
            "coin": {"mass": 0.01, "radius": 0.0125, "thickness": 0.005},
            "release": {"position": [0, 0, 0.2], "angles": [0, float(np.arctan2(2 * 0.0125, 0.005)), 0]},
        },
        {Outcome.EDGE, Outcome.HEADS},
        1e-7,
    ),
    "cos(90°) = 6e-17 decides its face": (
        {"coin": THIN, "release": {"position": [0, 0, 0.2], "angles": [0, np.pi / 2, 0]}},
        {Outcome.HEADS, Outcome.TAILS},
        1e-13,
    ),
    "rounding decides its end": (
        {
            "coin": ZLOTY,
            "floor": {"restitution": 0.9},
            "release": {
                "position": [0, 0, 0.5870748585344443],
                "angles": [2.9217774732493194, 5.284147883021898, 4.680012721511208],
                "angular_velocity": [0.9562029440338513, -8.525187897557554, -11.073491177609803],
            },
        },
        {Outcome.EDGE, Outcome.HEADS},
        1e-15,
    ),
}
"""Tosses, the outcomes between which they end, and by less than which part a state changes one to the other:
far less than the engine's errors have grown to, and of a coin that has just been released less than all."""


@pytest.mark.parametrize("tie", TIES)
def test_a_coin_that_ends_between_two_outcomes_is_not_certain_and_says_which(tie):
    parts, outcomes, most = TIES[tie]
    tossed = analytic.toss(scenario(**{"floor": {"restitution": 0.5}, **parts}))
    other = tossed.other_outcome
    assert tossed.outcome_certain is False
    assert other is not None
    assert {tossed.outcome, other.outcome} == outcomes
    assert 0 < other.change < most
    assert tossed.outcome_told == f"{tossed.outcome} or {other.outcome}: {other.told}"


def test_another_outcome_is_another_one():
    """Of a toss whose neighbours differ from it in their touches alone there is none."""
    tosses = [analytic.toss(case) for case in cases().values() if case.air.exponent == 0]
    assert sum(toss.outcome_certain is False for toss in tosses if toss.outcome != Outcome.UNDECIDED) > 1
    for toss in tosses:
        assert toss.other_outcome is None or toss.other_outcome.outcome != toss.outcome


def test_an_outcome_with_another_ending_or_none_to_change_is_not_certain():
    case = scenario(floor={"restitution": 0.5}, release={"position": [0, 0, 0.01]})
    log = run(case.body, case.rules, state_at_release(case.release), MANY)
    horizon = horizon_of(case.body, case.rules, log)

    def certainty(outcome, ending):
        verdict = TossEnd(outcome, ending)
        return certainty_of(case.body, case.rules, log.rows, log.started, verdict, horizon)

    assert certainty(log.outcome, log.ending).certain
    assert not certainty(log.outcome, Ending.PERIODIC).certain
    # No neighbour is tossed.
    for outcome in (Outcome.UNDECIDED, Outcome.TRANSIENT):
        assert certainty(outcome, log.ending) == (False, outcome, 0, 0.0)


def test_a_neighbour_is_tossed_in_the_time_that_is_left():
    """A coin that settles late, in a toss that is cut off soon after."""
    case = scenario(
        air=AIR, floor={"restitution": 0.7}, release={"position": [0, 0, 0.3], "angles": [0, 1, 0]}
    )
    whole = analytic.toss(case)
    assert whole.outcome_certain
    for spare, certain in ((1e-3, True), (-1e-3, False)):
        cut = analytic.toss(case.replace("ending.max_time", whole.end_time + spare))
        assert cut.outcome_certain is certain


FALL = (2 * 0.3 / 9.81) ** 0.5
"""The time of a fall from 0.5 m to a hand at 0.2 m [s]."""
CERTAIN = {
    # The last digit decides whether it is caught at once.
    "released downwards at the height of the hand": (
        {
            "floor": {"restitution": 0.9},
            "release": {
                "position": [0, 0, 0.05],
                "velocity": [0, 0, -1.0],
                "angles": [0, 2.08, 0],
                "angular_velocity": [-74, -70, -35],
            },
            "ending": {"caught": 0.05},
        },
        None,
        False,
    ),
    # Without any error the coin stays flat; with the least tilt it tumbles.
    **{
        f"flat with energy to turn over, h = {h}, ω = {turning}, χ = {chi}": (
            {
                "coin": {**ZLOTY, "thickness": h},
                "floor": {"restitution": chi},
                "release": {"position": [0, 0, height], "angular_velocity": [0, 0, turning]},
            },
            {Outcome.HEADS},
            False,
        )
        for h in (0.0, 2e-3)
        for turning in (0.0, 20.0)
        for chi, height in ((0.4, 0.5), (0.5, 0.2), (0.6, 0.1), (0.8, 0.05))
    },
    "flat from low": (
        {"floor": {"restitution": 0.5}, "release": {"position": [0, 0, 0.01]}},
        {Outcome.HEADS},
        True,
    ),
    "cut short": (
        {"release": {"position": [0, 0, 0.2]}, "ending": {"max_impacts": 1}},
        {Outcome.UNDECIDED},
        False,
    ),
    # It turns at ω from heads, and is upright when ω t = π/2.
    **{
        f"caught, turned by {angle:.2f}": (
            {
                "release": {"position": [0, 0, 0.5], "angular_velocity": [float(angle / FALL), 0, 0]},
                "ending": {"caught": 0.2},
            },
            {Outcome.HEADS, Outcome.TAILS},
            certain,
        )
        for angle, certain in ((1.0, True), (np.pi / 2, False))
    },
}
"""Tosses, the outcomes they may have, and whether that is certain."""


@pytest.mark.parametrize("name", CERTAIN)
def test_an_outcome_is_certain_that_no_error_changes(name):
    parts, outcomes, certain = CERTAIN[name]
    tossed = analytic.toss(scenario(**parts))
    assert outcomes is None or tossed.outcome in outcomes
    assert tossed.outcome_certain is certain


def test_a_neighbour_starts_at_the_last_trusted_impact_with_what_the_toss_has_left():
    """At the last but one where the toss ended there; before the first where a hand may catch, or flat."""
    ending = {"max_impacts": 50, "max_time": 50.0}
    for tilt in (0.0, 1.0):
        release = {"angles": [0, tilt, 0], "angular_velocity": [0, 0, 5.0]}
        case = scenario(floor={"restitution": 0.6}, release=release, ending=ending)
        log = run(case.body, case.rules, state_at_release(case.release))
        n = len(log.rows)
        assert (log.verdict.ending, n > 3) == (Ending.SETTLED, True)
        for horizon, caught, impact in ((n, np.inf, n - 1), (3, np.inf, 3), (3, 0.2, 0)):
            known, first = Horizon(horizon, np.zeros((12, 12))), impact if tilt else 0
            start = start_of(case.rules._replace(caught=caught), log.rows, log.started, known)
            assert start.impact == first
            assert np.array_equal(start.state, log.started.states[first])
            assert start.rules.max_impacts == 50 - first
            assert start.rules.max_time == 50.0 - log.started.times[first]
            assert start.rules.caught == caught
