"""The first touch of an ideal coin that turns in closed form, while its height is a polynomial.

Time is that of the clock of `turning`, in which the normal turns at a constant rate.

The rim of the face at ζ = ±h/2, whose centre is at height q, is clear while F = q² - r² (1 - n_z²) > 0. With
a bound on its bend F'', each evaluation of F and F' gives a time that is surely clear, or the assurance that
F falls through zero once in a time to come. From there on steps of third order find the touch.
"""

import math
from enum import IntEnum
from typing import NamedTuple

from cointoss.analytic.flight.turning import Turning
from cointoss.analytic.numerics.tolerances import CLOSED_TOUCH, SINK
from cointoss.models.body import Body
from cointoss.models.geometry import FLAT_SINE, lower_rim
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, scale

# A coin higher than `_HIGH` times the reach of its rim is followed by its height alone, down to `_NEAR`.
_HIGH, _NEAR = 2.0, 1.1
# On the way to a sure touch; two are common.
_MOST_EVALUATIONS = 10

Polynomial = tuple[float, float, float] | Array
"""Coefficients, that of t⁰ first."""


class PieceResult(IntEnum):
    """What the search of a piece of a flight finds."""

    NOTHING = 0
    TOUCH = 1
    GRAZE = 2
    """The coin touches and does not move down, nor clearly up."""


class Bounds(NamedTuple):
    """Bounds on what bends the gap in a piece of a flight."""

    down: float
    """Downward acceleration of C [m/s²]."""
    up: float
    """Upward acceleration of C [m/s²]."""
    jerk: float
    """The rate of change of that acceleration [m/s³]."""
    normal: float
    """|n_z''| [1/s²]."""
    square: float
    """|(n_z²)''|/2 [1/s²]."""
    rate: float
    """Third derivatives are at most so many times the second ones [1/s]."""


class HeightAndTilt(NamedTuple):
    """Height and tilt at one time."""

    z: float
    """The height of C [m]."""
    z_rate: float
    z_acceleration: float
    normal: Vector
    """n, space frame."""
    normal_rate: Vector
    normal_acceleration: float
    """n_z'' [1/s²]."""
    sine: float
    """The sine of the tilt."""


@compiled
def bounds_of(turning: Turning, down: float, up: float, jerk: float) -> Bounds:
    """Return the `Bounds` of a turning coin, those of C given."""
    rate, mean = turning.rate, abs(turning.mean[2])
    swing = math.hypot(turning.cosine[2], turning.sine[2])
    # n_z'' is -rate² times the swing, (n_z²)''/2 is -rate² (swing² cos 2φ + mean swing cos φ).
    normal = rate * rate * swing
    return Bounds(down, up, jerk, normal, normal * (swing + mean), 4 * rate)


@compiled
def height_and_tilt(turning: Turning, heights: Polynomial, t: float) -> HeightAndTilt:
    """Return the `HeightAndTilt` of a turning coin at the time t [s]; for the arguments see `first_touch`."""
    z, z_rate, z_half = 0.0, 0.0, 0.0
    for k in range(len(heights) - 1, -1, -1):
        z_half = z_half * t + z_rate
        z_rate = z_rate * t + z
        z = z * t + heights[k]
    rate = turning.rate
    c, s = math.cos(rate * t), math.sin(rate * t)
    swing = add(scale(c, turning.cosine), scale(s, turning.sine))
    n, n_rate = add(turning.mean, swing), scale(rate, add(scale(-s, turning.cosine), scale(c, turning.sine)))
    sine = (n[0] * n[0] + n[1] * n[1]) ** 0.5
    return HeightAndTilt(z, z_rate, 2 * z_half, n, n_rate, -rate * rate * swing[2], sine)


@compiled
def rim_clearance(body: Body, now: HeightAndTilt, rim: float) -> tuple[float, float, float]:
    """Return F, F'/2 and F''/2 of one rim.

    Args:
        body: the coin.
        now: the `HeightAndTilt`.
        rim: ±1, of the face.
    """
    r, arm, n_z, n_rate = body.radius, rim * body.thickness / 2, now.normal[2], now.normal_rate[2]
    q, q_rate = now.z + arm * n_z, now.z_rate + arm * n_rate
    q_acceleration = now.z_acceleration + arm * now.normal_acceleration
    bend = q_rate * q_rate + q * q_acceleration + r * r * (n_rate * n_rate + n_z * now.normal_acceleration)
    return (q - r * now.sine) * (q + r * now.sine), q * q_rate + r * r * n_z * n_rate, bend


@compiled
def lower_rim_of(now: HeightAndTilt) -> float:
    """Return the `lower_rim` at one time."""
    n_z = now.normal[2] if abs(now.normal[2]) > FLAT_SINE else now.normal_rate[2]
    return lower_rim(n_z)


@compiled
def closing(body: Body, now: HeightAndTilt) -> tuple[float, float]:
    """Return the gap [m] and its rate [m/s]; of a flat coin that turns, that of the point going down."""
    rim = lower_rim_of(now)
    arm, r, n, n_rate = rim * body.thickness / 2, body.radius, now.normal, now.normal_rate
    if now.sine > FLAT_SINE:
        sine_rate = -n[2] * n_rate[2] / now.sine
    else:
        sine_rate = (n_rate[0] * n_rate[0] + n_rate[1] * n_rate[1]) ** 0.5
    return now.z + arm * n[2] - r * now.sine, now.z_rate + arm * n_rate[2] - r * sine_rate


@compiled
def _reach(body: Body) -> float:
    """Return how far the rim is from C [m]."""
    return (body.radius * body.radius + body.thickness * body.thickness / 4) ** 0.5


class TouchBound(NamedTuple):
    """What one evaluation bounds of the time to come."""

    lower: float
    """±1, of the face whose rim is the lower one."""
    F: float
    """F of the lower rim [m²]."""
    F_rate: float
    """F'/2 [m²/s]."""
    ahead: float
    """The time for which the coin is surely clear [s]."""
    latest: float
    """When F has passed zero, if its rise is bent by less than F_rate²/F; 0 where that is not known [s]."""
    rise: float
    """F''/2 is at most that up to `latest` [m²/s²]."""
    third: float
    """A sixth of the largest third derivative of F up to then [m²/s³]."""


@compiled
def high(body: Body, z: float) -> bool:
    """Return whether a coin whose C is at the height z is far above the reach of its rim."""
    return z > _HIGH * _reach(body)


@compiled
def time_to_fall(body: Body, now: HeightAndTilt, down: float) -> float:
    """Return a time in which a high coin surely does not come down to the reach of its rim [s]."""
    fall = now.z - _NEAR * _reach(body)
    return (now.z_rate + (now.z_rate * now.z_rate + 2 * down * fall) ** 0.5) / down


@compiled
def touch_bound(body: Body, now: HeightAndTilt, bounds: Bounds, window: float) -> TouchBound:
    """Return the `TouchBound` of a coin that is not high, over a window of time [s]."""
    r, half = body.radius, body.thickness / 2
    if now.z_rate > 0:
        window = min(window, (_HIGH + 1) * _reach(body) / now.z_rate)
    highest = now.z + max(now.z_rate, 0.0) * window + bounds.up * window * window / 2 + half
    bend = highest * (bounds.down + half * bounds.normal) + r * r * bounds.square
    lower = lower_rim_of(now)
    F, F_rate, _ = rim_clearance(body, now, lower)
    ahead = min(window, _clear(F, F_rate, bend))
    latest = F / -F_rate if F > 0 and F_rate < 0 else 0.0
    if half > 0:
        F_upper, F_upper_rate, _ = rim_clearance(body, now, -lower)
        clear_above = _clear(F_upper, F_upper_rate, bend)
        ahead = min(ahead, clear_above)
        latest = latest if latest <= clear_above else 0.0
    latest = latest if latest <= window else 0.0
    sideways = max(bounds.down, bounds.up) + half * bounds.normal
    fastest = abs(now.z_rate) + half * abs(now.normal_rate[2]) + max(latest, ahead) * sideways
    rise = fastest * fastest + highest * (bounds.up + half * bounds.normal) + r * r * bounds.square
    q_jerk = bounds.jerk + half * bounds.normal * bounds.rate
    third = fastest * sideways + (highest * q_jerk + r * r * bounds.square * bounds.rate) / 3
    return TouchBound(lower, F, F_rate, ahead, latest, rise, third)


@compiled
def falls_through(ahead: TouchBound) -> bool:
    """Return whether F surely falls through zero once, and when at the latest; of a `TouchBound`."""
    return ahead.latest > 0 and ahead.F_rate * ahead.F_rate > ahead.rise * ahead.F


@compiled
def first_touch(
    body: Body, turning: Turning, heights: Polynomial, inside: float, length: float, bounds: Bounds
) -> tuple[PieceResult, float, int]:
    """Search a piece of a flight for the first touch.

    Args:
        body: the coin.
        turning: its turning, from the start of the piece on.
        heights: coefficients of the height of C as a polynomial of time [m, m/s, ..].
        inside: when the search starts [s].
        length: of the piece [s].
        bounds: on it.

    Returns:
        What is `PieceResult`, when [s], and the number of gap evaluations.
    """
    hop, evaluations = (2 * SINK * body.radius / body.gravity) ** 0.5, 0
    while inside < length:
        evaluations += 1
        now = height_and_tilt(turning, heights, inside)
        if high(body, now.z):
            inside += time_to_fall(body, now, bounds.down)
            continue
        height, speed = closing(body, now)
        to_come = touch_bound(body, now, bounds, length - inside)
        ahead = to_come.ahead
        # Also where time itself has no finer step than the coin still has to fall.
        touches = height <= CLOSED_TOUCH * body.radius and (speed <= 0 or ahead < hop)
        if touches or inside + ahead == inside:
            return PieceResult.TOUCH if speed < 0 else PieceResult.GRAZE, inside, evaluations
        if falls_through(to_come):
            touch, more = _sure_touch(body, turning, heights, inside, now, to_come)
            evaluations += more
            if touch > inside:
                return PieceResult.TOUCH, touch, evaluations
        inside += ahead
    return PieceResult.NOTHING, length, evaluations


@compiled
def lowest_dip(body: Body, turning: Turning, heights: Polynomial, length: float, bounds: Bounds) -> float:
    """Bound the minima of the gap in a piece of a flight; for the arguments see `first_touch`.

    In a quarter of the time that is surely clear F keeps three quarters. So a minimum between an evaluation
    at which the gap falls and one at which it rises is hardly below the first, or the second.

    Returns:
        A height such that no minimum of the gap is below half of it [m].
    """
    hop, t, lowest = (2 * SINK * body.radius / body.gravity) ** 0.5, 0.0, math.inf
    height_before, fell = math.inf, False
    while t < length:
        now = height_and_tilt(turning, heights, t)
        if high(body, now.z):
            lowest, fell = min(lowest, (_NEAR - 1) * body.radius), False
            t += time_to_fall(body, now, bounds.down)
            continue
        height, speed = closing(body, now)
        if fell and speed >= 0:
            lowest = min(lowest, height_before, height)
        height_before, fell = height, speed < 0
        to_come = touch_bound(body, now, bounds, length - t)
        if falls_through(to_come):
            return lowest
        t += max(to_come.ahead / 4, hop)
    return lowest


@compiled
def _clear(F: float, F_rate: float, bend: float) -> float:
    """Return the positive root of F + 2 F_rate t - bend t²: a rim is clear up to it."""
    F = max(F, 0.0)
    root = (F_rate * F_rate + bend * F) ** 0.5
    # Of the two forms of the root, each sign of F_rate takes the one without cancellation.
    if F_rate > 0:
        return (F_rate + root) / bend
    return F / (root - F_rate) if F > 0 else 0.0


@compiled
def _sure_touch(
    body: Body, turning: Turning, heights: Polynomial, low: float, now: HeightAndTilt, to_come: TouchBound
) -> tuple[float, int]:
    """Find the one zero of F in a time to come, to `CLOSED_TOUCH`.

    Args:
        body: the coin.
        turning: its turning.
        heights: coefficients of the height of C.
        low: start of the search [s].
        now: the `HeightAndTilt` there.
        to_come: its `TouchBound`.

    Returns:
        The time [s], or `low` where rounding hides it, and the number of gap evaluations.
    """
    t, evaluations = low, 0
    while evaluations < _MOST_EVALUATIONS:
        F, F_rate, bend = rim_clearance(body, now, to_come.lower)
        step = F / (max(F_rate * F_rate - bend * F, 0.0) ** 0.5 - F_rate)
        t += step
        if not low < t <= low + to_come.latest:
            return low, evaluations
        # What F may be after the step, against what it is at the gap `CLOSED_TOUCH` r.
        if to_come.third * abs(step) ** 3 <= CLOSED_TOUCH * body.radius * body.radius * now.sine:
            return t, evaluations
        now = height_and_tilt(turning, heights, t)
        evaluations += 1
    return low, evaluations
