"""Friction and moments of resistance in a step of contact, for a normal force that gives way to them.

With a normal force N the floor resists the part ω_h of ω along it by a moment of at most δ N, and pivoting by
one of at most p N about the vertical: -δ N ω_h/|ω_h| and -p N ω_z/|ω_z| while the coin turns, and at rest
what holds it. So they are Coulomb's law once more, of ω_h and of ω_z in place of the slip. What resists a
contact point that runs round the rim (`cointoss.models.contour`) is Coulomb's law of ω · ĝ, ĝ where the
normal leans, with the arm that its speed at the start of the step gives it. The four are solved together.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.steps.coulomb import force_in_cone
from cointoss.models.contour import air_moment_per_spin, contour_per_force, has_contour, leaning, longest_arm
from cointoss.models.geometry import FACE_SINE, tilt_sine_of
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, dot, norm, scale
from cointoss.models.rest import slow_spin

PointMotion = tuple[float, float, float, float, float, float]
"""Velocity of the contact point, and ω."""
PARTS = 64
"""Parts of a step in which slip, roll or pivoting starts, stops or turns far."""
TURN = 0.25
"""A motion that changes by less than this part of itself keeps to its mean direction."""
SWEEPS, SAME = 400, 1e-12
"""Most rounds over the three laws in a part, and the change, against the largest of each, that ends them."""
STEADY = 0.1
"""A motion below this part of what the floor can stop in the step may stop in it anywhere."""
STOPPED = 1e-9
"""A motion below this part of what the floor can stop in the step has been stopped."""
_LAWS = ((0, 1), (3, 4), (5, 2), (6, 2))
"""The places of the components of slip, roll, pivoting and ω · ĝ; the vertical one of slip is not used."""
_SIZE = 7


class Coefficients(NamedTuple):
    """How large friction and the moments are, at most, over the normal force."""

    sliding: float
    """μ."""
    rolling: float
    """δ [m]."""
    pivoting: float
    """p [m]."""
    contour: float
    """The arm of the moment against ω · ĝ [m]."""


class Laws(NamedTuple):
    """How friction and the moments of resistance change the motion, and how large they may be."""

    g: Array
    """Part of each that the normal force gives way to, (7,)."""
    G: Array
    """The change of the motion by each in a time, (7, 7)."""
    coefficients: Coefficients
    """Of each law."""


@compiled
def resisted_force(
    K: Array,
    coefficients: Coefficients,
    normal: float,
    motion: PointMotion,
    motion_free: PointMotion,
    leans: tuple[Vector, Vector],
    dt: float,
) -> tuple[Vector, Vector]:
    """Return the mean force of a step, without what holds the coin up, and the mean moment of resistance.

    MuJoCo prescribes the vertical acceleration of the contact, whatever else acts on it; see `coulomb_force`.

    Args:
        K: change of velocity of the contact point and of ω by an impulse there and an angular impulse, space
            frame, (6, 6).
        coefficients: `Coefficients`.
        normal: mean normal force of the step without friction and resistance [N].
        motion: velocity of the contact point and ω at the start of the step, space frame, (6,).
        motion_free: at its end without friction and resistance, (6,).
        leans: ĝ at the start and at the end of the step, space frame, (2, 3).
        dt: length of the step [s].

    Returns:
        The force, (3,) [N], its third component the change of the normal force, and the moment, (3,) [N m].
    """
    mean = add(leans[0], leans[1])
    size = norm(mean)
    lean = scale(1 / size, mean) if size > 0 else mean
    K = _with_lean(K, lean)
    g, G = np.zeros(_SIZE), np.zeros((_SIZE, _SIZE))
    for i in range(_SIZE):
        g[i] = K[i, 2] / K[2, 2] if i != 2 else 0.0
    for i in range(_SIZE):
        for j in range(_SIZE):
            G[i, j] = K[i, j] - g[i] * K[j, 2] if i != 2 and j != 2 else 0.0
    start, free, f = np.zeros(_SIZE), np.zeros(_SIZE), np.zeros(_SIZE)
    for i in range(6):
        start[i], free[i] = motion[i], motion_free[i]
    start[2], free[2] = 0.0, 0.0
    start[6], free[6] = dot(leans[0], motion[3:]), dot(leans[1], motion_free[3:])
    whole = Laws(g, G * dt, coefficients)
    _solve(whole, normal, start, free, f)
    if not _is_smooth(whole, normal, start, free, f):
        driven, part, total = (free - start) / PARTS, Laws(g, G * (dt / PARTS), coefficients), np.zeros(_SIZE)
        for _ in range(PARTS):
            free = start + driven
            _solve(part, normal, start, free, f)
            start = _motion_after(part, free, f)
            total += f
        f = total / PARTS
    given_way = 0.0
    for i in range(_SIZE):
        given_way += g[i] * f[i]
    return (f[0], f[1], -given_way), add((f[3], f[4], f[5]), scale(f[6], lean))


@compiled
def _with_lean(K: Array, lean: Vector) -> Array:
    """Return K with a row and a column for ω · ĝ and a moment along ĝ, (7, 7); see `resisted_force`."""
    found = np.zeros((_SIZE, _SIZE))
    for i in range(6):
        for k in range(6):
            found[i, k] = K[i, k]
        for k in range(3):
            found[i, 6] += K[i, 3 + k] * lean[k]
            found[6, i] += lean[k] * K[3 + k, i]
    for k in range(3):
        found[6, 6] += lean[k] * found[3 + k, 6]
    return found


@compiled
def _solve(laws: Laws, normal: float, start: Array, free: Array, f: Array) -> None:
    """Find the friction and the moments of a part of a step, law by law until none changes.

    Args:
        laws: in the part.
        normal: normal force without them [N].
        start: motion at the start of the part, (7,).
        free: motion at its end without them, (7,).
        f: friction and moments, a guess; written to, (7,).
    """
    g, G, coefficients = laws
    for _ in range(SWEEPS):
        change = 0.0
        for law in range(4):
            most = coefficients[law]
            if not most > 0:
                continue
            i, j = _LAWS[law]
            old_i, old_j = f[i], f[j]
            f[i], f[j] = 0.0, 0.0
            left, free_i, free_j = normal, free[i], free[j]
            for k in range(_SIZE):
                left -= g[k] * f[k]
                free_i += G[i, k] * f[k]
                free_j += G[j, k] * f[k]
            left = max(left, 0.0)
            across = G[j, j] if law < 2 else 1.0
            f[i], f[j] = force_in_cone(
                (g[i], g[j]), (G[i, i], across, G[i, j]), most, left, (start[i], start[j]), (free_i, free_j)
            )
            square = (f[i] - old_i) * (f[i] - old_i) + (f[j] - old_j) * (f[j] - old_j)
            change = max(change, math.sqrt(square) / most)
        if not change > SAME * normal:
            break


@compiled
def _motion_after(laws: Laws, free: Array, f: Array) -> Array:
    """Return the motion at the end of a part of a step, (7,); see `_solve`."""
    end = free.copy()
    for i in range(_SIZE):
        for k in range(_SIZE):
            end[i] += laws.G[i, k] * f[k]
    return end


@compiled
def _is_smooth(laws: Laws, normal: float, start: Array, free: Array, f: Array) -> bool:
    """Return whether each motion of a step stays at rest, or keeps its direction; see `_solve`."""
    g, G, coefficients = laws
    end, left = _motion_after(laws, free, f), normal
    for k in range(_SIZE):
        left -= g[k] * f[k]
    for law in range(4):
        i, j = _LAWS[law]
        across = G[j, j] if law < 2 else 0.0
        stoppable = coefficients[law] * max(left, 0.0) * (G[i, i] + across)
        if not stoppable > 0:
            continue
        before = math.hypot(start[i], start[j])
        if math.hypot(end[i], end[j]) < STOPPED * stoppable:
            if before > STEADY * stoppable:
                return False
        elif math.hypot(end[i] - start[i], end[j] - start[j]) > TURN * before:
            return False
    return True


@compiled
def contour_arm(coin: MujocoCoin, up: Vector, w: Vector, normal: float) -> float:
    """Return the arm of the moment that contour and air have against ω · ĝ over the normal force [m].

    Args:
        coin: MuJoCo's.
        up: the upward unit vector, body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
        normal: force [N].
    """
    body, contour, sine = coin.body, coin.contour, tilt_sine_of(up)
    if not has_contour(contour) or sine <= FACE_SINE or not normal > 0:
        return 0.0
    turn = dot(leaning(up), w)
    longest = longest_arm(body, coin.rolling_friction, coin.pivoting_friction)
    by_floor = abs(turn) * contour_per_force(body, contour, longest, sine, turn)
    return min(by_floor + abs(turn) * air_moment_per_spin(body, contour, sine, turn) / normal, longest)


@compiled
def shortest_stop(coin: MujocoCoin, up: Vector, w: Vector) -> float:
    """Return a time in which resistance cannot stop the coin's turning, unless that is slow [s].

    Args:
        coin: MuJoCo's.
        up: the upward unit vector, body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    if not coin.resists:
        return np.inf
    body = coin.body
    weight = body.mass * body.gravity
    arm = coin.rolling_friction + contour_arm(coin, up, w, weight)
    most = math.hypot(arm, coin.pivoting_friction) * weight
    return max(norm(w), slow_spin(body)) * body.inertia_smallest / most if most > 0 else np.inf
