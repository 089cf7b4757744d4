"""Contact that lasts of a planar coin on a smooth floor in linear air, in 106 bits.

Tilt, spin and drift follow an ordinary differential equation, solved by fixed steps of Dormand and
Prince's method of order 8. A step errs by 1e-12 or so, as a smooth function of where it starts: that moves
the boundaries between heads and tails, and leaves what they look like at any scale.
"""

import math

import numpy as np

from cointoss.study import STAGES, A, Array, B
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
    subtract,
)
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_state import (
    DRIFT,
    FALL,
    HEIGHT,
    SPIN,
    TILT,
    copy_state,
    flat,
    from_upright,
    part,
    put,
    turned_within,
)

STEP = 0.05
"""Of time [sqrt(r/g)]."""
_MOST_STEPS = 4000
_SECANTS = 60
_PART = (TILT, SPIN, DRIFT)


@compiled
def slide(coin: PlanarCoin, state: Array, corner: float) -> tuple[bool, bool, float, bool, float]:
    """Follow a coin whose rim point slides on a smooth floor in air until it lies flat or lifts off.

    Returns:
        Whether it lifts off, whether the coin has gone over its rim, the rim point on the floor, whether the
        contact has ended at all, and how near the coin came to standing; see `from_upright`.
    """
    passes, slopes = False, np.empty((STAGES, 3, 2))
    nearest = from_upright(coin, state)
    trial = state.copy()
    for _ in range(_MOST_STEPS):
        copy_state(trial, state)
        force = _step(coin, trial, corner, (STEP, 0.0), slopes)
        lies, lifts = -corner * math.sin(trial[TILT, 0]) <= 0, force[0] <= 0
        if lies or lifts:
            _end(coin, state, corner, lifts, slopes)
            if lifts:
                return True, passes, corner, True, nearest
            flat(state, part(state, FALL), corner)
            return False, passes, corner, True, nearest
        copy_state(state, trial)
        nearest = min(nearest, from_upright(coin, state))
        if turned_within(state):
            passes, corner = not passes, -corner
    return False, passes, corner, False, nearest


@compiled
def _end(coin: PlanarCoin, state: Array, corner: float, lifts: bool, slopes: Array) -> None:
    """Change the state to that where the floor's force, or the height, first is zero, by the secant rule."""
    low, high, which = (0.0, 0.0), (STEP, 0.0), 0 if lifts else 1
    trial = state.copy()
    f_low = _force_and_height(coin, trial, state, corner, low, slopes)[which]
    f_high = _force_and_height(coin, trial, state, corner, high, slopes)[which]
    for _ in range(_SECANTS):
        difference = subtract(f_high, f_low)
        if difference[0] == 0:
            break
        change = divide(multiply(f_high, subtract(high, low)), difference)
        low, f_low = high, f_high
        high = subtract(high, change)
        f_high = _force_and_height(coin, trial, state, corner, high, slopes)[which]
        if abs(change[0]) < 1e-31:
            break
    copy_state(state, trial)


@compiled
def _force_and_height(
    coin: PlanarCoin, trial: Array, state: Array, corner: float, duration: Pair, slopes: Array
) -> tuple[Pair, Pair]:
    """Write the state after a step into `trial`; return the floor's force and the height there."""
    copy_state(trial, state)
    force = _step(coin, trial, corner, duration, slopes)
    return force, part(trial, HEIGHT)


@compiled
def _step(coin: PlanarCoin, state: Array, corner: float, duration: Pair, slopes: Array) -> Pair:
    """Change the state by one step; return the floor's force at its end."""
    start = state.copy()
    for stage in range(STAGES + 1):
        for i in range(3):
            total = (0.0, 0.0)
            for j in range(stage):
                weight = B[j] if stage == STAGES else A[stage, j]
                if weight != 0:
                    total = add(total, scale((slopes[j, i, 0], slopes[j, i, 1]), weight))
            row = _PART[i]
            put(state, row, add(part(start, row), multiply(duration, total)))
        if stage < STAGES:
            _rates(coin, state, corner, slopes[stage])
    last = np.empty((3, 2))
    return _rates(coin, state, corner, last)


@compiled
def _rates(coin: PlanarCoin, state: Array, corner: float, rates: Array) -> Pair:
    """Write the rates of tilt, spin and drift; set height and fall as contact has them.

    Returns:
        The floor's force [m g].
    """
    sine, cosine = sine_cosine(part(state, TILT))
    w, u = part(state, SPIN), part(state, DRIFT)
    v = scale(multiply(cosine, w), -corner)
    put(state, HEIGHT, scale(sine, -corner))
    put(state, FALL, v)
    c2 = subtract(multiply(cosine, cosine), multiply(sine, sine))
    s2 = scale(multiply(sine, cosine), 2.0)
    a, b = coin.drag_mean, coin.drag_difference
    F_y = negative(add(multiply(a, u), multiply(b, add(multiply(c2, u), multiply(s2, v)))))
    F_z = negative(add(multiply(a, v), multiply(b, subtract(multiply(s2, u), multiply(c2, v)))))
    turning = multiply(multiply(coin.slowing, coin.inertia), w)
    # N = 1 - F_z + dv/dt, J dw/dt = σ cos θ N - d w, dv/dt = -σ cos θ dw/dt + σ sin θ w².
    free = add(subtract(ONE, F_z), scale(multiply(sine, multiply(w, w)), corner))
    wide = add(coin.inertia, multiply(cosine, cosine))
    spinning = divide(subtract(scale(multiply(cosine, free), corner), turning), wide)
    rates[0, 0], rates[0, 1] = w[0], w[1]
    rates[1, 0], rates[1, 1] = spinning[0], spinning[1]
    rates[2, 0], rates[2, 1] = F_y[0], F_y[1]
    return subtract(free, scale(multiply(cosine, spinning), corner))
