"""The rim point at which a coin touches the floor, and what a force there meets.

The rim point A that is lowest moves round the rim; v_A is the velocity of the coin's matter there. With a
force F at A, dv_A/dt = b + K F, K the mobility of A as in an impact and b what free flight gives.
"""

from typing import NamedTuple

import numpy as np

from analytic.flight.equations_of_motion import derivative
from analytic.flight.state_vector import STATE_SIZE, set_spin, set_velocity, spin_of, state_of, velocity_of
from analytic.impact.laws import mobility, spin_gained
from models.geometry import tilt_sine_of
from models.kernel.compiled import compiled
from models.kernel.vectors import Matrix, Vector, add, apply, cross, subtract


class RimContact(NamedTuple):
    """The lowest point A of a rim, in one state of the coin; space frame."""

    R: Matrix
    """Rotation matrix, body to space."""
    arm: Vector
    """From C to A [m]."""
    mobility: Matrix
    """K [1/kg]."""
    free_acceleration: Vector
    """b [m/s²]."""
    velocity: Vector
    """v_A [m/s]."""


@compiled
def rim_contact(body, y, rim):
    """Return the `RimContact` of a coin in the state y.

    Args:
        body: the coin.
        y: state, (13,), not flat.
        rim: -1 for tails' rim, 1 for heads'; see `models.geometry.lower_rim`.
    """
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    return rim_contact_in_flight(body, y, dy, rim)


@compiled
def both_rims(body, y):
    """Return the `RimContact` of tails' rim and that of heads', in the state y, (13,)."""
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    return rim_contact_in_flight(body, y, dy, -1.0), rim_contact_in_flight(body, y, dy, 1.0)


@compiled
def rim_contact_in_flight(body, y, dy, rim):
    """Return what `rim_contact` does, where the rate of change dy in free flight, (13,), is known."""
    state = state_of(y)
    R, w, up = state.R, state.spin, state.R[2]
    up_rate = cross(up, w)
    sine = tilt_sine_of(up)
    sine_rate = (up[0] * up_rate[0] + up[1] * up_rate[1]) / sine
    r = body.radius
    a = subtract((-r * up[0] / sine, -r * up[1] / sine, rim * body.thickness / 2), body.center)
    a_rate = (
        -r * (up_rate[0] * sine - up[0] * sine_rate) / (sine * sine),
        -r * (up_rate[1] * sine - up[1] * sine_rate) / (sine * sine),
        0.0,
    )
    turn = cross(w, a)
    turn_rate = add(cross(spin_of(dy), a), cross(w, add(turn, a_rate)))
    arm = apply(R, a)
    return RimContact(
        R=R,
        arm=arm,
        mobility=mobility(body, R, arm),
        free_acceleration=add(velocity_of(dy), apply(R, turn_rate)),
        velocity=add(state.velocity, apply(R, turn)),
    )


@compiled
def accelerate(body, A, F, dy):
    """Add what a force F at A, space frame, (3,) [N], gives to the rate of change dy of a state, (13,).

    Of an impulse [N s] and the state itself: the change that it makes.
    """
    set_velocity(dy, add_quotient(velocity_of(dy), F, body.mass))
    set_spin(dy, add(spin_of(dy), spin_gained(body, A.R, A.arm, F)))


@compiled
def add_quotient(a, b, divisor):
    """Return a + b/divisor."""
    return a[0] + b[0] / divisor, a[1] + b[1] / divisor, a[2] + b[2] / divisor
