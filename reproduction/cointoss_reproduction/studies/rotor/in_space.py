"""A coin in space over a smooth floor, whose phase is redrawn at each apex, and which may stay in contact.

Units are r, m and g. The floor's force is vertical and has no moment about ζ, so it keeps L_z and L_ζ. So
the coin is the planar one of `chain` in one more potential of its tilt s, which is 0 where heads is up:

    U(s) = (L_z - L_ζ cos s)²/(2 J sin² s).

In flight ζ turns about L at Ω = |L|/J, so n = cos s is a constant and a cosine of the angle φ = Ω t; a coin
that keeps its plane has L_z = L_ζ = 0 and φ = s. In contact the mass centre is at q(s) = sin s + b |cos s|,
and the tilt moves in V(s) = q + U with the inertia J + q'². Where L_z ≠ ± L_ζ the coin cannot fall flat.
"""

from math import acos, atan2, cos, exp, inf, log, pi, sin, sqrt

import numpy as np
from numba import njit

from cointoss import Scenario
from cointoss.study import Array, rotation_matrix
from cointoss_reproduction.studies.rotor import chain
from cointoss_reproduction.studies.rotor.chain import ANGLE, SPIN, Coin, V, Z, reach, shift
from cointoss_reproduction.studies.rotor.splitting import coin_of

L_Z, L_ZETA = 5, 6
"""What a state has beside that of `chain`, in which ANGLE is φ, SPIN is Ω, and DRIFT is 0."""
SIZE = 7
AT_FLOOR = 1e-12
"""A gap that is closed, as the square of a height less that of the floor."""
LEAST = 1e-9
"""The least step of the search for a touch."""
IN_CONTACT = 1e-2
"""Bounces die out in contact if the coin turns by less until the last of them, over the sine of its tilt."""
FLAT = 1e-5
"""Sine of the tilt below which a coin in contact lands on its face."""
LYING = 1e-12
"""The least sine of a tilt, by which rates of n are divided."""
GRAZE = 1e-7
"""A point that touches at less speed is only leaving a contact, and carries no change through an impact."""
TURN = 0.1
"""The angle of a step of contact, over the sine of the tilt."""
NEAR = 1e-6
"""The distance of the neighbours that give derivatives."""
MOST_TOUCHES = 1000
"""A coin that touches more often never ends its toss, which happens in vacuum."""
PERIOD = 3
"""Turns of the tilt in a contact which in vacuum prove that it never ends."""


@njit(cache=True)
def sine_of(n: float) -> float:
    """Return sin s, at least `LYING`."""
    return sqrt(max(1 - n**2, LYING**2))


@njit(cache=True)
def lean(coin: Coin, state: Array) -> tuple[float, float]:
    """Return n = cos s and its rate."""
    whole = coin.inertia * state[SPIN]
    up, own = state[L_Z] / whole, state[L_ZETA] / whole
    swing = sqrt(max((1 - up**2) * (1 - own**2), 0.0))
    n = up * own + swing * cos(state[ANGLE])
    return min(max(n, -1.0), 1.0), -state[SPIN] * swing * sin(state[ANGLE])


@njit(cache=True)
def set_lean(coin: Coin, state: Array, n: float, rate: float) -> None:
    """Give a state this n and its rate, with its L_z and L_ζ."""
    sine, own = sine_of(n), state[L_ZETA] / coin.inertia
    across = (state[L_Z] / coin.inertia - own * n) / sine
    spin = sqrt(own**2 + across**2 + (rate / sine) ** 2)
    state[SPIN] = spin
    state[ANGLE] = atan2(-rate / spin, n - state[L_Z] / coin.inertia * own / spin**2)


@njit(cache=True)
def depth(coin: Coin, state: Array) -> float:
    """Return q, how far the lowest point is below the mass centre."""
    n, _ = lean(coin, state)
    return sine_of(n) + coin.half * abs(n)


@njit(cache=True)
def above(coin: Coin, state: Array) -> float:
    """Return the energy above that of the pass; below it a face is settled [m g r].

    The spin about ζ, which no fall changes, is left out; and in air the turning at the pass, which dies away.
    """
    turning = coin.inertia * state[SPIN] ** 2 - state[L_ZETA] ** 2 / coin.inertia
    lost = state[L_Z] ** 2 / coin.inertia if coin.slowing == 0 else 0.0
    return state[Z] - reach(coin) + (state[V] ** 2 + turning - lost) / 2


@njit(cache=True)
def next_touch(coin: Coin, state: Array) -> float:
    """Return the time to the next touch.

    With either face's rim G = (z ∓ b n)² + n² - 1 is 0 at a touch; steps bend it by no more than gravity and
    Ω can, and so pass over no touch.
    """
    z, v, spin, moved = state[Z], state[V], state[SPIN], state.copy()
    above = z - reach(coin)
    time = v + sqrt(v * v + 2 * above) if above > 0 else 0.0
    highest = max(z + v * max(v, 0.0) / 2 if above <= 0 else reach(coin), 1.0)
    fastest = sqrt(2 * (highest + max(z, 1.0)) + v * v)
    bend = 2 * highest + 2 * (1 + coin.half**2) * spin**2
    bend += 2 * coin.half * (1 + 2 * fastest * spin + highest * spin**2)
    while True:
        moved[ANGLE] = state[ANGLE] + spin * time
        n, rate = lean(coin, moved)
        height, fall, step = z + v * time - time**2 / 2, v - time, inf
        for half in (coin.half, -coin.half):
            open_ = (height - half * n) ** 2 + n**2 - 1
            opening = 2 * (height - half * n) * (fall - half * rate) + 2 * n * rate
            if open_ < AT_FLOOR and opening < -LEAST:
                return time
            step = min(step, (opening + sqrt(opening**2 + 2 * bend * max(open_, 0.0))) / bend)
        time += max(step, LEAST)


@njit(cache=True)
def fly(coin: Coin, state: Array, change: Array, time: float) -> None:
    """Move a state and a small change of it through a flight; air slows L across ζ and along it."""
    chain.fly(coin, state, change, time)
    if coin.slowing > 0:
        state[L_Z:] *= exp(-coin.slowing * time)
        n, rate = lean(coin, state)
        across = state[L_Z] - state[L_ZETA] * n
        state[L_ZETA] *= exp((coin.slowing - coin.own_slowing) * time)
        state[L_Z] = across + state[L_ZETA] * n
        set_lean(coin, state, n, rate)


@njit(cache=True)
def rebound(coin: Coin, state: Array) -> float:
    """Apply Newton's impact at the lowest point, and return how fast that comes down."""
    n, rate = lean(coin, state)
    sine = sine_of(n)
    lever = coin.half * np.sign(n) * sine - n
    normal = state[V] - lever * rate / sine
    up = -(1 + coin.restitution) * normal / (1 + lever**2 / coin.inertia)
    state[V] += up
    set_lean(coin, state, n, rate - lever * sine * up / coin.inertia)
    return normal


@njit(cache=True)
def neighbours(state: Array, change: Array) -> tuple[Array, Array, float]:
    """Return two states on either side, and one over their distance in changes."""
    near = NEAR / np.sqrt(np.sum(change**2))
    return state - near * change, state + near * change, 1 / (2 * near)


@njit(cache=True)
def difference(lower: Array, upper: Array, over: float) -> Array:
    """Return what `neighbours` differ by, in changes, without whole turns of φ."""
    found = upper - lower
    found[ANGLE] -= 2 * pi * np.round(found[ANGLE] / (2 * pi))
    return found * over


@njit(cache=True)
def strike(coin: Coin, state: Array, change: Array) -> tuple[float, float]:
    """Apply an impact and its derivative; return how fast the point leaves, and the change of φ there."""
    lower, upper, over = neighbours(state, change)
    closed = (depth(coin, upper) - depth(coin, lower)) * over - change[Z]
    before = state.copy()
    approach = rebound(coin, state)
    if approach > -GRAZE:
        return 0.0, abs(change[ANGLE])
    later = closed / approach
    shift(before, change, later)
    turned = abs(change[ANGLE])
    lower, upper, over = neighbours(before, change)
    rebound(coin, lower)
    rebound(coin, upper)
    change[:] = difference(lower, upper, over)
    shift(state, change, -later)
    return -coin.restitution * approach, turned


@njit(cache=True)
def sliding(coin: Coin, y: Array) -> tuple[float, float]:
    """Return the acceleration of the tilt in contact, and the floor's force.

    Args:
        coin: the coin.
        y: tilt, its rate, then L_z and L_ζ.
    """
    sine, n, rate, j = sin(y[0]), cos(y[0]), y[1], coin.inertia
    slope, bent = n - coin.half * np.sign(n) * sine, -sine - coin.half * abs(n)
    pull = (y[2] - y[3] * n) * (y[3] - y[2] * n) / (j * sine**3)
    slowing = (j * coin.slowing + coin.drag * slope**2) * rate
    faster = -(slope * (1 + bent * rate**2) + pull + slowing) / (j + slope**2)
    return faster, 1 + bent * rate**2 + slope * (faster + coin.drag * rate)


@njit(cache=True)
def dies_out(coin: Coin, state: Array, leaves: float) -> bool:
    """Return whether bounces at a rim point, which it leaves at this speed, die out in sustained contact."""
    y = in_contact(coin, state)
    lever = cos(y[0]) - coin.half * np.sign(cos(y[0])) * sin(y[0])
    falls = sliding(coin, y)[1] * (1 + lever**2 / coin.inertia) * (1 - coin.restitution)
    return 2 * leaves * state[SPIN] < IN_CONTACT * sin(y[0]) * falls


@njit(cache=True)
def flow(coin: Coin, y: Array) -> Array:
    """Return the rates of coins in contact, each a row as in `sliding`, (n, 4)."""
    n, rates = np.cos(y[:, 0]), np.empty_like(y)
    rates[:, 0], rates[:, 3] = y[:, 1], -coin.own_slowing * y[:, 3]
    rates[:, 2] = -coin.slowing * (y[:, 2] - n * y[:, 3]) + n * rates[:, 3]
    for k in range(len(y)):
        rates[k, 1] = sliding(coin, y[k])[0]
    return rates


@njit(cache=True)
def in_contact(coin: Coin, state: Array) -> Array:
    """Return a state as it is in `sliding`."""
    n, rate = lean(coin, state)
    return np.array([acos(n), -rate / sine_of(n), state[L_Z], state[L_ZETA]])


@njit(cache=True)
def set_contact(coin: Coin, state: Array, y: Array) -> None:
    """Give a state what is in `sliding`, with its lowest point on the floor."""
    n, sine = cos(y[0]), sin(y[0])
    state[Z], state[L_Z], state[L_ZETA] = sine + coin.half * abs(n), y[2], y[3]
    state[V] = (n - coin.half * np.sign(n) * sine) * y[1]
    set_lean(coin, state, n, -sine * y[1])


@njit(cache=True)
def slide(coin: Coin, state: Array, change: Array) -> tuple[float, bool]:
    """Follow a contact until the coin lifts off, lands flat or on its other rim, or its face is settled.

    Returns:
        The largest change of the tilt before the coin last goes over its rim, 0 if it does not; and whether
        the contact never ends.
    """
    lower, upper, over = neighbours(state, change)
    largest, counted, turns, ends = 0.0, 0.0, 0, False
    y = np.stack((in_contact(coin, state), in_contact(coin, lower), in_contact(coin, upper)))
    while not ends and sin(y[0, 0]) > FLAT:
        before, rates, n, sine = y.copy(), np.zeros_like(y), cos(y[0, 0]), sin(y[0, 0])
        across = (y[0, 2] - y[0, 3] * n) / (coin.inertia * sine)
        step = TURN * sine / (sqrt(y[0, 1] ** 2 + across**2) + 1)
        for part, weight in ((0.0, 1), (0.5, 2), (0.5, 2), (1.0, 1)):
            rates = flow(coin, before + part * step * rates)
            y += step * weight / 6 * rates
        over_rim = cos(y[0, 0]) * n < 0
        if over_rim:
            counted = largest
        turns += y[0, 1] * before[0, 1] < 0
        largest = max(largest, abs(y[2, 0] - y[1, 0]) * over)
        set_contact(coin, state, y[0])
        ends = sliding(coin, y[0])[1] < 0 or above(coin, state) < 0 or (over_rim and coin.half > 0)
        ends = ends or (turns == PERIOD and coin.slowing == 0)
    set_contact(coin, lower, y[1])
    set_contact(coin, upper, y[2])
    change[:] = difference(lower, upper, over)
    if sin(y[0, 0]) < FLAT:
        state[ANGLE] = -state[ANGLE]
    return counted, turns == PERIOD and coin.slowing == 0


@njit(cache=True)
def bounce(coin: Coin, state: Array, change: Array, rng: np.random.Generator) -> tuple[float, int]:
    """Toss until the coin's face is settled, or it turns over for ever.

    At an apex above `reach` the angle is redrawn if the coin has turned by π since its touch. A stretch
    counts at each touch, as in `chain`; once the coin has been in contact, when it goes over its rim. Of a
    coin that turns over for ever it counts up to the first contact, for its neighbours do so, too.

    Args:
        coin: the coin.
        state: in flight, (7,); moved.
        change: of the state, (7,); moved.
        rng: draws the angles.

    Returns:
        The logarithm of the largest stretch of an angle over what the change was at release, and how often
        the coin came into contact.
    """
    known, most, counted, first, contacts, touches, endless = 0.0, -inf, -inf, -inf, 0, 0, False
    while above(coin, state) > 0 and not endless:
        if state[V] * state[SPIN] > pi and state[Z] + state[V] ** 2 / 2 > reach(coin):
            rise, more = state[V], change[V]
            fly(coin, state, change, rise)
            state[Z] -= coin.drag * rise**3 / 3
            change[Z] -= coin.drag * rise**2 * more
            state[V] = 0.0
            state[ANGLE] = rng.uniform(0.0, 2 * pi)
        time, before = next_touch(coin, state), lean(coin, state)[0]
        fly(coin, state, change, time)
        if state[SPIN] * time > pi or lean(coin, state)[0] * before < 0:
            counted = most
        leaves, size = strike(coin, state, change)
        known += log(max(size, LYING))
        most = max(most, known)
        change /= max(size, LYING)
        first = first if contacts else most
        if above(coin, state) > 0 and dies_out(coin, state, leaves):
            contacts += 1
            grown, endless = slide(coin, state, change)
            if grown > 0:
                counted = max(most, known + log(grown))
        touches += 1
        endless = endless or touches == MOST_TOUCHES
    return (max(first, counted) if contacts and not endless else first), contacts


@njit(cache=True)
def bounce_all(coin: Coin, states: Array, rng: np.random.Generator) -> Array:
    """Return what `bounce` does of several tosses, (n, 2), for a difference of their heights."""
    found = np.empty((len(states), 2))
    for i in range(len(states)):
        change = np.zeros(SIZE)
        change[Z] = 1.0
        found[i, 0], found[i, 1] = bounce(coin, states[i], change, rng)
    return found


def started(scenario: Scenario, states: Array) -> Array:
    """Return releases as states of the coin in space, (n, 7).

    Args:
        scenario: coin, air and floor.
        states: at release, (n, 13), in SI.
    """
    coin, radius = coin_of(scenario), scenario.coin.radius
    time, found = (radius / scenario.gravity) ** 0.5, np.zeros((len(states), SIZE))
    inertia = np.diag(scenario.body.inertia) / (scenario.coin.mass * radius**2)
    for state, at_start in zip(found, states, strict=True):
        up, w = np.array(rotation_matrix(at_start[6:10]))[2], at_start[10:] * time
        momentum = inertia * w
        state[Z], state[V] = at_start[2] / radius, at_start[5] * time / radius
        state[L_Z], state[L_ZETA] = up @ momentum, momentum[2]
        state[SPIN] = np.linalg.norm(momentum) / coin.inertia
        middle = state[L_Z] * state[L_ZETA] / (coin.inertia * state[SPIN]) ** 2
        state[ANGLE] = atan2(-(up[0] * w[1] - up[1] * w[0]) / state[SPIN], up[2] - middle)
    return found
