"""Whether a coin in vacuum keeps enough energy to turn over for ever."""

import math

import numpy as np

from models.body import in_vacuum
from models.ending import barrier, energy, spin_barrier
from models.kernel.compiled import compiled
from models.laws import ContactLaw

# The energy of a toss in contact is looked at after so many √(r/g), and whenever that time has doubled.
FIRST_LOOK = 64.0
# For ever: so many doublings of √(r/g), which takes a coin on Earth longer than the universe is old.
_DOUBLINGS = 64
# However little an engine can tell, a larger part of the energy is a loss.
_LARGEST_NONE = 2e-2
# So many looks are remembered, of which the last few are enough to tell a loss that does not grow.
_LOOKS, _FEW = 6, 4


@compiled
def no_looks():
    """Give the `looks` of a toss that was not in contact yet; see `dies_away`."""
    return np.full(_LOOKS + 2, np.inf)


@compiled
def first_contact(body, looks, time):
    """Begin the `looks` at the start of a contact, unless there was one before.

    Args:
        body: the coin.
        looks: see `dies_away`.
        time: now [s].
    """
    if looks[0] == np.inf:
        looks[0], looks[1] = time, time + FIRST_LOOK * (body.radius / body.gravity) ** 0.5


@compiled
def dies_away(body, rules, z, v, up, w, no_loss, time, looks):
    """Tell whether the energy that a coin loses in vacuum dies away before it is too low to turn over.

    The energy is looked at whenever the time since the first contact has doubled, and `loss_to_come` must
    leave enough; on a smooth floor, where horizontal velocity and angular momentum about the vertical
    never change, without the one and with what the other needs.

    Args:
        body: the coin.
        rules: floor and ending.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        up: the upward unit vector in the body frame, (3,).
        w: angular velocity, body frame, (3,) [rad/s].
        no_loss: a loss in the time √(r/g) that an engine cannot tell from none, against the energy.
        time: now [s].
        looks: start of the first contact and time of the next look [s], infinite before, and the energies at
            the last looks [J], (8,); kept up.
    """
    if time < looks[1] or not in_vacuum(body):
        return False
    E, needed = energy(body, z, v, w), max(barrier(body, 1.0), barrier(body, -1.0))
    if rules.law == ContactLaw.SMOOTH:
        E -= body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
        needed = max(needed, spin_barrier(body, up, w))
    gone_by = looks[1] - looks[0]
    while looks[0] + 2 * gone_by <= time:
        # In a long flight a look was missed.
        gone_by *= 2
        looks[2:] = np.inf
    looks[1] = looks[0] + 2 * gone_by
    looks[2:-1] = looks[3:]
    looks[-1] = E
    if not looks[-_FEW] < np.inf:
        return False
    gone_by /= (body.radius / body.gravity) ** 0.5
    none = E * min(no_loss * gone_by / 2, _LARGEST_NONE)
    to_come = loss_to_come(looks[2:], none, _DOUBLINGS - math.log2(gone_by))
    return E - to_come > needed


@compiled
def loss_to_come(energies, none, doublings):
    """Estimate the energy that will be lost while the time gone by doubles so many times [J].

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
    """Give the largest ratio of a loss to the one before, but for losses that are none; 0 without any."""
    growth = 0.0
    for i in range(1, len(losses)):
        if losses[i] > none:
            growth = max(growth, losses[i] / max(losses[i - 1], none))
    return growth
