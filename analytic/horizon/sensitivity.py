"""The tangent map of a toss, from event to event: from just after one impact to just after the next.

A small change is one of the state and of the time of the event, (14,); two tosses are compared each at its
own impact. So the saltation matrix, with f the rate of change of the state before and after the impact, D the
derivative of the impact and dt = -(∇gap . dy)/(∇gap . f_before) the delay of the touch,

    dy_after = D (dy + f_before dt) - f_after dt,

falls in two: the last term only brings back the tosses to one time, and dt goes into the time of the event.
At a low hop that term would cost digits.
"""

import numpy as np

from cointoss.analytic.events import EventLog
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.analytic.horizon.flight_tangent import FINE, flight_tangent
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.models.body import Body, Rules
from cointoss.models.records import Array


def event_tangent(body: Body, rules: Rules, toss: EventLog, number: int) -> Array:
    """Return the tangent map from just after the impact before to just after impact `number`, (14, 14).

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
        number: of the impact, from 0; the first map starts at the release.
    """
    start, y = toss.start_states[number], toss.start_states[number].copy()
    duration = fly(body, y, rules.max_time - toss.start_times[number], False).time
    tangents = np.eye(STATE_SIZE)
    flight_tangent(body, state_of(start), state_of(y), duration, FINE, tangents)
    touch = touch_derivatives(body, rules, y)
    delay = -np.append(touch.gap, 0) / touch.closing
    to_the_touch = np.eye(STATE_SIZE + 1) + np.outer(np.append(touch.rate, 1), delay)
    return _with_time(touch.after) @ to_the_touch @ _with_time(tangents.T)


def _with_time(of_state: Array) -> Array:
    """Return a map of the state, (13, 13), as one of an event that keeps its time, (14, 14)."""
    of_event = np.eye(STATE_SIZE + 1)
    of_event[:STATE_SIZE, :STATE_SIZE] = of_state
    return of_event
