"""What many tosses answer: how each ended, as arrays of codes and numbers."""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.arrays import Array
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Ending, Face, Outcome
from cointoss.models.rows import NOT_TOSSED as NOT_TOSSED
from cointoss.models.rows import REFUSED as REFUSED

Trust = Literal["impacts", "certain"]
"""How many impacts of a toss can be trusted; or that, and whether its outcome is certain."""
ANSWER = ("outcome", "ending", "impacts", "last_face", "end_time", "trusted_impacts", "outcome_certain")
"""Columns of what compiled code answers of a toss; -1 where that was not asked for."""
_MISSING = {NOT_TOSSED: "not_tossed", REFUSED: "refused"}


@dataclass(frozen=True, kw_only=True)
class AnswerColumn:
    """What one of the answers is: its type, and its attributes in a dataset."""

    kind: type[np.generic]
    attributes: dict[str, Any]
    words: dict[int, str] | None = None
    """What its codes mean; None for numbers."""
    missing: float = NOT_TOSSED
    """What it holds where no toss was made."""


def _worded(name: str, words: dict[int, str]) -> AnswerColumn:
    known = _MISSING | words
    return AnswerColumn(kind=np.int8, attributes={"long_name": name, **meanings_of(known)}, words=known)


COLUMNS = {
    "outcome": _worded("outcome", Outcome.by_value()),
    "ending": _worded("ending", Ending.by_value()),
    "impacts": AnswerColumn(kind=np.int32, attributes={"long_name": "number of impacts"}),
    "last_face": _worded("face up at the last touch", {0: "none", **Face.by_value()}),
    "end_time": AnswerColumn(
        kind=np.float64, attributes={"long_name": "time of the end", "units": "s"}, missing=np.nan
    ),
    "trusted_impacts": AnswerColumn(kind=np.int32, attributes={"long_name": "number of trusted impacts"}),
    "outcome_certain": AnswerColumn(
        kind=np.int8, attributes={"long_name": "whether the engine's own errors can't change the outcome"}
    ),
}
"""Of the answers, by name, in the order of `ANSWER`."""


def names_of(trust: Trust | None) -> tuple[str, ...]:
    """Return the names of the answers that there are where this is asked for."""
    return ANSWER[: {None: 5, "impacts": 6, "certain": 7}[trust]]


class Answers(NamedTuple):
    """How tosses ended, one entry each."""

    outcome: NDArray[np.int8]
    """`Outcome`, or `NOT_TOSSED` or `REFUSED`, (n,)."""
    ending: NDArray[np.int8]
    """`Ending`, or likewise, (n,)."""
    impacts: NDArray[np.int32]
    """Number of impacts, (n,)."""
    last_face: NDArray[np.int8]
    """The `Face` up at the last touch, (n,); 0 where there was none."""
    end_time: Array
    """When the toss stopped, (n,) [s]; NaN where there is none."""
    trusted_impacts: NDArray[np.int32] | None = None
    """How many of the leading impacts can be trusted, (n,); None where that was not asked for."""
    outcome_certain: NDArray[np.int8] | None = None
    """1 where the engine's own errors can't change the outcome, else 0, (n,); None where not asked for."""

    @classmethod
    def of_table(cls, table: Array, trust: Trust | None = None) -> "Answers":
        """Return the answers that compiled code wrote into a table, (n, 7), in the order of `ANSWER`."""
        columns: Any = (table[:, i].astype(COLUMNS[name].kind) for i, name in enumerate(names_of(trust)))
        found = cls(*columns)
        found.end_time[found.outcome < 0] = np.nan
        return found

    def after(self, impacts: int) -> NDArray[np.int8]:
        """Return the face at the touch after n impacts, the outcome where the toss ended before, (n,).

        Args:
            impacts: n; 0 for the first touch. The tosses must have been made with n + 1 as `max_impacts`, so
                that none goes on after that touch.

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


def unanswered(n: int, table: Array | None = None) -> Array:
    """Return the table in which compiled code writes the answers of n tosses, (n, 7), none of them made yet.

    Args:
        n: number of tosses.
        table: that is used, by default a new one.

    Raises:
        ValueError: for a table of another shape or kind, naming its shape and what is accepted.
    """
    shape = (n, len(ANSWER))
    found = np.empty(shape) if table is None else table
    if found.shape != shape or found.dtype != float or not found.flags.c_contiguous:
        raise ValueError(f"answers: shape {found.shape}, accepted: floats, {shape}, row by row")
    found[:] = NOT_TOSSED
    return found


def tally(outcomes: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return how many of some outcomes there are of each, by the code of `Outcome`, (6,)."""
    return np.bincount(outcomes.ravel(), minlength=len(Outcome))
