"""A sustained contact as a record: the coin, the floor's friction, the mode and the rim that touches."""

from typing import NamedTuple

from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.flight.state_vector import attitude_of
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import lower_rim
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

BOTH_RIMS = 0.0
"""The `SustainedContact.rim` of an upright coin, and of one that lies."""


class SustainedContact(NamedTuple):
    """The data that the functions of a sustained contact share, made once for each step."""

    body: Body
    friction: FloorFriction
    mode: int
    """Number of the `Mode`."""
    rim: float
    """The rim that touches: -1 tails', 1 heads', see `cointoss.models.geometry.lower_rim`; 0 for both or a
    face."""


@compiled
def lower_rim_of(y: Array) -> float:
    """Return the `lower_rim` of the state y, (13,)."""
    return lower_rim(rotation_matrix(attitude_of(y))[2][2])
