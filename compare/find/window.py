"""What a search looks for, and where: the window of fields that vary, and what the tosses in it show."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.compare.find.faces import faces_shown
from cointoss.compare.find.sequence import sequence_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.window import Window
from cointoss.models.processor import Processor
from cointoss.models.records import Array, Face, Outcome

AT_FIRST = 4
"""Touches that are computed for every toss; then twice as many for the tosses that agree so far, and so
on."""


@dataclass(frozen=True, kw_only=True)
class Target:
    """What a toss is to show."""

    sequence: str = ""
    """Faces up at the first touches, as in "HTTH"."""
    outcome: Outcome | None = None
    processor: Processor = field(default_factory=Processor, compare=False)
    """What tosses until the outcome; the faces are always found by the CPU."""

    def __post_init__(self) -> None:
        """Check that it is something.

        Raises:
            SweepError: naming what is wrong and what is accepted.
            UnsupportedError: for the device "cuda" and no outcome.
        """
        try:
            sequence_of(self.sequence)
        except ValueError as error:
            raise SweepError(f"sequence: {self.sequence!r}, accepted: {error}") from None
        if not self.sequence and self.outcome is None:
            raise SweepError("sequence, outcome: none; accepted: one of them, or both")
        if self.outcome is None:
            self.processor.require_cpu("for a sequence without an outcome")

    @property
    def steps(self) -> int:
        """Touches and the outcome, each a step."""
        return len(self.sequence) + (self.outcome is not None)

    @property
    def in_words(self) -> str:
        """What is to be shown, for a person."""
        return ", ".join(filter(None, [self.sequence, "" if self.outcome is None else str(self.outcome)]))

    def shown(self, window: Window, points: Array, steps: int | None = None) -> NDArray[np.int64]:
        """Return how many leading steps the toss at each point shows, -1 where there is no toss, (n,).

        Args:
            window: where the points are.
            points: (n, fields).
            steps: to be looked at; by default all.
        """
        steps = self.steps if steps is None else steps
        rows, is_tossed = window.rows(window.values(points))
        shown, left = np.where(is_tossed, 0, -1), np.flatnonzero(is_tossed)
        touches, most = 0, min(steps, len(self.sequence))
        faces = np.array([Face.HEADS if one == "H" else Face.TAILS for one in self.sequence])
        while touches < most and len(left):
            # Of a long sequence few show the beginning: the others need not go on.
            touches = min(max(AT_FIRST, 2 * touches), most)
            agree = faces_shown(rows[left], touches) == faces[:touches]
            shown[left] = np.logical_and.accumulate(agree, axis=1).sum(axis=1)
            left = left[shown[left] == touches]
        if steps > len(self.sequence) and len(left):
            shown[left] += analytic.toss_rows(rows[left], device=self.processor).outcome == self.outcome
        return shown
