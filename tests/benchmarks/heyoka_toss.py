"""Tosses by heyoka's Taylor series in double precision, whose event detection misses no touch."""

from collections.abc import Callable, Sequence

import heyoka as hy
import numba
import numpy as np

from cointoss.analytic.contact.resets import hit
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.models.ending import final_face
from cointoss.models.geometry import evaluate_gap
from cointoss.models.records import IMPACT_ROW, Array, Ending
from cointoss.models.scenario import Scenario
from tests.helpers.extended import Extended, integrator

Impacts = tuple[list[float], list[int]]
"""Their times [s], and the faces that are up at them."""
Strike = Callable[[Array], tuple[int, bool]]
"""Of y at a touch, which becomes the state after the impact: the face up, and whether the toss ends."""
LIFT = 1e-16
"""Above the floor at lift-off [m]: else that too would be a zero of the gap to heyoka."""
LATEST = 10.0
"""End of a flight without a touch [s]."""


def prepared(scenarios: Sequence[Scenario], *, in_lanes: bool = False) -> Callable[[], list[Impacts]]:
    """Return what makes tosses of one coin, one by one or in heyoka's batch mode."""
    numbers, strike = [Extended(one) for one in scenarios], striking(scenarios[0])
    most = scenarios[0].ending.max_impacts
    if in_lanes:
        return lambda: toss_batch(numbers, strike, most)
    return lambda: [toss(one, strike, most) for one in numbers]


def striking(scenario: Scenario) -> Strike:
    """Compile the engine's impacts of a coin as a function of its state alone, for a call costs little so."""
    body, rules = scenario.body, scenario.rules

    @numba.njit(error_model="numpy")
    def strike(y):
        row = np.zeros(1, dtype=IMPACT_ROW)
        ending = hit(body, rules, rules.restitution, y, row[0])
        y[2] += max(LIFT - evaluate_gap(body, state_of(y)).gap, 0.0)
        if ending == Ending.NONE:
            _, ending = final_face(body, rules, state_of(y), 0.0)
        return row[0].face, ending != Ending.NONE

    return strike


def toss(numbers: Extended, strike: Strike, most: int | None) -> Impacts:
    """Return the impacts of a toss.

    Args:
        numbers: the parameters of the motion, and the release.
        strike: the impacts of the same coin.
        most: impacts after which the toss ends, if not before.
    """
    flight = integrator(float, True)
    flight.pars[:] = numbers.parameters.astype(float)
    flight.time, flight.state[:] = 0.0, numbers.start.astype(float)
    # heyoka's state has neither x nor y.
    y = np.zeros(STATE_SIZE)
    times, faces, ended = [], [], False
    while not ended and len(times) != most:
        flight.propagate_until(LATEST)
        y[2:] = flight.state
        face, ended = strike(y)
        flight.state[:] = y[2:]
        times.append(flight.time)
        faces.append(face)
    return times, faces


def toss_batch(numbers: list[Extended], strike: Strike, most: int | None) -> list[Impacts]:
    """Return the impacts of many tosses in heyoka's batch mode: as many at once as a vector holds.

    Each lane flies and bounces by itself, and takes the next toss when its own is over.

    Args:
        numbers: the parameters of the motion, the same for all, and the releases.
        strike: the impacts of the same coin.
        most: impacts after which a toss ends, if not before.
    """
    lanes = hy.recommended_simd_size()
    flight = integrator(float, True, lanes)
    flight.pars[:] = numbers[0].parameters.astype(float)[:, None]
    starts = np.array([one.start.astype(float) for one in numbers])
    tosses: list[Impacts] = [([], []) for _ in numbers]
    flown, waiting, left = list(range(lanes)), lanes, len(numbers)
    begun = np.zeros(lanes)
    flight.set_time(0.0)
    flight.reset_cooldowns()
    flight.state[:] = starts[np.arange(lanes) % len(starts)].T
    y = np.zeros(STATE_SIZE)
    while left:
        flight.step()
        for lane, (outcome, _) in enumerate(flight.step_res):
            # Event number n, from 0, is told as -1 - n.
            if not -len(flight.t_events) <= int(outcome) < 0:
                continue
            y[2:] = flight.state[:, lane]
            face, ended = strike(y)
            flight.state[:, lane] = y[2:]
            if flown[lane] >= len(tosses):
                continue
            times, faces = tosses[flown[lane]]
            times.append(flight.time[lane] - begun[lane])
            faces.append(face)
            if ended or len(times) == most:
                left -= 1
                flown[lane], waiting = waiting, waiting + 1
                begun[lane] = flight.time[lane]
                flight.state[:, lane] = starts[flown[lane] % len(starts)]
    return tosses
