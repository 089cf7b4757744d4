"""How a small change of the state at a touch changes the impact: central differences of the impact itself."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.resets import impact_of, restitution_at
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.state_vector import (
    STATE_SIZE,
    attitude_of,
    normalise,
    spin_of,
    state_of,
    velocity_of,
)
from cointoss.analytic.numerics.rotation import quaternion_rate, turn_of
from cointoss.models.body import Body, Rules
from cointoss.models.contact_laws.table import uses_friction
from cointoss.models.geometry import (
    FLAT_SINE,
    contact_velocity,
    evaluate_gap,
    gap,
    lowest_point,
    tilt_sine_of,
)
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, apply, cross, dot, norm, scale, subtract
from cointoss.models.records import Array
from cointoss.models.restitution import elastic_restitution, elastic_speed, varies

STEP = 1e-5
"""The largest change of a component, relative to the coin's scales: 1 of Euler parameters,
V = √(g r) + |v| + r |ω| of velocities, V/r of angular velocities. Truncation and rounding then err by 1e-10
of the derivative; where Coulomb friction is integrated, by 1e-8."""
TO_KINK = 1e-2
"""The change is at most this part of the distance to a state at which the impact is not smooth."""
LEAST_STEP = 1e-11
"""The least change of the state: smaller ones drown in rounding."""
WIDER, AGREES = 4.0, 1e-3
"""The derivatives of a law of one's own are trusted if wider differences agree with them to this part: it
may have a kink that this engine does not know."""

# A touch as numbers: the gap, the upward unit vector, the velocity of A, the impulse, and the state after, or
# the spin gained.
_UP, _VELOCITY, _IMPULSE, _AFTER = 1, 4, 7, 10
_GAINED, _VALUES = 10, 13
_PARAMETERS = ((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0), (0.0, 0.0, 0.0, 1.0))
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class TouchDerivatives(NamedTuple):
    """Derivatives with respect to the state before an impact, with the coin held at the touch."""

    closing: float
    """Rate of the gap before the impact, v_Az [m/s]."""
    rate: Array
    """The rate of the state with time, before the impact, (13,)."""
    gap: Array
    """Derivatives of the gap, (13,)."""
    up: Array
    """Derivatives of the upward unit vector in the body frame, (3, 13)."""
    contact_velocity: Array
    """Derivatives of the velocity of the contact point, space frame, (3, 13)."""
    impulse: Array
    """Derivatives of the impulse, space frame, (3, 13)."""
    after: Array
    """Derivatives of the state after the impact, (13, 13)."""


@compiled
def touch_derivatives(body: Body, rules: Rules, y: Array) -> TouchDerivatives:
    """Return the derivatives of a touch and of its impact, the Euler parameters kept at norm 1.

    Those of the impact by a law of one's own are infinite where the law is not smooth.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at the touch, before the impact, (13,).
    """
    state, rate, chi = state_of(y), np.empty(STATE_SIZE), restitution_at(body, rules, y)
    derivative(body, y, rate)
    point, _ = lowest_point(body, state.R[2], state.spin)
    v_A = contact_velocity(body, state.R, state.velocity, state.spin, point)
    part = step_size(body, rules, y, v_A)
    slopes = touch_differences(body, rules, chi, y, part)
    if rules.own.address != 0 and not agree(
        slopes,
        touch_differences(body, rules, chi, y, WIDER * part),
        speed_scale(body, y),
        tilt_sine_of(state.R[2]) <= FLAT_SINE,
    ):
        slopes[_IMPULSE:] = np.inf
    return TouchDerivatives(
        v_A[2],
        rate,
        slopes[0],
        slopes[_UP:_VELOCITY],
        slopes[_VELOCITY:_IMPULSE],
        slopes[_IMPULSE:_AFTER],
        slopes[_AFTER:],
    )


@compiled
def step_size(body: Body, rules: Rules, y: Array, v_A: Vector) -> float:
    """Return the change of the state with which differences are taken, relative to the coin's scales.

    The lowest point jumps where a face or the edge is level; with friction the impulse has a kink where the
    point does not slip or does not close; a restitution by the speed has one where it becomes 1.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at the touch, (13,).
        v_A: velocity of the contact point, (3,) [m/s].
    """
    up, speed = state_of(y).R[2], speed_scale(body, y)
    tilt_sine, slip = (up[0] ** 2 + up[1] ** 2) ** 0.5, (v_A[0] ** 2 + v_A[1] ** 2) ** 0.5
    distance = abs(up[2])
    if tilt_sine > FLAT_SINE:
        distance *= tilt_sine
    has_friction = uses_friction(rules.law) or rules.own.address != 0
    if has_friction or varies(rules):
        distance *= abs(v_A[2]) / speed
    if has_friction and slip > 0:
        distance *= slip / speed
    if elastic_speed(rules) > 0:
        distance = min(distance, abs(-v_A[2] - elastic_speed(rules)) / speed)
    return max(min(STEP, TO_KINK * distance), LEAST_STEP)


@compiled
def agree(slopes: Array, wider: Array, speed: float, is_flat: bool) -> bool:
    """Return whether both differences give the same derivatives of the impulse, to the part `AGREES`.

    Of a flat coin those by the velocity: where a turn would change its lowest point, nothing is trusted.

    Args:
        slopes: of `touch_differences`.
        wider: by wider changes.
        speed: the scale of velocities [m/s].
        is_flat: whether the coin lies flat at the touch.
    """
    largest, apart = 0.0, 0.0
    for j in range(3, 6 if is_flat else 10):
        scale = speed if j < 6 else 1.0
        for i in range(_IMPULSE, _AFTER):
            largest = max(largest, scale * abs(slopes[i, j]))
            apart = max(apart, scale * abs(slopes[i, j] - wider[i, j]))
    return apart <= AGREES * largest


@compiled
def speed_scale(body: Body, y: Array) -> float:
    """Return √(g r) + |v| + r |ω| of the state y, (13,) [m/s]."""
    spin = norm(spin_of(y))
    return (body.gravity * body.radius) ** 0.5 + norm(velocity_of(y)) + body.radius * spin


@compiled
def touch_differences(body: Body, rules: Rules, chi: float, y: Array, part: float) -> Array:
    """Return the derivatives of a touch by the state's components, (23, 13), by central differences.

    The law is asked beside the touch in six directions: velocities, and turns about ξ, η, ζ. A spin does what
    it does to v_A; the Euler parameters do what they turn.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of the touch, and where it does not vary with the speed of those beside it.
        y: state at the touch, (13,).
        part: size of the changes, relative to the coin's scales.
    """
    state, slopes = state_of(y), np.zeros((_AFTER + STATE_SIZE, STATE_SIZE))
    e, by_velocity, by_turn = state.attitude, np.empty((_VALUES, 3)), np.empty((_VALUES, 3))
    _write_differences(body, rules, chi, y, part, by_velocity, by_turn)
    point, _ = lowest_point(body, state.R[2], state.spin)
    arm = subtract(point, body.center)
    for k in range(3):
        _write_column(body, by_velocity, _AXES[k], slopes[:, 3 + k])
        _write_column(body, by_velocity, apply(state.R, cross(_AXES[k], arm)), slopes[:, 10 + k])
        for column in (k, 3 + k, 10 + k):
            slopes[_AFTER + column, column] += 1.0
    slopes[0, 2] = 1.0
    for j in range(4):
        turn = turn_of(e, _PARAMETERS[j])
        _write_column(body, by_turn, turn, slopes[:, 6 + j])
        copy_into(slopes[_AFTER + 6 : _AFTER + 10, 6 + j], quaternion_rate(e, turn))
    return slopes


@compiled
def _write_differences(
    body: Body, rules: Rules, chi: float, y: Array, part: float, by_velocity: Array, by_turn: Array
) -> None:
    """Write the differences of `_write_values` by velocities along x, y, z, and by turns about ξ, η, ζ.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution, see `touch_differences`.
        y: state at the touch, (13,).
        part: see `touch_differences`.
        by_velocity: where the one go, (13, 3).
        by_turn: where the other go, (13, 3).
    """
    speed, moved, ends = speed_scale(body, y), np.empty(STATE_SIZE), np.empty((2, _VALUES))
    for column in range(6):
        size = part * (speed if column < 3 else 1.0)
        for i in range(2):
            change = size if i == 0 else -size
            copy_into(moved, y)
            if column < 3:
                moved[3 + column] += change
            else:
                turned = quaternion_rate(attitude_of(y), scale(change, _AXES[column - 3]))
                for j in range(4):
                    moved[6 + j] += turned[j]
                normalise(moved)
            _write_values(body, rules, chi, moved, ends[i])
        for i in range(_VALUES):
            slope = (ends[0, i] - ends[1, i]) / (2 * size)
            if column < 3:
                by_velocity[i, column] = slope
            else:
                by_turn[i, column - 3] = slope


@compiled
def _write_values(body: Body, rules: Rules, chi: float, y: Array, values: Array) -> None:
    """Write gap, upward unit vector, velocity of A, impulse and the spin gained into `values`, (13,)."""
    state = state_of(y)
    if chi > 0 and varies(rules):
        chi = elastic_restitution(rules, -evaluate_gap(body, state).speed)
    up, struck = state.R[2], impact_of(body, rules, chi, state)
    gained = subtract(struck.after.spin, state.spin)
    copy_into(values, (gap(body, y[2], up), *up, *struck.contact_velocity, *struck.impulse, *gained))


@compiled
def _write_column(body: Body, differences: Array, change: Vector, column: Array) -> None:
    """Write what a change along three directions does to a touch and to the motion after it.

    Args:
        body: the coin.
        differences: by those directions, (13, 3).
        change: along them, (3,).
        column: of the derivatives, (23,).
    """
    for i in range(_VALUES):
        changed = dot((differences[i, 0], differences[i, 1], differences[i, 2]), change)
        if i < _GAINED:
            column[i] = changed
            if i >= _IMPULSE:
                column[_AFTER + 3 + i - _IMPULSE] = changed / body.mass
        else:
            column[_AFTER + 10 + i - _GAINED] = changed
