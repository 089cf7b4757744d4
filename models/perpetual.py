"""Whether a coin in vacuum keeps enough energy to turn over for ever."""

import math
from typing import NamedTuple

import numpy as np

from models.barriers import barrier, energy, spin_barrier
from models.body import in_vacuum
from models.kernel.arrays import copy_into
from models.kernel.compiled import compiled
from models.laws import ContactLaw
from models.records import Array

# The energy is checked so many √(r/g) after the first sustained contact, then whenever the time since it has
# doubled.
FIRST_CHECK = 64.0
# For ever: so many doublings of √(r/g), which takes a coin on Earth longer than the universe is old.
_DOUBLINGS = 64
# What an engine cannot tell from no loss is never taken for more than this part of the energy.
_LARGEST_NONE = 2e-2
# So many checks are remembered, of which the last few are enough to tell a loss that does not grow.
_REMEMBERED, _FEW = 6, 4


class EnergyHistory(NamedTuple):
    """The energies of a toss at its last checks; the arrays are written to as it goes on."""

    start: Array
    """When the coin came into sustained contact for the first time, infinite before, (1,) [s]."""
    next_check: Array
    """Time of the next check, infinite before that contact, (1,) [s]."""
    energies: Array
    """At the last checks, the oldest first, infinite where there was none, (6,) [J]."""


@compiled
def energy_history():
    """Return the `EnergyHistory` of a toss that was not in sustained contact yet."""
    return EnergyHistory(np.full(1, np.inf), np.full(1, np.inf), np.full(_REMEMBERED, np.inf))


@compiled
def start_history(body, history, time):
    """Begin the history at a sustained contact that starts now, `time` [s], unless one was before."""
    if history.start[0] == np.inf:
        history.start[0] = time
        history.next_check[0] = time + FIRST_CHECK * (body.radius / body.gravity) ** 0.5


@compiled
def energy_loss_converges(body, rules, state, time, history, no_loss):
    """Return whether a coin in vacuum keeps enough energy to turn over for ever, as its losses suggest.

    The energy is checked whenever the time since the first sustained contact has doubled, and `loss_to_come`
    must leave enough; on a smooth floor, where horizontal velocity and angular momentum about the vertical
    never change, without the energy of the one and with what the other needs.

    Args:
        body: the coin.
        rules: floor and ending.
        state: of the coin, a `State`.
        time: now [s].
        history: kept up.
        no_loss: a loss in the time √(r/g) that an engine cannot tell from none, against the energy.
    """
    if time < history.next_check[0] or not in_vacuum(body):
        return False
    v, up, w = state.velocity, state.R[2], state.spin
    E, needed = energy(body, state.position[2], v, w), max(barrier(body, 1.0), barrier(body, -1.0))
    if rules.law == ContactLaw.SMOOTH:
        E -= body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
        needed = max(needed, spin_barrier(body, up, w))
    start, energies = history.start[0], history.energies
    elapsed = history.next_check[0] - start
    while start + 2 * elapsed <= time:
        # A check was missed in a long flight.
        elapsed *= 2
        energies[:] = np.inf
    history.next_check[0] = start + 2 * elapsed
    copy_into(energies[:-1], energies[1:])
    energies[-1] = E
    if not energies[-_FEW] < np.inf:
        return False
    elapsed /= (body.radius / body.gravity) ** 0.5
    none = E * min(no_loss * elapsed / 2, _LARGEST_NONE)
    to_come = loss_to_come(energies, none, _DOUBLINGS - math.log2(elapsed))
    return E - to_come > needed


@compiled
def loss_to_come(energies, none, doublings):
    """Estimate the energy that will be lost while the elapsed time doubles so many times [J].

    The loss of the last doubling grows in each that comes as it grew at most in the last few; it shrinks
    only where it shrank in all that are remembered. So a coin that loses ever less in the same time loses
    little. Energy gained is no evidence of anything: the loss to come is infinite.

    Args:
        energies: after each doubling up to now, the oldest first, infinite where there was none, (n,) [J].
        none: a loss that cannot be told from none [J].
        doublings: how many.
    """
    losses = energies[:-1] - energies[1:]
    few = losses[1 - _FEW :]
    if few.min() < -none:
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
def _largest_growth(losses, none):
    """Return the largest ratio of a loss to the one before, but for losses that are none; 0 without any."""
    growth = 0.0
    for i in range(1, len(losses)):
        if losses[i] > none:
            growth = max(growth, losses[i] / max(losses[i - 1], none))
    return growth
