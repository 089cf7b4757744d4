"""The state of a planar coin, its release, and its energy, in 106 bits."""

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.precision.compiled import compiled
from cointoss_reproduction.precision.double_double import (
    ONE,
    Pair,
    add,
    multiply,
    negative,
    pair_of,
    scale,
    sine_cosine,
    subtract,
)
from cointoss_reproduction.precision.planar_coin import PlanarCoin, Units, square_root

HEIGHT, FALL, TILT, SPIN, DRIFT, SIZE = 0, 1, 2, 3, 4, 5
"""Rows of a state, (5, 2): height and velocity of C, the angle of the coin's plane, its rate, velocity aside.

The tilt lies within ±π/2 of the flat coin; the face up is kept apart.
"""
_PI = (3.141592653589793, 1.2246467991473532e-16)


def release(
    units: Units, *, height: Fraction | float, spin: Fraction | float, tilt: Fraction | float = 0.0
) -> NDArray[np.float64]:
    """Return the state of a coin released at rest but for its spin, (5, 2).

    Args:
        units: of the coin.
        height: of C [m].
        spin: ω [rad/s].
        tilt: θ, within ±π/2 [rad].
    """
    time = square_root(units.length / units.gravity)
    state = np.zeros((SIZE, 2))
    state[HEIGHT] = pair_of(Fraction(height) / units.length)
    state[TILT] = pair_of(Fraction(tilt))
    state[SPIN] = pair_of(Fraction(spin) * time)
    return state


@compiled
def part(state: Array, row: int) -> Pair:
    """Return one number of a state, a pair."""
    return state[row, 0], state[row, 1]


@compiled
def put(state: Array, row: int, pair: Pair) -> None:
    """Set one number of a state."""
    state[row, 0], state[row, 1] = pair[0], pair[1]


@compiled
def copy_state(state: Array, source: Array) -> None:
    """Make a state that of another, both (5, 2)."""
    for i in range(SIZE):
        put(state, i, part(source, i))


@compiled
def energy(coin: PlanarCoin, state: Array) -> Pair:
    """Return the energy that counts against the barrier 1, in m g r.

    On a smooth floor that of drift cannot lift the coin; in air no more than a share of it can.
    """
    v, w, u = part(state, FALL), part(state, SPIN), part(state, DRIFT)
    e = add(part(state, HEIGHT), scale(multiply(v, v), 0.5))
    e = add(e, scale(multiply(coin.inertia, multiply(w, w)), 0.5))
    share = 1.0 if coin.rough else (coin.sliding_share if coin.in_air else 0.0)
    return add(e, scale(multiply(u, u), 0.5 * share))


@compiled
def from_upright(coin: PlanarCoin, state: Array) -> float:
    """Return how far a coin in contact is from standing upright at rest, but for its drift, in m g r.

    The energy of its motion and that which its height lacks: by so much its energy differs from that of the
    coin that stands when it turns back below the upright, or passes it.
    """
    v, w = part(state, FALL), part(state, SPIN)
    of_motion = add(multiply(v, v), multiply(coin.inertia, multiply(w, w)))
    return add(scale(of_motion, 0.5), subtract(ONE, part(state, HEIGHT)))[0]


@compiled
def is_settled(coin: PlanarCoin, state: Array) -> bool:
    """Return whether the coin has too little energy to go over its rim."""
    return subtract(energy(coin, state), ONE)[0] < 0


@compiled
def turned_within(state: Array) -> bool:
    """Reduce the tilt to ±π/2.

    Returns:
        Whether the other face is up and the rim's two points have changed names.
    """
    tilt = part(state, TILT)
    halves = np.round(tilt[0] / _PI[0])
    if halves == 0:
        return False
    put(state, TILT, subtract(tilt, scale(_PI, halves)))
    return int(halves) % 2 != 0


@compiled
def rim_velocity(state: Array, corner: float) -> tuple[Pair, Pair]:
    """Return the velocity of a rim point across and along the vertical, pairs.

    Args:
        state: (5, 2).
        corner: which, 1 or -1: it lies at `corner` (cos θ, sin θ) from C.
    """
    sine, cosine = sine_cosine(part(state, TILT))
    w = part(state, SPIN)
    across = subtract(part(state, DRIFT), scale(multiply(sine, w), corner))
    return across, add(part(state, FALL), scale(multiply(cosine, w), corner))


@compiled
def flat(state: Array, fall: Pair, corner: float) -> None:
    """Lay the coin down on the floor, one rim point at rest there; (5, 2), changed."""
    state[HEIGHT], state[TILT] = 0.0, 0.0
    put(state, FALL, fall)
    put(state, SPIN, scale(negative(fall), corner))


def spread(starts: Array, row: int, step: tuple[float, float], points: int) -> NDArray[np.float64]:
    """Return releases in steps from each of `starts`, (n points, 5, 2).

    Args:
        starts: releases, (n, 5, 2).
        row: what varies.
        step: by which it grows, a pair.
        points: releases from each.
    """
    spread_out = np.repeat(starts, points, axis=0)
    _spread(spread_out, row, step, points)
    return spread_out


@compiled
def _spread(states: Array, row: int, step: Pair, points: int) -> None:
    for i in range(len(states)):
        put(states[i], row, add(part(states[i], row), scale(step, float(i % points))))
