"""Coulomb friction integrated through the impact (Routh 1860; Keller 1986), the contact law `coulomb`.

The impact takes no time but has an order: the normal impulse p = S_z grows from 0, and with it the velocity
of the contact point A, dv_A/dp = K (-μ s, 1), s the direction of the slip and K the mobility. The slip may
turn, slow down, stop, stick, or start anew. E. J. Routh, Dynamics of a System of Rigid Bodies, 1860; J. B.
Keller, J. Appl. Mech. 53 (1986) 1; W. J. Stronge, Impact Mechanics.
"""

import math

import numpy as np

from analytic.numerics.runge_kutta import (
    STAGES,
    combined_error,
    end_point,
    error_parts,
    stage_point,
    step_factor,
)
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, norm
from models.laws import RestitutionKind

# The state of an impact: v_A, S and the work of the normal impulse, ∫ v_Az dp.
SIZE = 7
V_Z, WORK = 2, 6
TOLERANCE = 1e-13
# Slip slower than this part of the speed of A is none.
NO_SLIP = 1e-12
# Slip slower than this part of it is followed to the error of slip as fast as this, well below `NO_SLIP`.
SLOW_SLIP = 1e-2
# An acceleration of slip across itself, against that which friction makes of slip, that is none.
STRAIGHT = 1e-11
# After so many times the impulse in which slip turns, none is left of any other direction.
SETTLED = 40.0


@compiled
def coulomb(K, v_A, chi, mu, kind):
    """Return the impulse of Coulomb friction integrated through the impact.

    Kinematic restitution ends it when v_Az' = -χ v_Az. Energetic restitution (Stronge) ends it when the
    normal impulse has given back the part χ² of the work that it took in compression; it never adds energy.

    Args:
        K: mobility of A, space frame, a tuple of rows [1/kg].
        v_A: velocity of A before the impact, space frame, (3,), v_Az < 0 [m/s].
        chi: restitution χ.
        mu: coefficient of friction μ.
        kind: `RestitutionKind`.

    Returns:
        S: impulse, space frame, (3,) [N s].
    """
    y = np.zeros(SIZE)
    y[0], y[1], y[V_Z] = v_A
    no_slip = NO_SLIP * norm(v_A)
    if kind == RestitutionKind.KINEMATIC:
        grow_impulse(K, y, mu, no_slip, V_Z, -chi * v_A[2])
    else:
        grow_impulse(K, y, mu, no_slip, V_Z, 0.0)
        grow_impulse(K, y, mu, no_slip, WORK, (1 - chi * chi) * y[WORK])
    return y[3], y[4], y[5]


@compiled
def grow_impulse(K, y, mu, no_slip, component, target):
    """Let the normal impulse grow until a component of the state has risen to its target.

    Args:
        K: mobility of A [1/kg].
        y: state of the impact, (7,); advanced.
        mu: coefficient of friction μ.
        no_slip: slip that counts as none [m/s].
        component: `V_Z` or `WORK`.
        target: its value at the end.
    """
    if slide(K, y, mu, no_slip, component, target):
        return
    f = friction_without_slip(K, mu)
    gained = apply(K, (f[0], f[1], 1.0))
    go_straight(y, f, gained, impulse_to(y, gained[2], component, target))


@compiled
def impulse_to(y, rise, component, target):
    """Return the normal impulse in which a component reaches its target, dv_z/dp = `rise` being constant."""
    missing = target - y[component]
    if component == V_Z:
        return missing / rise
    return ((y[2] ** 2 + 2 * rise * missing) ** 0.5 - y[2]) / rise


@compiled
def go_straight(y, f, gained, p):
    """Advance the state by the normal impulse p under the friction f per normal impulse: v_A is linear in p.

    Args:
        y: state of the impact, (7,); advanced.
        f: (2,).
        gained: dv_A/dp, (3,) [1/kg].
        p: normal impulse [N s].
    """
    y[WORK] += y[2] * p + gained[2] * p * p / 2
    for i in range(3):
        y[i] += gained[i] * p
    y[3] += f[0] * p
    y[4] += f[1] * p
    y[5] += p


@compiled
def end_straight(y, f, gained, p, stops, component, target):
    """Advance the state by the p of `straight_slip`, and take the rounding out of its end."""
    go_straight(y, f, gained, p)
    if stops:
        y[0], y[1] = 0.0, 0.0
    else:
        y[component] = target


@compiled
def slide(K, y, mu, no_slip, component, target):
    """Follow the slip until it stops or a component has risen to its target; return whether it has risen.

    With dp = |v_t| dτ the equations are regular where the slip stops: dS/dτ = (-μ v_t, |v_t|) and
    dv_A/dτ = K dS/dτ.

    Arguments as those of `grow_impulse`.
    """
    stages, y_new = np.empty((STAGES, SIZE)), np.empty(SIZE)
    speed, dt = norm((y[0], y[1], y[2])), first_slip_step(K, mu)
    while y[component] < target:
        if math.hypot(y[0], y[1]) <= no_slip:
            return False
        f, gained, _, p, stops = straight_slip(K, y, mu, component, target)
        if p > 0:
            end_straight(y, f, gained, p, stops, component, target)
            return not stops
        _, dt = accepted_slip_step(K, y, mu, speed, dt, stages, y_new, component, target)
        copy_into(y, y_new)
    return True


@compiled
def straight_slip(K, y, mu, component, target):
    """Return whether slip keeps its direction long enough for all others to turn into it, and where it leads.

    Friction turns slip towards the direction s in which it accelerates, s × dv_A/dp = 0, at the rate
    (λ + κ)/|v_t|; λ = s · dv_A/dp is the growth of slip and κ = μ t · K_tt t, t across s. Where λ is small
    against κ, slip goes straight over many times the impulse in which it turns: step by step it would take
    thousands.

    Args:
        K: mobility of A [1/kg].
        y: state of the impact, (7,).
        mu: coefficient of friction μ.
        component: `V_Z` or `WORK`.
        target: its value at the end.

    Returns:
        f: friction per normal impulse, (2,).
        gained: dv_A/dp, (3,) [1/kg].
        κ [1/kg].
        p: the normal impulse of the straight slip, 0 where slip may turn [N s].
        stops: whether slip stops before the component reaches its target.
    """
    slip = math.hypot(y[0], y[1])
    s = (y[0] / slip, y[1] / slip)
    f = (-mu * s[0], -mu * s[1])
    gained = apply(K, (f[0], f[1], 1.0))
    turning, growth = s[0] * gained[1] - s[1] * gained[0], s[0] * gained[0] + s[1] * gained[1]
    kappa = mu * (s[1] * s[1] * K[0][0] - 2 * s[0] * s[1] * K[0][1] + s[0] * s[0] * K[1][1])
    if abs(turning) > STRAIGHT * kappa:
        return f, gained, kappa, 0.0, False
    to_stop = slip / -growth if growth < 0 else np.inf
    to_target = impulse_to(y, gained[2], component, target) if gained[2] > 0 else np.inf
    p = min(to_stop, to_target)
    if not SETTLED * slip < (kappa + growth) * p < np.inf:
        return f, gained, kappa, 0.0, False
    return f, gained, kappa, p, to_stop < to_target


@compiled
def first_slip_step(K, mu):
    """Return a step in τ with which to start, well below the time in which slip turns or stops."""
    return 0.1 / ((1 + mu) * (K[0][0] + K[1][1] + K[2][2]))


@compiled
def accepted_slip_step(K, y, mu, speed, dt, stages, y_new, component, target):
    """Advance the state by a step in τ whose error is within `TOLERANCE`, and not beyond the target.

    Args:
        K: mobility of A [1/kg].
        y: state at the start, (7,).
        mu: coefficient of friction μ.
        speed: of A before the impact, the scale of errors [m/s].
        dt: length to try first, in τ.
        stages: work space, (12, 7).
        y_new: where the state at the end goes, (7,).
        component: `V_Z` or `WORK`.
        target: its value at the end.

    Returns:
        The length of the step made, and a length for the next.
    """
    slip_rate(K, y, mu, stages[0])
    while True:
        slip_step(K, y, mu, dt, stages, y_new)
        slip = max(math.hypot(y[0], y[1]), SLOW_SLIP * speed)
        error = slip_error(dt, stages, slip, speed, speed / K[2][2]) / TOLERANCE
        if error <= 1:
            break
        dt *= step_factor(error)
    if y_new[component] < target:
        return dt, dt * step_factor(error)
    return slip_step_to(K, y, mu, dt, stages, y_new, component, target), dt


@compiled
def slip_rate(K, y, mu, dy):
    """Write the rate of change of the state with τ into dy."""
    slip = (y[0] * y[0] + y[1] * y[1]) ** 0.5
    dS = (-mu * y[0], -mu * y[1], slip)
    dy[0], dy[1], dy[2] = apply(K, dS)
    dy[3], dy[4], dy[5] = dS
    dy[WORK] = y[2] * slip


@compiled
def slip_step(K, y, mu, dt, stages, y_new):
    """Write the state after a step of dt in τ into y_new; `stages[0]` must hold the rate at y."""
    for stage in range(1, STAGES):
        stage_point(y, dt, stages, stage, y_new)
        slip_rate(K, y_new, mu, stages[stage])
    end_point(y, dt, stages, y_new)


@compiled
def slip_error(dt, stages, slip, speed, momentum):
    """Estimate the error of the step just made, relative to the slip, a speed and a momentum."""
    sum_5, sum_3 = 0.0, 0.0
    for i in range(SIZE):
        size = slip if i < V_Z else speed if i == V_Z else momentum if i < 6 else speed * momentum
        e5, e3 = error_parts(stages, i)
        sum_5 += (e5 / size) ** 2
        sum_3 += (e3 / size) ** 2
    return combined_error(dt, sum_5, sum_3, SIZE)


@compiled
def slip_step_to(K, y, mu, dt, stages, y_new, component, target):
    """Shorten a step of dt until the component just reaches its target; its end goes into y_new.

    A root by regula falsi (Illinois); each try is one step from the same start.

    Returns:
        The length of the shortened step.
    """
    low, high = 0.0, dt
    below, above = y[component] - target, y_new[component] - target
    for _ in range(60):
        middle = high - above * (high - low) / (above - below)
        if above == 0 or not low < middle < high:
            break
        slip_step(K, y, mu, middle, stages, y_new)
        excess = y_new[component] - target
        if excess >= 0:
            high, above, below = middle, excess, below / 2
        else:
            low, below, above = middle, excess, above / 2
    slip_step(K, y, mu, high, stages, y_new)
    y_new[component] = target
    return high


@compiled
def friction_without_slip(K, mu):
    """Return the tangential impulse per normal impulse at a contact point that does not slip, (2,).

    It sticks, K_tt f + K_tz = 0, where that lies within the cone. Elsewhere slip starts in the direction s
    that keeps itself, f = -μ s and K_tz - μ K_tt s = λ s: s = (μ K_tt + λ)⁻¹ K_tz has length 1 for just one
    λ > 0, for its length falls with λ.

    Args:
        K: mobility of A [1/kg].
        mu: coefficient of friction μ.
    """
    push = (K[0][2], K[1][2])
    stick = resisted(K, 1.0, 0.0, push)
    if math.hypot(stick[0], stick[1]) <= mu:
        return -stick[0], -stick[1]
    low, high = 0.0, math.hypot(K[0][2], K[1][2])
    for _ in range(100):
        middle = (low + high) / 2
        s = resisted(K, mu, middle, push)
        if not low < middle < high:
            break
        if math.hypot(s[0], s[1]) > 1:
            low = middle
        else:
            high = middle
    s = resisted(K, mu, high, push)
    length = math.hypot(s[0], s[1])
    return -mu * s[0] / length, -mu * s[1] / length


@compiled
def resisted(K, mu, growth, push):
    """Return (mu K_tt + growth)⁻¹ push, (2,)."""
    xx, yy, xy = mu * K[0][0] + growth, mu * K[1][1] + growth, mu * K[0][1]
    determinant = xx * yy - xy * xy
    return (yy * push[0] - xy * push[1]) / determinant, (xx * push[1] - xy * push[0]) / determinant
