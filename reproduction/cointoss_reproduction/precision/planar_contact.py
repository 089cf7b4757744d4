"""What the floor does to a planar coin: an impact, contact that lasts, a slap, in 106 bits."""

import math

from cointoss.study import Array
from cointoss_reproduction.precision.compiled import compiled
from cointoss_reproduction.precision.double_double import (
    ONE,
    Pair,
    add,
    divide,
    multiply,
    negative,
    scale,
    sine_cosine,
    square_root,
    subtract,
)
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_state import (
    DRIFT,
    FALL,
    HEIGHT,
    SPIN,
    TILT,
    energy,
    flat,
    is_settled,
    part,
    put,
    rim_velocity,
)

SLAPS = 1000
"""Impacts of a flat coin on its two rim points in turn, at most."""
LIES, LIFTS = 0, 1
"""How a contact ends: the coin falls flat on the floor, or its rim point lifts off."""


@compiled
def hit(coin: PlanarCoin, state: Array, corner: float, restitution: Pair) -> None:
    """Change the state by the impact of a rim point, 1 or -1, that comes down; else do nothing.

    Newton's law along the vertical; on a rough floor the point stops aside.
    """
    _, down = rim_velocity(state, corner)
    if down[0] < 0:
        _push(coin, state, corner, negative(multiply(add(ONE, restitution), down)))


@compiled
def stop(coin: PlanarCoin, state: Array, corner: float) -> None:
    """Change the state by the impulse that leaves a rim point at rest along the vertical, of any sign."""
    _, v = rim_velocity(state, corner)
    _push(coin, state, corner, negative(v))


@compiled
def _push(coin: PlanarCoin, state: Array, corner: float, wanted: Pair) -> None:
    """Change a rim point's vertical velocity by what is wanted; a rough floor stops it aside, too."""
    sine, cosine = sine_cosine(part(state, TILT))
    # The point lies at (y, z) from C; K is what an impulse there does to its velocity.
    y, z = scale(cosine, corner), scale(sine, corner)
    J = coin.inertia
    K_zz = add(ONE, divide(multiply(y, y), J))
    if coin.rough:
        across, _ = rim_velocity(state, corner)
        K_yy, K_yz = add(ONE, divide(multiply(z, z), J)), negative(divide(multiply(y, z), J))
        determinant = subtract(multiply(K_yy, K_zz), multiply(K_yz, K_yz))
        aside = negative(across)
        S_y = divide(subtract(multiply(K_zz, aside), multiply(K_yz, wanted)), determinant)
        S_z = divide(subtract(multiply(K_yy, wanted), multiply(K_yz, aside)), determinant)
        moment = subtract(multiply(y, S_z), multiply(z, S_y))
        put(state, DRIFT, add(part(state, DRIFT), S_y))
    else:
        S_z = divide(wanted, K_zz)
        moment = multiply(y, S_z)
    put(state, FALL, add(part(state, FALL), S_z))
    put(state, SPIN, add(part(state, SPIN), divide(moment, J)))


@compiled
def keep_contact(coin: PlanarCoin, state: Array, corner: float) -> tuple[int, bool, float, float]:
    """Follow a coin whose rim point rests on the floor, in vacuum, until the contact ends.

    The motion has one degree of freedom and keeps its energy, so its course is algebraic in s = sin of the
    tilt, the height of C: on a smooth floor it presses while s² - 2 e s + 1 + J > 0, on a rough one, where it
    rolls, while 3 s² - 2 e s + J > 0. Where a rough floor would have to pull, the point slips freely.

    Returns:
        How it ends, whether the coin has gone over its rim, the rim point on the floor, and the clock up to
        which the flight that follows is free of touches.
    """
    passes = False
    if coin.rough:
        lies, passes = _roll(coin, state, corner, energy(coin, state))
        corner = -corner if passes else corner
        if lies:
            return LIES, passes, corner, 0.0
    if drawn_up(state) > 0:
        return LIFTS, passes, corner, lift_off(state)
    u = part(state, DRIFT)
    e = energy(coin, state)
    if coin.rough:
        e = subtract(e, scale(multiply(u, u), 0.5))
    rises = state[FALL, 0] > 0
    if rises and subtract(e, add(ONE, scale(coin.inertia, 0.5)))[0] > 0:
        under = subtract(multiply(e, e), add(ONE, coin.inertia))
        s = subtract(e, square_root(under))
        _raise_to(state, corner, s)
        wide = add(coin.inertia, subtract(ONE, multiply(s, s)))
        _pivot(state, corner, square_root(divide(scale(subtract(e, s), 2.0), wide)), 1.0)
        return LIFTS, passes, corner, 2 * state[FALL, 0] / state[SPIN, 0] ** 2
    over = rises and subtract(e, ONE)[0] > 0
    corner = -corner if over else corner
    flat(state, negative(square_root(divide(scale(e, 2.0), add(ONE, coin.inertia)))), corner)
    return LIES, over != passes, corner, 0.0


@compiled
def nearest_upright(coin: PlanarCoin, before: Array, after: Array, ends: int, passes: bool) -> float:
    """Return how near a coin comes to standing in a contact in vacuum; see `planar_state.from_upright`.

    On a rough floor the energy of rolling counts as motion.

    Args:
        coin: the coin.
        before: state at the start of the contact, (5, 2).
        after: state at its end, (5, 2).
        ends: how it ends.
        passes: whether the coin has gone over its rim.
    """
    e, top = energy(coin, before), part(before, HEIGHT)
    if passes:
        top = ONE
    elif ends == LIFTS:
        top = part(after, HEIGHT) if after[HEIGHT, 0] > top[0] else top
    elif before[FALL, 0] > 0:
        # It turns back where all its energy is height.
        top = e
    return abs(subtract(add(e, ONE), scale(top, 2.0))[0])


@compiled
def lift_off(state: Array) -> float:
    """Return the clock up to which a rim point does not touch that is at rest on the floor and drawn up."""
    w = abs(state[SPIN, 0])
    return 1.5 * drawn_up(state) / w**3


@compiled
def drawn_up(state: Array) -> float:
    """Return the acceleration of a rim point on the floor in free flight, upward."""
    w = part(state, SPIN)
    return subtract(multiply(part(state, HEIGHT), multiply(w, w)), ONE)[0]


@compiled
def _roll(coin: PlanarCoin, state: Array, corner: float, e: Pair) -> tuple[bool, bool]:
    """Roll about the rim point until the coin lies flat or the floor would have to pull.

    Returns:
        Whether it lies flat, and whether it has gone over its rim.
    """
    inner = subtract(multiply(e, e), scale(coin.inertia, 3.0))
    s, rises, passes = part(state, HEIGHT), state[FALL, 0] > 0, False
    if inner[0] <= 0:
        low, high = (2.0, 0.0), (2.0, 0.0)
    else:
        root = square_root(inner)
        low = divide(subtract(e, root), (3.0, 0.0))
        high = divide(add(e, root), (3.0, 0.0))
    if low[0] < s[0] < high[0]:
        return False, False
    if rises and s[0] < low[0] < 1:
        end = low
    elif rises and subtract(e, ONE)[0] <= 0:
        # It turns back and comes down as it rose.
        end, rises = ((0.0, 0.0) if s[0] <= low[0] else high), False
    elif s[0] >= high[0]:
        end, passes, rises = high, rises, False
    else:
        end, passes, rises = (0.0, 0.0), rises, False
    side = -corner if passes else corner
    w = square_root(divide(scale(subtract(e, end), 2.0), add(ONE, coin.inertia)))
    if end[0] == 0:
        flat(state, negative(w), side)
        put(state, DRIFT, (0.0, 0.0))
        return True, passes
    _raise_to(state, side, end)
    _pivot(state, side, w, 1.0 if rises else -1.0)
    sine, _ = sine_cosine(part(state, TILT))
    put(state, DRIFT, scale(multiply(sine, part(state, SPIN)), side))
    return False, passes


@compiled
def _raise_to(state: Array, corner: float, s: Pair) -> None:
    """Set height and tilt so that a rim point on the floor has C at the height s."""
    put(state, HEIGHT, s)
    wanted = scale(s, -corner)
    tilt = (math.asin(max(-1.0, min(1.0, wanted[0]))), 0.0)
    for _ in range(2):
        sine, cosine = sine_cosine(tilt)
        tilt = add(tilt, divide(subtract(wanted, sine), cosine))
    put(state, TILT, tilt)


@compiled
def _pivot(state: Array, corner: float, w: Pair, direction: float) -> None:
    """Set the rates of a coin that turns about a rim point on the floor, w >= 0, up or down."""
    _, cosine = sine_cosine(part(state, TILT))
    put(state, SPIN, scale(w, -corner * direction))
    put(state, FALL, scale(multiply(cosine, w), direction))


@compiled
def slap(coin: PlanarCoin, state: Array) -> bool:
    """Let a flat coin's two rim points hit the floor in turn.

    Returns:
        Whether both leave it in the end; else the coin is settled.
    """
    for _ in range(SLAPS):
        _, left = rim_velocity(state, -1.0)
        _, right = rim_velocity(state, 1.0)
        if is_settled(coin, state) or (left[0] > 0 and right[0] > 0):
            break
        hit(coin, state, -1.0 if left[0] < right[0] else 1.0, coin.restitution)
    return not is_settled(coin, state)
