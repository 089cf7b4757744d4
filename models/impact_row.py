"""How either engine writes down its impacts."""

import numpy as np

from cointoss.models.barriers import energy
from cointoss.models.ending import face_up
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW

FIRST_ROOM = 64
"""A toss of which all is kept starts with room for so many impacts."""


@compiled
def write_impact(body, impulse, point, n_z, touch, release, row):
    """Write an impact, all but its time, into a row.

    Args:
        body: the coin.
        impulse: of the floor, space frame, (3,) [N s].
        point: that touches, from B, body frame, (3,) [m].
        n_z: upward component of the coin's normal at first touch.
        touch: position and velocity of C (space), Euler parameters, angular velocity (body), and velocity of
            the point (space), at first touch.
        release: height of C, then as `touch` without the attitude, when the floor has acted.
        row: one `IMPACT_ROW`.
    """
    x, v, e, w, v_A = touch
    z_after, v_after, w_after, v_A_after = release
    E_before, E_after = energy(body, x[2], v, w), energy(body, z_after, v_after, w_after)
    for i in range(3):
        row.impulse[i] = impulse[i]
        row.point[i] = point[i]
        row.position[i] = x[i]
        row.velocity_before[i] = v[i]
        row.velocity_after[i] = v_after[i]
        row.angular_velocity_before[i] = w[i]
        row.angular_velocity_after[i] = w_after[i]
        row.contact_velocity_before[i] = v_A[i]
        row.contact_velocity_after[i] = v_A_after[i]
    for i in range(4):
        row.quaternion[i] = e[i]
    row.face = face_up(n_z)
    row.energy = E_after
    row.energy_change = E_after - E_before


@compiled
def with_room(rows, n):
    """Return rows with room for impact number n: these, or twice as many."""
    if n < len(rows):
        return rows
    more = np.zeros(2 * len(rows), IMPACT_ROW)
    for i in range(len(rows)):
        more[i] = rows[i]
    return more
