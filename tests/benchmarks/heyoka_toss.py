"""The toss by heyoka's Taylor series in double precision, whose event detection misses no touch."""

import numpy as np

from analytic.flight.state_vector import STATE_SIZE
from tests.benchmarks.one_coin import OneCoin
from tests.helpers.extended import Extended, integrator


def toss(
    numbers: Extended, coin: OneCoin, latest: float, most: int | None = None
) -> tuple[list[float], list[int]]:
    """Give the times of the impacts [s] and the faces that are up at them.

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
