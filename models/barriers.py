"""The energy of a coin, and the energy that it needs to turn over."""

import math

from cointoss.models.body import Body, is_ideal
from cointoss.models.geometry import lower_rim, tilt_sine_of
from cointoss.models.inertia import largest_across
from cointoss.models.kernel.circle import on_circle
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, apply, dot
from cointoss.models.state import State

# Sines and cosines of the tilts at which the energy needed is computed, from just off a face to upright.
_COSINES, _SINES = (part[1:].copy() for part in on_circle(4 * 128, 129))
# The number of leans on either side of the edge at which it is computed, the closer the nearer to the edge.
_LEANS = 16
# A bound times this factor is still a bound after rounding.
BEYOND_ROUNDING = 1 + 1e-12


@compiled
def energy(body: Body, z: float, v: Vector, w: Vector) -> float:
    """Return the mechanical energy T + m g z_C [J], zero at rest with C on the floor.

    On a slope g is its part along the floor's normal: this energy lifts the coin off the floor and turns it.

    Args:
        body: the coin.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return body.mass * (dot(v, v) / 2 + body.gravity * z) + dot(w, apply(body.inertia, w)) / 2


@compiled
def energy_without_spin(body: Body, state: State) -> float:
    """Return the energy less the energies of horizontal motion and of spin about the normal, eq. (20) [J].

    Args:
        body: the coin.
        state: of the coin, a `State`.
    """
    v, w = state.velocity, state.spin
    kept = body.mass * (v[0] * v[0] + v[1] * v[1]) / 2 + body.inertia[2][2] * w[2] * w[2] / 2
    return energy(body, state.position[2], v, w) - kept


@compiled
def barrier(body: Body, n_z: float) -> float:
    """Return the lowest energy at which a coin can roll over its rim to the other face [J].

    m g sqrt((r - |c_perp|)^2 + (h/2 ± c_zeta)^2), with + where heads is up: C must pass above the point of
    the rim that is nearest to it.

    Args:
        body: the coin.
        n_z: upward component of the coin's normal.
    """
    out, up = rim_offset(body, n_z)
    return body.mass * body.gravity * math.hypot(out, up)


@compiled
def rim_offset(body: Body, n_z: float) -> tuple[float, float]:
    """Return how far outward of C the nearest point of the lower rim lies, and how far below C [m]."""
    c = body.center
    out = body.radius - math.hypot(c[0], c[1])
    up = body.thickness / 2 - lower_rim(n_z) * c[2]
    return out, up


@compiled
def highest_on_floor(body: Body) -> float:
    """Return the largest height that the mass centre of a coin that touches the floor may have [m]."""
    c = body.center
    return math.hypot(body.radius + math.hypot(c[0], c[1]), body.thickness / 2 + abs(c[2]))


@compiled
def spin_barrier(body: Body, up: Vector, w: Vector) -> float:
    """Bound from below the energy at which a coin on a smooth floor in vacuum can turn over [J].

    The bound omits the horizontal motion, and includes the energy of the conserved spin.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return _top_barrier(body, up, w) if is_ideal(body) else _general_barrier(body, up, w)


@compiled
def spin_barrier_bound(body: Body, up: Vector, w: Vector) -> float:
    """Bound `spin_barrier` from above without trying tilts [J].

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return _top_bound(body, up, w) if is_ideal(body) else _general_bound(body, up, w)


@compiled
def edge_barrier(body: Body, up: Vector, w: Vector) -> float:
    """Bound from below the energy at which a coin on a smooth floor in vacuum can leave its edge [J].

    It is `least_energy` at the lesser of the two passes around n_z = 0: the first maximum on either side, or
    the lean with C above the lowest point if that comes first. As n_z is continuous, it never passes where
    the coin needs more energy than it has. The bound is 0 for a coin that is not between two passes.

    Args:
        body: the coin, balanced.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    most = body.thickness / (2 * math.hypot(body.radius, body.thickness / 2))
    L = apply(body.inertia, w)
    L_z, weight = dot(up, L), body.mass * body.gravity
    tips = abs(L_z * L[2]) >= weight * body.thickness / 2 * body.inertia[0][0]
    if tips or abs(up[2]) >= most:
        return 0.0
    upright, least = least_energy(body, L_z, L[2], 1.0, 0.0), math.inf
    for side in (1.0, -1.0):
        highest, lean = upright, 0.0
        for i in range(_LEANS):
            n_z = most * ((i + 1) / _LEANS) ** 2
            E = least_energy(body, L_z, side * L[2], math.sqrt(1 - n_z * n_z), n_z)
            if E <= highest:
                break
            highest, lean = E, n_z
        least = min(least, highest if side * up[2] <= lean else 0.0)
    return least


@compiled
def least_energy(body: Body, L_z: float, L_zeta: float, sine: float, cosine: float) -> float:
    """Return the least energy, without that of v_h, of a balanced coin at a tilt s over the floor [J].

    m g (r sin s + (h/2) cos s) + (L_z - L_ζ cos s)²/(2 J_ξ sin² s) + L_ζ²/(2 J_ζ)

    Args:
        body: the coin.
        L_z: angular momentum about the vertical [kg m²/s].
        L_zeta: about the normal, as it is with heads up [kg m²/s].
        sine: of the tilt, not 0.
        cosine: of the tilt, not negative.
    """
    J = body.inertia
    weight = body.mass * body.gravity * (body.radius * sine + body.thickness / 2 * cosine)
    across = (L_z - L_zeta * cosine) ** 2 / (2 * J[0][0] * sine * sine)
    return weight + across + L_zeta * L_zeta / (2 * J[2][2])


@compiled
def _top_barrier(body: Body, up: Vector, w: Vector) -> float:
    """Bound from below the energy at which the ideal coin on a smooth floor in vacuum can turn over [J].

    There L_z and L_ζ are conserved, through impacts too, so that at each tilt the coin needs at least
    `least_energy`. To turn over it must pass every tilt from the present one to π/2, so the largest energy
    over some of them is a bound.
    """
    L = apply(body.inertia, w)
    L_z = dot(up, L)
    L_zeta = -lower_rim(up[2]) * L[2]
    today, highest = min(tilt_sine_of(up), 1.0), 0.0
    for i in range(len(_SINES)):
        if _SINES[i] >= today:
            highest = max(highest, least_energy(body, L_z, L_zeta, _SINES[i], _COSINES[i]))
    return highest


@compiled
def _top_bound(body: Body, up: Vector, w: Vector) -> float:
    """Bound `_top_barrier` from above without trying tilts [J].

    The energy of the spin has no maximum between: it is largest at the present tilt, where L_z - L_ζ cos s
    is the part of L_z across the normal, or upright.
    """
    J = body.inertia
    L = apply(J, w)
    L_z, across = dot(up, L), L[0] * up[0] + L[1] * up[1]
    spinning = max(L_z * L_z, across * across / (up[0] * up[0] + up[1] * up[1])) / (2 * J[0][0])
    weight = body.mass * body.gravity * math.hypot(body.radius, body.thickness / 2)
    return BEYOND_ROUNDING * (weight + spinning + L[2] * L[2] / (2 * J[2][2]))


@compiled
def _general_barrier(body: Body, up: Vector, w: Vector) -> float:
    """Bound from below the energy at which a coin on a smooth floor in vacuum can turn over [J].

    Vertical impulses keep L_z, with which the coin has at least the energy L_z²/(2 uᵀ J u), u the upward unit
    vector in the body frame. To turn over it must pass every tilt from the present one to π/2, in some
    direction: so the largest, over some of these tilts, of the least energy over all directions is a bound.
    """
    J = body.inertia
    L_z = dot(up, apply(J, w))
    today = min(tilt_sine_of(up), 1.0)
    upper = -lower_rim(up[2])
    c_across = math.hypot(body.center[0], body.center[1])
    highest, J_across, J_out = 0.0, largest_across(J), math.hypot(J[0][2], J[1][2])
    for i in range(len(_SINES)):
        sine, cosine = _SINES[i], _COSINES[i]
        if sine < today:
            continue
        # The lowest height and the largest moment of inertia over all directions, each taken by itself.
        z = (body.radius - c_across) * sine + (body.thickness / 2 + upper * body.center[2]) * cosine
        moment = J_across * sine * sine + J[2][2] * cosine * cosine
        moment += 2 * sine * cosine * J_out
        highest = max(highest, body.mass * body.gravity * z + L_z * L_z / (2 * moment))
    return highest


@compiled
def _general_bound(body: Body, up: Vector, w: Vector) -> float:
    """Bound `_general_barrier` from above without trying tilts [J]."""
    L_z = dot(up, apply(body.inertia, w))
    return BEYOND_ROUNDING * (barrier(body, up[2]) + L_z * L_z / (2 * body.inertia_smallest))
