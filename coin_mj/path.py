"""The path of a toss in MuJoCo, stepped again where it is asked for."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cointoss.coin_mj.entries import knot_forces, sample_path
from cointoss.coin_mj.model.machine import Machine
from cointoss.coin_mj.steps.knots import StepKind
from cointoss.models.certificate import Changes
from cointoss.models.entries import states_of_joint
from cointoss.models.records import Array, States

TIME, STEP, MOTION = 0, 1, slice(2, 15)
"""Columns of a knot."""
PARTS = 16
"""The number of parts in which a contact is measured."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Knots:
    """The path of a toss: the states before all steps.

    In flight they are stepped again by MuJoCo to the times asked for; in contact they are interpolated:
    those of an impact are less than a hundredth of a microsecond apart, those of a sustained contact less
    than a small turn of the coin. There the position and the attitude are cubic between two knots.
    """

    machine: Machine
    knots: Array
    """Time [s], the `StepKind` that starts there, qpos and qvel, (n, 15)."""
    restitution: float
    """χ of the floor, see `contact_restitution`."""

    def sample(self, times: Array) -> States:
        """Return the states at `times` [s], in the order of `times`; at an impact, that at first touch."""
        before = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        rows = sample_path(self.machine.coin, self.knots, before.astype(np.int32), times)
        return States.from_rows(times, rows)

    def contact_states(self) -> tuple[States, States, States]:
        """Return the states at the start, midway and at the end of each step of the sustained contacts."""
        first = np.flatnonzero(self.knots[:, STEP] == StepKind.CONTACT)
        midway = (self.knots[first, TIME] + self.knots[first + 1, TIME]) / 2
        return self._at(first), self.sample(midway), self._at(first + 1)

    def landings(self) -> Changes:
        """Return the states before and after the landings of a second rim in sustained contacts."""
        first = np.flatnonzero(self.knots[:, STEP] == StepKind.LANDING)
        return Changes(self._at(first), self._at(first + 1))

    def stretches(self, contacts: Array) -> Changes:
        """Return the states at start and end of `PARTS` parts of contacts, which lie at knots.

        Args:
            contacts: start and end of each, (n, 2) [s].
        """
        start, end = np.searchsorted(self.knots[:, TIME], contacts.T)
        numbers = np.linspace(start, end, PARTS + 1).astype(int)
        return Changes(self._at(numbers[:-1].ravel()), self._at(numbers[1:].ravel()))

    def _at(self, numbers: NDArray[np.intp]) -> States:
        """Return the states at knots, of which `numbers` are the numbers."""
        knots = self.knots[numbers]
        rows = states_of_joint(self.machine.coin.body, knots[:, MOTION].copy())
        return States.from_rows(knots[:, TIME], rows)

    def floor_force(self, times: Array) -> Array:
        """Return the floor's force at `times` in sustained contacts, space frame, (n, 3) [N].

        It is MuJoCo's at the knots, and interpolated between them.
        """
        steps = self.knots[:, STEP]
        first = np.searchsorted(self.knots[:, TIME], times, side="right") - 1
        # At its very end a contact still holds the coin.
        first = np.where(steps[first] == StepKind.CONTACT, first, first - 1)
        second = np.where(steps[first + 1] == StepKind.CONTACT, first + 1, first)
        numbers, places = np.unique(np.stack([first, second]), return_inverse=True)
        forces = knot_forces(self.machine.coin, self.restitution, self.knots, numbers.astype(np.int32))
        at_first, at_second = forces[places.reshape(2, -1)]
        start, end = self.knots[first, TIME], self.knots[first + 1, TIME]
        part = ((times - start) / (end - start))[:, None]
        return ((1 - part) * at_first + part * at_second) * self.machine.mass_unit
