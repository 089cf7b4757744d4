"""When the energy that a coin loses in vacuum is said to die away."""

import numpy as np
import pytest

from cointoss.models.barriers import barrier
from cointoss.models.ending import classify_ending
from cointoss.models.perpetual import (
    FIRST_CHECK,
    energy_history,
    energy_loss_converges,
    loss_to_come,
    start_history,
)
from cointoss.models.records import Ending, Outcome
from cointoss.models.state import state
from tests.helpers.draws import AIR, ZLOTY, scenario

G = 9.81
NONE = 1e-9
STILL = (0.0, 0.0, 0.0)
UNKNOWN = np.inf
RATE = 1e-6


@pytest.fixture(autouse=True)
def _silent():
    """What was not known yet is no number when it is taken from itself, as in compiled code."""
    with np.errstate(invalid="ignore"):
        yield


def energies(losses, known=6):
    """Give the energies at the last six checks [J], of which so many are known, for the losses between."""
    seen = 1.0 - np.cumsum([0.0, *losses])
    return np.array([UNKNOWN] * (6 - known) + list(seen[-known:]))


SHRINKING = 1e-2 * 0.5 ** np.arange(5)
LOSSES = {
    # After time T and n more doublings (2ⁿ - 1) T are still to come.
    "at a steady rate, 1": (RATE * 2.0 ** np.arange(5), 6, 1, RATE * 2.0**5),
    "at a steady rate, 10": (RATE * 2.0 ** np.arange(5), 6, 10, RATE * 2.0**5 * (2.0**10 - 1)),
    "at a steady rate, 60": (RATE * 2.0 ** np.arange(5), 6, 60, RATE * 2.0**5 * (2.0**60 - 1)),
    "as much in every doubling": ([1e-3] * 5, 6, 50.0, 50e-3),
    # Summed to its limit only after six checks.
    "shrinking, six checks": (SHRINKING, 6, 60, SHRINKING[-1]),
    "shrinking, five checks": (SHRINKING, 5, 60, 60 * SHRINKING[-1]),
    "shrinking, four checks": (SHRINKING, 4, 60, 60 * SHRINKING[-1]),
    # Of the last three: an older one that grew does not count unless all have shrunk.
    "grew once": ([1e-3, 1e-3, 1e-3, 2e-3, 1e-3], 6, 3, 1e-3 * (2 + 4 + 8)),
    "grew before": ([1e-3, 1e-3, 2e-3, 1e-3, 1e-3], 6, 3, 3e-3),
    "none": ([NONE / 2] * 5, 6, 60, 0.0),
    "none in the end": ([1e-3, 1e-4, 1e-6, -NONE / 2, NONE / 2], 6, 60, 0.0),
    "a gain": ([0, 0, 0, -2 * NONE, 0], 6, 60, np.inf),
    # A loss out of nothing grows a thousandfold with every doubling.
    "a beginning": ([0, 0, 0, 1e-6, 0], 6, 2, NONE * (1e3 + 1e6)),
}


@pytest.mark.parametrize(("losses", "known", "doublings", "expected"), LOSSES.values(), ids=LOSSES)
def test_the_loss_to_come_continues_the_growth_of_the_last_losses(losses, known, doublings, expected):
    found = loss_to_come(energies(losses, known), NONE, doublings)
    assert found == pytest.approx(expected, rel=1e-6)


def converges(case, z, time, history, *, v=STILL, w=STILL):
    flat = state((0.0, 0.0, z), v, (1.0, 0.0, 0.0, 0.0), w)
    return energy_loss_converges(case.body, case.rules, flat, time, history)


def watched(case, share_at, until, v=STILL, w=STILL):
    """Tell when a coin is said to turn over for ever, in √(r/g) from its first contact on.

    Its energy is that of C at a share of twice the radius, and of its velocity and spin.
    """
    history, unit = energy_history(1e-12), (ZLOTY["radius"] / G) ** 0.5
    start_history(case.body, history, 0.0)
    for elapsed in np.arange(1.0, until):
        z = 2 * ZLOTY["radius"] * share_at(elapsed)
        if converges(case, z, elapsed * unit, history, v=v, w=w):
            return elapsed
    return None


ROUGH = {"floor": {"contact": "coulomb", "friction": 0.3}}
SLIDE, SPIN = {"v": (1.0, 0.0, 0.0)}, {"w": (0.0, 0.0, 100.0)}
OFF_BALANCE = {**ROUGH, "coin": {**ZLOTY, "center_of_mass": [0.0, 0.0, 4e-4]}}
"""The passes are at 12.58 and 12.51 mm, 50.3 and 50.1 % of twice the radius."""
WATCHED = {
    "loses nothing": ({}, lambda _: 1.0, {}, 8 * FIRST_CHECK),
    "cannot turn over": ({}, lambda _: 0.4, {}, None),
    "in air": ({"air": AIR}, lambda _: 1.0, {}, None),
    "against resistance": ({"floor": {"rolling_friction": 1e-4}}, lambda _: 1.0, {}, None),
    "down a slope": ({"floor": {**ROUGH["floor"], "slope": 0.1}}, lambda _: 1.0, {}, None),
    # The pass is at half the energy; 55 doublings are to come after the fourth check.
    "loses steadily": ({}, lambda t: 1 - 1e-9 * t, {}, None),
    "loses slowly in every doubling": ({}, lambda t: 1 - 7e-3 * np.log2(t), {}, 8 * FIRST_CHECK),
    "loses fast in every doubling": ({}, lambda t: 1 - 8e-3 * np.log2(t), {}, None),
    "loses by a power of time": ({}, lambda t: 1 - 1e-3 * t**0.3, {}, None),
    "tends to a height": ({}, lambda t: 0.6 + t**-0.5, {}, 32 * FIRST_CHECK),
    "above both passes": (OFF_BALANCE, lambda _: 0.504, {}, 8 * FIRST_CHECK),
    "between both passes": (OFF_BALANCE, lambda _: 0.502, {}, None),
    # Spin needs L_z²/(2 J_ξ) of its own to come upright, twice what it has as L_z²/(2 J_ζ) lying flat.
    "slides on a smooth floor": ({}, lambda _: 0.4, SLIDE, None),
    "slides on a rough floor": (ROUGH, lambda _: 0.4, SLIDE, 8 * FIRST_CHECK),
    "spins on a smooth floor": ({}, lambda _: 0.4, SPIN, None),
    "spins on a rough floor": (ROUGH, lambda _: 0.4, SPIN, 8 * FIRST_CHECK),
    # The paper's tests compare with m g r; eq. (20) leaves the sliding out.
    "slides, the paper's test": ({"ending": {"test": "paper"}}, lambda _: 0.4, SLIDE, 8 * FIRST_CHECK),
    "slides, eq. (20)": ({"ending": {"test": "paper_smooth"}}, lambda _: 0.4, SLIDE, None),
}


@pytest.mark.parametrize(("parts", "share_at", "motion", "expected"), WATCHED.values(), ids=WATCHED)
def test_a_coin_goes_on_for_ever_where_what_it_loses_leaves_enough_to_turn_over(
    parts, share_at, motion, expected
):
    """It is known at the fourth check, or at the sixth where its losses shrink."""
    found = watched(scenario(**{"coin": ZLOTY, **parts}), share_at, 5000, **motion)
    assert found == (None if expected is None else pytest.approx(expected, abs=1))


def test_checks_missed_in_a_long_flight_count_for_nothing():
    """Else energies of nearly the same moment would pass for those of as many doublings."""
    case, history, unit = scenario(coin=ZLOTY), energy_history(1e-12), (ZLOTY["radius"] / G) ** 0.5
    start_history(case.body, history, 0.0)
    said = [
        converges(case, 2 * ZLOTY["radius"], elapsed * unit, history)
        for elapsed in (5000, 5001, 5002, 5003, 5004)
    ]
    assert not any(said)
    assert history.next_check[0] / unit == pytest.approx(8192)


def test_a_loss_that_no_engine_may_overlook_is_one():
    """An engine that can tell little does not make a coin that loses steadily one that goes on for ever."""
    case, history, unit = scenario(coin=ZLOTY), energy_history(8e-5), (ZLOTY["radius"] / G) ** 0.5
    start_history(case.body, history, 0.0)
    for k in range(7):
        z = 4 * ZLOTY["radius"] * (1 - 0.05 * k)
        assert not converges(case, z, 64 * 2**k * unit * 1.001, history)


@pytest.mark.parametrize(
    ("below", "expected"),
    [(3e-6, (Outcome.PERPETUAL, Ending.PERPETUAL)), (5e-6, (Outcome.HEADS, Ending.SETTLED))],
)
def test_a_coin_that_steps_of_contact_may_have_taken_below_the_pass_is_not_settled(below, expected):
    """Their errors begin with the first contact."""
    case, history, unit = scenario(coin=ZLOTY), energy_history(8e-5), (ZLOTY["radius"] / G) ** 0.5
    z = barrier(case.body, 1.0) / (case.body.mass * G) * (1 - below)
    tilted = state((0.0, 0.0, z), STILL, (0.8, 0.6, 0.0, 0.0), STILL)
    assert classify_ending(case.body, case.rules, tilted, 0.0, history) == (Outcome.HEADS, Ending.SETTLED)
    start_history(case.body, history, 0.0)
    found = [
        classify_ending(case.body, case.rules, tilted, 64 * 2**k * unit * 1.001, history) for k in range(4)
    ]
    assert found[-1] == expected
