"""The tosses of a batch, made in pieces of about a second on all cores."""

import time
import warnings
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.sweep.batch import Batch
from cointoss.models.answers import ANSWER, REFUSED, Answers, Trust, names_of
from cointoss.models.batch import refused

FIRST, GROWTH, SECOND = 64, 8, 1.0
"""Tosses of the first piece; how many times as many the next may have; and the time of one [s]."""
MOST = 1 << 17
"""Tosses of a piece, whose rows take 50 MB."""


@dataclass(frozen=True, kw_only=True)
class How:
    """How a batch is tossed."""

    engine: Engine
    settings: Any
    """Of the engine."""
    trust: Trust | None = None
    law: Any = None
    """A `cointoss.OwnLaw` in place of the scenarios' laws."""
    workers: int | None = None
    """Number of threads; by default one for each core."""
    keeps: bool = False
    """Whether a row that is no scenario is answered as such; else no row is looked at again."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the answers."""
        return names_of(self.trust)


def require_supported(batch: Batch, how: How) -> None:
    """Refuse a batch that can't be tossed so, before its first toss.

    Raises:
        ScenarioError, UnsupportedError: naming field, value and what is accepted.
    """
    for tosses in batch.tried():
        rows = batch.rows(tosses)
        if how.keeps:
            rows = rows[~refused(rows, batch.fields)]
        how.engine.package.require_rows(rows, settings=how.settings, law=how.law, trust=how.trust)


def pieces(
    batch: Batch, how: How, parts: Iterable[NDArray[np.intp]] | None = None
) -> Iterator[tuple[NDArray[np.intp], Answers]]:
    """Toss some of a batch, and yield the numbers of the tosses of each piece, and their answers.

    What a toss costs is known from the piece before: some cost a thousand times what others do. Ctrl-C yields
    what is made of its piece before it is raised.

    Args:
        batch: checked.
        how: it is tossed.
        parts: numbers of tosses, each of which is cut into pieces; by default those of all.
    """
    size = FIRST
    for part in whole(len(batch)) if parts is None else parts:
        done = 0
        while done < len(part):
            piece, start = part[done : done + size], time.perf_counter()
            for answers in _tossed(batch, how, piece):
                yield piece, answers
            done += len(piece)
            seconds = max(time.perf_counter() - start, 1e-9)
            if len(piece) == size or seconds > SECOND:
                size = min(max(1, int(len(piece) * min(GROWTH, SECOND / seconds))), MOST)


def whole(count: int) -> Iterator[NDArray[np.intp]]:
    """Yield the numbers from 0 up to a count, in parts of at most `MOST`."""
    for first in range(0, count, MOST):
        yield np.arange(first, min(first + MOST, count))


def _tossed(batch: Batch, how: How, piece: NDArray[np.intp]) -> Iterator[Answers]:
    """Yield the answers of a piece; and where Ctrl-C came meanwhile, raise it after them."""
    rows = batch.rows(piece)
    table, kept = np.full((len(rows), len(ANSWER)), float(REFUSED)), np.ones(len(rows), dtype=bool)
    if how.keeps:
        kept = ~refused(rows, batch.fields)
    made = np.empty((int(kept.sum()), len(ANSWER)))
    interruption = None
    try:
        how.engine.package.toss_rows(
            rows if kept.all() else rows[kept],
            settings=how.settings,
            trust=how.trust,
            law=how.law,
            workers=how.workers,
            answers=made,
        )
    except KeyboardInterrupt as error:
        interruption = error
    table[kept] = made
    yield Answers.of_table(table, how.trust)
    if interruption is not None:
        raise interruption


def warn_of_interruption(made: int, count: int) -> None:
    """Warn that Ctrl-C left some tosses of a batch unmade."""
    warnings.warn(
        f"interrupted: {made:,} of {count:,} tosses were made; the others are not_tossed", stacklevel=4
    )
