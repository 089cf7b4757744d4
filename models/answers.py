"""The results of many tosses: how each ended, as arrays of codes and numbers."""

from collections import namedtuple
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.arrays import Array, Row
from cointoss.models.kernel.compiled import compiled
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Ending, Face, Outcome
from cointoss.models.resting_place import RestReason
from cointoss.models.rows import NOT_TOSSED as NOT_TOSSED
from cointoss.models.rows import REFUSED as REFUSED

Trust = Literal["impacts", "certain"]
"""What `trust` asks for: the number of trusted impacts, or also whether the outcome is certain."""
ANSWER = ("outcome", "ending", "impacts", "last_face", "end_time", "trusted_impacts", "outcome_certain")
"""The columns of the results that compiled code writes; -1 in a column that was not asked for."""
ANSWER_AT = namedtuple("AnswerPlaces", ANSWER)(*range(len(ANSWER)))
"""The place of each column by its name, as compiled code reads it."""
_LAST_OF = {None: "end_time", "impacts": "trusted_impacts", "certain": "outcome_certain"}
"""The last column that tosses with a `trust` have."""
_MISSING = {NOT_TOSSED: "not_tossed", REFUSED: "refused"}


@dataclass(frozen=True, kw_only=True)
class AnswerColumn:
    """A column of the results: its type, and its attributes in a dataset."""

    kind: type[np.generic]
    attributes: dict[str, Any]
    words: dict[int, str] | None = None
    """The meaning of each code; None for a column of numbers."""
    missing: float = NOT_TOSSED
    """The value in a row whose toss was not made."""


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
    "rest_reason": _worded("whether the coin comes to rest, or why not", RestReason.by_value()),
    **{
        name: AnswerColumn(kind=np.float64, attributes={"long_name": told, "units": unit}, missing=np.nan)
        for name, told, unit in (
            ("rest_time", "time of rest", "s"),
            ("rest_x", "x of the coin's centre at rest", "m"),
            ("rest_y", "y of the coin's centre at rest", "m"),
            ("rest_heading", "heading at rest", "rad"),
            ("rest_path", "length of the path from the first touch to rest", "m"),
            ("rest_error", "estimated error of a place on the rim at rest", "m"),
        )
    },
}
"""The columns of the results by name, in the order of `ANSWER` and of `REST`."""


def names_of(trust: Trust | None) -> tuple[str, ...]:
    """Return the names of the columns that tosses with this `trust` have."""
    return ANSWER[: ANSWER.index(_LAST_OF[trust]) + 1]


class Answers(NamedTuple):
    """How tosses ended, one entry each."""

    outcome: NDArray[np.int8]
    """`Outcome`, or `NOT_TOSSED` or `REFUSED`, (n,)."""
    ending: NDArray[np.int8]
    """`Ending`, or `NOT_TOSSED` or `REFUSED`, (n,)."""
    impacts: NDArray[np.int32]
    """Number of impacts, (n,)."""
    last_face: NDArray[np.int8]
    """The `Face` up at the last touch, (n,); 0 where there was none."""
    end_time: Array
    """The time at which the toss stopped, (n,) [s]; NaN where no toss was made."""
    trusted_impacts: NDArray[np.int32] | None = None
    """The number of leading impacts that can be trusted, (n,); None if not asked for."""
    outcome_certain: NDArray[np.int8] | None = None
    """1 if the engine's own errors can't change the outcome, else 0, (n,); None if not asked for."""

    @classmethod
    def of_table(cls, table: Array, trust: Trust | None = None) -> "Answers":
        """Return the results that compiled code wrote into a table, (n, 7), in the order of `ANSWER`."""
        columns: Any = (table[:, i].astype(COLUMNS[name].kind) for i, name in enumerate(names_of(trust)))
        found = cls(*columns)
        found.end_time[found.outcome < 0] = np.nan
        return found

    def after(self, impacts: int) -> NDArray[np.int8]:
        """Return the face at the touch after n impacts, the outcome where the toss ended before, (n,).

        Args:
            impacts: n; 0 for the first touch. The tosses must have n + 1 as `max_impacts`, so that all
                stop at that touch.

        Raises:
            ValueError: if a toss has more impacts than n + 1.
        """
        most = int(self.impacts.max(initial=0))
        if most > impacts + 1:
            raise ValueError(
                f"impacts: {impacts}, but a toss has {most}; accepted: tosses of at most {impacts + 1}, "
                f"so set ending.max_impacts = {impacts + 1}"
            )
        return np.where(self.impacts == impacts + 1, self.last_face, self.outcome)


def unanswered(n: int, table: Array | None = None) -> Array:
    """Return the table for the results of n tosses that are not made yet, (n, 7).

    Args:
        n: number of tosses.
        table: the table to use, by default a new one.

    Raises:
        ValueError: for a table of another shape or kind, naming its shape and what is accepted.
    """
    shape = (n, len(ANSWER))
    found = np.empty(shape) if table is None else table
    if found.shape != shape or found.dtype != float or not found.flags.c_contiguous:
        raise ValueError(f"answers: shape {found.shape}, accepted: floats, {shape}, row by row")
    found[:] = NOT_TOSSED
    return found


@compiled
def write_end(
    outcome: Outcome, ending: Ending, impacts: int, last_face: int, end_time: float, answer: Row
) -> None:
    """Write how a toss ended; its outcome comes last, so that a row that has one is complete.

    Args:
        outcome: of the toss.
        ending: of the toss.
        impacts: their number.
        last_face: up at the last of them, 0 where there was none.
        end_time: when the toss stopped [s].
        answer: where it goes, (7,).
    """
    answer[ANSWER_AT.ending] = ending.value
    answer[ANSWER_AT.impacts] = impacts
    answer[ANSWER_AT.last_face] = last_face
    answer[ANSWER_AT.end_time] = end_time
    answer[ANSWER_AT.outcome] = outcome.value


def tally(outcomes: NDArray[np.integer]) -> NDArray[np.int64]:
    """Return the count of each outcome, by the code of `Outcome`, (6,)."""
    return np.bincount(outcomes.ravel(), minlength=len(Outcome))
