"""Flights of an ideal coin that turns in closed form: on a parabola, or in linear air piece by piece."""

import numpy as np

from analytic.fall import ORDER, ROWS, Z, expand, fallen, piece_length
from analytic.first_touch import Found, begun, bounds_of, first_touch
from analytic.flight import attitude_of, position_of, spin_of, velocity_of
from analytic.rim import TOUCH, closing_speed, smallest_flight
from analytic.turning import turn, turning_of
from models.body import in_vacuum
from models.compiled import compiled
from models.vectors import norm


@compiled
def fly_closed(body, y, longest):
    """Fly until the coin first touches the floor; see `flying.fly`.

    The coin is one that `turns_in_closed_form`.
    """
    time, graze, looks = 0.0, np.inf, 0
    while True:
        height, speed = closing_speed(body, y)
        inside = 0.0
        if height <= TOUCH * body.radius:
            # A coin that starts on the floor has just been lifted off it: only a clear descent is a touch.
            shortest, slowest = smallest_flight(body, y)
            if speed < -slowest:
                return time, True, graze, looks
            inside = shortest
        found, flown, search = _search(body, y, inside, longest - time)
        time, graze, looks = time + flown, min(graze, search.graze), looks + search.looks
        # After a graze it flies on from there.
        if found != Found.GRAZE:
            return time, found == Found.TOUCH, graze, looks


@compiled
def _search(body, y, inside, longest):
    """Fly to a touch, to a graze or to the end; y becomes the state there.

    Args:
        body: the coin.
        y: state at the start, (13,).
        inside: when the search starts [s].
        longest: the longest flight wanted [s].

    Returns:
        What is `Found`, when, and the `Search`.
    """
    turning = turning_of(body, attitude_of(y), spin_of(y))
    search = begun()
    if in_vacuum(body):
        heights = (y[2], y[5], -body.gravity / 2)
        bounds = bounds_of(turning, body.gravity, 0.0, 0.0)
        found, t, search = first_touch(body, turning, heights, 0.0, inside, longest, bounds, search)
        fall_freely(body, y, t, y)
        turn(turning, y, t, y)
        return found, t, search
    series = np.empty((ROWS, ORDER + 1))
    x, v, t, found = position_of(y), velocity_of(y), 0.0, Found.NOTHING
    while t < longest and found == Found.NOTHING:
        length = min(piece_length(body, turning, t), longest - t)
        frame = expand(body, turning, t, x, v, series)
        bounds = _bounds(body, turning, v, length)
        found, made, search = first_touch(body, turning, series[Z], t, inside, length, bounds, search)
        x, v = fallen(frame, series, made)
        t, inside = t + made, max(inside - made, 0.0)
    y[0], y[1], y[2] = x
    y[3], y[4], y[5] = v
    turn(turning, y, t, y)
    return found, t, search


@compiled
def _bounds(body, turning, v, length):
    """Give the `Bounds` of a piece in air that starts with the velocity v; drag never speeds the coin up."""
    rate = max(body.drag.force_tangential, body.drag.force_normal) / body.mass
    drag = rate * (norm(v) + body.gravity * length)
    jerk = rate * (body.gravity + drag) + 2 * turning.rate * drag
    return bounds_of(turning, body.gravity + drag, max(drag - body.gravity, 0.0), jerk)


@compiled
def fall_freely(body, y, t, y_new):
    """Write position and velocity of the state at the time t of a flight on a parabola into y_new.

    Args:
        body: the coin.
        y: state at the start of the flight, (13,).
        t: time [s].
        y_new: state, (13,).
    """
    y_new[0], y_new[1], y_new[2] = y[0] + t * y[3], y[1] + t * y[4], y[2] + t * (y[5] - t * body.gravity / 2)
    y_new[3], y_new[4], y_new[5] = y[3], y[4], y[5] - t * body.gravity


@compiled
def sample_closed(body, start, start_time, times, states):
    """Write the states of one flight at `times` into `states`; see `flying.sample_flight`.

    Returns:
        The number of pieces of the flight up to the last time.
    """
    turning, pieces = turning_of(body, attitude_of(start), spin_of(start)), 1
    if in_vacuum(body):
        for i in range(len(times)):
            fall_freely(body, start, times[i] - start_time, states[i])
            turn(turning, start, times[i] - start_time, states[i])
        return pieces
    series = np.empty((ROWS, ORDER + 1))
    x, v, t = position_of(start), velocity_of(start), 0.0
    length, frame = piece_length(body, turning, t), expand(body, turning, t, x, v, series)
    for i in range(len(times)):
        while times[i] - start_time > t + length:
            x, v = fallen(frame, series, length)
            t += length
            length, frame = piece_length(body, turning, t), expand(body, turning, t, x, v, series)
            pieces += 1
        x_now, v_now = fallen(frame, series, times[i] - start_time - t)
        for k in range(3):
            states[i, k], states[i, 3 + k] = x_now[k], v_now[k]
        turn(turning, start, times[i] - start_time, states[i])
    return pieces
