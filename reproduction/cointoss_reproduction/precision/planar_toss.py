"""Whole tosses of a planar coin in 106 bits, one and many."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss import Outcome
from cointoss.study import Array
from cointoss_reproduction.precision.compiled import compiled
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_contact import (
    LIES,
    LIFTS,
    drawn_up,
    hit,
    keep_contact,
    lift_off,
    nearest_upright,
    slap,
    stop,
)
from cointoss_reproduction.precision.planar_flight import Series, fly, room_for_series
from cointoss_reproduction.precision.planar_slide import slide
from cointoss_reproduction.precision.planar_state import (
    FALL,
    HEIGHT,
    SIZE,
    SPIN,
    TILT,
    copy_state,
    energy,
    is_settled,
    rim_velocity,
    turned_within,
)

MOST_IMPACTS = 20_000
CHATTERING, CHATTERING_ROUGH = 1e-10, 1e-15
"""The coin stays on the floor when all bounces to come last so short against what else changes. Contact errs
by the third power of it on a smooth floor, by the second on a rough one."""
COMPARED = 400
"""Touches that are compared with those of a neighbour, at most."""
APART = 0.1
"""Two tosses have diverged when height, velocity and spin differ by so much in all, or the faces do."""
_SLOW = 1e-25
"""What rounding leaves of a rim point that was stopped."""
_FLYING, _LIFTING, _CHATTERING = 0, 1, 2
_HEADS, _TAILS, _UNDECIDED = int(Outcome.HEADS), int(Outcome.TAILS), int(Outcome.UNDECIDED)


class PlanarOutcomes(NamedTuple):
    """How tosses end, a number each."""

    outcome: NDArray[np.int8]
    """`Outcome`: heads, tails, or undecided where a limit was met."""
    impacts: NDArray[np.int64]
    """In all, those of bounces that die away included."""
    itinerary: NDArray[np.int64]
    """A hash of the rim points that touch and of how contacts end, up to the end."""
    contacts: NDArray[np.int64]
    """Contacts that lasted."""
    energy: Array
    """With which it was settled [m g r]: after its last impact, or in the contact that came before lying."""
    from_upright: Array
    """How near it came to standing in its last contact [m g r]; see `planar_state.from_upright`. NaN where
    none lasted before it was settled."""
    flattest: Array
    """The smallest tilt of a touch before it was settled [rad]."""
    left: Array
    """The larger energy of this toss and the one before it in the row after the first impact at which they
    have diverged, 0 where they have not [m g r]; see `toss_many`."""


def toss_many(
    coin: PlanarCoin, starts: Array, most_impacts: int = MOST_IMPACTS, *, to_contact: bool = False
) -> PlanarOutcomes:
    """Toss coins; the releases of a line in a row, so that neighbours are compared.

    Args:
        coin: the coin.
        starts: as of `planar_state.release`, (n, 5, 2).
        most_impacts: a toss that makes more is undecided.
        to_contact: whether a settled coin is followed until it lies.
    """
    n = len(starts)
    outcomes = PlanarOutcomes(
        outcome=np.empty(n, dtype=np.int8),
        impacts=np.empty(n, dtype=np.int64),
        itinerary=np.empty(n, dtype=np.int64),
        contacts=np.empty(n, dtype=np.int64),
        energy=np.empty(n),
        from_upright=np.empty(n),
        flattest=np.empty(n),
        left=np.zeros(n),
    )
    _toss_all(coin, np.ascontiguousarray(starts), most_impacts, to_contact, outcomes)
    return outcomes


@compiled
def _toss_all(
    coin: PlanarCoin, starts: Array, most_impacts: int, to_contact: bool, outcomes: PlanarOutcomes
) -> None:
    outcome, impacts, itinerary, contacts, last_energy, nearest, flattest, left = outcomes
    series, state, touches = room_for_series(), np.empty((SIZE, 2)), np.empty((2, COMPARED, 5))
    for i in range(len(starts)):
        copy_state(state, starts[i])
        outcome[i], impacts[i], itinerary[i], contacts[i], last_energy[i], nearest[i], flattest[i] = toss(
            coin, state, most_impacts, to_contact, series, touches[i % 2]
        )
        if i > 0:
            left[i] = _energy_left(touches, min(impacts[i - 1], impacts[i], COMPARED))


@compiled
def _energy_left(touches: Array, compared: int) -> float:
    for n in range(compared):
        a, b = touches[0, n], touches[1, n]
        apart = abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2]) > APART
        if apart or a[3] != b[3]:
            return max(a[4], b[4])
    return 0.0


@compiled
def toss(
    coin: PlanarCoin, state: Array, most_impacts: int, to_contact: bool, series: Series, touches: Array
) -> tuple[int, int, int, int, float, float, float]:
    """Toss a coin; the state becomes the last.

    Args:
        coin: the coin.
        state: at the release, heads up, (5, 2).
        most_impacts: when to stop.
        to_contact: whether a settled coin is followed until it lies.
        series: work space.
        touches: room for states after the first impacts, (n, 5): height, fall, spin, face, energy.

    Returns:
        Outcome, impacts, itinerary, contacts, energy, nearness to standing and flattest touch; see
        `PlanarOutcomes`.
    """
    heads, corner, start, before = True, 0, 0.0, state.copy()
    itinerary, contacts, last, nearest, flattest = 0, 0, np.nan, np.nan, np.inf
    for n in range(most_impacts):
        corner = fly(coin, state, corner, start, series)
        start = 0.0
        if corner == 0:
            return _UNDECIDED, n, itinerary, contacts, last, nearest, flattest
        if turned_within(state):
            heads, corner = not heads, -corner
        itinerary = itinerary * 31 + (3 if heads else 5) + corner
        if not is_settled(coin, state):
            flattest = min(flattest, abs(state[TILT, 0]))
        hit(coin, state, float(corner), coin.restitution)
        if n < len(touches):
            touches[n, 0], touches[n, 1], touches[n, 2] = state[HEIGHT, 0], state[FALL, 0], state[SPIN, 0]
            touches[n, 3], touches[n, 4] = (1.0 if heads else 0.0), energy(coin, state)[0]
        if is_settled(coin, state) and not to_contact:
            last = energy(coin, state)[0]
            return _HEADS if heads else _TAILS, n + 1, itinerary, contacts, last, nearest, flattest
        ending = _bounces(coin, state, corner)
        if ending == _LIFTING:
            start = lift_off(state)
        elif ending == _CHATTERING:
            stop(coin, state, float(corner))
            contacts, last = contacts + 1, energy(coin, state)[0]
            if coin.in_air:
                lifts, passes, side, ended, nearest = slide(coin, state, float(corner))
                if not ended:
                    return _UNDECIDED, n + 1, itinerary, contacts, last, nearest, flattest
                ends = LIFTS if lifts else LIES
                start = state[FALL, 0] / state[SPIN, 0] ** 2 if lifts else 0.0
            else:
                copy_state(before, state)
                ends, passes, side, start = keep_contact(coin, state, float(corner))
                nearest = nearest_upright(coin, before, state, ends, passes)
            itinerary = itinerary * 31 + 11 + 2 * ends + passes
            corner, heads = int(side), heads != passes
            if ends == LIES:
                if not slap(coin, state):
                    return _HEADS if heads else _TAILS, n + 1, itinerary, contacts, last, nearest, flattest
                corner = 2
    return _UNDECIDED, most_impacts, itinerary, contacts, last, nearest, flattest


@compiled
def _bounces(coin: PlanarCoin, state: Array, corner: int) -> int:
    """Return whether a rim point that was just hit flies, lifts off without speed, or ends its bounces."""
    w = abs(state[SPIN, 0])
    _, v = rim_velocity(state, float(corner))
    sinking = -drawn_up(state)
    if sinking <= 0:
        return _LIFTING if v[0] < _SLOW else _FLYING
    lasting = 2 * v[0] / sinking / (1 - coin.restitution[0])
    limit = CHATTERING_ROUGH if coin.rough else CHATTERING
    return _CHATTERING if lasting * (1 + w**3) < limit * sinking else _FLYING
