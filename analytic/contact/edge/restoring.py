"""How strongly the floor turns a coin that leans off its edge back to it."""

import numpy as np

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import contact_at, flow
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.rim_contact import lean_and_rate
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, spin_of
from cointoss.models.attitude import rotation_matrix
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import cross
from cointoss.models.records import Array

TRIAL = 2e-9
"""The angle by which an upright coin is tipped onto either rim, for trial [rad]."""


@compiled
def held_on_edge(contact: SustainedContact, y: Array) -> bool:
    """Return whether the floor's force on either rim turns a coin on its edge back to the other now.

    Args:
        contact: the contact, at one rim.
        y: state of a coin on its edge, (13,).
    """
    on_heads = restoring_acceleration(contact, 1.0, TRIAL, y)
    return on_heads > 0 and restoring_acceleration(contact, -1.0, TRIAL, y) > 0


@compiled
def restoring_acceleration(contact: SustainedContact, rim: float, lean: float, y: Array) -> float:
    """Return how fast n_z accelerates back to 0 of a coin leaning onto a rim [1/s²]; < 0 where it does not.

    Args:
        contact: the contact, at one rim.
        rim: the lower one: -1 tails', 1 heads'; see `cointoss.models.geometry.lower_rim`.
        lean: |n_z|.
        y: state that is tried so, (13,).
    """
    dy, leaning = np.empty(STATE_SIZE), y.copy()
    # To the first order, the second time from next to nothing.
    for most in (0.0, -rim * lean):
        n_z, _ = lean_and_rate(leaning)
        upright.tilt(leaning, n_z - most)
    flow(contact_at(contact.body, contact.friction, contact.mode, leaning), leaning, dy)
    up, w = rotation_matrix(attitude_of(leaning))[2], spin_of(leaning)
    return rim * (cross(cross(up, w), w)[2] + cross(up, spin_of(dy))[2])
