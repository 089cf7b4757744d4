"""The path of a toss in MuJoCo, stepped again where it is asked for."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass

import numpy as np

from cointoss.coin_mj.model.machine import Machine
from cointoss.coin_mj.model.state import motion_of, set_motion
from cointoss.coin_mj.steps.free_step import free_step
from cointoss.coin_mj.steps.knots import Step
from cointoss.coin_mj.steps.runge_kutta import normalise, write_rate
from cointoss.coin_mj.steps.sustained_contact import floor_force
from cointoss.models.free_joint import states_of_joint
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array, States

TIME, STEP, MOTION = 0, 1, slice(2, 15)
"""Columns of a knot."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps.

    In flight they are stepped again by MuJoCo to the times asked for; in contact they are interpolated:
    those of an impact are less than a hundredth of a microsecond apart, those of a sustained contact less
    than a small turn of the coin. There the position and the attitude are cubic between two knots.
    """

    machine: Machine
    knots: Array
    """Time [s], the `Step` that starts there, qpos and qvel, (n, 15)."""
    restitution: float
    """χ of the floor."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s], in the order of `times`; at an impact, that at first touch."""
        coin = self.machine.coin
        motions = np.empty((len(times), 13))
        before = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        for motion, time, number in zip(motions, times, before, strict=True):
            knot = self.knots[number]
            if time > knot[TIME] and knot[STEP] == Step.FLIGHT:
                set_motion(coin, knot[MOTION])
                free_step(coin, time - knot[TIME])
                motion[:] = motion_of(coin)
            elif time > knot[TIME]:
                write_between(knot, self.knots[number + 1], time, motion)
            else:
                motion[:] = knot[MOTION]
        return self._states(times, motions)

    def contact_states(self) -> States:
        """Return the states at the knots of the sustained contacts, midway between, and at their ends."""
        return self._states(*_in_contact(self.knots))

    def _states(self, times: Array, motions: Array) -> States:
        """Return states from qpos and qvel, (n, 13)."""
        parts = np.split(states_of_joint(self.machine.coin.body, motions), (3, 6, 10), axis=1)
        x, v, e, w = (part.copy() for part in parts)
        return States(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)

    def floor_force(self, times: Array) -> Array:
        """Return the floor's force at `times` in sustained contacts, space frame, (n, 3) [N].

        It is MuJoCo's at the knots, and interpolated between them.
        """
        steps = self.knots[:, STEP]
        first = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        # At its very end a contact still holds the coin.
        first = np.where(steps[first] == Step.CONTACT, first, first - 1)
        second = np.where(steps[first + 1] == Step.CONTACT, first + 1, first)
        at = {number: self._knot_force(number) for number in np.union1d(first, second)}
        start, end = self.knots[first, TIME], self.knots[first + 1, TIME]
        part = ((times - start) / (end - start))[:, None]
        forces = (1 - part) * np.array([at[k] for k in first]) + part * np.array([at[k] for k in second])
        return forces * self.machine.mass_unit

    def _knot_force(self, number: int) -> tuple[float, float, float]:
        """Return the floor's force in the step that starts at a knot; 0 where that is none of a contact."""
        if self.knots[number, STEP] != Step.CONTACT:
            return 0.0, 0.0, 0.0
        coin = self.machine.coin
        set_motion(coin, self.knots[number, MOTION])
        return floor_force(coin, self.restitution, self.knots[number + 1, TIME] - self.knots[number, TIME])


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
    if knot[1] == Step.CONTACT.value:
        rates, still = np.empty((2, 13)), np.zeros(6)
        write_rate(start, still, rates[0])
        write_rate(end, still, rates[1])
        for i in range(7):
            rise = end[i] - start[i]
            bend = (1 - part) * (length * rates[0, i] - rise) - part * (length * rates[1, i] - rise)
            motion[i] += part * (1 - part) * bend
    normalise(motion)


@compiled
def _in_contact(knots: Array) -> tuple[Array, Array]:
    """Return times, (n,), and qpos and qvel then, (n, 13), at and between the knots of sustained contacts."""
    times, motions = np.empty(3 * len(knots)), np.empty((3 * len(knots), 13))
    n = 0
    for i in range(len(knots) - 1):
        if knots[i, 1] != Step.CONTACT.value:
            continue
        start, end = knots[i, 0], knots[i + 1, 0]
        times[n], times[n + 1], times[n + 2] = start, (start + end) / 2, end
        motions[n], motions[n + 2] = knots[i, 2:], knots[i + 1, 2:]
        write_between(knots[i], knots[i + 1], times[n + 1], motions[n + 1])
        n += 3
    return times[:n], motions[:n]
