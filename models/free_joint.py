"""Between MuJoCo's free joint and the records: the joint carries B, the records carry C.

Both have velocities in space, the angular velocity in the body, and Euler parameters with the scalar first.
"""

import numpy as np

from cointoss.models.attitude import Quaternion, rotation_matrix
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array, Table, copy_into, four, three
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, apply, cross, subtract
from cointoss.models.state import State


@compiled
def to_mass_center(body: Body, qpos: Array, qvel: Array) -> State:
    """Return the `State` of a free joint.

    Args:
        body: the coin.
        qpos: of the free joint, (7,).
        qvel: of the free joint, (6,).
    """
    e, w = four(qpos, 3), three(qvel, 3)
    R = rotation_matrix(e)
    x = add(three(qpos, 0), apply(R, body.center))
    v = add(three(qvel, 0), apply(R, cross(w, body.center)))
    return State(x, v, e, w, R)


@compiled
def of_mass_center(body: Body, x: Vector, v: Vector, e: Quaternion, w: Vector) -> tuple[Vector, Vector]:
    """Return position and velocity of B, space frame, of a state in which C is at x with the velocity v.

    Args:
        body: the coin.
        x: position of C, (3,) [m].
        v: velocity of C, (3,) [m/s].
        e: Euler parameters, (4,).
        w: angular velocity, body frame, (3,) [rad/s].
    """
    R = rotation_matrix(e)
    return subtract(x, apply(R, body.center)), subtract(v, apply(R, cross(w, body.center)))


@compiled
def states_of_joint(body: Body, motions: Table) -> Table:
    """Return the state vectors of C, (n, 13), from qpos and qvel, (n, 13)."""
    states = np.empty((len(motions), 13))
    for i in range(len(motions)):
        x, v, e, w, _ = to_mass_center(body, motions[i, :7], motions[i, 7:])
        copy_into(states[i], x + v + e + w)
    return states


@compiled
def joint_of_states(body: Body, states: Table) -> Table:
    """Return qpos and qvel, (n, 13), from the state vectors of C, (n, 13)."""
    motions = np.empty((len(states), 13))
    for i in range(len(states)):
        e, w = four(states[i], 6), three(states[i], 10)
        x, v = of_mass_center(body, three(states[i], 0), three(states[i], 3), e, w)
        copy_into(motions[i], x + e + v + w)
    return motions
