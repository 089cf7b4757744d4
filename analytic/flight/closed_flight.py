"""Flights of an ideal coin that turns in closed form: on a parabola, or in linear air piece by piece."""

import numpy as np

from cointoss.analytic.flight.fall import (
    ORDER,
    Piece,
    clock,
    expand,
    fall_freely,
    fallen,
    slowing_of,
    time_of,
)
from cointoss.analytic.flight.first_touch import Bounds, PieceResult, bounds_of, first_touch, lowest_dip
from cointoss.analytic.flight.state_vector import position_of, state_of, velocity_of
from cointoss.analytic.flight.touch_search import Flown, smallest_flight
from cointoss.analytic.flight.turning import Turning, turn, turning_of
from cointoss.models.body import Body, in_vacuum
from cointoss.models.geometry import evaluate_gap
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm


@compiled
def fly_closed(body: Body, y: Array, longest: float, with_graze: bool) -> Flown:
    """Fly a coin that `turns_in_closed_form` until it first touches the floor; see `flying.fly`."""
    start, time, inside, evaluations, pieces = y.copy(), 0.0, 0.0, 0, 0
    while True:
        result, flown, made, more = _search(body, y, inside, longest - time)
        time, evaluations, pieces = time + flown, evaluations + made, pieces + more
        state = state_of(y)
        starts_on_floor = result == PieceResult.TOUCH and time == 0
        if starts_on_floor and evaluate_gap(body, state).speed >= -smallest_flight(body, state).speed:
            # A coin that starts on the floor has just been lifted off it: only a clear descent is a touch.
            result = PieceResult.GRAZE
        if result != PieceResult.GRAZE:
            graze = closed_graze(body, start, time) if with_graze else np.inf
            return Flown(time, result == PieceResult.TOUCH, evaluations, pieces, graze)
        # It flies on from there, where it hardly sinks for a while.
        inside = smallest_flight(body, state).time


@compiled
def _search(body: Body, y: Array, inside: float, longest: float) -> tuple[PieceResult, float, int, int]:
    """Fly to a touch, to a graze or to the end; y becomes the state there.

    Args:
        body: the coin.
        y: state at the start, (13,).
        inside: when the search starts [s].
        longest: the longest flight wanted [s].

    Returns:
        What is `PieceResult`, when [s], and the numbers of gap evaluations and of pieces.
    """
    if in_vacuum(body):
        turning, heights = turning_of(body, state_of(y)), _parabola(body, y)
        bounds = bounds_of(turning, body.gravity, 0.0, 0.0)
        result, t, evaluations = first_touch(body, turning, heights, inside, longest, bounds)
        fall_freely(body, y, t, y)
        turn(turning, y, t, 1.0, y)
        return result, t, evaluations, 1
    series = np.empty((4, ORDER + 1))
    time, result, evaluations, pieces = 0.0, PieceResult.NOTHING, 0, 0
    while time < longest and result == PieceResult.NOTHING:
        turning = turning_of(body, state_of(y))
        piece = expand(body, turning, y, clock(slowing_of(body), longest - time), series)
        heights, bounds = series[3, : piece.order + 1], bounds_in_air(body, turning, piece, velocity_of(y))
        result, s, made = first_touch(body, turning, heights, inside, piece.length, bounds)
        fly_on(turning, piece, series, s, y, y)
        time, inside = time + time_of(piece.slowing, s), 0.0
        evaluations, pieces = evaluations + made, pieces + 1
    return result, min(time, longest), evaluations, pieces


@compiled
def closed_graze(body: Body, start: Array, duration: float) -> float:
    """Return a height such that no minimum of the gap in a flight is below half of it [m].

    Args:
        body: the coin.
        start: state at the start of the flight, (13,).
        duration: of the flight [s].
    """
    turning = turning_of(body, state_of(start))
    if in_vacuum(body):
        heights, bounds = _parabola(body, start), bounds_of(turning, body.gravity, 0.0, 0.0)
        return lowest_dip(body, turning, heights, duration, bounds)
    series, y, time, lowest = np.empty((4, ORDER + 1)), start.copy(), 0.0, np.inf
    while time < duration:
        turning = turning_of(body, state_of(y))
        piece = expand(body, turning, y, clock(slowing_of(body), duration - time), series)
        heights, bounds = series[3, : piece.order + 1], bounds_in_air(body, turning, piece, velocity_of(y))
        lowest = min(lowest, lowest_dip(body, turning, heights, piece.length, bounds))
        fly_on(turning, piece, series, piece.length, y, y)
        made = time_of(piece.slowing, piece.length)
        if time + made == time:
            break
        time += made
    return lowest


@compiled
def fly_on(turning: Turning, piece: Piece, series: Array, s: float, y: Array, y_new: Array) -> None:
    """Write the state at the clock s of a piece, that starts with the state y, into y_new; both (13,)."""
    fallen(piece, series, s, y, y_new)
    turn(turning, y, s, 1 - piece.slowing * s, y_new)


@compiled
def bounds_in_air(body: Body, turning: Turning, piece: Piece, v: Vector) -> Bounds:
    """Return the `Bounds` of a piece that starts with the velocity v; drag never speeds the coin up."""
    rate = max(body.drag.force_tangential, body.drag.force_normal) / body.mass
    # The clock is slower than time: dt = ds/left.
    left = 1 - piece.slowing * piece.length
    g = body.gravity + body.downhill
    speed = norm(v) + g * time_of(piece.slowing, piece.length)
    drag = (rate + piece.slowing) * speed
    jerk = (rate + 3 * piece.slowing) * (g + drag) + 2 * turning.rate * rate * speed
    down, up = body.gravity + drag, max(drag - body.gravity, 0.0)
    return bounds_of(turning, down / left**2, up / left**2, jerk / left**3)


@compiled
def _parabola(body: Body, y: Array) -> tuple[float, float, float]:
    """Return the coefficients of the height of C as a polynomial of time, on a parabola from the state y."""
    return position_of(y)[2], velocity_of(y)[2], -body.gravity / 2


@compiled
def sample_closed(body: Body, start: Array, start_time: float, times: Array, states: Array) -> int:
    """Write the states of one flight at `times` into `states`; see `flying.sample`.

    Returns:
        The number of pieces of the flight up to the last time.
    """
    y, time, pieces, turning = start.copy(), 0.0, 1, turning_of(body, state_of(start))
    if in_vacuum(body):
        for i in range(len(times)):
            t = times[i] - start_time
            fall_freely(body, y, t, states[i])
            turn(turning, y, t, 1.0, states[i])
        return pieces
    series = np.empty((4, ORDER + 1))
    piece = expand(body, turning, y, np.inf, series)
    for i in range(len(times)):
        while times[i] - start_time > time + time_of(piece.slowing, piece.length):
            fly_on(turning, piece, series, piece.length, y, y)
            time += time_of(piece.slowing, piece.length)
            turning = turning_of(body, state_of(y))
            piece = expand(body, turning, y, np.inf, series)
            pieces += 1
        s = clock(piece.slowing, times[i] - start_time - time)
        fly_on(turning, piece, series, s, y, states[i])
    return pieces
