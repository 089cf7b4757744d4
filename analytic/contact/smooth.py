"""Sliding on a smooth floor, which acts on the rim point A by its normal force alone.

What `cointoss.analytic.contact.sliding` does without friction: nothing but A's vertical motion is left.
"""

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.resistance import FRICTIONLESS
from cointoss.analytic.contact.rim_contact import contact_margin, rim_motion, rim_point
from cointoss.analytic.flight.equations_of_motion import flight_in, write_rate
from cointoss.analytic.flight.state_vector import (
    set_height,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
    velocity_of,
)
from cointoss.models.body import Body, is_ideal
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.lanes import where
from cointoss.models.kernel.vectors import Vector, add, apply, apply_transposed, cross, dot, scale
from cointoss.models.records import Array


@inlined
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`."""
    body = contact.body
    flight = flight_in(body, state_of(y), True)
    write_rate(body, flight, dy)
    A = rim_motion(body, FRICTIONLESS, flight, contact.rim)
    b_z = dot(A.up, A.free_acceleration)
    N = stopping(body, A.up, A.arm, b_z, dy)
    _spare_spin(body, flight.state.spin, dy)
    return min(contact_margin(body, A.up, N, contact.rim), -b_z / body.gravity)


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Bring A to the floor, and stop its fall or rise by an impulse there; see `automaton.project`."""
    body = contact.body
    state = state_of(y)
    up = state.R[2]
    a, turn, _ = rim_point(body, up, state.spin, contact.rim)
    set_height(y, -dot(up, a))
    stopping(body, up, a, dot(up, add(apply_transposed(state.R, state.velocity), turn)), y)
    _spare_spin(body, state.spin, y)


@inlined
def _spare_spin(body: Body, w: Vector, change: Array) -> None:
    """Let an ideal coin without spin about ζ get none by rounding; see `laws.spin_after`.

    Args:
        body: the coin; linear air gives it none either.
        w: ω, body frame, (3,) [rad/s].
        change: see `stopping`.
    """
    if body.air.exponent is None and is_ideal(body):
        w_xi, w_eta, w_zeta = spin_of(change)
        set_spin(change, (w_xi, w_eta, where(w[2] == 0, 0.0, w_zeta)))


@inlined
def stopping(body: Body, up: Vector, a: Vector, motion: float, change: Array) -> float:
    """Add what takes the vertical motion of A: a force to a rate of change, or an impulse to a state.

    Args:
        body: the coin.
        up: the upward unit vector, body frame, (3,).
        a: from C to A, body frame, (3,) [m].
        motion: acceleration of A [m/s²], or its velocity [m/s].
        change: rate of change of a state, or a state, (13,); written to.

    Returns:
        The force [N], or the impulse [N s].
    """
    lever = cross(a, up)
    spin = apply(body.inertia_inverse, lever)
    N = -motion / (1 / body.mass + dot(lever, spin))
    v = velocity_of(change)
    set_velocity(change, (v[0], v[1], v[2] + N / body.mass))
    set_spin(change, add(spin_of(change), scale(N, spin)))
    return N
