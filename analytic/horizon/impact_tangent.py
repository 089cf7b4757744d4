"""The tangent map of an impact: how a small change of the state at a touch changes what the floor does.

Every function here is the derivative, line by line, of one of `models.geometry`, `analytic.impact.laws` or
`analytic.events.hit`.
"""

from typing import NamedTuple

import numpy as np

from analytic.flight.equations_of_motion import STATE_SIZE, attitude_of, derivative, spin_of, velocity_of
from analytic.horizon.coulomb_tangent import coulomb_change
from analytic.impact.laws import NO_IMPULSE, impulse, mobility, spin_gained
from analytic.numerics.rotation import rotation_change
from models.attitude import rotation_matrix
from models.geometry import FLAT_SINE, contact_velocity, lowest_point
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, apply_transposed, cross, dot, scale, solve, subtract
from models.laws import ContactLaw
from models.records import Array


@compiled
def gap_change(body, up, dz, d_up):
    """Give the change of the gap [m], of a coin neither flat nor on its edge.

    A flat coin's gap has no derivative towards a tilt; one that keeps flat has that without the rim's term.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        dz: change of the height of C [m].
        d_up: change of `up`, (3,).
    """
    side = 1.0 if up[2] > 0 else -1.0
    change = dz - dot(d_up, body.center) - side * body.thickness / 2 * d_up[2]
    tilt_sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    if tilt_sine > FLAT_SINE:
        change -= body.radius * (up[0] * d_up[0] + up[1] * d_up[1]) / tilt_sine
    return change


@compiled
def lowest_point_change(body, up, d_up):
    """Give how the lowest point of a tilted coin moves along its rim, body frame, (3,) [m].

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, (3,).
        d_up: its change, (3,).
    """
    tilt_sine = (up[0] * up[0] + up[1] * up[1]) ** 0.5
    if tilt_sine <= FLAT_SINE:
        return 0.0, 0.0, 0.0
    across = (up[0] * d_up[1] - up[1] * d_up[0]) / tilt_sine**3
    return body.radius * up[1] * across, -body.radius * up[0] * across, 0.0


@compiled
def spin_gained_change(body, R, dR, arm, d_arm, S, dS):
    """Give the change of `impact.spin_gained`: of J_C⁻¹ Rᵀ (a × S), body frame, (3,) [rad/s]."""
    turn = add(cross(d_arm, S), cross(arm, dS))
    return apply(body.inertia_inverse, add(apply_transposed(dR, cross(arm, S)), apply_transposed(R, turn)))


@compiled
def velocity_gained_change(body, R, dR, arm, d_arm, S):
    """Give dK S: the change, for the same impulse S, of the velocity that A gains, space frame [m/s]."""
    turned = apply(R, spin_gained(body, R, arm, S))
    d_turned = add(
        apply(dR, spin_gained(body, R, arm, S)),
        apply(R, spin_gained_change(body, R, dR, arm, d_arm, S, NO_IMPULSE)),
    )
    return add(cross(d_turned, arm), cross(turned, d_arm))


@compiled
def wanted_change(law, chi, v_A, dv_A, tau, d_tau):
    """Give the change of the velocity of A that the laws (a) to (d) want after the impact, (3,) [m/s].

    Args:
        law: one of them.
        chi: restitution.
        v_A: velocity of A before the impact, space frame, (3,) [m/s].
        dv_A: its change, (3,) [m/s].
        tau: unit vector along the coin's edge at A, space frame, (3,).
        d_tau: its change, (3,).
    """
    up = -chi * dv_A[2]
    if law == ContactLaw.SHARP_EDGE:
        along, d_along = dot(v_A, tau), dot(dv_A, tau) + dot(v_A, d_tau)
        return d_along * tau[0] + along * d_tau[0], d_along * tau[1] + along * d_tau[1], up
    if law == ContactLaw.KNURLED:
        nu, d_nu = (-tau[1], tau[0], 0.0), (-d_tau[1], d_tau[0], 0.0)
        across, d_across = dot(v_A, nu), dot(dv_A, nu) + dot(v_A, d_nu)
        return d_across * nu[0] + across * d_nu[0], d_across * nu[1] + across * d_nu[1], up
    if law == ContactLaw.SLIP_PRESERVING:
        return dv_A[0], dv_A[1], up
    return 0.0, 0.0, up


@compiled
def impulse_change(body, rules, R, dR, arm, d_arm, tau, d_tau, v_A, dv_A, S, flat):
    """Give the change of `impact.impulse` S, space frame, (3,) [N s].

    For (a) to (d), K S = v_A' - v_A gives K dS = dv_A' - dv_A - dK S. For (e) and (f) the impulse has a
    direction p, S = S_z p, and (K p)_z S_z = -(1 + χ) v_Az. Routh's law is followed through its phases.
    """
    chi, law = rules.restitution, rules.law
    if flat:
        return 0.0, 0.0, -(1 + chi) * body.mass * dv_A[2]
    K = mobility(body, R, arm)
    dK_S = velocity_gained_change(body, R, dR, arm, d_arm, S)
    if law != ContactLaw.SMOOTH and law != ContactLaw.SLIDING_FRICTION:
        if law == ContactLaw.COULOMB:
            # dK is symmetric: its columns are its rows.
            dK = (
                velocity_gained_change(body, R, dR, arm, d_arm, (1.0, 0.0, 0.0)),
                velocity_gained_change(body, R, dR, arm, d_arm, (0.0, 1.0, 0.0)),
                velocity_gained_change(body, R, dR, arm, d_arm, (0.0, 0.0, 1.0)),
            )
            return coulomb_change(K, dK, v_A, dv_A, chi, rules.friction, rules.restitution_kind)
        wanted = wanted_change(law, chi, v_A, dv_A, tau, d_tau)
        return solve(K, subtract(subtract(wanted, dv_A), dK_S))
    slip = (v_A[0] * v_A[0] + v_A[1] * v_A[1]) ** 0.5
    direction, d_direction = (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
    if law == ContactLaw.SLIDING_FRICTION and slip > 0:
        u = (v_A[0] / slip, v_A[1] / slip)
        turn = (u[0] * dv_A[1] - u[1] * dv_A[0]) / slip
        direction = (-rules.friction * u[0], -rules.friction * u[1], 1.0)
        d_direction = (rules.friction * u[1] * turn, -rules.friction * u[0] * turn, 0.0)
    gained = dot(K[2], direction)
    S_z = S[2]
    dS_z = (-(1 + chi) * dv_A[2] - dK_S[2] - S_z * dot(K[2], d_direction)) / gained
    return add(scale(dS_z, direction), scale(S_z, d_direction))


class Touch(NamedTuple):
    """Derivatives with respect to the state before an impact, with the coin held at the touch."""

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
def touch_tangent(body, rules, y):
    """Give the derivatives of a touch and of its impact, as a `Touch`.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at the touch, before the impact, (13,).
    """
    v, e, w = velocity_of(y), attitude_of(y), spin_of(y)
    R = rotation_matrix(e)
    point, flat = lowest_point(body, R[2], w)
    from_C = subtract(point, body.center)
    arm = apply(R, from_C)
    edge = (point[0] ** 2 + point[1] ** 2) ** 0.5
    t = (-point[1] / edge, point[0] / edge, 0.0) if edge > 0 else (1.0, 0.0, 0.0)
    tau = apply(R, t)
    v_A = contact_velocity(body, R, v, w, point)
    S, _ = impulse(body, rules, rules.restitution, R, arm, tau, v_A, flat)

    n = STATE_SIZE
    rate, gap_row, dy = np.empty(n), np.empty(n), np.empty(n)
    up_rows, velocity_rows, impulse_rows = np.empty((3, n)), np.empty((3, n)), np.empty((3, n))
    after = np.eye(n)
    derivative(body, y, rate)
    for column in range(n):
        dy[:] = 0.0
        dy[column] = 1.0
        dv, dw, dR = velocity_of(dy), spin_of(dy), rotation_change(e, attitude_of(dy))
        d_point = (0.0, 0.0, 0.0) if flat else lowest_point_change(body, R[2], dR[2])
        d_arm = add(apply(dR, from_C), apply(R, d_point))
        d_t = (-d_point[1] / edge, d_point[0] / edge, 0.0) if edge > 0 else (0.0, 0.0, 0.0)
        d_tau = add(apply(dR, t), apply(R, d_t))
        turn, d_turn = cross(w, from_C), add(cross(dw, from_C), cross(w, d_point))
        dv_A = add(dv, add(apply(dR, turn), apply(R, d_turn)))
        dS = impulse_change(body, rules, R, dR, arm, d_arm, tau, d_tau, v_A, dv_A, S, flat)
        d_spin = spin_gained_change(body, R, dR, arm, d_arm, S, dS)
        gap_row[column] = gap_change(body, R[2], dy[2], dR[2])
        for i in range(3):
            up_rows[i, column] = dR[2][i]
            velocity_rows[i, column] = dv_A[i]
            impulse_rows[i, column] = dS[i]
            after[3 + i, column] += dS[i] / body.mass
            if not flat:
                after[10 + i, column] += d_spin[i]
    return Touch(rate, gap_row, up_rows, velocity_rows, impulse_rows, after)
