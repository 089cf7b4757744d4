"""How a small change of the state at a touch changes the impact: central differences of the impact itself."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.contact.resets import impact_of, restitution_at
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.state_vector import STATE_SIZE, normalise, spin_of, state_of, velocity_of
from cointoss.models.body import Body, Rules
from cointoss.models.geometry import FLAT_SINE, gap
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Array

STEP = 1e-5
"""The largest change of a component, relative to the coin's scales: 1 of Euler parameters,
V = √(g r) + |v| + r |ω| of velocities, V/r of angular velocities. Truncation and rounding then err by 1e-10
of the derivative; where Coulomb friction is integrated, by 1e-8."""
TO_KINK = 1e-2
"""A change stays below this part of the distance to a state at which the impact is not smooth."""
LEAST_STEP = 1e-11
"""Smaller changes drown in rounding."""

# A touch as numbers: the gap, the upward unit vector, the velocity of A, the impulse, and the state after.
_UP, _VELOCITY, _IMPULSE, _AFTER = 1, 4, 7, 10


class Touch(NamedTuple):
    """Derivatives with respect to the state before an impact, with the coin held at the touch."""

    closing: float
    """Rate of the gap before the impact, v_Az [m/s]."""
    rate: Array
    """Of the state with time, before the impact, (13,)."""
    gap: Array
    """Of the gap, (13,)."""
    up: Array
    """Of the upward unit vector in the body frame, (3, 13)."""
    contact_velocity: Array
    """Of the velocity of the contact point, space frame, (3, 13)."""
    impulse: Array
    """Of the impulse, space frame, (3, 13)."""
    after: Array
    """Of the state after the impact, (13, 13)."""


@compiled
def touch_derivatives(body: Body, rules: Rules, y: Array) -> Touch:
    """Return the derivatives of a touch and of its impact, the Euler parameters kept at norm 1.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at the touch, before the impact, (13,).
    """
    rate, values = np.empty(STATE_SIZE), np.empty(_AFTER + STATE_SIZE)
    chi = restitution_at(body, rules, y)
    derivative(body, y, rate)
    touch_values(body, rules, chi, y, values)
    v_A = values[_VELOCITY], values[_VELOCITY + 1], values[_VELOCITY + 2]
    slopes = touch_differences(body, rules, chi, y, step_size(body, rules, y, v_A))
    return Touch(
        v_A[2],
        rate,
        slopes[0],
        slopes[_UP:_VELOCITY],
        slopes[_VELOCITY:_IMPULSE],
        slopes[_IMPULSE:_AFTER],
        slopes[_AFTER:],
    )


@compiled
def touch_values(body: Body, rules: Rules, chi: float, y: Array, values: Array) -> None:
    """Write gap, upward unit vector, velocity of A, impulse and the state after into `values`.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of the touch.
        y: state at the touch, (13,).
        values: where they go, (23,).
    """
    state = state_of(y)
    up, struck = state.R[2], impact_of(body, rules, chi, state)
    values[0] = gap(body, y[2], up)
    copy_into(values[_AFTER:], y)
    for i in range(3):
        values[_UP + i] = up[i]
        values[_VELOCITY + i] = struck.contact_velocity[i]
        values[_IMPULSE + i] = struck.impulse[i]
        values[_AFTER + 3 + i] = struck.after.velocity[i]
        values[_AFTER + 10 + i] = struck.after.spin[i]


@compiled
def step_size(body: Body, rules: Rules, y: Array, v_A: Vector) -> float:
    """Return the change of the state with which differences are taken, relative to the coin's scales.

    The lowest point jumps where a face or the edge is level; with friction the impulse has a kink where the
    point does not slip or does not close.

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
    if rules.law == ContactLaw.SLIDING_FRICTION or rules.law == ContactLaw.COULOMB:
        distance *= abs(v_A[2]) / speed
        if slip > 0:
            distance *= slip / speed
    return max(min(STEP, TO_KINK * distance), LEAST_STEP)


@compiled
def speed_scale(body: Body, y: Array) -> float:
    """Return √(g r) + |v| + r |ω| of the state y, (13,) [m/s]."""
    spin = norm(spin_of(y))
    return (body.gravity * body.radius) ** 0.5 + norm(velocity_of(y)) + body.radius * spin


@compiled
def touch_differences(body: Body, rules: Rules, chi: float, y: Array, part: float) -> Array:
    """Return central differences of `touch_values`, over changes of the state's components, (23, 13).

    Where the coin is only moves the gap, and the coin after the impact.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of the touch, and of those beside it.
        y: state at the touch, (13,).
        part: size of the changes, relative to the coin's scales; the Euler parameters keep norm 1.
    """
    speed = speed_scale(body, y)
    slopes = np.zeros((_AFTER + STATE_SIZE, STATE_SIZE))
    ends, moved = np.empty((2, _AFTER + STATE_SIZE)), np.empty(STATE_SIZE)
    slopes[0, 2] = 1.0
    for i in range(3):
        slopes[_AFTER + i, i] = 1.0
    for column in range(3, STATE_SIZE):
        size = speed if column < 6 else 1.0 if column < 10 else speed / body.radius
        change = part * size
        for i in range(2):
            copy_into(moved, y)
            moved[column] += change if i == 0 else -change
            normalise(moved)
            touch_values(body, rules, chi, moved, ends[i])
        for i in range(len(slopes)):
            slopes[i, column] = (ends[0, i] - ends[1, i]) / (2 * change)
    return slopes
