"""The path of a toss in MuJoCo, stepped again where it is asked for."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from dataclasses import dataclass

import numpy as np

from coin_mj.model.air_callback import air_of
from coin_mj.model.machine import Machine, set_motion, state_of
from coin_mj.steps.free_step import glide
from models.records import Array, States

TIME, PRESSED, MOTION = 0, 1, slice(2, 15)
"""Columns of a knot."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps.

    In flight they are stepped again by MuJoCo to the times asked for; in contact they are interpolated: they
    stand closer than a hundredth of a microsecond in an impact, and than a small turn of the coin in a
    contact that lasts.
    """

    machine: Machine
    knots: Array
    """Time [s], whether the coin was in contact, qpos and qvel, (n, 15)."""

    def sample(self, times: Array) -> States:
        """Give the states at `times` [s], in the order of `times`; at an impact, that at first touch."""
        coin = self.machine.coin
        rows = np.empty((len(times), 13))
        before = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        with air_of(self.machine.model):
            for row, time, number in zip(rows, times, before, strict=True):
                knot = self.knots[number]
                set_motion(coin, knot[MOTION])
                if time > knot[TIME] and knot[PRESSED]:
                    after = self.knots[number + 1]
                    part = (time - knot[TIME]) / (after[TIME] - knot[TIME])
                    between = knot + part * (after - knot)
                    between[5:9] /= np.linalg.norm(between[5:9])
                    set_motion(coin, between[MOTION])
                elif time > knot[TIME]:
                    glide(coin, time - knot[TIME])
                row[:] = np.concatenate(state_of(coin))
        x, v, e, w = (part.copy() for part in np.split(rows, (3, 6, 10), axis=1))
        return States(time=times.copy(), position=x, velocity=v, quaternion=e, angular_velocity=w)
