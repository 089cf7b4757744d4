"""Tosses by heyoka's Taylor series in double precision, whose event detection misses no touch."""

import heyoka as hy
import numpy as np

from cointoss.analytic.flight.state_vector import STATE_SIZE
from tests.benchmarks.one_coin import OneCoin
from tests.helpers.extended import Extended, integrator

Impacts = tuple[list[float], list[int]]
"""Their times [s], and the faces that are up at them."""


def toss(numbers: Extended, coin: OneCoin, latest: float, most: int | None = None) -> Impacts:
    """Give the impacts of a toss.

    Args:
        numbers: the parameters of the motion, and the release.
        coin: the same, for the impacts.
        latest: end of a flight without a touch [s].
        most: impacts after which the toss ends, if not before.
    """
    flight = integrator(float, True)
    flight.pars[:] = numbers.parameters.astype(float)
    flight.time, flight.state[:] = 0.0, numbers.start.astype(float)
    # heyoka's state has neither x nor y.
    y = np.zeros(STATE_SIZE)
    times, faces, ended = [], [], False
    while not ended and len(times) != most:
        flight.propagate_until(latest)
        y[2:] = flight.state
        face, ended = coin.strike(y)
        flight.state[:] = y[2:]
        times.append(flight.time)
        faces.append(face)
    return times, faces


def toss_batch(numbers: list[Extended], coin: OneCoin, most: int) -> list[Impacts]:
    """Give the impacts of many tosses in heyoka's batch mode: so many at once as a processor's vector holds.

    Each lane flies and bounces by itself, and takes the next toss when its own is over.

    Args:
        numbers: the parameters of the motion, the same for all, and the releases.
        coin: the same, for the impacts.
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
            face, ended = coin.strike(y)
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
