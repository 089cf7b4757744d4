"""The modes of sustained contact, each with the same functions: rate, floor, margin, landing, next event."""

import numpy as np

from cointoss.analytic.automaton import Event, Mode
from cointoss.analytic.contact import edge, one_rim, upright
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.state_vector import STATE_SIZE, velocity_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import scale, subtract


@compiled
def rate(body, friction, mode, rim, y, dy):
    """Write the rate of change of the state y of a coin in contact into dy; both (13,).

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        rim: the lower one, where the coin is in contact at one rim.
        y: state, (13,).
        dy: where its rate of change goes, (13,).

    Returns:
        How far the mode is from its end: positive in it, 0 or below past it.
    """
    if mode == Mode.UPRIGHT:
        return upright.rate(body, friction, y, dy)
    return one_rim.rate(body, friction, mode, rim, y, dy)


@compiled
def floor_force(body, friction, mode, y):
    """Return the floor's force, of both rims where a coin is upright, space frame, (3,) [N].

    It is what the rate of change in contact has more than that of free flight.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        y: state, (13,).
    """
    free, held = np.empty(STATE_SIZE), np.empty(STATE_SIZE)
    derivative(body, y, free)
    rate(body, friction, mode, one_rim.lower_rim_of(y), y, held)
    return scale(body.mass, subtract(velocity_of(held), velocity_of(free)))


@compiled
def put_on_floor(body, friction, mode, rim, y):
    """Bring the points in contact to the floor, and their velocities to what the mode allows; see `rate`."""
    if mode == Mode.UPRIGHT:
        upright.put_on_floor(body, y)
    else:
        one_rim.put_on_floor(body, friction, mode, rim, y)


@compiled
def landing(body, mode, rim, y):
    """Return which part of the coin lands in the state y just past the end of a mode; see `rate`."""
    return Event.NONE if mode == Mode.UPRIGHT else one_rim.landing(body, rim, y)


@compiled
def time_to_landing(body, mode, rim, y, dy):
    """Return about when the other rim will land [s], infinite where that is not in sight; see `rate`."""
    return np.inf if mode == Mode.UPRIGHT else one_rim.time_to_landing(body, rim, y, dy)


@compiled
def next_event(body, friction, mode, y):
    """Return the event by which a mode that came to its end without a landing gives way; see `rate`."""
    if mode == Mode.UPRIGHT:
        upright.tip_over(body, friction, y)
    return one_rim.next_event(body, friction, mode, y)


@compiled
def edge_event(body, friction, mode, steps, early, y):
    """Return whether a coin on its edge comes upright, or stands for good: `Event.ENDS`.

    Args:
        body: the coin.
        friction: `FloorFriction`.
        mode: number of the `Mode`, in contact.
        steps: made in the mode so far.
        early: whether a coin that still rocks may be said to stand.
        y: state, (13,); put upright where the coin comes so.
    """
    if mode == Mode.UPRIGHT:
        return edge.event_of_upright_coin(body, friction, steps, y)
    return edge.event_at_one_rim(body, friction, mode, steps, early, y)
