"""One step of Dormand and Prince's Runge-Kutta pair of order 8(5,3), for the state of a coin.

Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, section II.5. The caller computes the
slope at each stage; `stages` holds them, (STAGES, 13). No slope depends on the position of C.
"""

import numpy as np

from cointoss.analytic.flight.state_vector import (
    STATE_SIZE,
    attitude_of,
    motion_scales,
    position_of,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    spin_of,
    velocity_of,
)
from cointoss.analytic.numerics.tableau import END, ERROR_3, ERROR_5, TERMS, WEIGHTED, WEIGHTS
from cointoss.models.attitude import Quaternion
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector

_SAFETY, _SHRINK_MOST, _GROW_MOST = 0.8, 0.2, 6.0


@inlined
def stage_point(y: Array, dt: float, stages: Array, stage: int, point: Array) -> None:
    """Write the place of a stage, whose slope is wanted, into `point`, all but the position of C.

    Args:
        y: state at the start of the step, (13,).
        dt: length of the step.
        stages: slopes at the stages before, (STAGES, 13).
        stage: its number.
        point: state, (13,), an array of its own.
    """
    _, v, e, w = _weighted_slope(stages, stage)
    _advance(y, dt, v, e, w, point)


@inlined
def end_point(y: Array, dt: float, stages: Array, point: Array) -> None:
    """Write into `point`, (13,), the end of the step; for the arguments see `stage_point`."""
    x, v, e, w = _weighted_slope(stages, END)
    set_position(point, _plus(position_of(y), dt, x))
    _advance(y, dt, v, e, w, point)


@compiled
def _advance(y: Array, dt: float, v: Vector, e: Quaternion, w: Vector, point: Array) -> None:
    """Write y + dt (v, e, w) into the parts of `point` after the position; LLVM makes vectors of them."""
    set_velocity(point, _plus(velocity_of(y), dt, v))
    set_attitude(point, _plus_4(attitude_of(y), dt, e))
    set_spin(point, _plus(spin_of(y), dt, w))


@compiled
def _weighted_slope(stages: Array, row: int) -> tuple[Vector, Vector, Quaternion, Vector]:
    """Return the sum of the slopes with the weights of a row of the tableau, part by part of the state."""
    x, v, w, e = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)
    for term in range(TERMS[row]):
        weight, slope = WEIGHTS[row, term], stages[WEIGHTED[row, term]]
        x = _plus(x, weight, position_of(slope))
        v = _plus(v, weight, velocity_of(slope))
        e = _plus_4(e, weight, attitude_of(slope))
        w = _plus(w, weight, spin_of(slope))
    return x, v, e, w


@compiled
def _plus(a: Vector, k: float, b: Vector) -> Vector:
    """Return a + k b for vectors."""
    return a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]


@compiled
def _plus_4(a: Quaternion, k: float, b: Quaternion) -> Quaternion:
    """Return a + k b for Euler parameters."""
    return a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2], a[3] + k * b[3]


@compiled
def step_error(body: Body, y: Array, dt: float, stages: Array) -> float:
    """Estimate the error of the step just made, relative to the scales of the coin."""
    sum_5, sum_3 = error_sums(body, y, stages)
    return combined_error(dt, sum_5, sum_3, STATE_SIZE)


@compiled
def error_sums(body: Body, y: Array, stages: Array) -> tuple[float, float]:
    """Return the sums of the squares of the estimates of order 5 and 3, see `combined_error`.

    The scales: r for positions, √(g r) beside |v| for velocities, 1 for Euler parameters, √(g/r) beside
    |ω| for angular velocities.
    """
    speed, spin = motion_scales(body, y)
    return (
        _sum_of_squares(_weighted_slope(stages, ERROR_5), body.radius, speed, spin),
        _sum_of_squares(_weighted_slope(stages, ERROR_3), body.radius, speed, spin),
    )


@compiled
def _sum_of_squares(
    slope: tuple[Vector, Vector, Quaternion, Vector], length: float, speed: float, spin: float
) -> float:
    """Return the sum of the squares of a slope's components, each relative to its scale."""
    x, v, e, w = slope
    total = 0.0
    for part in x:
        total += _squared(part / length)
    for part in v:
        total += _squared(part / speed)
    total += (_squared(e[0]) + _squared(e[1])) + (_squared(e[2]) + _squared(e[3]))
    for part in w:
        total += _squared(part / spin)
    return total


@compiled
def _squared(number: float) -> float:
    return number * number


@compiled
def combined_error(dt: float, sum_5: float, sum_3: float, size: int) -> float:
    """Return the error of a step of a system of `size` components, as Hairer's code combines the estimates.

    Args:
        dt: length of the step.
        sum_5: of the squares of the estimates of order 5, each relative to its component's scale.
        sum_3: of those of order 3.
        size: number of components.
    """
    if sum_5 == 0 and sum_3 == 0:
        return 0.0
    combined = (sum_5 + 0.01 * sum_3) * size
    if not combined < np.inf:
        # Divided by it, any error would be none.
        return np.inf
    return abs(dt) * sum_5 / combined**0.5


@compiled
def step_factor(error: float) -> float:
    """Return the factor from a step to the next, or to its next try.

    Args:
        error: of the step, relative to the error allowed.
    """
    if error == 0:
        return _GROW_MOST
    # An error that is not a number comes from an overflow inside the step.
    if not error >= 0:
        return _SHRINK_MOST
    return min(_GROW_MOST, max(_SAFETY * error ** (-1 / 8), _SHRINK_MOST))
