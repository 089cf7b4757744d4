"""A flight: its first touch, and its states; in closed form where the coin turns so, else integrated."""

from cointoss.analytic.flight.closed_flight import fly_closed, sample_closed
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.analytic.flight.state_vector import spin_of
from cointoss.analytic.flight.touch_search import Flown, fly_by_steps
from cointoss.analytic.flight.turning import turns_in_closed_form
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled


@compiled
def fly(body: Body, y: Array, longest: float, with_graze: bool) -> Flown:
    """Fly until the coin first touches the floor.

    Args:
        body: the coin.
        y: state at the start, (13,); becomes the state at the touch, or at the end of the flight.
        longest: the longest flight wanted [s].
        with_graze: whether minima of the gap are looked for on the way; they change nothing else.
    """
    if body.air.exponent is None and turns_in_closed_form(body, spin_of(y)):
        return fly_closed(body, y, longest, with_graze)
    return fly_by_steps(body, y, longest, with_graze)


@compiled
def sample(body: Body, start: Array, start_time: float, times: Array, states: Array) -> int:
    """Write the states of one flight at `times` into `states`; for the arguments see `sample_flight`.

    Returns:
        The number of steps up to the last time: on a parabola one.
    """
    if body.air.exponent is None and turns_in_closed_form(body, spin_of(start)):
        return sample_closed(body, start, start_time, times, states)
    return sample_flight(body, start, start_time, times, states)
