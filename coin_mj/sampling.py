"""States of a toss between its knots, and the floor's force at them."""

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import motion_of, set_motion
from cointoss.coin_mj.steps.free_step import free_step
from cointoss.coin_mj.steps.held_step import floor_force
from cointoss.coin_mj.steps.knots import StepKind
from cointoss.coin_mj.steps.runge_kutta import normalise, write_rate
from cointoss.models.free_joint import states_of_joint
from cointoss.models.kernel.arrays import Array, Counts, Row, Table, copy_into
from cointoss.models.kernel.compiled import compiled


@compiled
def sample_path(coin: MujocoCoin, knots: Table, before: Counts, times: Row) -> Table:
    """Return the states at times, (n, 13); at an impact, that at first touch.

    Args:
        coin: MuJoCo's.
        knots: of the path, see `cointoss.coin_mj.path.Knots`.
        before: number of the last knot up to each time, (n,).
        times: (n,) [s].
    """
    motions = np.empty((len(times), 13))
    for i in range(len(times)):
        knot, time = knots[before[i]], times[i]
        if time > knot[0] and knot[1] == StepKind.FLIGHT.value:
            set_motion(coin, knot[2:])
            free_step(coin, time - knot[0])
            copy_into(motions[i], motion_of(coin))
        elif time > knot[0]:
            write_between(knot, knots[before[i] + 1], time, motions[i])
        else:
            copy_into(motions[i], knot[2:])
    return states_of_joint(coin.body, motions)


@compiled
def write_between(knot: Array, after: Array, time: float, motion: Array) -> None:
    """Write qpos and qvel at a time between two knots of a contact.

    In a sustained contact qpos is Hermite's cubic: the chord of an arc on which the coin tilts is below it.

    Args:
        knot: the one before, (15,).
        after: the next one, (15,).
        time: between them [s].
        motion: where they go, (13,).
    """
    start, end, length = knot[2:], after[2:], after[0] - knot[0]
    part = (time - knot[0]) / length
    for i in range(13):
        motion[i] = start[i] + part * (end[i] - start[i])
    if knot[1] == StepKind.CONTACT.value:
        rates, still = np.empty((2, 13)), np.zeros(6)
        write_rate(start, still, rates[0])
        write_rate(end, still, rates[1])
        for i in range(7):
            rise = end[i] - start[i]
            bend = (1 - part) * (length * rates[0, i] - rise) - part * (length * rates[1, i] - rise)
            motion[i] += part * (1 - part) * bend
    normalise(motion)


@compiled
def knot_forces(coin: MujocoCoin, chi: float, knots: Table, numbers: Counts) -> Table:
    """Return the floor's force in the steps that start at knots, space frame, (n, 3) [N].

    Where such a step is none of a sustained contact, it is 0.

    Args:
        coin: MuJoCo's.
        chi: restitution χ.
        knots: of the path, see `cointoss.coin_mj.path.Knots`.
        numbers: of those knots, (n,).
    """
    forces = np.zeros((len(numbers), 3))
    for i in range(len(numbers)):
        knot = knots[numbers[i]]
        if knot[1] == StepKind.CONTACT.value:
            set_motion(coin, knot[2:])
            copy_into(forces[i], floor_force(coin, chi, knots[numbers[i] + 1, 0] - knot[0]))
    return forces
