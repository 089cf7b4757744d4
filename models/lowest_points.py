"""Where the lowest point of a coin is at many times: the point of contact where the coin touches."""

import numpy as np

from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.arrays import Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import add, apply, subtract


@compiled
def lowest_points(body: Body, positions: Table, quaternions: Table, spins: Table) -> Table:
    """Return the lowest point A in each state, space frame, (n, 3) [m]; see `lowest_point`.

    Args:
        body: the coin.
        positions: of C, space frame, (n, 3) [m].
        quaternions: Euler parameters, body to space, (n, 4).
        spins: ω, body frame, (n, 3) [rad/s].
    """
    points = np.empty((len(positions), 3))
    for i in range(len(positions)):
        e, w, x = quaternions[i], spins[i], positions[i]
        R = rotation_matrix((e[0], e[1], e[2], e[3]))
        A, _ = lowest_point(body, R[2], (w[0], w[1], w[2]))
        place = add((x[0], x[1], x[2]), apply(R, subtract(A, body.center)))
        for j in range(3):
            points[i, j] = place[j]
    return points
