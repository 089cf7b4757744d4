"""The tangent map of Routh's law: how a small change before an impact changes its impulse.

Every function here is the derivative, line by line, of one of `analytic.impact.coulomb`, its steps held.
"""

import math

import numpy as np

from analytic.impact.coulomb import (
    NO_SLIP,
    SIZE,
    V_Z,
    WORK,
    accepted_slip_step,
    end_straight,
    first_slip_step,
    friction_without_slip,
    go_straight,
    impulse_to,
    resisted,
    slip_rate,
    straight_slip,
)
from analytic.numerics.runge_kutta import STAGES, end_point, stage_point
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, norm
from models.laws import RestitutionKind


@compiled
def coulomb_change(K, dK, v_A, dv_A, chi, mu, kind):
    """Give the change of `coulomb.coulomb`, space frame, (3,) [N s].

    Args:
        K: mobility of A, space frame, a tuple of rows [1/kg].
        dK: its change.
        v_A: velocity of A before the impact, space frame, (3,) [m/s].
        dv_A: its change, (3,).
        chi: restitution χ.
        mu: coefficient of friction μ.
        kind: `RestitutionKind`.
    """
    y, dy = np.zeros(SIZE), np.zeros(SIZE)
    y[0], y[1], y[V_Z] = v_A
    dy[0], dy[1], dy[V_Z] = dv_A
    no_slip = NO_SLIP * norm(v_A)
    if kind == RestitutionKind.KINEMATIC:
        press_change(K, dK, y, dy, mu, no_slip, V_Z, -chi * v_A[2], -chi * dv_A[2])
    else:
        press_change(K, dK, y, dy, mu, no_slip, V_Z, 0.0, 0.0)
        part = 1 - chi * chi
        press_change(K, dK, y, dy, mu, no_slip, WORK, part * y[WORK], part * dy[WORK])
    return dy[3], dy[4], dy[5]


@compiled
def press_change(K, dK, y, dy, mu, no_slip, component, target, d_target):
    """Carry the change dy of the state through `coulomb.press`; both (7,)."""
    if slide_change(K, dK, y, dy, mu, no_slip, component, target, d_target):
        return
    f, df = friction_change(K, dK, mu)
    direction, d_direction = (f[0], f[1], 1.0), (df[0], df[1], 0.0)
    gained = apply(K, direction)
    d_gained = add(apply(dK, direction), apply(K, d_direction))
    rise, d_rise = gained[2], d_gained[2]
    p = impulse_to(y, rise, component, target)
    if component == V_Z:
        dp = (d_target - dy[2] - d_rise * p) / rise
    else:
        dp = (d_target - dy[WORK] - dy[2] * p - d_rise * p * p / 2) / (y[2] + rise * p)
    dy[WORK] += dy[2] * p + y[2] * dp + d_rise * p * p / 2 + rise * p * dp
    for i in range(3):
        dy[i] += d_gained[i] * p + gained[i] * dp
        dy[3 + i] += d_direction[i] * p + direction[i] * dp
    go_straight(y, f, gained, p)


@compiled
def slide_change(K, dK, y, dy, mu, no_slip, component, target, d_target):
    """Carry the change dy of the state through `coulomb.slide`; tell whether the target was reached."""
    stages, y_new = np.empty((STAGES, SIZE)), np.empty(SIZE)
    speed, dt = norm((y[0], y[1], y[2])), first_slip_step(K, mu)
    while y[component] < target:
        if math.hypot(y[0], y[1]) <= no_slip:
            return False
        f, gained, kappa, p, stops = straight_slip(K, y, mu, component, target)
        if p > 0:
            straight_change(K, dK, y, dy, mu, f, gained, kappa, p, stops, component, d_target)
            end_straight(y, f, gained, p, stops, component, target)
            return not stops
        made, dt = accepted_slip_step(K, y, mu, speed, dt, stages, y_new, component, target)
        slip_step_change(K, dK, y, dy, mu, made, stages)
        y[:] = y_new
        if y[component] >= target:
            # The phase ends where the component meets its target: sooner or later, with the change.
            slip_rate(K, y, mu, stages[0])
            delay = (d_target - dy[component]) / stages[0, component]
            for i in range(SIZE):
                dy[i] += stages[0, i] * delay
    return True


@compiled
def straight_change(K, dK, y, dy, mu, f, gained, kappa, p, stops, component, d_target):
    """Carry the change dy of the state through a straight slip, which `coulomb.straight_slip` found.

    Along t, across the slip's direction s, the change obeys dδ/dp = c - κ δ/u with u = |v_t| = u_0 + λ p. By
    the end only δ = c u/(λ + κ) is left of it, and the direction's change has summed up, with P = ∫ δ/u dp
    and Q = ∫ P dp, to κ P = c p - [δ] and κ Q = c p²/2 + δ_0 p - ∫ δ dp, (κ - λ) ∫ δ dp = c ∫ u dp - [u δ].
    """
    u = math.hypot(y[0], y[1])
    s, t = (y[0] / u, y[1] / u), (-y[1] / u, y[0] / u)
    growth = s[0] * gained[0] + s[1] * gained[1]
    u_end = 0.0 if stops else u + growth * p
    pushed = apply(dK, (f[0], f[1], 1.0))
    across = t[0] * pushed[0] + t[1] * pushed[1]
    d_start, d_end = t[0] * dy[0] + t[1] * dy[1], across * u_end / (growth + kappa)
    P = (across * p - (d_end - d_start)) / kappa
    summed = (across * (u * p + growth * p * p / 2) - (u_end * d_end - u * d_start)) / (kappa - growth)
    Q = (across * p * p / 2 + d_start * p - summed) / kappa
    turned = apply(K, (-mu * t[0], -mu * t[1], 0.0))
    dy[WORK] += dy[2] * p + pushed[2] * p * p / 2 + turned[2] * Q
    for i in range(3):
        dy[i] += pushed[i] * p + turned[i] * P
    dy[3] -= mu * t[0] * P
    dy[4] -= mu * t[1] * P
    # The straight slip ends sooner or later, with the change.
    if stops:
        delay = -(s[0] * dy[0] + s[1] * dy[1]) / growth
    else:
        rate = gained[2] if component == V_Z else y[2] + gained[2] * p
        delay = (d_target - dy[component]) / rate
    dy[WORK] += (y[2] + gained[2] * p) * delay
    for i in range(3):
        dy[i] += gained[i] * delay
    dy[3] += f[0] * delay
    dy[4] += f[1] * delay
    dy[5] += delay
    if stops:
        dy[0], dy[1] = 0.0, 0.0


@compiled
def slip_step_change(K, dK, y, dy, mu, dt, stages):
    """Carry the change dy of the state through the step of dt whose rates are in `stages`."""
    slopes, point, change = np.empty((STAGES, SIZE)), np.empty(SIZE), np.empty(SIZE)
    for stage in range(STAGES):
        stage_point(y, dt, stages, stage, point)
        stage_point(dy, dt, slopes, stage, change)
        slip = math.hypot(point[0], point[1])
        d_slip = (point[0] * change[0] + point[1] * change[1]) / slip
        dS = (-mu * point[0], -mu * point[1], slip)
        ddS = (-mu * change[0], -mu * change[1], d_slip)
        slopes[stage, 0], slopes[stage, 1], slopes[stage, 2] = add(apply(dK, dS), apply(K, ddS))
        slopes[stage, 3], slopes[stage, 4], slopes[stage, 5] = ddS
        slopes[stage, WORK] = change[2] * slip + point[2] * d_slip
    end_point(dy, dt, slopes, change)
    dy[:] = change


@compiled
def friction_change(K, dK, mu):
    """Give `coulomb.friction_without_slip` and its change, both (2,).

    Where A sticks, K_tt df = -dK_tz - dK_tt f. Where slip starts in the direction s, (μ K_tt + λ) s = K_tz
    with |s| = 1: ds = M⁻¹ (dK_tz - μ dK_tt s) - dλ M⁻¹ s, M = μ K_tt + λ, and dλ keeps s · ds = 0.
    """
    f = friction_without_slip(K, mu)
    if math.hypot(f[0], f[1]) < mu * (1 - 1e-12):
        pushed = (dK[0][2] + dK[0][0] * f[0] + dK[0][1] * f[1], dK[1][2] + dK[1][0] * f[0] + dK[1][1] * f[1])
        df = resisted(K, 1.0, 0.0, pushed)
        return f, (-df[0], -df[1])
    if mu == 0:
        return f, (0.0, 0.0)
    s = (-f[0] / mu, -f[1] / mu)
    pushed = (
        dK[0][2] - mu * (dK[0][0] * s[0] + dK[0][1] * s[1]),
        dK[1][2] - mu * (dK[1][0] * s[0] + dK[1][1] * s[1]),
    )
    growth = s[0] * K[0][2] + s[1] * K[1][2]
    growth -= mu * (s[0] * (K[0][0] * s[0] + K[0][1] * s[1]) + s[1] * (K[1][0] * s[0] + K[1][1] * s[1]))
    free, along = resisted(K, mu, growth, pushed), resisted(K, mu, growth, s)
    d_growth = (s[0] * free[0] + s[1] * free[1]) / (s[0] * along[0] + s[1] * along[1])
    return f, (-mu * (free[0] - d_growth * along[0]), -mu * (free[1] - d_growth * along[1]))
