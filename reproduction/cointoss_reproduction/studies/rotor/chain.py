"""A planar coin whose phase is redrawn at each apex, and how far it stretches a difference of its release.

Units are r, m and g. The lowest point of the coin lies q(θ) = |sin θ| + b |cos θ| below the mass centre, b
half its thickness. While one corner is the lowest, q'' = -q. The coin meets the floor where q = z, at the
speed v - q' ω.
"""

from math import ceil, cos, exp, floor, inf, log, pi, sin, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit

from cointoss.study import Array

Z, V, ANGLE, SPIN, DRIFT = range(5)
"""What a state has: height and vertical speed of the mass centre, θ and ω, horizontal speed."""
AT_FLOOR = 1e-13
"""A gap that is closed."""
IN_CONTACT = 1e-7
"""A corner that leaves the floor at less speed stays there, unless the coin turns too fast."""
MOST_STEPS = 100_000
"""The most steps of the search for a touch."""


class Coin(NamedTuple):
    """A planar coin, its floor, and what air does to it on average over a turn."""

    inertia: float
    """J, about a diameter."""
    half: float
    """b, half its thickness."""
    restitution: float
    """χ."""
    rough: bool
    """Whether the floor stops the point that touches."""
    slowing: float
    """Rate at which air slows the spin."""
    drag: float
    """Rate at which air slows the centre."""
    own_slowing: float = 0.0
    """Rate at which air slows the spin about ζ."""


@njit(cache=True)
def reach(coin: Coin) -> float:
    """Return the height of the mass centre above which the coin turns freely, that of its pass."""
    return sqrt(1 + coin.half**2)


@njit(cache=True)
def energy(coin: Coin, state: Array) -> float:
    """Return the energy of a state [m g r]."""
    return state[Z] + (state[V] ** 2 + state[DRIFT] ** 2 + coin.inertia * state[SPIN] ** 2) / 2


@njit(cache=True)
def corner(angle: float, spin: float) -> tuple[float, float, float]:
    """Return the signs of sin θ and cos θ for the corner that is lowest next, and up to which angle it is."""
    quarter = angle / (pi / 2)
    start = floor(quarter) if spin >= 0 else ceil(quarter) - 1
    middle = (start + 0.5) * pi / 2
    return np.sign(sin(middle)), np.sign(cos(middle)), (start + (spin >= 0)) * pi / 2


@njit(cache=True)
def depth(coin: Coin, angle: float, spin: float) -> tuple[float, float]:
    """Return q and q' at an angle."""
    s, c, _ = corner(angle, spin)
    return (
        s * sin(angle) + coin.half * c * cos(angle),
        s * cos(angle) - coin.half * c * sin(angle),
    )


@njit(cache=True)
def next_touch(coin: Coin, state: Array) -> float:
    """Return the time to the next touch; infinite where none was found.

    On one corner the gap falls no faster than freely, for q'' = -q. So it stays open at least as long as it
    would from here if only gravity bent it; steps of this length pass over no touch.
    """
    z, v, angle, spin = state[Z], state[V], state[ANGLE], state[SPIN]
    above = z - reach(coin)
    time = v + sqrt(v * v + 2 * above) if above > 0 else 0.0
    for _ in range(MOST_STEPS):
        turned = angle + spin * time
        q, slope = depth(coin, turned, spin)
        gap, rate = z + v * time - time**2 / 2 - q, v - time - slope * spin
        if gap < AT_FLOOR and rate < 0:
            return time
        step = rate + sqrt(rate**2 + 2 * max(gap, 0.0))
        if spin != 0:
            step = min(step, (corner(turned, spin)[2] - turned) / spin)
        time += max(step, 1e-15 * max(1.0, time))
    return inf


@njit(cache=True)
def fly(coin: Coin, state: Array, change: Array, time: float) -> None:
    """Move a state and a small change of it through a flight.

    Air slows what the state has at its start for the whole flight, and what gravity adds for half of it. The
    path is that without air, which the search for the touch follows.
    """
    state[Z] += state[V] * time - time**2 / 2
    state[ANGLE] += state[SPIN] * time
    change[Z] += change[V] * time
    change[ANGLE] += change[SPIN] * time
    slower, turning = exp(-coin.drag * time), exp(-coin.slowing * time)
    for each in (state, change):
        each[V] *= slower
        each[DRIFT] *= slower
        each[SPIN] *= turning
    state[V] -= time * sqrt(slower)


@njit(cache=True)
def shift(state: Array, change: Array, time: float) -> None:
    """Move a change to a slightly later time."""
    change[Z] += state[V] * time
    change[V] -= time
    change[ANGLE] += state[SPIN] * time


@njit(cache=True)
def strike(coin: Coin, state: Array, change: Array) -> tuple[float, float]:
    """Apply Newton's impact at the lowest corner, and its derivative; return how fast that leaves, and q.

    The change is moved to its own touch and back. On a rough floor the point that touches is stopped, too;
    its horizontal speed is that of the centre and q ω.
    """
    q, slope = depth(coin, state[ANGLE], state[SPIN])
    normal = state[V] - slope * state[SPIN]
    later = -(change[Z] - slope * change[ANGLE]) / normal
    shift(state, change, later)
    dq, dslope = slope * change[ANGLE], -q * change[ANGLE]
    dnormal = change[V] - slope * change[SPIN] - dslope * state[SPIN]
    j, rebound = coin.inertia, 1 + coin.restitution
    nn, dnn = 1 + slope**2 / j, 2 * slope * dslope / j
    if coin.rough:
        along = state[DRIFT] + q * state[SPIN]
        dalong = change[DRIFT] + q * change[SPIN] + dq * state[SPIN]
        nt, tt = -q * slope / j, 1 + q**2 / j
        dnt, dtt = -(dq * slope + q * dslope) / j, 2 * q * dq / j
        whole = nn * tt - nt**2
        up = (-rebound * normal * tt + along * nt) / whole
        across = (-along * nn + rebound * normal * nt) / whole
        right = -rebound * dnormal - dnn * up - dnt * across
        left = -dalong - dnt * up - dtt * across
        dup, dacross = (right * tt - left * nt) / whole, (left * nn - right * nt) / whole
    else:
        up, across, dacross = -rebound * normal / nn, 0.0, 0.0
        dup = (-rebound * dnormal - dnn * up) / nn
    state[V] += up
    state[DRIFT] += across
    state[SPIN] += (q * across - slope * up) / j
    change[V] += dup
    change[DRIFT] += dacross
    change[SPIN] += (dq * across + q * dacross - dslope * up - slope * dup) / j
    shift(state, change, -later)
    return state[V] - slope * state[SPIN], q


@njit(cache=True)
def stretch(
    coin: Coin, state: Array, change: Array, known: float, target: float, rng: np.random.Generator
) -> float:
    """Toss until a difference is stretched to the target, or the coin lacks the energy to pass over a corner.

    At each apex above `reach` the angle is redrawn. A coin that stays in contact is followed no further.

    Args:
        coin: the coin.
        state: in flight, (5,); moved.
        change: of the state, (5,); moved, and kept at about one.
        known: logarithm of what the change has to be multiplied by.
        target: of the logarithm.
        rng: draws the angles.

    Returns:
        The logarithm of the largest stretch of the angle at a touch, over what the change was at release.
    """
    most = -inf
    while energy(coin, state) > reach(coin):
        if state[V] > 0 and state[Z] + state[V] ** 2 / 2 > reach(coin):
            rise, more = state[V], change[V]
            fly(coin, state, change, rise)
            # Air takes so much of the height, and at the apex there is no speed.
            state[Z] -= coin.drag * rise**3 / 3
            change[Z] -= coin.drag * rise**2 * more
            state[V] = 0.0
            state[ANGLE] = rng.uniform(0.0, 2 * pi)
        time = next_touch(coin, state)
        if time == inf:
            return most
        fly(coin, state, change, time)
        _, slope = depth(coin, state[ANGLE], state[SPIN])
        normal = state[V] - slope * state[SPIN]
        turned = change[ANGLE] - state[SPIN] * (change[Z] - slope * change[ANGLE]) / normal
        size = abs(turned)
        if size > 0:
            known += log(size)
            most = max(most, known)
            change /= size
        leaves, q = strike(coin, state, change)
        if leaves < IN_CONTACT and q * state[SPIN] ** 2 < 1:
            return most
        if most >= target:
            break
    return most


@njit(cache=True)
def stretch_all(
    coin: Coin, states: Array, changes: Array, known: Array, target: float, rng: np.random.Generator
) -> Array:
    """Return what `stretch` does of several tosses, (n,); their states and changes are moved.

    Args:
        coin: the coin.
        states: in flight, (n, 5).
        changes: of the states, (n, 5).
        known: logarithms by which the changes have to be multiplied, (n,); moved, too.
        target: logarithm of the stretch at which a toss is let go.
        rng: draws the angles.
    """
    found = np.empty(len(states))
    for i in range(len(states)):
        found[i] = stretch(coin, states[i], changes[i], known[i], target, rng)
        known[i] = found[i]
    return found
