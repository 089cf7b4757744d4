"""Coulomb friction integrated through the impact (Routh 1860; Keller 1986), the contact law `coulomb`.

The impact takes no time but has an order: the normal impulse p = S_z grows from 0, and with it the velocity
of the contact point A, dv_A/dp = K (-μ s, 1), s the direction of the slip and K the Delassus matrix. The
slip may turn, slow down, stop, stick, or start anew. E. J. Routh, Dynamics of a System of Rigid Bodies, 1860;
J. B. Keller, J. Appl. Mech. 53 (1986) 1; W. J. Stronge, Impact Mechanics.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.models.contact_laws.law import Impact, Law, Recorded
from cointoss.models.contact_laws.slip_stop import SlipStop, expand_stop, impulse_until, room_for_stop
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.roots import bracket_between, is_narrow, narrowed, next_try
from cointoss.models.kernel.vectors import Matrix, Vector, apply, norm
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


class RoughPoint(NamedTuple):
    """The contact point A in an impact with friction."""

    delassus: Matrix
    """K, space frame [1/kg]."""
    friction: float
    """Coefficient of friction μ."""
    no_slip: float
    """Slip that counts as none [m/s]."""
    with_work: bool
    """Whether the work is wanted; else that of slip is left out."""


class Goal(NamedTuple):
    """What ends an impact, or its compression: a component of its state that rises to a target."""

    component: int
    """`V_Z` or `WORK`."""
    target: float


@compiled
def coulomb(K: Matrix, v_A: Vector, chi: float, mu: float, kind: RestitutionKind) -> Vector:
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
        grow_impulse(RoughPoint(K, mu, no_slip, False), y, Goal(V_Z, -chi * v_A[2]))
    else:
        A = RoughPoint(K, mu, no_slip, True)
        grow_impulse(A, y, Goal(V_Z, 0.0))
        grow_impulse(A, y, Goal(WORK, (1 - chi * chi) * y[WORK]))
    return y[3], y[4], y[5]


@compiled
def grow_impulse(A: RoughPoint, y: Array, goal: Goal) -> None:
    """Let the normal impulse grow until a component of the state has risen to its target.

    Args:
        A: that may slip.
        y: state of the impact, (7,); advanced.
        goal: what it grows to.
    """
    if slide(A, y, goal):
        return
    f = friction_without_slip(A.delassus, A.friction)
    gained = apply(A.delassus, (f[0], f[1], 1.0))
    go_straight(y, f, gained, impulse_to(y, gained[2], goal))


@compiled
def impulse_to(y: Array, rise: float, goal: Goal) -> float:
    """Return the normal impulse that reaches the goal, dv_z/dp = `rise` being constant."""
    missing = goal.target - y[goal.component]
    if goal.component == V_Z:
        return missing / rise
    return ((y[2] ** 2 + 2 * rise * missing) ** 0.5 - y[2]) / rise


@compiled
def go_straight(y: Array, f: tuple[float, float], gained: Vector, p: float) -> None:
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
def slide(A: RoughPoint, y: Array, goal: Goal) -> bool:
    """Follow the slip until it stops or reaches the goal; return whether it has reached it.

    With dp = |v_t| dτ the equations are regular where the slip stops: dS/dτ = (-μ v_t, |v_t|) and
    dv_A/dτ = K dS/dτ.

    Arguments as those of `grow_impulse`.
    """
    series, y_new, speed = np.empty((ORDER + 1, COLUMNS)), np.empty(COLUMNS), norm((y[0], y[1], y[2]))
    to_stop = room_for_stop()
    while y[goal.component] < goal.target:
        if math.hypot(y[0], y[1]) <= A.no_slip:
            return False
        f, gained, p, stops = straight_slip(A, y, goal)
        if p > 0:
            go_straight(y, f, gained, p)
            # Its end is without rounding.
            if stops:
                y[0], y[1] = 0.0, 0.0
            else:
                y[goal.component] = goal.target
            return not stops
        if die_away(A, y, goal, to_stop, y_new):
            copy_into(y, y_new[:SIZE])
            continue
        length, size = expand_slip(A, y, speed, series)
        while True:
            slipped(series, length, y_new)
            if abs(y_new[SLIP] - math.hypot(y_new[0], y_new[1])) <= AGREES * size:
                break
            length /= 2
        if y_new[goal.component] >= goal.target:
            slipped(series, time_to(series, length, y_new, goal), y_new)
            y_new[goal.component] = goal.target
        copy_into(y, y_new)
    return True


@compiled
def straight_slip(A: RoughPoint, y: Array, goal: Goal) -> tuple[tuple[float, float], Vector, float, bool]:
    """Return whether slip keeps its direction long enough for all others to turn into it, and where it leads.

    Friction turns slip towards the direction s in which it accelerates, s × dv_A/dp = 0, at the rate
    (λ + κ)/|v_t|; λ = s · dv_A/dp is the growth of slip and κ = μ t · K_tt t, t across s. Where λ is small
    against κ, slip goes straight over many times the impulse in which it turns: step by step it would take
    thousands. The direction of slow slip is known only to the rounding of v_A: it is turned into the one that
    it keeps, by Newton's method, where what it has across that counts as none.

    Args:
        A: that slips.
        y: state of the impact, (7,).
        goal: of the impact.

    Returns:
        f: friction per normal impulse, (2,).
        gained: dv_A/dp, (3,) [1/kg].
        p: the normal impulse of the straight slip, 0 where slip may turn [N s].
        stops: whether slip stops before the goal is reached.
    """
    K, mu = A.delassus, A.friction
    slip, most = math.hypot(y[0], y[1]), A.no_slip
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
    to_target = impulse_to(y, gained[2], goal) if gained[2] > 0 else np.inf
    p = min(to_stop, to_target)
    if not SETTLED * slip < (kappa + growth) * p < np.inf:
        return f, gained, 0.0, False
    return f, gained, p, to_stop < to_target


@compiled
def die_away(A: RoughPoint, y: Array, goal: Goal, series: Array, y_new: Array) -> bool:
    """Follow slip that dies away to its stop, or to the goal.

    Args:
        A: that slips.
        y: state of the impact, (7,), which slips.
        goal: of the impact.
        series: see `room_for_stop`; work space.
        y_new: where the state goes, (8,).

    Returns:
        Whether slip dies away so, and v_Az rises whatever its direction.
    """
    K, mu = A.delassus, A.friction
    component, target = goal
    if not K[2][2] > mu * math.hypot(K[2][0], K[2][1]):
        return False
    stop = expand_stop(K, mu, (y[0], y[1]), A.with_work, series)
    if stop.end == 0:
        return False
    state_at(A, y, stop, series, 0.0, y_new)
    if y_new[component] < target:
        y_new[0], y_new[1] = 0.0, 0.0
        return True
    state_at(A, y, stop, series, math.exp(-TURNED), y_new)
    if y_new[component] < target:
        return True
    tolerance = TARGET * TURNED
    bracket = bracket_between(0.0, target - y[component], TURNED, target - y_new[component])
    while not is_narrow(bracket, tolerance):
        tried = next_try(bracket)
        state_at(A, y, stop, series, math.exp(-tried), y_new)
        bracket = narrowed(bracket, tried, target - y_new[component], tolerance)
    state_at(A, y, stop, series, math.exp(-bracket.high), y_new)
    y_new[component] = target
    return True


@compiled
def state_at(A: RoughPoint, y: Array, stop: SlipStop, series: Array, x: float, y_new: Array) -> None:
    """Write the state at the place x of slip that dies away into y_new; see `impulse_until`."""
    S, path = impulse_until(stop, series, x)
    gained = apply(A.delassus, S)
    y_new[WORK] = y[WORK] + A.friction * path
    for i in range(3):
        y_new[i], y_new[3 + i] = y[i] + gained[i], y[3 + i] + S[i]
        # The work of S, of which friction's is -μ X.
        y_new[WORK] += (y[i] + gained[i] / 2) * S[i]


@compiled
def expand_slip(A: RoughPoint, y: Array, speed: float, series: Array) -> tuple[float, float]:
    """Expand the motion of the slipping point as a power series of τ.

    dS/dτ = (-μ v_t, q) with q = |v_t|, so the next coefficients of S, and of v_A by K, follow from those of
    v_t and q, and the next one of q from q² = v_t².

    Args:
        A: that slips.
        y: state at the start, (7,), which slips.
        speed: of A before the impact [m/s].
        series: where the coefficients go, (ORDER + 1, COLUMNS).

    Returns:
        The τ up to which the series holds, and the scale of the slip [m/s].
    """
    K, mu = A.delassus, A.friction
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
        series[k + 1, WORK] = part * _work_term(series, k) if A.with_work else 0.0
        products = _products(series, k)
        series[k + 1, SLIP] = (series[0, 0] * v[0] + series[0, 1] * v[1] - products) / slip
        if k >= ORDER - 2:
            term = max(abs(v[0]), abs(v[1]), abs(series[k + 1, SLIP])) / size
            term = max(term, abs(v[2]) / speed)
            if term > 0:
                length = min(length, (SMALLEST / term) ** part)
    return length, size


@compiled
def _work_term(series: Array, k: int) -> float:
    """Return the coefficient k of v_Az |v_t|."""
    total = 0.0
    for j in range(k + 1):
        total += series[j, V_Z] * series[k - j, SLIP]
    return total


@compiled
def _products(series: Array, k: int) -> float:
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
def slipped(series: Array, t: float, y_new: Array) -> None:
    """Write the state of the impact at τ = t of a series, and |v_t|, into y_new, (8,)."""
    for i in range(COLUMNS):
        y_new[i] = 0.0
    for k in range(ORDER, -1, -1):
        for i in range(COLUMNS):
            y_new[i] = y_new[i] * t + series[k, i]


@compiled
def time_to(series: Array, length: float, y_new: Array, goal: Goal) -> float:
    """Return the τ at which the goal is reached.

    Args:
        series: see `expand_slip`.
        length: τ at which it is passed.
        y_new: state there, (8,); work space.
        goal: of the impact.
    """
    component, target = goal
    tolerance = TARGET * length
    bracket = bracket_between(0.0, target - series[0, component], length, target - y_new[component])
    while not is_narrow(bracket, tolerance):
        tried = next_try(bracket)
        slipped(series, tried, y_new)
        bracket = narrowed(bracket, tried, target - y_new[component], tolerance)
    return bracket.high


@compiled
def friction_without_slip(K: Matrix, mu: float) -> tuple[float, float]:
    """Return the tangential impulse per normal impulse at a contact point that does not slip, (2,).

    It sticks, K_tt f + K_tz = 0, where that lies within the cone. Elsewhere slip starts in the direction s
    that keeps itself, f = -μ s and K_tz - μ K_tt s = λ s: s = (μ K_tt + λ)⁻¹ K_tz has length 1 for just one
    λ > 0, for its length falls with λ.

    Args:
        K: Delassus matrix of A [1/kg].
        mu: coefficient of friction μ.
    """
    coupling = (K[0][2], K[1][2])
    stick = resisted(K, 1.0, 0.0, coupling)
    if math.hypot(stick[0], stick[1]) <= mu:
        return -stick[0], -stick[1]
    low, high = 0.0, math.hypot(K[0][2], K[1][2])
    for _ in range(100):
        middle = (low + high) / 2
        s = resisted(K, mu, middle, coupling)
        if not low < middle < high:
            break
        if math.hypot(s[0], s[1]) > 1:
            low = middle
        else:
            high = middle
    s = resisted(K, mu, high, coupling)
    length = math.hypot(s[0], s[1])
    return -mu * s[0] / length, -mu * s[1] / length


@compiled
def resisted(K: Matrix, mu: float, growth: float, coupling: tuple[float, float]) -> tuple[float, float]:
    """Return (mu K_tt + growth)⁻¹ coupling, (2,)."""
    xx, yy, xy = mu * K[0][0] + growth, mu * K[1][1] + growth, mu * K[0][1]
    determinant = xx * yy - xy * xy
    x, y = coupling
    return (yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant


@compiled
def impulse(A: Impact) -> tuple[Vector, bool]:
    """Return the impulse of Coulomb friction integrated through the impact; there is always one."""
    return coulomb(A.delassus, A.velocity, A.restitution, A.friction, A.restitution_kind), True


def missed(impacts: Recorded) -> Array:
    """Return by how much |S_xy| exceeds μ S_z."""
    return np.maximum(impacts.horizontal - impacts.friction * impacts.impulse[:, 2], 0) / impacts.size


LAW = Law(
    impulse,
    missed,
    uses_friction=True,
    is_followed=True,
    hardly_adds_energy=True,
    may_be_energetic=True,
    is_in_mujoco=True,
)
