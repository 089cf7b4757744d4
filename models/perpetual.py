"""Whether a coin in vacuum keeps enough energy to turn over for ever."""

import numpy as np

from models.body import in_vacuum
from models.compiled import compiled
from models.ending import barrier, energy
from models.laws import ContactLaw

# The energy of a toss in contact is looked at after so many √(r/g), and whenever that time has doubled.
FIRST_LOOK = 64.0
# So many more doublings are for ever: from a second on, they take longer than the universe is old.
_MORE_LOOKS = 60
_LOOKS = 4


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
def dies_away(body, rules, z, v, w, no_loss, time, looks):
    """Tell whether the energy that a coin loses in vacuum dies away before it is too low to turn over.

    The energy is looked at whenever the time since the first contact has doubled. The loss of the last
    doubling, growing in each that comes as it grew at most in those before, must leave enough after
    `_MORE_LOOKS` more: so it does where a coin loses ever less in the same time. On a smooth floor the
    horizontal motion, which never changes, is left out.

    Args:
        body: the coin.
        rules: floor and ending.
        z: height of C [m].
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        no_loss: a loss that an engine cannot tell from none, against the energy.
        time: now [s].
        looks: start of the first contact and time of the next look [s], infinite before, and the energies at
            the last looks [J], (6,); kept up.
    """
    if time < looks[1] or not in_vacuum(body):
        return False
    E = energy(body, z, v, w)
    if rules.law == ContactLaw.SMOOTH:
        E -= body.mass * (v[0] * v[0] + v[1] * v[1]) / 2
    looks[1] += looks[1] - looks[0]
    looks[2:-1] = looks[3:]
    looks[-1] = E
    losses = looks[2:-1] - looks[3:]
    none, growth = no_loss * E, 1.0
    for i in range(1, _LOOKS - 1):
        # An infinite or undefined loss is one not looked at yet; energy gained is no evidence of anything.
        if not losses[i - 1] < np.inf or losses[i] < -none:
            return False
        if losses[i] > none:
            growth = max(growth, losses[i] / max(losses[i - 1], none))
    to_come, loss = 0.0, losses[-1]
    if loss <= none:
        loss = none if growth > 1 else 0.0
    for _ in range(_MORE_LOOKS):
        loss *= growth
        to_come += loss
    return E - to_come > max(barrier(body, 1.0), barrier(body, -1.0))
