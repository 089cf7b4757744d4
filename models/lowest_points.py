"""Where the lowest point of a coin is at many times: the point of contact where the coin touches."""

import numpy as np

from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import lowest_point
from cointoss.models.kernel.arrays import Table, copy_into, four, three
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
        R = rotation_matrix(four(quaternions[i], 0))
        A, _ = lowest_point(body, R[2], three(spins[i], 0))
        copy_into(points[i], add(three(positions[i], 0), apply(R, subtract(A, body.center))))
    return points
