"""The first touch within a step of free flight, searched on polynomials between its two ends."""

import math
from typing import NamedTuple

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import Motion
from cointoss.coin_mj.steps.turning_frame import (
    TurningFrame,
    about_axis,
    about_axis_back,
    about_normal,
    about_normal_back,
    frame_of,
    left_over,
    spin_rate,
    turn_after,
)
from cointoss.models.attitude import rotation_matrix
from cointoss.models.clearance import clear_time
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import add, cross, dot, norm, scale, subtract
from cointoss.models.records import Array

_HEIGHT, _UP, _SPIN, _ROWS = 0, 1, 4, 7
_FINEST = 1e-7
"""The search locates a touch within this part of the step, which is about what its polynomials err."""


class Arc(NamedTuple):
    """A step of free flight between its ends, in the step's `TurningFrame`.

    Height of B and the upward unit vector in the turning frame are of fifth order in the part of the step,
    and have both ends' values, rates and accelerations; ω_F is of third order.
    """

    coefficients: Array
    """The coefficients of height, upward vector and ω_F, (7, 6)."""
    frame: TurningFrame
    """The turning frame of the step."""
    duration: float
    """The duration of the step [s]."""
    fastest: float
    """Largest horizontal speed of B at either end [m/s]."""


@compiled
def arc_of(start: Motion, start_rate: Array, end: Motion, end_rate: Array, duration: float) -> Arc:
    """Return the `Arc` of a step.

    Args:
        start: qpos and qvel, (13,).
        start_rate: its rate of change, (13,).
        end: as start.
        end_rate: as start_rate.
        duration: of the step [s].
    """
    frame, ends = frame_of(start, start_rate), np.empty((6, _ROWS))
    _write_end(frame, 0.0, start, start_rate, duration, ends[:3])
    _write_end(frame, duration, end, end_rate, duration, ends[3:])
    table = np.zeros((_ROWS, 6))
    for i in range(_ROWS):
        table[i, 0], table[i, 1] = ends[0, i], ends[1, i]
        change, rate_change = ends[3, i] - ends[0, i] - ends[1, i], ends[4, i] - ends[1, i]
        if i < _SPIN:
            table[i, 2] = ends[2, i] / 2
            change, rate_change = change - ends[2, i] / 2, rate_change - ends[2, i]
            bend = ends[5, i] - ends[2, i]
            table[i, 3] = 10 * change - 4 * rate_change + bend / 2
            table[i, 4] = -15 * change + 7 * rate_change - bend
            table[i, 5] = 6 * change - 3 * rate_change + bend / 2
        else:
            table[i, 2], table[i, 3] = 3 * change - rate_change, rate_change - 2 * change
    fastest = max(math.hypot(start[7], start[8]), math.hypot(end[7], end[8]))
    return Arc(table, frame, duration, fastest)


@compiled
def _write_end(
    frame: TurningFrame, time: float, motion: Motion, rate: Array, duration: float, end: Array
) -> None:
    """Write values, rates and accelerations at an end, in units of the step, (3, 7).

    Args:
        frame: of the step.
        time: of the end [s].
        motion: qpos and qvel there, (13,).
        rate: its rate of change, (13,).
        duration: of the step [s].
        end: where they go.
    """
    turn = turn_after(frame, time)
    w = about_normal(turn, (motion[10], motion[11], motion[12]))
    w_rate = spin_rate(frame, turn, w, (rate[10], rate[11], rate[12]))
    up = rotation_matrix((motion[3], motion[4], motion[5], motion[6]))[2]
    up = about_axis(turn, about_normal(turn, up))
    # The frame turns with ω_g = R(exp(W t/2)) (ω_F - s ζ - W).
    left = left_over(frame, w)
    w_g = about_axis(turn, left)
    w_g_rate = about_axis(turn, add(cross(frame.rate, left), w_rate))
    up_rate = cross(up, w_g)
    up_acceleration = add(cross(up_rate, w_g), cross(up, w_g_rate))
    copy_into(end[0], (motion[2], *up, *w))
    copy_into(end[1], (rate[2], *up_rate, *w_rate))
    copy_into(end[2], (rate[9], *up_acceleration, 0.0, 0.0, 0.0))
    for i in range(_ROWS):
        end[1, i] *= duration
        end[2, i] *= duration * duration


@compiled
def first_touch(coin: MujocoCoin, arc: Arc, shortest: float) -> float:
    """Return the time from the start of a step to the first touch in it [s]; infinite where there is none.

    Steps of `clear_time` on the polynomials lead there from before.

    Args:
        coin: MuJoCo's.
        arc: of the step.
        shortest: a time in which no touch is looked for [s].
    """
    shape, c, table = coin.shape, coin.body.center, arc.coefficients
    time, shortest = 0.0, max(shortest, _FINEST * arc.duration)
    while time < arc.duration:
        part, turn = time / arc.duration, turn_after(arc.frame, time)
        up = (_value(table[_UP], part), _value(table[_UP + 1], part), _value(table[_UP + 2], part))
        up = about_normal_back(turn, about_axis_back(turn, scale(1 / norm(up), up)))
        w = (_value(table[_SPIN], part), _value(table[_SPIN + 1], part), _value(table[_SPIN + 2], part))
        w = about_normal_back(turn, w)
        z = _value(table[_HEIGHT], part) + dot(up, c) - coin.floor_height
        z_rate = _slope(table[_HEIGHT], part) / arc.duration + dot(up, cross(w, c))
        v = (arc.fastest + norm(w) * norm(c), 0.0, z_rate)
        clear = clear_time(shape, z, v, up, w, arc.duration - time)
        if clear >= arc.duration - time:
            break
        point, _ = lowest_point(shape, up, w)
        if clear < shortest and z_rate + dot(up, cross(w, subtract(point, c))) < 0:
            return time
        time += max(clear, shortest)
    return np.inf


@compiled
def _value(row: Array, part: float) -> float:
    """Return a polynomial's value."""
    return row[0] + part * (row[1] + part * (row[2] + part * (row[3] + part * (row[4] + part * row[5]))))


@compiled
def _slope(row: Array, part: float) -> float:
    """Return a polynomial's derivative."""
    return row[1] + part * (2 * row[2] + part * (3 * row[3] + part * (4 * row[4] + part * 5 * row[5])))
