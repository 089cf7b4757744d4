"""The tosses of a batch, made in pieces of about a second on all cores."""

import time
import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.margin import MANY, ReleaseQuantity, quantity_of, smallest_changes
from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.answers import (
    ANSWER,
    COLUMNS,
    NOT_TOSSED,
    REFUSED,
    AnswerColumn,
    Answers,
    Trust,
    names_of,
)
from cointoss.models.batch import PLACE, refused
from cointoss.models.devices import Device
from cointoss.models.errors import ScenarioError
from cointoss.models.processor import Processor
from cointoss.models.records import Array
from cointoss.models.resting_place import REST
from cointoss.models.stages import stage
from cointoss.models.unused import warn_of_unused_fields

FIRST, GROWTH, SECOND = 64, 8, 1.0
"""Tosses of the first piece; the factor by which the next may grow; and the time that a piece should take
[s]."""
MOST = 1 << 17
"""The most tosses of a piece: their rows take 50 MB."""
LEAST_ON_CARD, MOST_ON_CARD = 1 << 14, 1 << 20
"""The fewest and the most tosses of a piece on a card: fewer leave a part of the card idle; the rows of more
take over 400 MB."""
Columns = dict[str, NDArray[Any]]
"""Arrays by the names of answers, or of a map's layers."""


@dataclass(frozen=True, kw_only=True)
class How:
    """How a batch is tossed."""

    engine: Engine
    settings: Any
    """The settings of the engine."""
    trust: Trust | None = None
    law: Any = None
    """A `cointoss.OwnLaw` in place of the scenarios' laws."""
    workers: int | None = None
    """Number of threads; by default one for each core."""
    keeps: bool = False
    """Whether a row that is no scenario gets the answer "refused"; else the rows are not checked again."""
    rest: bool = False
    """Whether to find where each coin comes to rest."""
    processor: Processor = field(default_factory=Processor, compare=False)
    """What tosses, and counts what a card tossed."""
    after: int | None = None
    """Each toss stops at the touch after this number of impacts, and the face there is its outcome; None for
    the final outcome."""
    margin: str | None = None
    """The full name of the quantity of the release along which each toss has its margin, if any."""

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the answers."""
        return names_of(self.trust) + (REST if self.rest else ())

    @property
    def quantity(self) -> ReleaseQuantity:
        """The quantity along which each toss has its margin, where one is asked for."""
        return quantity_of(self.margin or "")


def check(batch: Batch, how: How) -> None:
    """Refuse a batch with a toss that is no scenario, unless those are kept, or that its engine can't make.

    The errors and warnings are those of `require_scenarios` and `require_supported`.
    """
    if not how.keeps:
        require_scenarios(batch)
    require_supported(batch, how)


def check_map(batch: Batch, how: How) -> None:
    """Refuse a map as `check` does its tosses.

    Raises:
        SweepError: for a pixel that is no scenario, naming field, value, and what is accepted.
    """
    try:
        require_scenarios(batch)
    except ScenarioError as error:
        raise SweepError(str(error)) from None
    require_supported(batch, how)


def require_scenarios(batch: Batch) -> None:
    """Refuse a batch with a toss that is no scenario, before the first one.

    Raises:
        ScenarioError: naming field, value, and what is accepted.

    Warns:
        UnusedFieldWarning: for a field that nothing uses.
    """
    batch.check()
    if not any(one.words for one in batch.varied):  # which may use a field each
        largest = batch.largest()
        warn_of_unused_fields(largest.floor, largest.air)


def require_supported(batch: Batch, how: How) -> None:
    """Refuse a batch that can't be tossed so, before its first toss.

    Raises:
        ScenarioError, UnsupportedError, DeviceError: naming field, value and what is accepted.
    """
    for tosses in batch.tried():
        rows = batch.rows(tosses)
        rows = rows[~refused(rows, batch.fields)] if how.keeps else rows
        how.engine.package.require_rows(
            rows, settings=how.settings, law=how.law, trust=how.trust, device=how.processor
        )


def gathered(
    batch: Batch, how: How, columns: Mapping[str, AnswerColumn], name: str, *, shown: bool | None = None
) -> Columns:
    """Return some answers of a batch, by name, over its dimensions; Ctrl-C leaves out the rest, and warns.

    Args:
        batch: checked.
        how: it is tossed.
        columns: that are kept, `outcome` among them.
        name: of the job, for who waits.
        shown: whether to show progress; None shows it in a terminal or a notebook.
    """
    arrays = {one: np.full(len(batch), column.missing, column.kind) for one, column in columns.items()}
    with stage(name, "tosses", total=len(batch), shown=shown) as progress:
        try:
            for tosses, found in pieces(batch, how):
                for one, array in arrays.items():
                    array[tosses] = found[one]
                progress(int(tosses[-1]) + 1, len(batch))
        except KeyboardInterrupt:
            warn_of_interruption(int(np.sum(arrays["outcome"] != NOT_TOSSED)), len(batch))
    return {one: array.reshape(batch.shape) for one, array in arrays.items()}


def pieces(
    batch: Batch, how: How, parts: Iterable[NDArray[np.intp]] | None = None
) -> Iterator[tuple[NDArray[np.intp], Columns]]:
    """Toss some of a batch, and yield the numbers of the tosses of each piece, and their answers by name.

    What a toss costs is known from the piece before: some cost a thousand times what others do. Ctrl-C yields
    what is made of its piece before it is raised.

    Args:
        batch: checked.
        how: it is tossed.
        parts: numbers of tosses, each of which is cut into pieces; by default those of all.
    """
    size, most = FIRST, MOST if how.processor.device is Device.CPU else MOST_ON_CARD
    how.processor.expect(len(batch))
    for part in whole(len(batch), most) if parts is None else parts:
        done = 0
        while done < len(part):
            piece, start = part[done : done + size], time.perf_counter()
            for answers in _tossed(batch, how, piece):
                yield piece, columns_of(batch, how, piece, answers)
            done += len(piece)
            seconds = max(time.perf_counter() - start, 1e-9)
            if len(piece) == size or seconds > SECOND:
                least = LEAST_ON_CARD if how.processor.is_card else 1
                size = min(max(least, int(len(piece) * min(GROWTH, SECOND / seconds))), most)


def whole(count: int, most: int = MOST) -> Iterator[NDArray[np.intp]]:
    """Yield the numbers from 0 up to a count, in parts of at most `most`."""
    for first in range(0, count, most):
        yield np.arange(first, min(first + most, count))


def toss_part(batch: Batch, how: How, numbers: NDArray[np.intp]) -> Columns:
    """Return what is known of some tosses, made at once, by name."""
    (answers,) = _tossed(batch, how, numbers)
    return columns_of(batch, how, numbers, answers)


def columns_of(batch: Batch, how: How, numbers: NDArray[np.intp], answers: Answers) -> Columns:
    """Return what is known of some tosses by name, (n,) each.

    Args:
        batch: that they are of.
        how: they were tossed.
        numbers: of the tosses.
        answers: of the engine.
    """
    found: Columns = {name: getattr(answers, name) for name in names_of(how.trust)}
    found["outcome"] = _shown(how, answers)
    if how.rest:
        found |= _rests(how, _rows(batch, how, numbers), answers.outcome)
    if how.margin is not None:
        found["margin"] = _margins(how, _rows(batch, how, numbers))
    return found


def _shown(how: How, answers: Answers) -> NDArray[np.int8]:
    """Return the outcomes, or the faces at a touch."""
    return answers.outcome if how.after is None else answers.after(how.after)


def _rests(how: How, rows: Array, outcomes: NDArray[np.int8]) -> Columns:
    """Return where coins come to rest, by name; of a toss that was not made the reason is its outcome."""
    table, made = np.full((len(rows), len(REST)), np.nan), outcomes >= 0
    table[:, 0] = outcomes
    table[made] = how.engine.package.rest_rows(
        rows[made],
        settings=how.settings,
        workers=how.workers,
        **({} if how.law is None else {"law": how.law}),
    )
    return {name: column.astype(COLUMNS[name].kind) for name, column in zip(REST, table.T, strict=True)}


def _margins(how: How, rows: Array) -> Array:
    def outcomes(changed: Array) -> NDArray[np.int8]:
        return _shown(how, how.engine.package.toss_rows(changed, settings=how.settings, device=how.processor))

    return how.quantity.factor * smallest_changes(rows, how.quantity, outcomes=outcomes, search=MANY)


def _rows(batch: Batch, how: How, numbers: NDArray[np.intp]) -> Array:
    """Return some tosses as rows, (n, m), each of which stops at the touch that is shown."""
    rows = batch.rows(numbers)
    if how.after is not None:
        most = rows[:, PLACE["ending.max_impacts"]]
        np.fmin(most, how.after + 1, out=most)  # NaN stands for no such number
    return rows


def _tossed(batch: Batch, how: How, piece: NDArray[np.intp]) -> Iterator[Answers]:
    """Yield the answers of a piece; and where Ctrl-C came meanwhile, raise it after them."""
    rows = _rows(batch, how, piece)
    table = np.full((len(rows), len(ANSWER)), float(REFUSED))
    kept = ~refused(rows, batch.fields) if how.keeps else np.ones(len(rows), dtype=bool)
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
            device=how.processor,
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
