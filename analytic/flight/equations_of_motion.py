"""The equations of motion of a flying coin."""

from typing import NamedTuple

from cointoss.analytic.air.force import force_and_moment_by
from cointoss.analytic.flight.state_vector import set_attitude, set_position, set_spin, set_velocity, state_of
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.vectors import Vector, apply, apply_transposed, cross, subtract
from cointoss.models.state import State


class Flight(NamedTuple):
    """A coin that nothing but air and weight acts on, in one state; body frame."""

    state: State
    velocity: Vector
    """The velocity of C [m/s]."""
    force: Vector
    """The force of the air [N]."""
    spin_rate: Vector
    """dω/dt [rad/s²]."""


@inlined
def flight_of(body: Body, y: Array) -> Flight:
    """Return the `Flight` of a coin in the state y, (13,)."""
    return flight_in(body, state_of(y), False)


@inlined
def flight_in(body: Body, state: State, in_contact: bool) -> Flight:
    """Return the `Flight` of a coin in a state.

    J_C ω̇ + ω × J_C ω = m_C; Strzalko et al. 2008, eq. (22).

    Args:
        body: the coin.
        state: a `State`.
        in_contact: whether the air's force need be no better than a step of sustained contact.
    """
    v, w = apply_transposed(state.R, state.velocity), state.spin
    f, m_C = force_and_moment_by(body.air.exponent, body, v, w, in_contact)
    gyroscopic = cross(w, apply(body.inertia, w))
    return Flight(state, v, f, apply(body.inertia_inverse, subtract(m_C, gyroscopic)))


@compiled
def write_rate(body: Body, flight: Flight, dy: Array) -> None:
    """Write the rate of change of a flying coin's state into dy, (13,); m a_C = f, eq. (21)."""
    state, f = flight.state, apply(flight.state.R, flight.force)
    set_position(dy, state.velocity)
    set_velocity(dy, (f[0] / body.mass + body.downhill, f[1] / body.mass, f[2] / body.mass - body.gravity))
    set_attitude(dy, quaternion_rate(state.attitude, state.spin))
    set_spin(dy, flight.spin_rate)


@compiled
def derivative(body: Body, y: Array, dy: Array) -> None:
    """Write the time derivative of the state y into dy.

    Args:
        body: the coin.
        y: state, (13,).
        dy: where its rate of change goes, (13,).
    """
    write_rate(body, flight_of(body, y), dy)
