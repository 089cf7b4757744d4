"""Whether the face that is up can still change."""

import math

from models.body import in_vacuum, is_ideal
from models.geometry import drag_bound
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, dot, norm
from models.laws import ContactLaw, EndingTest, RestitutionKind
from models.records import Ending, Face, Outcome

TILTS_TRIED = 128
# A bound times it stays a bound whatever rounding does.
BEYOND_ROUNDING = 1 + 1e-12
# What is left of the energy of tilting, against m g r, in a coin that lies flat.
WOBBLE = 1e-9


@compiled
def face_up(n_z):
    """Give the face that is up, from the upward component of the coin's normal, eq. (4)."""
    return Face.HEADS if n_z > 0 else Face.TAILS


@compiled
def energy(body, z, v, w):
    """Give the mechanical energy T + m g z_C [J], zero at rest with C on the floor.

    Args:
        body: the coin.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return body.mass * (dot(v, v) / 2 + body.gravity * z) + dot(w, apply(body.inertia, w)) / 2


@compiled
def barrier(body, n_z):
    """Give the lowest energy at which a coin can roll over its rim to the other face [J].

    m g sqrt((r - |c_perp|)^2 + (h/2 ± c_zeta)^2), with + where heads is up: C must pass above the point of
    the rim that is nearest to it.

    Args:
        body: the coin.
        n_z: upward component of the coin's normal.
    """
    out, up = _pass(body, n_z)
    return body.mass * body.gravity * math.hypot(out, up)


@compiled
def _pass(body, n_z):
    """Give how far the nearest rim point lies outwards of C, and C's height over the lower face [m]."""
    c = body.center
    out = body.radius - math.hypot(c[0], c[1])
    up = body.thickness / 2 + (c[2] if n_z > 0 else -c[2])
    return out, up


@compiled
def _top_barrier(body, up, w):
    """Bound from below the energy at which the ideal coin on a smooth floor in vacuum can turn over [J].

    There L_z and L_ζ are conserved, through impacts too, so that at tilt s the coin needs at least
    m g (r sin s + (h/2) cos s) + (L_z - L_ζ cos s)²/(2 J_ξ sin² s), beside L_ζ²/(2 J_ζ). To turn over it
    must pass every tilt from today's to π/2: the largest over a set of these tilts is needed for sure.
    """
    J_across, J_normal = body.inertia[0][0], body.inertia[2][2]
    L = apply(body.inertia, w)
    L_z = dot(up, L)
    L_zeta = L[2] if up[2] > 0 else -L[2]
    today = math.atan2(math.hypot(up[0], up[1]), abs(up[2]))
    highest = 0.0
    for i in range(TILTS_TRIED):
        s = math.pi / 2 - (math.pi / 2 - today) * i / TILTS_TRIED
        sine, cosine = math.sin(s), math.cos(s)
        weight = body.mass * body.gravity * (body.radius * sine + body.thickness / 2 * cosine)
        highest = max(highest, weight + (L_z - L_zeta * cosine) ** 2 / (2 * J_across * sine * sine))
    return highest + L_zeta * L_zeta / (2 * J_normal)


@compiled
def spin_barrier(body, up, w):
    """Bound from below the energy at which a coin on a smooth floor in vacuum can turn over [J].

    It leaves the horizontal motion out, and counts what the conserved spin needs.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    return _top_barrier(body, up, w) if is_ideal(body) else _spin_barrier(body, up, w)


@compiled
def _top_ceiling(body, up, w):
    """Bound `_top_barrier` from above without trying tilts [J].

    What the spin needs has no maximum inside: it is largest at today's tilt, where L_z - L_ζ cos s is the
    part of L_z across the normal, or upright.
    """
    J = body.inertia
    L = apply(J, w)
    L_z, across = dot(up, L), L[0] * up[0] + L[1] * up[1]
    spinning = max(L_z * L_z, across * across / (up[0] * up[0] + up[1] * up[1])) / (2 * J[0][0])
    weight = body.mass * body.gravity * math.hypot(body.radius, body.thickness / 2)
    return BEYOND_ROUNDING * (weight + spinning + L[2] * L[2] / (2 * J[2][2]))


@compiled
def judge(body, rules, z, v, up, w):
    """Tell after an impact whether the toss is decided.

    "rigorous": the energy is below the pass to the other face (or, on a smooth floor in vacuum, below it with
    what the conserved spin needs) and the tilt is on this face's side of the pass; or the coin lies flat. A
    thick coin may also be caught on its edge. Only the smooth law, and Routh's with energetic
    restitution, never add energy; for every other the same test ends the toss under the paper's name,
    `Ending.PAPER`. "paper" is E < m g r and "paper_smooth" is eq. (20) of Strzalko et al. 2008.

    Args:
        body: the coin.
        rules: floor and ending.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        The outcome and the ending; `Outcome.UNDECIDED` and `Ending.NONE` where the toss goes on.
    """
    E = energy(body, z, v, w)
    face = Outcome.HEADS if up[2] > 0 else Outcome.TAILS
    mgr = body.mass * body.gravity * body.radius
    if rules.test == EndingTest.PAPER:
        if E < mgr:
            return face, Ending.PAPER
        return Outcome.UNDECIDED, Ending.NONE
    if rules.test == EndingTest.PAPER_SMOOTH:
        kept = body.mass * (v[0] * v[0] + v[1] * v[1]) / 2 + body.inertia[2][2] * w[2] * w[2] / 2
        if E - kept < mgr:
            return face, Ending.PAPER_SMOOTH
        return Outcome.UNDECIDED, Ending.NONE

    smooth = rules.law == ContactLaw.SMOOTH
    energetic = rules.restitution_kind == RestitutionKind.ENERGETIC
    ending = Ending.SETTLED if smooth or energetic else Ending.PAPER
    tilt_sine = math.hypot(up[0], up[1])
    out, high = _pass(body, up[2])
    on_face = tilt_sine * high < out * abs(up[2])
    if E < barrier(body, up[2]):
        if on_face:
            return face, ending
        if E < barrier(body, -up[2]) and _beyond_the_pass(body, up, tilt_sine):
            return Outcome.EDGE, ending
    if smooth and in_vacuum(body):
        E_turning = E - body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
        # Off the face's side of the pass a coin may be just upright, within rounding of what it needs.
        E_turning += 0.0 if on_face else WOBBLE * mgr
        ceiling = _top_ceiling(body, up, w) if is_ideal(body) else _spin_ceiling(body, up, w)
        if not E_turning > ceiling and E_turning < spin_barrier(body, up, w):
            return face, Ending.SETTLED
    if _lies(body, rules, z, v, up, w):
        return face, Ending.LYING
    return Outcome.UNDECIDED, Ending.NONE


@compiled
def _beyond_the_pass(body, up, tilt_sine):
    """Tell whether C is on the edge's side of the pass over the rim point that is lowest."""
    if tilt_sine == 0:
        return False
    c = body.center
    out = body.radius + (c[0] * up[0] + c[1] * up[1]) / tilt_sine
    high = _pass(body, up[2])[1]
    return tilt_sine * high > out * abs(up[2])


@compiled
def _spin_barrier(body, up, w):
    """Bound from below the energy at which a coin on a smooth floor in vacuum can turn over [J].

    Vertical impulses keep L_z, with which the coin has at least the energy L_z²/(2 uᵀ J u), u the upward unit
    vector in the body frame. To turn over it must pass every tilt from today's to π/2, in some direction:
    the largest over a set of these tilts, of the least over all directions, is needed for sure.
    """
    J = body.inertia
    L_z = dot(up, apply(J, w))
    today = math.atan2(math.hypot(up[0], up[1]), abs(up[2]))
    side = 1.0 if up[2] > 0 else -1.0
    c_across = math.hypot(body.center[0], body.center[1])
    highest = 0.0
    for i in range(TILTS_TRIED):
        s = math.pi / 2 - (math.pi / 2 - today) * i / TILTS_TRIED
        sine, cosine = math.sin(s), math.cos(s)
        # The lowest height and the largest moment of inertia of all directions, each for itself.
        z = (body.radius - c_across) * sine + (body.thickness / 2 + side * body.center[2]) * cosine
        J_across = _largest_across(J)
        moment = J_across * sine * sine + J[2][2] * cosine * cosine
        moment += 2 * sine * cosine * math.hypot(J[0][2], J[1][2])
        highest = max(highest, body.mass * body.gravity * z + L_z * L_z / (2 * moment))
    return highest


@compiled
def _spin_ceiling(body, up, w):
    """Bound `_spin_barrier` from above without trying tilts [J]."""
    L_z = dot(up, apply(body.inertia, w))
    return BEYOND_ROUNDING * (barrier(body, up[2]) + L_z * L_z / (2 * body.inertia_smallest))


@compiled
def _largest_across(J):
    """Give the largest moment of inertia about an axis in the coin's plane."""
    mean, half = (J[0][0] + J[1][1]) / 2, (J[0][0] - J[1][1]) / 2
    return mean + math.hypot(half, J[0][1])


@compiled
def _lies(body, rules, z, v, up, w):
    """Tell whether the coin lies flat for good, whatever it has of sliding and of spin about its normal.

    What is left of its tilt, of its turning about diameters and of its vertical motion is nothing, and the
    floor can balance all moments that spin, drag and friction make about diameters by pressing inside the
    rim. As sliding and spinning never grow, neither do these moments.
    """
    c, J = body.center, body.inertia
    flat_z = body.thickness / 2 + (c[2] if up[2] > 0 else -c[2])
    across = (w[0], w[1], 0.0)
    wobble = (
        body.mass * (v[2] * v[2] / 2 + body.gravity * abs(z - flat_z)) + dot(across, apply(J, across)) / 2
    )
    weight = body.mass * body.gravity
    if wobble > WOBBLE * weight * body.radius:
        return False
    mu = rules.friction if rules.law == ContactLaw.COULOMB else 0.0
    if rules.law != ContactLaw.COULOMB and rules.law != ContactLaw.SMOOTH:
        return False
    k, arm, turn_drag = drag_bound(body, body.air.exponent, v, w, 0.0)
    drag = k * (norm(v) + arm * norm(w))
    slowing = (mu * weight * body.radius + turn_drag * abs(w[2]) + drag * arm) / J[2][2]
    moment = math.hypot(J[0][2], J[1][2]) * (w[2] * w[2] + slowing)
    moment += mu * weight * flat_z + drag * arm
    return moment < weight * (body.radius - math.hypot(c[0], c[1]))
