"""A coin whose phase is redrawn at each apex, and how far it stretches a difference of its release.

Units are r, m and g. In flight the coin's normal ζ turns about its angular momentum L at |L|/J. With s the
tilt of ζ from the vertical, the lowest point of the coin lies q(s) = sin s + b |cos s| below the mass centre,
b half its thickness, and q'(s) beside it. The force of a smooth floor is vertical and has no moment about ζ,
so it keeps L_z and L_ζ. So the coin is a planar one in one more potential of its tilt,

    U(s) = (L_z - L_ζ cos s)²/(2 J sin² s),

and where L_z ≠ ± L_ζ it cannot fall flat. In a plane both are 0. On a rough floor it has to keep its plane.

A state is complex: its imaginary part is a change of it, `TINY` times as large, which analytic functions
carry by their derivative (W. Squire, G. Trapp, 1998).
"""

from math import exp, inf, log, pi, sqrt
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from cointoss.study import Array

States = NDArray[np.complex128]
"""A state, or several; or their rates."""
POSITION, VELOCITY, NORMAL, MOMENTUM = range(4)
"""Rows of a state, vectors in space: of the mass centre, of it, ζ, L."""
KNOWN, MOST, COUNTED, FIRST, CONTACTS = range(5)
"""What is remembered of a toss: logarithms of stretches, and how often it came into contact. `KNOWN` is what
the change has to be multiplied by, `MOST` the largest so far, `COUNTED` that which decides, `FIRST` that at
the first contact."""
TINY = 1e-30
"""The size of the imaginary part of a state whose change is 1."""
AT_FLOOR = 1e-12
"""A gap that is closed, as the square of a height less that of the floor; and the least step of a search."""
LEAST = 1e-9
"""The least speed of a touch, over its height; and the least step while a gap is closed."""
IN_CONTACT = 1e-2
"""Bounces die out in contact if the coin turns by less until the last of them, over the sine of its tilt."""
FLAT = 1e-5
"""Sine of the tilt below which a coin in contact lands on its face."""
LYING = 1e-12
"""The least sine of a tilt, by which rates are divided."""
GRAZE = 1e-7
"""A point that touches at less speed is only leaving a contact, and carries no change through an impact."""
TURN = 0.1
"""The angle of a step of contact, over the sine of the tilt."""
MOST_TOUCHES, MOST_CONTACTS = 1000, 100
"""A coin that touches more often, or in vacuum comes into contact so often, never ends its toss."""
PERIOD = 3
"""Turns of the tilt in a contact which in vacuum prove that it never ends."""


class Coin(NamedTuple):
    """A coin, its floor, and what air does to it on average over a turn."""

    inertia: float
    """J, about a diameter."""
    half: float
    """b, half its thickness."""
    restitution: float
    """χ."""
    rough: bool
    """Whether the floor stops the point that touches."""
    slowing: float
    """Rate at which air slows the spin about a diameter."""
    drag: float
    """Rate at which air slows the centre."""
    own_slowing: float = 0.0
    """Rate at which air slows the spin about ζ."""


@njit(cache=True)
def reach(coin: Coin) -> float:
    """Return the height of the mass centre above which the coin turns freely, that of its pass."""
    return sqrt(1 + coin.half**2)


@njit(cache=True)
def dot(state: States, first: int, second: int) -> complex:
    """Return the product of two rows."""
    return (
        state[first, 0] * state[second, 0]
        + state[first, 1] * state[second, 1]
        + state[first, 2] * state[second, 2]
    )


@njit(cache=True)
def cross(state: States) -> tuple[complex, complex, complex]:
    """Return L x ζ."""
    x, y, z = state[MOMENTUM, 0], state[MOMENTUM, 1], state[MOMENTUM, 2]
    a, b, c = state[NORMAL, 0], state[NORMAL, 1], state[NORMAL, 2]
    return y * c - z * b, z * a - x * c, x * b - y * a


@njit(cache=True)
def spin(coin: Coin, state: States) -> float:
    """Return how fast ζ turns, |L|/J."""
    return sqrt(dot(state, MOMENTUM, MOMENTUM).real) / coin.inertia


@njit(cache=True)
def above(coin: Coin, state: States) -> float:
    """Return the energy above that of the pass; below it a face is settled [m g r].

    The spin about ζ, which no fall changes, is left out; and in air the turning at the pass, which dies away.
    """
    turning = (dot(state, MOMENTUM, MOMENTUM) - dot(state, MOMENTUM, NORMAL) ** 2).real / coin.inertia
    lost = state[MOMENTUM, 2].real ** 2 / coin.inertia if coin.slowing == 0 else 0.0
    return state[POSITION, 2].real - reach(coin) + (dot(state, VELOCITY, VELOCITY).real + turning - lost) / 2


@njit(cache=True)
def tilt(coin: Coin, state: States) -> tuple[complex, complex, complex, complex]:
    """Return sin s and the rate of s, q and q'."""
    n, half = state[NORMAL, 2], coin.half * np.sign(state[NORMAL, 2].real)
    sine = np.sqrt(state[NORMAL, 0] ** 2 + state[NORMAL, 1] ** 2 + LYING**2)
    return sine, -cross(state)[2] / (coin.inertia * sine), sine + half * n, n - half * sine


@njit(cache=True)
def circle(state: States) -> tuple[complex, complex, complex]:
    """Return a, b, c of cos s = a + b cos φ + c sin φ after a flight in which ζ turns by φ."""
    whole = dot(state, MOMENTUM, MOMENTUM) + LYING**2
    middle = state[MOMENTUM, 2] * dot(state, MOMENTUM, NORMAL) / whole
    return middle, state[NORMAL, 2] - middle, cross(state)[2] / np.sqrt(whole)


@njit(cache=True)
def next_touch(coin: Coin, state: States) -> float:
    """Return the time to the next touch.

    With either face's rim G = (z ∓ b n)² + n² - 1 is 0 at a touch, n = cos s; steps bend it by no more than
    gravity and the spin can, and so pass over no touch.
    """
    z, v, turning = state[POSITION, 2].real, state[VELOCITY, 2].real, spin(coin, state)
    middle, b, c = circle(state)
    high = z - reach(coin)
    time = v + sqrt(v * v + 2 * high) if high > 0 else 0.0
    highest = max(z + v * max(v, 0.0) / 2 if high <= 0 else reach(coin), 1.0)
    fastest = sqrt(2 * (highest + max(z, 1.0)) + v * v)
    bend = 2 * highest + 2 * (1 + coin.half**2) * turning**2
    bend += 2 * coin.half * (1 + 2 * fastest * turning + highest * turning**2)
    while True:
        cosine, sine = np.cos(turning * time), np.sin(turning * time)
        n = middle.real + b.real * cosine + c.real * sine
        rate = turning * (c.real * cosine - b.real * sine)
        height, fall, step = z + v * time - time**2 / 2, v - time, inf
        for half in (coin.half, -coin.half):
            open_ = (height - half * n) ** 2 + n**2 - 1
            opening = 2 * (height - half * n) * (fall - half * rate) + 2 * n * rate
            if open_ < AT_FLOOR and opening < -LEAST * height:
                return time
            ahead = (opening + sqrt(opening**2 + 2 * bend * max(open_, 0.0))) / bend
            step = min(step, max(ahead, LEAST if open_ < AT_FLOOR else AT_FLOOR))
        time += step


@njit(cache=True)
def turn(state: States, angle: complex) -> None:
    """Turn ζ about L."""
    whole, ahead, cosine = dot(state, MOMENTUM, MOMENTUM) + LYING**2, cross(state), np.cos(angle)
    across, along = np.sin(angle) / np.sqrt(whole), (1 - cosine) * dot(state, MOMENTUM, NORMAL) / whole
    for i in range(3):
        state[NORMAL, i] = cosine * state[NORMAL, i] + across * ahead[i] + along * state[MOMENTUM, i]


@njit(cache=True)
def fly(coin: Coin, state: States, time: float) -> None:
    """Move a state through a flight.

    Air slows what the state has at its start for the whole flight, and what gravity adds for half of it. The
    path is that without air, which the search for the touch follows.
    """
    turn(state, np.sqrt(dot(state, MOMENTUM, MOMENTUM) + LYING**2) / coin.inertia * time)
    slower, across = exp(-coin.drag * time), exp(-coin.slowing * time)
    own = (exp(-coin.own_slowing * time) - across) * dot(state, MOMENTUM, NORMAL)
    for i in range(3):
        state[POSITION, i] += state[VELOCITY, i] * time
        state[VELOCITY, i] *= slower
        state[MOMENTUM, i] = across * state[MOMENTUM, i] + own * state[NORMAL, i]
    state[POSITION, 2] -= time**2 / 2
    state[VELOCITY, 2] -= time * sqrt(slower)


@njit(cache=True)
def shift(coin: Coin, state: States, time: complex) -> None:
    """Move the change of a state to a slightly later time, which is imaginary."""
    for i, faster in enumerate(cross(state)):
        state[POSITION, i] += state[VELOCITY, i] * time
        state[NORMAL, i] += faster / coin.inertia * time
    state[VELOCITY, 2] -= time


@njit(cache=True)
def strike(coin: Coin, state: States) -> tuple[float, float]:
    """Apply Newton's impact at the lowest point; return how fast that leaves, and the change of the phase.

    The change is moved to its own touch and back. On a rough floor the point that touches is stopped, too.
    """
    change = state.imag.copy()
    _, rate, q, slope = tilt(coin, state)
    approach = (state[VELOCITY, 2] - slope * rate).real
    later = -1j * (state[POSITION, 2] - q).imag / approach if approach < -GRAZE else 0j
    shift(coin, state, later)
    _, b, c = circle(state)
    turned = abs(b.real * c.imag - c.real * b.imag) / (b.real**2 + c.real**2 + LYING**2) / TINY
    sine, rate, q, slope = tilt(coin, state)
    x, y, j = state[NORMAL, 0] / sine, state[NORMAL, 1] / sine, coin.inertia
    grip = q if coin.rough else 0j
    along = state[VELOCITY, 0] * x + state[VELOCITY, 1] * y - q * rate if coin.rough else 0j
    rebound = (1 + coin.restitution) * (slope * rate - state[VELOCITY, 2])
    nn, nt, tt = 1 + slope**2 / j, slope * grip / j, 1 + grip**2 / j
    up = (rebound * tt + along * nt) / (nn * tt - nt**2)
    across = (-along * nn - rebound * nt) / (nn * tt - nt**2)
    moment = slope * up + grip * across
    for i, pushed in enumerate((across * x, across * y, up)):
        state[VELOCITY, i] += pushed
    state[MOMENTUM, 0] += moment * y
    state[MOMENTUM, 1] -= moment * x
    shift(coin, state, -later)
    if approach > -GRAZE:
        state.imag[:] = change
    return -coin.restitution * approach, turned


@njit(cache=True)
def floor_force(coin: Coin, state: States) -> complex:
    """Return the force of a smooth floor in sustained contact."""
    sine, rate, q, slope = tilt(coin, state)
    n, up, own, j = state[NORMAL, 2], state[MOMENTUM, 2], dot(state, MOMENTUM, NORMAL), coin.inertia
    pull = (up - own * n) * (own - up * n) / (j * sine**3)
    faster = (coin.drag - coin.slowing) * rate - pull / j
    return (1 - q * rate**2 + slope * faster) / (1 + slope**2 / j)


@njit(cache=True)
def dies_out(coin: Coin, state: States, leaves: float) -> bool:
    """Return whether bounces at a rim point, which it leaves at this speed, die out in sustained contact."""
    sine, _, _, slope = tilt(coin, state)
    falls = floor_force(coin, state) * (1 + slope**2 / coin.inertia) * (1 - coin.restitution)
    return 2 * leaves * spin(coin, state) < IN_CONTACT * sine.real * falls.real


@njit(cache=True)
def contact_flow(coin: Coin, state: States) -> States:
    """Return the rates of ζ and L in contact, as rows of a state."""
    rates, (sine, _, _, slope), ahead = np.zeros_like(state), tilt(coin, state), cross(state)
    moment = floor_force(coin, state) * slope / sine
    kept = (coin.slowing - coin.own_slowing) * dot(state, MOMENTUM, NORMAL)
    for i in range(3):
        rates[NORMAL, i] = ahead[i] / coin.inertia
        rates[MOMENTUM, i] = kept * state[NORMAL, i] - coin.slowing * state[MOMENTUM, i]
    rates[MOMENTUM, 0] += moment * state[NORMAL, 1]
    rates[MOMENTUM, 1] -= moment * state[NORMAL, 0]
    return rates


@njit(cache=True)
def slide(coin: Coin, state: States) -> tuple[float, bool]:
    """Follow a contact until the coin lifts off, lands flat or on its other rim, or its face is settled.

    Returns:
        The largest change of the tilt before the coin last goes over its rim, 0 if it does not; and whether
        the contact never ends.
    """
    largest, counted, turns, ends = 0.0, 0.0, 0, False
    sine, rate, _, _ = tilt(coin, state)
    while not ends and sine.real > FLAT:
        start, rates, was = state.copy(), np.zeros_like(state), rate.real
        turning = dot(state, MOMENTUM, MOMENTUM) - dot(state, MOMENTUM, NORMAL) ** 2
        step = TURN * sine.real / (sqrt(max(turning.real, 0.0)) / coin.inertia + 1)
        for part, weight in ((0.0, 1), (0.5, 2), (0.5, 2), (1.0, 1)):
            rates = contact_flow(coin, start + part * step * rates)
            state += step * weight / 6 * rates
        state[NORMAL] /= np.sqrt(dot(state, NORMAL, NORMAL))
        sine, rate, q, slope = tilt(coin, state)
        state[POSITION, 2], state[VELOCITY, 2] = q, slope * rate
        over_rim = (start[NORMAL, 2] * state[NORMAL, 2]).real < 0
        if over_rim:
            counted = largest
        turns += rate.real * was < 0
        largest = max(largest, abs(state[NORMAL, 2].imag) / (TINY * sine.real))
        ends = floor_force(coin, state).real < 0 or above(coin, state) < 0 or (over_rim and coin.half > 0)
        ends = ends or (turns == PERIOD and coin.slowing == 0)
    if sine.real < FLAT:
        state[NORMAL, :2] = -state[NORMAL, :2]
    return counted, turns == PERIOD and coin.slowing == 0


@njit(cache=True)
def rise(coin: Coin, state: States, angle: float) -> None:
    """Move a state to its apex, and turn it there by an angle; air takes of its height."""
    fast = state[VELOCITY, 2]
    fly(coin, state, fast.real)
    state[POSITION, 2] -= coin.drag * fast**3 / 3
    state[VELOCITY, 2] = state[VELOCITY, 2].imag * 1j
    turn(state, angle)


@njit(cache=True)
def bounce(coin: Coin, state: States, known: Array, target: float, rng: np.random.Generator) -> None:
    """Toss until a difference is stretched to the target, or the coin's face is settled.

    At an apex above `reach` the phase is redrawn. A stretch counts at each touch; once the coin has been in
    contact, when it goes over its rim. Of a coin that turns over for ever it counts up to the first contact,
    for its neighbours do so, too. On a rough floor a coin in contact is followed no further.

    Args:
        coin: the coin.
        state: in flight, (4, 3); moved.
        known: what is remembered of the toss, (5,); changed.
        target: of the logarithm of the stretch.
        rng: draws the phases.
    """
    touches, endless = 0, False
    while above(coin, state) > 0 and known[COUNTED] < target and not endless:
        up = state[VELOCITY, 2].real
        if up > 0 and state[POSITION, 2].real + up**2 / 2 > reach(coin):
            rise(coin, state, rng.uniform(0.0, 2 * pi))
        time, before = next_touch(coin, state), state[NORMAL, 2].real
        fly(coin, state, time)
        if spin(coin, state) * time > pi or state[NORMAL, 2].real * before < 0:
            known[COUNTED] = known[MOST]
        leaves, size = strike(coin, state)
        known[KNOWN] += log(max(size, LYING))
        known[MOST] = max(known[MOST], known[KNOWN])
        state.imag[:] /= max(size, LYING)
        if known[CONTACTS] == 0:
            known[COUNTED] = known[FIRST] = known[MOST]
        if above(coin, state) > 0 and dies_out(coin, state, leaves):
            if coin.rough:
                break
            known[CONTACTS] += 1
            grown, endless = slide(coin, state)
            endless = endless or (known[CONTACTS] == MOST_CONTACTS and coin.slowing == 0)
            if grown > 0:
                known[COUNTED] = max(known[MOST], known[KNOWN] + log(grown))
        touches += 1
        endless = endless or touches == MOST_TOUCHES
    if endless:
        known[COUNTED] = known[FIRST]
    known[COUNTED] = max(known[COUNTED], known[FIRST])


@njit(cache=True)
def bounce_all(coin: Coin, states: States, known: Array, target: float, rng: np.random.Generator) -> None:
    """Apply `bounce` to several tosses, (n, 4, 3) and (n, 5)."""
    for i in range(len(states)):
        bounce(coin, states[i], known[i], target, rng)


def unknown(count: int) -> Array:
    """Return what is remembered of tosses at their release, (n, 5)."""
    known = np.full((count, 5), -inf)
    known[:, [KNOWN, CONTACTS]] = 0.0
    return known
