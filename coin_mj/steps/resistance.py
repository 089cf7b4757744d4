"""Friction and moments of resistance in a step of contact, for a normal force that gives way to them.

With a normal force N the floor resists the part ω_h of ω along it by a moment of at most δ N, and pivoting by
one of at most p N about the vertical: -δ N ω_h/|ω_h| and -p N ω_z/|ω_z| while the coin turns, and at rest
what holds it. So they are Coulomb's law once more, of ω_h and of ω_z in place of the slip, and the three are
solved together.
"""

import math
from typing import NamedTuple

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.steps.coulomb import STEADY, force_in_cone
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm
from cointoss.models.rest import slow_spin

PointMotion = tuple[float, float, float, float, float, float]
"""Velocity of the contact point, and ω."""
PARTS = 64
"""Parts of a step in which slip, roll or pivoting starts, stops or turns far."""
TURN = 0.25
"""A motion that changes by less than this part of itself keeps to its mean direction."""
SWEEPS, SAME = 400, 1e-12
"""Most rounds over the three laws in a part, and the change, against the largest of each, that ends them."""
STOPPED = 1e-9
"""A motion below this part of what the floor can stop in the step has been stopped."""
_LAWS = ((0, 1), (3, 4), (5, 2))
"""The places of the components of slip, roll and pivoting; the vertical one of the second is not used."""


class Laws(NamedTuple):
    """How friction and the moments of resistance change the motion, and how large they may be."""

    g: Array
    """Part of each that the normal force gives way to, (6,)."""
    G: Array
    """The change of the motion by each in a time, (6, 6)."""
    coefficients: tuple[float, float, float]
    """μ, δ [m] and p [m]."""


@compiled
def resisted_force(
    K: Array,
    coefficients: tuple[float, float, float],
    normal: float,
    motion: PointMotion,
    motion_free: PointMotion,
    dt: float,
) -> tuple[Vector, Vector]:
    """Return the mean force of a step, without what holds the coin up, and the mean moment of resistance.

    MuJoCo prescribes the vertical acceleration of the contact, whatever else acts on it; see `coulomb_force`.

    Args:
        K: change of velocity of the contact point and of ω by an impulse there and an angular impulse, space
            frame, (6, 6).
        coefficients: μ, δ [m] and p [m].
        normal: mean normal force of the step without friction and resistance [N].
        motion: velocity of the contact point and ω at the start of the step, space frame, (6,).
        motion_free: at its end without friction and resistance, (6,).
        dt: length of the step [s].

    Returns:
        The force, (3,) [N], its third component the change of the normal force, and the moment, (3,) [N m].
    """
    g, G = np.zeros(6), np.zeros((6, 6))
    for i in range(6):
        g[i] = K[i, 2] / K[2, 2] if i != 2 else 0.0
    for i in range(6):
        for j in range(6):
            G[i, j] = K[i, j] - g[i] * K[j, 2] if i != 2 and j != 2 else 0.0
    start, free, f = np.array(motion), np.array(motion_free), np.zeros(6)
    start[2], free[2] = 0.0, 0.0
    whole = Laws(g, G * dt, coefficients)
    _solve(whole, normal, start, free, f)
    if not _is_smooth(whole, normal, start, free, f):
        driven, part, total = (free - start) / PARTS, Laws(g, G * (dt / PARTS), coefficients), np.zeros(6)
        for _ in range(PARTS):
            free = start + driven
            _solve(part, normal, start, free, f)
            start = _motion_after(part, free, f)
            total += f
        f = total / PARTS
    given_way = 0.0
    for i in range(6):
        given_way += g[i] * f[i]
    return (f[0], f[1], -given_way), (f[3], f[4], f[5])


@compiled
def _solve(laws: Laws, normal: float, start: Array, free: Array, f: Array) -> None:
    """Find the friction and the moments of a part of a step, law by law until none changes.

    Args:
        laws: in the part.
        normal: normal force without them [N].
        start: motion at the start of the part, (6,).
        free: motion at its end without them, (6,).
        f: friction and moments, a guess; written to, (6,).
    """
    g, G, coefficients = laws
    for _ in range(SWEEPS):
        change = 0.0
        for law in range(3):
            most = coefficients[law]
            if not most > 0:
                continue
            i, j = _LAWS[law]
            old_i, old_j = f[i], f[j]
            f[i], f[j] = 0.0, 0.0
            left, free_i, free_j = normal, free[i], free[j]
            for k in range(6):
                left -= g[k] * f[k]
                free_i += G[i, k] * f[k]
                free_j += G[j, k] * f[k]
            left = max(left, 0.0)
            across = G[j, j] if law < 2 else 1.0
            f[i], f[j] = force_in_cone(
                (g[i], g[j]), (G[i, i], across, G[i, j]), most, left, (start[i], start[j]), (free_i, free_j)
            )
            change = max(change, math.hypot(f[i] - old_i, f[j] - old_j) / most)
        if not change > SAME * normal:
            break


@compiled
def _motion_after(laws: Laws, free: Array, f: Array) -> Array:
    """Return the motion at the end of a part of a step, (6,); see `_solve`."""
    end = free.copy()
    for i in range(6):
        for k in range(6):
            end[i] += laws.G[i, k] * f[k]
    return end


@compiled
def _is_smooth(laws: Laws, normal: float, start: Array, free: Array, f: Array) -> bool:
    """Return whether each motion of a step stays at rest, or keeps its direction; see `_solve`."""
    g, G, coefficients = laws
    end, left = _motion_after(laws, free, f), normal
    for k in range(6):
        left -= g[k] * f[k]
    for law in range(3):
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
def shortest_stop(coin: MujocoCoin, w: Vector) -> float:
    """Return a time in which resistance cannot stop the coin's turning, unless that is slow [s].

    Args:
        coin: MuJoCo's.
        w: angular velocity, body frame, (3,) [rad/s].
    """
    if not coin.resists:
        return np.inf
    body = coin.body
    most = math.hypot(coin.rolling_friction, coin.pivoting_friction) * body.mass * body.gravity
    return max(norm(w), slow_spin(body)) * body.inertia_smallest / most
