"""How either engine writes down its impacts."""

from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.models.barriers import energy
from cointoss.models.body import Body
from cointoss.models.ending import face_up
from cointoss.models.geometry import contact_velocity
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.kinds import Rows
from cointoss.models.kernel.vectors import Vector
from cointoss.models.records import IMPACT_ROW
from cointoss.models.state import State

ImpactRows = Annotated[NDArray[Any], Rows(IMPACT_ROW)]
"""Impacts, (n,) of `IMPACT_ROW`."""
FIRST_ROOM = 64
"""A toss of which all is kept starts with room for so many impacts."""


@compiled
def write_impact(
    body: Body, impulse: Vector, point: Vector, before: State, after: State, row: np.record
) -> None:
    """Write an impact, all but its time, into a row.

    Args:
        body: the coin.
        impulse: of the floor, space frame, (3,) [N s].
        point: that touches, from B, body frame, (3,) [m].
        before: state at first touch.
        after: state when the floor has acted.
        row: where it goes, one `IMPACT_ROW`.
    """
    v, w, v_after, w_after = before.velocity, before.spin, after.velocity, after.spin
    v_A = contact_velocity(body, before.R, v, w, point)
    v_A_after = contact_velocity(body, after.R, v_after, w_after, point)
    E_before = energy(body, before.position[2], v, w)
    E_after = energy(body, after.position[2], v_after, w_after)
    copy_into(row.impulse, impulse)
    copy_into(row.point, point)
    copy_into(row.position, before.position)
    copy_into(row.quaternion, before.attitude)
    copy_into(row.velocity_before, v)
    copy_into(row.velocity_after, v_after)
    copy_into(row.angular_velocity_before, w)
    copy_into(row.angular_velocity_after, w_after)
    copy_into(row.contact_velocity_before, v_A)
    copy_into(row.contact_velocity_after, v_A_after)
    row.face = face_up(before.R[2][2])
    row.energy = E_after
    row.energy_change = E_after - E_before


@compiled
def with_room(rows: NDArray[Any], n: int) -> NDArray[Any]:
    """Return rows with room for impact number n: these, or twice as many."""
    if n < len(rows):
        return rows
    more = np.zeros(2 * len(rows), IMPACT_ROW)
    for i in range(len(rows)):
        more[i] = rows[i]
    return more


@compiled
def last_face(impacts: ImpactRows, n: int) -> int:
    """Return the face up at impact n, counted from 1, in the row that is its own; 0 for none."""
    return impacts[(n - 1) % len(impacts)]["face"] if n > 0 else 0
