"""The tangent map of a toss from event to event, in parts: a flight, and the impact that ends it."""

from cointoss.analytic.flight.flying import fly
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.analytic.horizon.flight_tangent import FINE, flight_tangent
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives
from cointoss.models.body import Body, Rules
from cointoss.models.kernel.arrays import Row, Table
from cointoss.models.kernel.compiled import compiled


@compiled
def event_tangent(body: Body, rules: Rules, start: Row, left: float, tangent: Table) -> None:
    """Write the parts of the tangent map from just after an impact to just after the next.

    Args:
        body: the coin.
        rules: floor and ending.
        start: state after the impact, (13,).
        left: how long the toss may last from there [s].
        tangent: where they go, in its rows: the map of the flight, transposed, (13, 13); of the impact,
            (13, 13); the rate of change at the touch, (13,); and minus the delay of the touch for each change
            of the state there, (13,).
    """
    y, touched = start.copy(), tangent[STATE_SIZE : 2 * STATE_SIZE]
    duration = fly(body, y, left, False).time
    for i in range(STATE_SIZE):
        for k in range(STATE_SIZE):
            tangent[i, k] = 1.0 if i == k else 0.0
    flight_tangent(body, state_of(start), state_of(y), duration, FINE, tangent[:STATE_SIZE])
    touch = touch_derivatives(body, rules, y)
    for i in range(STATE_SIZE):
        for k in range(STATE_SIZE):
            touched[i, k] = touch.after[i, k]
        tangent[2 * STATE_SIZE, i] = touch.rate[i]
        tangent[2 * STATE_SIZE + 1, i] = touch.gap[i] / touch.closing
