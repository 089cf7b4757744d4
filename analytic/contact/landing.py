"""The guards of a landing: which part of a coin in contact comes down next, and about when."""

import numpy as np

from cointoss.analytic.contact.automaton import Event
from cointoss.analytic.contact.contact import BOTH_RIMS, SustainedContact
from cointoss.analytic.flight.state_vector import attitude_of, spin_of
from cointoss.models.attitude import rotation_matrix
from cointoss.models.geometry import FACE_SINE, tilt_sine_of
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import cross
from cointoss.models.records import Array


@compiled
def landing(contact: SustainedContact, y: Array) -> Event:
    """Return which part of the coin lands in the state y, (13,), just past the end of a mode, or `NONE`."""
    if contact.rim == BOTH_RIMS:
        return Event.NONE
    up = rotation_matrix(attitude_of(y))[2]
    if contact.body.thickness > 0 and -contact.rim * up[2] <= 0:
        return Event.SECOND_RIM_LANDS
    return Event.FACE_LANDS if tilt_sine_of(up) <= FACE_SINE else Event.NONE


@compiled
def time_to_landing(contact: SustainedContact, y: Array, dy: Array) -> float:
    """Return when the other rim would land if n_z were a parabola [s], infinite where it would not.

    Args:
        contact: the contact.
        y: state, (13,).
        dy: its rate of change, (13,).
    """
    if contact.rim == BOTH_RIMS or contact.body.thickness == 0:
        return np.inf
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    up_rate = cross(up, w)
    left, speed = max(-contact.rim * up[2], 0.0), -contact.rim * up_rate[2]
    acceleration = -contact.rim * (cross(up_rate, w)[2] + cross(up, spin_of(dy))[2])
    squared = speed * speed - 2 * left * acceleration
    if not squared >= 0:
        return np.inf
    if speed < 0:
        return 2 * left / (squared**0.5 - speed)
    return (speed + squared**0.5) / -acceleration if acceleration < 0 else np.inf
