"""Coulomb friction integrated through the impact (Routh 1860; Keller 1986), the contact law `coulomb`.

The impact takes no time but has an order: the normal impulse p = S_z grows from 0, and with it the velocity
of the contact point A, dv_A/dp = K (-μ s, 1), s the direction of the slip and K the Delassus matrix. The slip
may turn, slow down, stop, stick, or start anew. E. J. Routh, Dynamics of a System of Rigid Bodies, 1860;
J. B. Keller, J. Appl. Mech. 53 (1986) 1; W. J. Stronge, Impact Mechanics.
"""

import math

import numpy as np

from cointoss.analytic.impact.slip_stop import expand_stop, impulse_until, room_for_stop
from cointoss.analytic.numerics.roots import bracket_between, is_narrow, narrowed, next_try
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import apply, norm
from cointoss.models.laws import RestitutionKind

# The state of an impact: v_A, S and the work of the normal impulse, ∫ v_Az dp.
SIZE = 7
V_Z, WORK = 2, 6
# The slip's power series: its order, and what its last two terms are at most, against slip and speed.
ORDER, SMALLEST = 20, 1e-16
# Columns of the series: v_A, S, the work, and |v_t|.
COLUMNS, SLIP = 8, 7
# |v_t| of the series and of v_A in it agree to this part of the slip. Beyond a slip of almost 0 they do not:
# the series goes on as if it had passed 0.
AGREES = 1e-13
# Where a component reaches its target in a step is found to this part of the step.
TARGET = 0.5**50
# Slip slower than this part of the speed of A is none.
NO_SLIP = 1e-12
# Slip slower than this part of it is followed to the error of slip as fast as this: with `SMALLEST` and
# `AGREES` well below `NO_SLIP`.
SLOW_SLIP = 1.0
# An acceleration of slip across itself, against that which friction makes of slip, that is none.
STRAIGHT = 1e-11
# After so many times the impulse in which slip turns, none is left of any other direction.
SETTLED = 40.0
# Slip that dies away is followed until x, see `slip_stop`, is e to the minus this.
TURNED = 40.0


@compiled
def coulomb(K, v_A, chi, mu, kind):
    """Return the impulse of Coulomb friction integrated through the impact.

    Kinematic restitution ends it when v_Az' = -χ v_Az. Energetic restitution (Stronge) ends it when the
    normal impulse has given back the part χ² of the work that it took in compression; it never adds energy.

    Args:
        K: Delassus matrix of A, space frame, a tuple of rows [1/kg].
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
        grow_impulse(K, y, mu, no_slip, False, V_Z, -chi * v_A[2])
    else:
        grow_impulse(K, y, mu, no_slip, True, V_Z, 0.0)
        grow_impulse(K, y, mu, no_slip, True, WORK, (1 - chi * chi) * y[WORK])
    return y[3], y[4], y[5]


@compiled
def grow_impulse(K, y, mu, no_slip, with_work, component, target):
    """Let the normal impulse grow until a component of the state has risen to its target.

    Args:
        K: Delassus matrix of A [1/kg].
        y: state of the impact, (7,); advanced.
        mu: coefficient of friction μ.
        no_slip: slip that counts as none [m/s].
        with_work: whether the work is wanted; else that of slip is left out.
        component: `V_Z` or `WORK`.
        target: its value at the end.
    """
    if slide(K, y, mu, no_slip, with_work, component, target):
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
def slide(K, y, mu, no_slip, with_work, component, target):
    """Follow the slip until it stops or a component has risen to its target; return whether it has risen.

    With dp = |v_t| dτ the equations are regular where the slip stops: dS/dτ = (-μ v_t, |v_t|) and
    dv_A/dτ = K dS/dτ.

    Arguments as those of `grow_impulse`.
    """
    series, y_new, speed = np.empty((ORDER + 1, COLUMNS)), np.empty(COLUMNS), norm((y[0], y[1], y[2]))
    to_stop = room_for_stop()
    while y[component] < target:
        if math.hypot(y[0], y[1]) <= no_slip:
            return False
        f, gained, p, stops = straight_slip(K, y, mu, no_slip, component, target)
        if p > 0:
            end_straight(y, f, gained, p, stops, component, target)
            return not stops
        if die_away(K, y, mu, with_work, component, target, to_stop, y_new):
            copy_into(y, y_new[:SIZE])
            continue
        length, size = expand_slip(K, y, mu, speed, with_work, series)
        while True:
            slipped(series, length, y_new)
            if abs(y_new[SLIP] - math.hypot(y_new[0], y_new[1])) <= AGREES * size:
                break
            length /= 2
        if y_new[component] >= target:
            slipped(series, time_to(series, length, y_new, component, target), y_new)
            y_new[component] = target
        copy_into(y, y_new)
    return True


@compiled
def straight_slip(K, y, mu, no_slip, component, target):
    """Return whether slip keeps its direction long enough for all others to turn into it, and where it leads.

    Friction turns slip towards the direction s in which it accelerates, s × dv_A/dp = 0, at the rate
    (λ + κ)/|v_t|; λ = s · dv_A/dp is the growth of slip and κ = μ t · K_tt t, t across s. Where λ is small
    against κ, slip goes straight over many times the impulse in which it turns: step by step it would take
    thousands. The direction of slow slip is known only to the rounding of v_A: it is turned into the one that
    it keeps, by Newton's method, where what it has across that counts as none.

    Args:
        K: Delassus matrix of A [1/kg].
        y: state of the impact, (7,).
        mu: coefficient of friction μ.
        no_slip: slip that counts as none [m/s].
        component: `V_Z` or `WORK`.
        target: its value at the end.

    Returns:
        f: friction per normal impulse, (2,).
        gained: dv_A/dp, (3,) [1/kg].
        p: the normal impulse of the straight slip, 0 where slip may turn [N s].
        stops: whether slip stops before the component reaches its target.
    """
    slip, most = math.hypot(y[0], y[1]), no_slip
    s = (y[0] / slip, y[1] / slip)
    while True:
        f = (-mu * s[0], -mu * s[1])
        gained = apply(K, (f[0], f[1], 1.0))
        turning, growth = s[0] * gained[1] - s[1] * gained[0], s[0] * gained[0] + s[1] * gained[1]
        kappa = mu * (s[1] * s[1] * K[0][0] - 2 * s[0] * s[1] * K[0][1] + s[0] * s[0] * K[1][1])
        if abs(turning) <= STRAIGHT * kappa:
            break
        aside = slip * abs(turning)
        if not aside <= most * (kappa + growth):
            return f, gained, 0.0, False
        angle = turning / (kappa + growth)
        most = slip * abs(angle) / 2
        length = math.hypot(1.0, angle)
        s = ((s[0] - angle * s[1]) / length, (s[1] + angle * s[0]) / length)
    to_stop = slip / -growth if growth < 0 else np.inf
    to_target = impulse_to(y, gained[2], component, target) if gained[2] > 0 else np.inf
    p = min(to_stop, to_target)
    if not SETTLED * slip < (kappa + growth) * p < np.inf:
        return f, gained, 0.0, False
    return f, gained, p, to_stop < to_target


@compiled
def die_away(K, y, mu, with_work, component, target, series, y_new):
    """Follow slip that dies away to its stop, or until a component of the state rises to its target.

    Args:
        K: Delassus matrix of A [1/kg].
        y: state of the impact, (7,), which slips.
        mu: coefficient of friction μ.
        with_work: see `grow_impulse`.
        component: `V_Z` or `WORK`.
        target: its value at the end.
        series: see `room_for_stop`; work space.
        y_new: where the state goes, (8,).

    Returns:
        Whether slip dies away so, and v_Az rises whatever its direction.
    """
    if not K[2][2] > mu * math.hypot(K[2][0], K[2][1]):
        return False
    stop = expand_stop(K, mu, (y[0], y[1]), with_work, series)
    if stop.end == 0:
        return False
    state_at(K, y, mu, stop, series, 0.0, y_new)
    if y_new[component] < target:
        y_new[0], y_new[1] = 0.0, 0.0
        return True
    state_at(K, y, mu, stop, series, math.exp(-TURNED), y_new)
    if y_new[component] < target:
        return True
    tolerance = TARGET * TURNED
    bracket = bracket_between(0.0, target - y[component], TURNED, target - y_new[component])
    while not is_narrow(bracket, tolerance):
        tried = next_try(bracket)
        state_at(K, y, mu, stop, series, math.exp(-tried), y_new)
        bracket = narrowed(bracket, tried, target - y_new[component], tolerance)
    state_at(K, y, mu, stop, series, math.exp(-bracket.high), y_new)
    y_new[component] = target
    return True


@compiled
def state_at(K, y, mu, stop, series, x, y_new):
    """Write the state at the place x of slip that dies away into y_new; see `impulse_until`."""
    S, path = impulse_until(stop, series, x)
    gained = apply(K, S)
    y_new[WORK] = y[WORK] + mu * path
    for i in range(3):
        y_new[i], y_new[3 + i] = y[i] + gained[i], y[3 + i] + S[i]
        # The work of S, of which friction's is -μ X.
        y_new[WORK] += (y[i] + gained[i] / 2) * S[i]


@compiled
def expand_slip(K, y, mu, speed, with_work, series):
    """Expand the motion of the slipping point as a power series of τ.

    dS/dτ = (-μ v_t, q) with q = |v_t|, so the next coefficients of S, and of v_A by K, follow from those of
    v_t and q, and the next one of q from q² = v_t².

    Args:
        K: Delassus matrix of A [1/kg].
        y: state at the start, (7,), which slips.
        mu: coefficient of friction μ.
        speed: of A before the impact [m/s].
        with_work: see `grow_impulse`.
        series: where the coefficients go, (ORDER + 1, COLUMNS).

    Returns:
        The τ up to which the series holds, and the scale of the slip [m/s].
    """
    slip = math.hypot(y[0], y[1])
    copy_into(series[0, :SIZE], y)
    series[0, SLIP] = slip
    size = max(slip, SLOW_SLIP * speed)
    length = np.inf
    for k in range(ORDER):
        part = 1 / (k + 1)
        S = (-mu * series[k, 0] * part, -mu * series[k, 1] * part, series[k, SLIP] * part)
        v = apply(K, S)
        for i in range(3):
            series[k + 1, i], series[k + 1, 3 + i] = v[i], S[i]
        series[k + 1, WORK] = part * _work_term(series, k) if with_work else 0.0
        products = _products(series, k)
        series[k + 1, SLIP] = (series[0, 0] * v[0] + series[0, 1] * v[1] - products) / slip
        if k >= ORDER - 2:
            term = max(abs(v[0]), abs(v[1]), abs(series[k + 1, SLIP])) / size
            term = max(term, abs(v[2]) / speed)
            if term > 0:
                length = min(length, (SMALLEST / term) ** part)
    return length, size


@compiled
def _work_term(series, k):
    """Return the coefficient k of v_Az |v_t|."""
    total = 0.0
    for j in range(k + 1):
        total += series[j, V_Z] * series[k - j, SLIP]
    return total


@compiled
def _products(series, k):
    """Return half of what the coefficients from 1 up to k give to the next one of q² - v_t²."""
    q, x, y = 0.0, 0.0, 0.0
    for j in range(1, (k + 2) // 2):
        one, other = series[j], series[k + 1 - j]
        q += one[SLIP] * other[SLIP]
        x += one[0] * other[0]
        y += one[1] * other[1]
    if k % 2 == 1:
        middle = series[(k + 1) // 2]
        q += middle[SLIP] ** 2 / 2
        x += middle[0] ** 2 / 2
        y += middle[1] ** 2 / 2
    return q - x - y


@compiled
def slipped(series, t, y_new):
    """Write the state of the impact at τ = t of a series, and |v_t|, into y_new, (8,)."""
    for i in range(COLUMNS):
        y_new[i] = 0.0
    for k in range(ORDER, -1, -1):
        for i in range(COLUMNS):
            y_new[i] = y_new[i] * t + series[k, i]


@compiled
def time_to(series, length, y_new, component, target):
    """Return the τ at which a component of the state rises to its target.

    Args:
        series: see `expand_slip`.
        length: τ at which the component is beyond the target.
        y_new: state there, (8,); work space.
        component: `V_Z` or `WORK`.
        target: its value at the end.
    """
    tolerance = TARGET * length
    bracket = bracket_between(0.0, target - series[0, component], length, target - y_new[component])
    while not is_narrow(bracket, tolerance):
        tried = next_try(bracket)
        slipped(series, tried, y_new)
        bracket = narrowed(bracket, tried, target - y_new[component], tolerance)
    return bracket.high


@compiled
def friction_without_slip(K, mu):
    """Return the tangential impulse per normal impulse at a contact point that does not slip, (2,).

    It sticks, K_tt f + K_tz = 0, where that lies within the cone. Elsewhere slip starts in the direction s
    that keeps itself, f = -μ s and K_tz - μ K_tt s = λ s: s = (μ K_tt + λ)⁻¹ K_tz has length 1 for just one
    λ > 0, for its length falls with λ.

    Args:
        K: Delassus matrix of A [1/kg].
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
