"""The first touch of an ideal coin that turns in closed form, while its height is a polynomial.

Time is that of the clock of `turning`, in which the normal turns at a constant rate.

The rim of the face at ζ = ±h/2, whose centre is at height q, is clear while F = q² - r² (1 - n_z²) > 0. With
a bound on its bend F'', each look at F and F' gives a time that is surely clear, or the assurance that F
falls through zero once in a time to come. From there on steps of third order find the touch.
"""

import math
from enum import IntEnum
from typing import NamedTuple

from analytic.rim import SINK
from models.compiled import compiled
from models.geometry import FLAT_SINE
from models.vectors import Vector, add, scale

# A gap below this part of the radius is zero within rounding.
TOUCH = 2e-15
# A coin higher than `_HIGH` times the reach of its rim is followed by its height alone, down to `_NEAR`.
_HIGH, _NEAR = 2.0, 1.1
# On the way to a sure touch; two are common.
_MOST_LOOKS = 10


class Found(IntEnum):
    """What the search of a piece of a flight finds."""

    NOTHING = 0
    TOUCH = 1
    GRAZE = 2
    """The coin touches and does not move down, nor clearly up."""


class Search(NamedTuple):
    """A search so far."""

    looks: int
    """How often the gap was looked at."""
    graze: float
    """A height such that no minimum of the gap on the way is below half of it [m]."""
    height: float
    """The gap at the last look [m]."""
    falls: bool
    """Whether it was falling then."""


class Bounds(NamedTuple):
    """Bounds on what bends the gap in a piece of a flight."""

    down: float
    """Downward acceleration of C [m/s²]."""
    up: float
    """Upward acceleration of C [m/s²]."""
    jerk: float
    """Its change [m/s³]."""
    normal: float
    """|n_z''| [1/s²]."""
    square: float
    """|(n_z²)''|/2 [1/s²]."""
    rate: float
    """Third derivatives are at most so many times the second ones [1/s]."""


class Look(NamedTuple):
    """Height and tilt at one time."""

    z: float
    """Of C [m]."""
    z_rate: float
    z_acceleration: float
    normal: Vector
    """n, space frame."""
    normal_rate: Vector
    normal_acceleration: float
    """n_z'' [1/s²]."""
    sine: float
    """Of the tilt."""


@compiled
def begun():
    """Give a `Search` that has not looked yet."""
    return Search(0, math.inf, math.inf, False)


@compiled
def bounds_of(turning, down, up, jerk):
    """Give the `Bounds` of a turning coin, those of C given."""
    rate, mean = turning.rate, abs(turning.mean[2])
    swing = math.hypot(turning.cosine[2], turning.sine[2])
    # n_z'' is -rate² times the swing, (n_z²)''/2 is -rate² (swing² cos 2φ + mean swing cos φ).
    normal = rate * rate * swing
    return Bounds(down, up, jerk, normal, normal * (swing + mean), 4 * rate)


@compiled
def look(turning, heights, t):
    """Look at a turning coin at the time t [s]; for the other arguments see `first_touch`."""
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
    return Look(z, z_rate, 2 * z_half, n, n_rate, -rate * rate * swing[2], sine)


@compiled
def rim(body, seen, side):
    """Give F, F'/2 and F''/2 of one rim.

    Args:
        body: the coin.
        seen: a `Look`.
        side: ±1, of the face.
    """
    r, arm, n_z, n_rate = body.radius, side * body.thickness / 2, seen.normal[2], seen.normal_rate[2]
    q, q_rate = seen.z + arm * n_z, seen.z_rate + arm * n_rate
    q_acceleration = seen.z_acceleration + arm * seen.normal_acceleration
    bend = q_rate * q_rate + q * q_acceleration + r * r * (n_rate * n_rate + n_z * seen.normal_acceleration)
    return (q - r * seen.sine) * (q + r * seen.sine), q * q_rate + r * r * n_z * n_rate, bend


@compiled
def closing(body, seen):
    """Give the gap [m] and its rate [m/s]; of a flat coin that turns, that of the point going down."""
    side = -1.0 if seen.normal[2] > 0 else 1.0
    arm, r, n, n_rate = side * body.thickness / 2, body.radius, seen.normal, seen.normal_rate
    if seen.sine > FLAT_SINE:
        sine_rate = -n[2] * n_rate[2] / seen.sine
    else:
        sine_rate = (n_rate[0] * n_rate[0] + n_rate[1] * n_rate[1]) ** 0.5
    return seen.z + arm * n[2] - r * seen.sine, seen.z_rate + arm * n_rate[2] - r * sine_rate


@compiled
def first_touch(body, turning, heights, inside, length, bounds, search):
    """Search a piece of a flight for the first touch.

    Args:
        body: the coin.
        turning: its turning, from the start of the piece on.
        heights: coefficients of the height of C as a polynomial of time [m, m/s, ..].
        inside: when the search starts [s].
        length: of the piece [s].
        bounds: on it.
        search: so far.

    Returns:
        What is `Found`, when [s], and the `Search`.
    """
    r, half = body.radius, body.thickness / 2
    reach, hop = math.hypot(r, half), (2 * SINK * r / body.gravity) ** 0.5
    looks, graze, height_before, fell = search
    while inside < length:
        looks += 1
        seen = look(turning, heights, inside)
        z, z_rate = seen.z, seen.z_rate
        if z > _HIGH * reach:
            # No minimum of the gap that is passed by is lower than the rest.
            graze, height_before, fell = min(graze, (_NEAR - 1) * reach), z - reach, False
            fall = z - _NEAR * reach
            inside += (z_rate + (z_rate * z_rate + 2 * bounds.down * fall) ** 0.5) / bounds.down
            continue
        height, speed = closing(body, seen)
        if fell and speed >= 0:
            graze = min(graze, height_before, height)
        height_before, fell = height, speed < 0

        window = length - inside
        if z_rate > 0:
            window = min(window, (_HIGH + 1) * reach / z_rate)
        highest = z + max(z_rate, 0.0) * window + bounds.up * window * window / 2 + half
        bend = highest * (bounds.down + half * bounds.normal) + r * r * bounds.square
        lower = -1.0 if seen.normal[2] > 0 else 1.0
        F, F_rate, _ = rim(body, seen, lower)
        ahead = min(window, _clear(F, F_rate, bend))
        latest = F / -F_rate if F > 0 and F_rate < 0 else 0.0
        if half > 0:
            F_upper, F_upper_rate, _ = rim(body, seen, -lower)
            clear_above = _clear(F_upper, F_upper_rate, bend)
            ahead = min(ahead, clear_above)
            latest = latest if latest <= clear_above else 0.0
        # Also where time itself has no finer step than the coin still has to fall.
        if (height <= TOUCH * r and (speed <= 0 or ahead < hop)) or inside + ahead == inside:
            found = Found.TOUCH if speed < 0 else Found.GRAZE
            return found, inside, Search(looks, graze, height, fell)
        if 0 < latest <= window:
            sideways = max(bounds.down, bounds.up) + half * bounds.normal
            fastest = abs(z_rate) + half * abs(seen.normal_rate[2]) + latest * sideways
            most = fastest * fastest + highest * (bounds.up + half * bounds.normal) + r * r * bounds.square
            if F_rate * F_rate > most * F:
                # F falls through zero once, by then.
                q_jerk = bounds.jerk + half * bounds.normal * bounds.rate
                third = fastest * sideways + (highest * q_jerk + r * r * bounds.square * bounds.rate) / 3
                touch, more = _sure_touch(body, turning, heights, inside, latest, seen, lower, third)
                looks += more
                if touch > inside:
                    return Found.TOUCH, touch, Search(looks, graze, height, fell)
        inside += ahead
    return Found.NOTHING, length, Search(looks, graze, height_before, fell)


@compiled
def _clear(F, F_rate, bend):
    """Give the positive root of F + 2 F_rate t - bend t²: a rim is clear up to it."""
    F = max(F, 0.0)
    root = (F_rate * F_rate + bend * F) ** 0.5
    # Of the two forms of the root, each sign of F_rate takes the one without cancellation.
    if F_rate > 0:
        return (F_rate + root) / bend
    return F / (root - F_rate) if F > 0 else 0.0


@compiled
def _sure_touch(body, turning, heights, low, latest, seen, side, third):
    """Find the one zero of a rim's F in a time to come, to `TOUCH`.

    Args:
        body: the coin.
        turning: its turning.
        heights: coefficients of the height of C.
        low: start of the search [s].
        latest: its length [s].
        seen: the `Look` at its start.
        side: ±1, of the face with this rim.
        third: a sixth of the largest third derivative of F on the way [m²/s³].

    Returns:
        The time [s], or `low` where rounding hides it, and the number of looks.
    """
    t, looks = low, 0
    while looks < _MOST_LOOKS:
        F, F_rate, bend = rim(body, seen, side)
        step = F / (max(F_rate * F_rate - bend * F, 0.0) ** 0.5 - F_rate)
        t += step
        if not low < t <= low + latest:
            return low, looks
        # What F may be after the step, against what it is at the gap `TOUCH` r.
        if third * abs(step) ** 3 <= TOUCH * body.radius * body.radius * seen.sine:
            return t, looks
        seen = look(turning, heights, t)
        looks += 1
    return low, looks
