"""How often coins that people tossed showed the side that had been up at the release."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.models.errors import shown

MOST_PEOPLE = 1000
MOST_FLIPS = 1_000_000
"""The most flips of one person; the quadrature over people would need too many nodes for more."""


@dataclass(frozen=True, init=False, eq=False)
class Flips:
    """How often each person's coin showed the side that had been up at its release; arrays are read-only.

    Flips(same=[5_130, 260], flips=[10_000, 500])
    """

    same: NDArray[np.int64]
    """Flips of each person with that side up, (n,)."""
    flips: NDArray[np.int64]
    """All flips of each person, (n,)."""
    people: tuple[str, ...]
    """What each person, or series, is called; by default they are numbered from 1."""

    def __init__(self, *, same: ArrayLike, flips: ArrayLike, people: tuple[str, ...] = ()) -> None:
        """Check the counts.

        Raises:
            ObservationError: naming the argument, its value and what is accepted.
        """
        most = _counts("flips", flips, MOST_FLIPS)
        if not most.sum():
            raise ObservationError("no flips; accepted: at least one")
        names = tuple(map(str, people)) or tuple(str(n + 1) for n in range(len(most)))
        if len(names) != len(most):
            raise ObservationError(f"Flips.people: {len(names)} names, accepted: {len(most)}, one a person")
        for name, value in (("same", _counts("same", same, most)), ("flips", most), ("people", names)):
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        """Return how many there are."""
        return f"<Flips: {self.same.sum()} of {self.flips.sum()} by {len(self.flips)} people>"


def _counts(name: str, given: ArrayLike, most: int | NDArray[np.int64]) -> NDArray[np.int64]:
    """Return an argument's whole numbers, of each person at most so many; refuse what has none."""
    try:
        values = np.array(given, dtype=float)
    except (TypeError, ValueError):
        accepted = "whole numbers from 0, one for each person"
        raise ObservationError(f"Flips.{name}: {shown(given)}, accepted: {accepted}") from None
    if values.ndim != 1 or np.shape(most) not in ((), values.shape) or len(values) > MOST_PEOPLE:
        accepted = f"one of flips and of same for each of at most {MOST_PEOPLE} people"
        raise ObservationError(f"Flips.{name}: shape {values.shape}, accepted: {accepted}")
    limits = np.broadcast_to(most, values.shape)
    if (bad := ~((values % 1 == 0) & (values >= 0) & (values <= limits))).any():
        i = int(np.argmax(bad))
        raise ValueRefusedError(name, i, f"{values[i]:g}", f"a whole number from 0 to {limits[i]}", "Flips")
    kept = values.astype(np.int64)
    kept.setflags(write=False)
    return kept
