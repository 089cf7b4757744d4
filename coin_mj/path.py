"""The path of a toss in MuJoCo, stepped again where it is asked for."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass

import numpy as np

from cointoss.coin_mj.model.air_callback import air_of
from cointoss.coin_mj.model.machine import Machine
from cointoss.coin_mj.model.state import set_motion, state_of
from cointoss.coin_mj.steps.free_step import free_step
from cointoss.coin_mj.steps.knots import Step
from cointoss.coin_mj.steps.sustained_contact import floor_force
from cointoss.models.records import Array, States

TIME, STEP, MOTION = 0, 1, slice(2, 15)
"""Columns of a knot."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps.

    In flight they are stepped again by MuJoCo to the times asked for; in contact they are interpolated:
    those of an impact are less than a hundredth of a microsecond apart, those of a sustained contact less
    than a small turn of the coin.
    """

    machine: Machine
    knots: Array
    """Time [s], the `Step` that starts there, qpos and qvel, (n, 15)."""
    restitution: float
    """χ of the floor."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s], in the order of `times`; at an impact, that at first touch."""
        coin = self.machine.coin
        rows = np.empty((len(times), 13))
        before = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        with air_of(self.machine.model):
            for row, time, number in zip(rows, times, before, strict=True):
                knot = self.knots[number]
                set_motion(coin, knot[MOTION])
                if time > knot[TIME] and knot[STEP] != Step.FLIGHT:
                    after = self.knots[number + 1]
                    part = (time - knot[TIME]) / (after[TIME] - knot[TIME])
                    between = knot + part * (after - knot)
                    between[5:9] /= np.linalg.norm(between[5:9])
                    set_motion(coin, between[MOTION])
                elif time > knot[TIME]:
                    free_step(coin, time - knot[TIME])
                row[:] = np.concatenate(state_of(coin)[:4])
        x, v, e, w = (part.copy() for part in np.split(rows, (3, 6, 10), axis=1))
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
        with air_of(self.machine.model):
            at = {number: self._knot_force(number) for number in np.union1d(first, second)}
        start, end = self.knots[first, TIME], self.knots[first + 1, TIME]
        part = ((times - start) / (end - start))[:, None]
        return (1 - part) * np.array([at[k] for k in first]) + part * np.array([at[k] for k in second])

    def _knot_force(self, number: int) -> tuple[float, float, float]:
        """Return the floor's force in the step that starts at a knot; 0 where that is none of a contact."""
        if self.knots[number, STEP] != Step.CONTACT:
            return 0.0, 0.0, 0.0
        coin = self.machine.coin
        set_motion(coin, self.knots[number, MOTION])
        return floor_force(coin, self.restitution, self.knots[number + 1, TIME] - self.knots[number, TIME])
