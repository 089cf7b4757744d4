"""Lying: a coin flat on a face, which slides on the floor and spins about the vertical.

The face presses with the same pressure all over. Each of its points meets Coulomb's friction against its own
slip; both integrals over the face are elliptic ones of ε = v/(r Ω), v the speed of B and Ω the rate of the
spin (Z. Farkas, G. Bartels, T. Unger, D. E. Wolf, Phys. Rev. Lett. 90, 248302, 2003). Floor and face hold
what else would tilt the coin.
"""

import math

from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.resistance import moment_per_force
from cointoss.analytic.flight.equations_of_motion import flight_in, write_rate
from cointoss.analytic.flight.state_vector import (
    attitude_of,
    normalise,
    set_attitude,
    set_height,
    set_spin,
    set_velocity,
    spin_of,
    state_of,
    velocity_of,
)
from cointoss.analytic.numerics.elliptic import complete_elliptic
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, friction_can_hold
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, dot, scale
from cointoss.models.records import Array

STILL = 1e-6
"""A coin that lies is at rest where it moves slower than this part of √(g r)."""
# Beyond these ratios ε the elliptic integrals lose digits, and the first terms of their series have more.
_SMALL, _LARGE = 1e-3, 30.0


@compiled
def flow(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Write the rate of change of the state y into dy, and return the margin; see `automaton.flow`.

    The mode ends when the coin is at rest, except on a slope too steep for friction.
    """
    body, friction = contact.body, contact.friction
    write_rate(body, flight_in(body, state_of(y), True), dy)
    v, w, R, air = velocity_of(y), spin_of(y), rotation_matrix(attitude_of(y)), velocity_of(dy)
    side, N = math.copysign(1.0, R[2][2]), -body.mass * air[2]
    turn = side * w[2]
    # B from C.
    x, z = scale(-1.0, apply(R, body.center)), (0.0, 0.0, 1.0)
    slip = (v[0] - turn * x[1], v[1] + turn * x[0], 0.0)
    speed, rim_speed = math.hypot(slip[0], slip[1]), body.radius * abs(turn)
    holding, turning = face_friction(speed, rim_speed)
    push = -friction.sliding * N * holding / speed if speed > 0 else 0.0
    force = scale(push, slip)
    moment = -math.copysign(friction.sliding * N * body.radius * turning, turn)
    moment += N * dot(z, moment_per_force(body, friction, z, (0.0, 0.0, turn)))
    moment += x[0] * force[1] - x[1] * force[0]
    by_air = dot(body.inertia[2], spin_of(dy))
    set_velocity(dy, (air[0] + force[0] / body.mass, air[1] + force[1] / body.mass, 0.0))
    set_spin(dy, (0.0, 0.0, (by_air + side * moment) / body.inertia[2][2]))
    if not friction_can_hold(body, friction.sliding):
        return 1.0
    return max(speed, rim_speed) / (body.gravity * body.radius) ** 0.5 - STILL


@compiled
def face_friction(speed: float, rim_speed: float) -> tuple[float, float]:
    """Return the friction of a face over μ N, and its moment about B over μ N r.

    Args:
        speed: of B [m/s].
        rim_speed: r Ω, Ω >= 0 the rate of the spin [m/s].
    """
    if speed <= _SMALL * rim_speed:
        ratio = speed / rim_speed if rim_speed > 0 else 0.0
        return ratio * (1 - ratio * ratio / 8), 2 / 3 - ratio * ratio / 2 if rim_speed > 0 else 0.0
    if speed >= _LARGE * rim_speed:
        inverse = rim_speed / speed
        m = inverse * inverse
        return 1 - m * (1 / 8 + m / 64), inverse / 4 * (1 + m * (1 / 12 + m * 3 / 128))
    ratio = speed / rim_speed
    if ratio <= 1:
        m = ratio * ratio
        K, E = complete_elliptic(m)
        holding = ((m + 1) * E + (m - 1) * K) / ratio
        return 4 / (3 * math.pi) * holding, 4 / (9 * math.pi) * ((4 - 2 * m) * E + (m - 1) * K)
    m = 1 / (ratio * ratio)
    K, E = complete_elliptic(m)
    holding = ((1 + m) * E - (1 - m) * K) / m
    turning = ((4 * m - 2) * E + (2 - 5 * m + 3 * m * m) * K) / m
    return 4 / (3 * math.pi) * holding, 4 * ratio / (9 * math.pi) * turning


@compiled
def project(contact: SustainedContact, y: Array) -> None:
    """Lay a coin that lies, or all but does, on the floor, and stop all but its sliding and its spin."""
    v, w = velocity_of(y), spin_of(y)
    lay_flat(contact.body, y)
    set_velocity(y, (v[0], v[1], 0.0))
    set_spin(y, (0.0, 0.0, w[2]))


@compiled
def lay_flat(body: Body, y: Array) -> None:
    """Turn a coin that all but lies on a face until it does, and all of the face touches the floor.

    A coin whose axis passes the vertical at a tilt below `FACE_SINE` would go on upon its rim, around which
    the lowest point runs in no time: here the opposite rim point lands, as where the axis passes through it.
    """
    a, b, c, d = attitude_of(y)
    heads_up = rotation_matrix((a, b, c, d))[2][2] > 0
    set_attitude(y, (a, 0.0, 0.0, d) if heads_up else (0.0, b, c, 0.0))
    normalise(y)
    set_height(y, body.thickness / 2 + (body.center[2] if heads_up else -body.center[2]))
