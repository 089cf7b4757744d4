"""The floor's force on a coin in a sustained contact."""

import numpy as np

from analytic.contact.contact import contact_rate
from analytic.contact.floor_force import side_of
from analytic.flight.equations_of_motion import STATE_SIZE, derivative
from models.kernel.compiled import compiled
from models.kernel.vectors import scale, subtract


@compiled
def force_in_contact(body, mu, motion, y):
    """Return the floor's force, of both rims where a coin is upright, space frame, (3,) [N].

    It is what the rate of change in contact has more than that of free flight.

    Args:
        body: the coin.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state, (13,).
    """
    free, held = np.empty(STATE_SIZE), np.empty(STATE_SIZE)
    derivative(body, y, free)
    contact_rate(body, mu, motion, side_of(y), y, held)
    gained = subtract((held[3], held[4], held[5]), (free[3], free[4], free[5]))
    return scale(body.mass, gained)
