"""How many tosses ended."""

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from models.records import Array


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcomes:
    """How many tosses of one coin ended, one row each; arrays are read-only."""

    outcome: NDArray[np.int8]
    """`Outcome`, (n,)."""
    ending: NDArray[np.int8]
    """`Ending`, (n,)."""
    impacts: NDArray[np.int32]
    """Number of impacts, (n,)."""
    last_face: NDArray[np.int8]
    """The `Face` up at the last touch, (n,); 0 where there was none."""
    end_time: Array
    """When the toss stopped, (n,) [s]."""

    def __post_init__(self) -> None:
        """Check the shapes and make the arrays read-only."""
        expected = (len(self.outcome),)
        for item in fields(self):
            array = getattr(self, item.name)
            if array.shape != expected:
                raise ValueError(f"Outcomes.{item.name}: shape {array.shape}, expected {expected}")
            array.setflags(write=False)

    def __len__(self) -> int:
        """Return the number of tosses."""
        return len(self.outcome)

    def after(self, impacts: int) -> NDArray[np.int8]:
        """Return the face at the touch after so many impacts, the outcome where the toss ended before, (n,).

        Args:
            impacts: 0 for the first touch. The tosses must have been made with one more as `max_impacts`,
                so that none goes on after that touch.

        Raises:
            ValueError: if a toss went on.
        """
        most = int(self.impacts.max(initial=0))
        if most > impacts + 1:
            raise ValueError(
                f"impacts: {impacts}, but a toss has {most}; accepted: tosses of at most {impacts + 1}, "
                f"so set ending.max_impacts = {impacts + 1}"
            )
        return np.where(self.impacts == impacts + 1, self.last_face, self.outcome)
