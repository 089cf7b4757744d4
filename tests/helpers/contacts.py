"""Sustained contact a step at a time, at the tolerance of flights."""

import numpy as np

from analytic.contact.following import follow, start_following
from analytic.contact.resistance import FloorFriction
from analytic.numerics.tolerances import STEP_ERROR
from models.body import Body
from models.records import Array


def follow_step(body: Body, friction: FloorFriction, mode: int, y: Array, dt: float):
    """Follow a contact for one step, or to its end; see `analytic.contact.following.follow`."""
    return follow(body, friction, mode, y, dt, STEP_ERROR, start_following(body, friction, mode, y))


def follow_for(body: Body, friction: FloorFriction, mode: int, y: Array, time: float) -> tuple[Array, Array]:
    """Return the states and times after every step of a contact that goes on for `time`."""
    y, states, times, dt = y.copy(), [y.copy()], [0.0], np.inf
    while times[-1] < time:
        made, dt, over, _ = follow_step(body, friction, mode, y, min(dt, time - times[-1]))
        assert not over
        states.append(y.copy())
        times.append(times[-1] + made)
    return np.array(states), np.array(times)
