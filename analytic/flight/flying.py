"""A flight: its first touch, and its states; in closed form where the coin turns so, else integrated."""

import numpy as np

from cointoss.analytic.flight.closed_flight import closed_graze, fly_closed, sample_closed
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.analytic.flight.state_vector import STATE_SIZE, spin_of
from cointoss.analytic.flight.touch_search import fly_by_steps
from cointoss.analytic.flight.turning import turns_in_closed_form
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled


@compiled
def fly(body: Body, y: Array, longest: float) -> tuple[float, bool, int]:
    """Fly until the coin first touches the floor.

    Args:
        body: the coin.
        y: state at the start, (13,); becomes the state at the touch, or at the end of the flight.
        longest: the longest flight wanted [s].

    Returns:
        The time of flight [s], whether the coin touches, and the number of gap evaluations.
    """
    if body.air.exponent is None and turns_in_closed_form(body, spin_of(y)):
        return fly_closed(body, y, longest)
    flown, touches, evaluations, _ = fly_by_steps(body, y, longest, False)
    return flown, touches, evaluations


@compiled
def fly_with_graze(body: Body, y: Array, longest: float) -> tuple[float, float]:
    """Fly as `fly` does, and return how near to the floor the coin came before.

    Returns:
        The time of flight [s], and a graze: a height such that no minimum of the gap on the way is below half
        of it, or infinity [m].
    """
    if body.air.exponent is None and turns_in_closed_form(body, spin_of(y)):
        start = y.copy()
        flown, _, _ = fly_closed(body, y, longest)
        return flown, closed_graze(body, start, flown)
    flown, _, _, graze = fly_by_steps(body, y, longest, True)
    return flown, graze


@compiled
def sample(body: Body, start: Array, start_time: float, times: Array, states: Array) -> int:
    """Write the states of one flight at `times` into `states`; for the arguments see `sample_flight`.

    Returns:
        The number of steps up to the last time: on a parabola one.
    """
    if body.air.exponent is None and turns_in_closed_form(body, spin_of(start)):
        return sample_closed(body, start, start_time, times, states)
    return sample_flight(body, start, start_time, times, states)


@compiled
def steps_of(body: Body, start: Array, duration: float) -> int:
    """Return the number of steps of a flight of this duration [s] from the state `start`, (13,)."""
    return sample(body, start, 0.0, np.array([duration]), np.empty((1, STATE_SIZE)))
