"""Gaps and energies of many states."""

import numpy as np

from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.geometry import gap
from cointoss.models.records import Array, Impacts, States, Toss
from cointoss.models.scenario import Scenario


def gaps(body: Body, states: States | Impacts) -> Array:
    """Return the height of the lowest point in each state, (n,) [m]."""
    pairs = zip(states.position[:, 2], states.quaternion, strict=True)
    return np.array([gap(body, z, rotation_matrix(tuple(e))[2]) for z, e in pairs])


def energies(case: Scenario, states: States) -> Array:
    """Return the energy in each state, zero at rest with C on the floor, (n,) [J]."""
    v, w = states.velocity, states.angular_velocity
    turning = np.einsum("ni,ij,nj->n", w, np.array(case.body.inertia), w) / 2
    return turning + case.coin.mass * ((v**2).sum(1) / 2 + case.gravity * states.position[:, 2])


def last_state(toss: Toss) -> tuple[Array, Array, Array]:
    """Return position, velocity and angular velocity at the end of a toss's path, (3,) each."""
    end = toss.sample(toss.path_end)
    return end.position[0], end.velocity[0], end.angular_velocity[0]
