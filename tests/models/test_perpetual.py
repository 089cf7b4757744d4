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


def test_a_loss_at_a_steady_rate_doubles_with_every_doubling_of_time():
    """After time T and n more doublings (2ⁿ - 1) T are still to come."""
    seen = energies(RATE * 2.0 ** np.arange(5))
    for doublings in (1, 10, 60):
        lost = RATE * 2.0**5 * (2.0**doublings - 1)
        assert loss_to_come(seen, NONE, doublings) == pytest.approx(lost, rel=1e-6)


def test_a_loss_that_falls_with_time_is_the_same_in_every_doubling():
    assert loss_to_come(energies([1e-3] * 5), NONE, 50.0) == pytest.approx(50e-3, rel=1e-9)


def test_a_loss_that_shrinks_is_summed_to_its_limit_only_after_six_checks():
    shrinking = 1e-2 * 0.5 ** np.arange(5)
    assert loss_to_come(energies(shrinking), NONE, 60) == pytest.approx(shrinking[-1], rel=1e-9)
    for known in (4, 5):
        assert loss_to_come(energies(shrinking, known), NONE, 60) == pytest.approx(60 * shrinking[-1])


def test_one_loss_that_grew_is_taken_for_what_is_to_come():
    """Of the last three: an older one does not count unless all have shrunk."""
    grew = [1e-3, 1e-3, 1e-3, 2e-3, 1e-3]
    assert loss_to_come(energies(grew), NONE, 3) == pytest.approx(1e-3 * (2 + 4 + 8), rel=1e-9)
    grew_before = [1e-3, 2e-3, 1e-3, 1e-3, 1e-3]
    assert loss_to_come(energies(grew_before), NONE, 3) == pytest.approx(3e-3, rel=1e-9)


def test_what_cannot_be_told_from_no_loss_is_none_and_energy_gained_is_no_evidence():
    assert loss_to_come(energies([NONE / 2] * 5), NONE, 60) == 0
    assert loss_to_come(energies([1e-3, 1e-4, 1e-6, -NONE / 2, NONE / 2]), NONE, 60) == 0
    assert loss_to_come(energies([0, 0, 0, -2 * NONE, 0]), NONE, 60) == np.inf
    began = loss_to_come(energies([0, 0, 0, 1e-6, 0]), NONE, 60)
    assert began > 1, "a loss out of nothing grows without bound"


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


def test_a_coin_that_loses_nothing_is_known_after_four_checks_if_it_can_turn_over():
    case = scenario(coin=ZLOTY)
    assert watched(case, lambda _: 1.0, 1000) == pytest.approx(8 * FIRST_CHECK, abs=1)
    assert watched(case, lambda _: 0.4, 1000) is None
    assert watched(scenario(coin=ZLOTY, air=AIR), lambda _: 1.0, 1000) is None


def test_a_coin_that_loses_steadily_is_never_said_to_go_on_for_ever():
    """The pass is at half the energy; 55 doublings are to come after the fourth check, fewer after others."""
    case = scenario(coin=ZLOTY)
    assert watched(case, lambda t: 1 - 1e-9 * t, 5000) is None
    assert watched(case, lambda t: 1 - 7e-3 * np.log2(t), 5000) is not None
    assert watched(case, lambda t: 1 - 8e-3 * np.log2(t), 5000) is None
    assert watched(case, lambda t: 1 - 1e-3 * t**0.3, 5000) is None
    assert watched(case, lambda t: 0.6 + t**-0.5, 5000) is not None


@pytest.mark.parametrize("motion", [{"v": (1.0, 0.0, 0.0)}, {"w": (0.0, 0.0, 100.0)}], ids=["slide", "spin"])
def test_neither_sliding_nor_spin_about_the_vertical_turns_a_coin_over_on_a_smooth_floor(motion):
    """Spin needs L_z²/(2 J_ξ) of its own to come upright, twice what it has as L_z²/(2 J_ζ) lying flat."""
    rough = scenario(coin=ZLOTY, floor={"contact": "coulomb", "friction": 0.3})
    assert watched(scenario(coin=ZLOTY), lambda _: 0.4, 1000, **motion) is None
    assert watched(rough, lambda _: 0.4, 1000, **motion) is not None


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
