"""Whether a coin in vacuum keeps enough energy to turn over for ever."""

import math
from typing import NamedTuple

import numpy as np

from cointoss.models.barriers import barrier, energy, energy_without_spin, spin_barrier
from cointoss.models.body import Body, Rules, in_vacuum, resists, slope_feeds
from cointoss.models.contact_laws.table import is_smooth
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.laws import EndingTest
from cointoss.models.records import Array
from cointoss.models.state import State

# The energy is first checked this many √(r/g) after the first sustained contact, then whenever the time since
# that contact has doubled.
FIRST_CHECK = 64.0
# "For ever" is this many doublings of √(r/g): for a coin on Earth, longer than the age of the universe.
_DOUBLINGS = 64
# Steps take at most this part of the energy from a coin that tends to that of a pass, even where a larger
# loss is none: 8e-5 is as much as the passes of a coin of 0.4 mm.
_MOST_TAKEN = 4e-6
# A loss that an engine cannot tell from none counts as at most this part of the energy.
_LARGEST_NONE = 2e-2
# The number of checks remembered, and of the last ones that suffice to tell a loss that does not grow.
_REMEMBERED, _FEW = 6, 4
KEPT = 2 + _REMEMBERED
"""The numbers that an `EnergyHistory` keeps."""


class EnergyHistory(NamedTuple):
    """The energies of a toss at its last checks; the arrays are written to as it goes on."""

    start: Array
    """The time of the first sustained contact, infinite before it, (1,) [s]."""
    next_check: Array
    """Time of the next check, infinite before that contact, (1,) [s]."""
    energies: Array
    """The energies at the last checks, the oldest first, infinite where there was none, (6,) [J]."""
    no_loss: float
    """A loss in the time √(r/g) that the engine cannot tell from none, against the energy."""


@compiled
def energy_history(no_loss: float) -> EnergyHistory:
    """Return the `EnergyHistory`, with this `no_loss`, of a toss that was not in sustained contact yet."""
    return history_in(np.full(KEPT, np.inf), no_loss)


@compiled
def history_in(kept: Array, no_loss: float) -> EnergyHistory:
    """Return the `EnergyHistory` that lies in `kept`, (`KEPT`,), infinite before the first contact."""
    return EnergyHistory(kept[:1], kept[1:2], kept[2:], no_loss)


@compiled
def start_history(body: Body, history: EnergyHistory, time: float) -> None:
    """Begin the history at a sustained contact that starts now, `time` [s], unless one was before."""
    if history.start[0] == np.inf:
        history.start[0] = time
        history.next_check[0] = time + FIRST_CHECK * (body.radius / body.gravity) ** 0.5


@compiled
def can_be_judged(history: EnergyHistory) -> bool:
    """Return whether a coin has gone on so long after its first contact that its losses can be judged."""
    return history.energies[-_FEW] < np.inf


@compiled
def wrongly_lost(body: Body, history: EnergyHistory, time: float) -> float:
    """Return the part of its energy that the engine's steps of contact may have taken from a coin wrongly.

    A coin may tend from above to the energy of a pass and never come below it: one that is less than this
    part below may be above.

    Args:
        body: the coin.
        history: of the toss.
        time: now [s].
    """
    elapsed = (time - history.start[0]) * (body.gravity / body.radius) ** 0.5
    return min(history.no_loss, _MOST_TAKEN) * min(elapsed, 1.0) if elapsed > 0 else 0.0


@compiled
def energy_loss_converges(
    body: Body, rules: Rules, state: State, time: float, history: EnergyHistory
) -> bool:
    """Return whether a coin in vacuum keeps enough energy to turn over for ever, as its losses suggest.

    Where the floor resists rolling or pivoting, it never does: a small loss continues there. Where a slope
    feeds the coin, the answer is no.

    The energy is checked whenever the time since the first sustained contact has doubled, and `loss_to_come`
    must leave enough. On a smooth floor the horizontal velocity and the angular momentum about the vertical
    never change: the energy of the first is left out, and the energy that the second needs is included.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        time: now [s].
        history: kept up.
    """
    if time < history.next_check[0] or not in_vacuum(body) or resists(rules):
        return False
    if slope_feeds(body, is_smooth(rules.law)):
        return False
    E, needed = _energy_and_need(body, rules, state)
    start, energies = history.start[0], history.energies
    elapsed = history.next_check[0] - start
    while start + 2 * elapsed <= time:
        # A check was missed in a long flight.
        elapsed *= 2
        energies[:] = np.inf
    history.next_check[0] = start + 2 * elapsed
    copy_into(energies[:-1], energies[1:])
    energies[-1] = E
    if not can_be_judged(history):
        return False
    elapsed /= (body.radius / body.gravity) ** 0.5
    none = E * min(history.no_loss * elapsed / 2, _LARGEST_NONE)
    to_come = loss_to_come(energies, none, _DOUBLINGS - math.log2(elapsed))
    return E * (1 + wrongly_lost(body, history, time)) - to_come > needed


@compiled
def _energy_and_need(body: Body, rules: Rules, state: State) -> tuple[float, float]:
    """Return the energy that losses take from, and what must be left of it to go on undecided [J]."""
    v, w = state.velocity, state.spin
    if rules.test == EndingTest.PAPER_SMOOTH:
        return energy_without_spin(body, state), body.mass * body.gravity * body.radius
    E = energy(body, state.position[2], v, w)
    if rules.test == EndingTest.PAPER:
        return E, body.mass * body.gravity * body.radius
    needed = max(barrier(body, 1.0), barrier(body, -1.0))
    if not is_smooth(rules.law):
        return E, needed
    E -= body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
    return E, max(needed, spin_barrier(body, state.R[2], w))


@compiled
def loss_to_come(energies: Array, none: float, doublings: float) -> float:
    """Estimate the energy that will be lost while the elapsed time doubles so many times [J].

    The loss of the last doubling grows in each that comes as it grew at most in the last few; it shrinks
    only where it shrank in all that are remembered. So a coin that loses ever less in the same time loses
    little. If the coin gained energy, the loss to come is infinite.

    Args:
        energies: after each doubling up to now, the oldest first, infinite where there was none, (n,) [J].
        none: a loss that cannot be told from none [J].
        doublings: how many.
    """
    losses = np.empty(len(energies) - 1)
    for i in range(len(losses)):
        losses[i] = energies[i] - energies[i + 1]
    few = losses[1 - _FEW :]
    for loss in few:
        if loss < -none:
            return np.inf
    growth = _largest_growth(losses, none) if energies[0] < np.inf else np.inf
    if growth >= 1:
        growth = max(_largest_growth(few, none), 1.0)
    loss, to_come = losses[-1], 0.0
    if loss <= none:
        loss = none if growth > 1 else 0.0
    for _ in range(math.ceil(doublings)):
        loss *= growth
        to_come += loss
    return to_come


@compiled
def _largest_growth(losses: Array, none: float) -> float:
    """Return the largest ratio of a loss to the one before, but for losses that are none; 0 without any."""
    growth = 0.0
    for i in range(1, len(losses)):
        if losses[i] > none:
            growth = max(growth, losses[i] / max(losses[i - 1], none))
    return growth
