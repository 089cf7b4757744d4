"""Sustained contact a step at a time, at the tolerance of flights, and coins upright on the floor."""

import numpy as np

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.following import follow, start_following
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.numerics.tolerances import STEP_ERROR
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import Body
from cointoss.models.records import Array


def follow_step(body: Body, friction: FloorFriction, mode: int, y: Array, dt: float):
    """Follow a contact for one step, or to its end; see `cointoss.analytic.contact.following.follow`."""
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


def upright_coin(body: Body, phase: float, turn_rate: float, roll_rate: float) -> Array:
    """Return a coin upright on the floor that turns about the vertical and rolls [rad/s]."""
    y = np.array([0, 0, 0, 0.1, -0.2, 0, *quaternion_from_angles((0.3, np.pi / 2, phase)), 0, 0, roll_rate])
    up = rotation_matrix(tuple(y[6:10]))[2]
    y[10:13] += turn_rate * np.array(up)
    upright.put_on_floor(body, y)
    return y
