"""Counts of flips, read from a table with a row for each person or series, or from a row of sides."""

import re
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.fitting.cells import (
    BEFORE_HEADER,
    columns_of,
    read_cells,
    require_whole_rows,
    warn_of_unused_columns,
)
from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.compare.flips.counts import Flips
from cointoss.compare.flips.sides import Sides
from cointoss.compare.output.language import listed

NAMES = {
    "person": ("person", "participant", "subject", "series", "name", "id", "flipper", "tosser"),
    "same": ("same", "same side", "sameside"),
    "other": ("other", "other side", "different", "different side", "opposite", "opposite side", "not same"),
    "flips": ("flips", "n", "tosses", "throws", "trials", "total"),
    "heads": ("heads", "head"),
    "tails": ("tails", "tail"),
    "start": ("start", "started", "start side", "starting side", "first", "first side", "up", "up first"),
    "edge": ("edge", "edges"),
}
"""Columns: the names accepted, in any case, with spaces, underscores or hyphens."""
PAIRS = ("heads to heads", "heads to tails", "tails to tails", "tails to heads")
"""Columns of flips by the side up at the release and the side up in the end."""
ACCEPTED = (
    "same and flips; same and other; heads_to_heads, heads_to_tails, tails_to_tails and tails_to_heads; or "
    "start, heads and tails; and perhaps person"
)
ONE_SIDE = "; without the side at the release heads and tails, or a row of sides, as HTTH or 0110 (1: heads)"
_PAIR = re.compile(r"(h|t)(?:eads?|ails?)? ?(?:to|>|→)? ?(h|t)(?:eads?|ails?)?")
_AROUND = re.compile(r"^(?:n|number of|count of) (?=.)|(?<=.) (?:n|counts?)$")
_COUNT = re.compile(r"\+?\d{1,15}(e\+?0?\d)?", re.IGNORECASE)
"""A whole number; one with a point or a comma, which may stand between thousands, is none."""
_ROW_OF_SIDES = re.compile(r"[ht\s]+|[01\s]+", re.IGNORECASE)
_SIDES = {"h": "heads", "t": "tails"}
_COUNTED = {"same", "other", "flips", "heads", "tails", "edge", *PAIRS}


def key_of(name: str) -> str | None:
    """Return which of `NAMES` or `PAIRS` a column is; None for another."""
    plain = " ".join(re.split(r"[_\-.\s]+", re.sub(r"[(\[].*", "", name.lower()).strip()))
    plain = _AROUND.sub("", plain)
    if pair := _PAIR.fullmatch(plain):
        return f"{_SIDES[pair[1]]} to {_SIDES[pair[2]]}"
    return next((key for key, names in NAMES.items() if plain in names), None)


class Table(NamedTuple):
    """The counts of a file."""

    flips: Flips | None
    """By the side that was up at the release; None where none is known."""
    sides: dict[str, Sides]
    """Of each person, or series, by the side in the end; empty where none is known."""


def read_flips(path: str | PathLike[str]) -> Flips:
    """Return the counts of a file by the side that was up at the release; see `read_table`.

    Raises:
        ObservationError: also for a file that does not have that side.
    """
    if (found := read_table(path).flips) is None:
        raise ObservationError(f"{path}: the side at the release is not known; accepted: {ACCEPTED}")
    return found


def read_table(path: str | PathLike[str]) -> Table:
    """Return the counts of a CSV file; rows with one person's name are added up.

    Args:
        path: of the file, with commas, semicolons or tabs between its cells, and # before a comment; or with
            nothing but the sides of one coin's flips.

    Raises:
        ObservationError: naming file, column, value and what is accepted.

    Warns:
        UnusedFieldWarning: for columns that are not used.
    """
    rows = read_cells(Path(path))
    row_of_sides = "".join(map("".join, rows))
    try:
        if _ROW_OF_SIDES.fullmatch(row_of_sides):
            heads, tails = (sum(map(row_of_sides.lower().count, names)) for names in ("h1", "t0"))
            return Table(None, {"1": Sides(heads=heads, tails=tails)})
        for at, row in enumerate(rows[:BEFORE_HEADER]):
            if sum(key_of(name) in _COUNTED for name in row) > 1:
                return _table(row, rows[at + 1 :])
        raise ObservationError(f"no columns of counts; accepted: {ACCEPTED}{ONE_SIDE}")
    except ObservationError as error:
        raise ObservationError(f"{path}: {error}") from None


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return the counts of a table's rows, below the names of its columns."""
    columns = _columns(head)
    way = _way_of_counting(columns, head)
    used = {key: columns[key] for key in (*way, "person") if key in columns}
    warn_of_unused_columns([name for i, name in enumerate(head) if i not in used.values()])
    if not rows:
        raise ObservationError("no rows; accepted: one or more, each a person or a series")
    require_whole_rows(rows, 1 + max(used.values()), len(head))
    sums: dict[str, NDArray[np.int64]] = {}
    for n, row in enumerate(rows, start=1):
        person = row[columns["person"]] if "person" in columns else str(n)
        counts = _counts({key: (head[columns[key]], row[columns[key]]) for key in way}, n)
        sums[person] = sums.get(person, 0) + np.array(counts)
    counted = {
        who: Sides(heads=int(heads), tails=int(all_ - heads))
        for who, (*_, heads, all_) in sums.items()
        if all_
    }
    by_start = {who: (same, flips) for who, (same, flips, *_) in sums.items() if flips or who not in counted}
    if not by_start:
        return Table(None, counted)
    same, flips = np.transpose(list(by_start.values()))
    try:
        return Table(Flips(same=same, flips=flips, people=tuple(by_start)), counted)
    except ValueRefusedError as error:
        who = f"flips of {tuple(by_start)[error.index]}"
        raise ObservationError(f"{who}: {error.value}, accepted: {error.accepted}") from None


def _columns(head: Sequence[str]) -> dict[str, int]:
    """Return what each column is; refuse two for one thing, and columns that count no sides."""
    keys = [key_of(name) for name in head]
    if "edge" in keys:
        accepted = "none, and flips without those on the edge, which cointoss shares --vary counts"
        raise ObservationError(f"column {head[keys.index('edge')]}: accepted: {accepted}")
    return columns_of(keys, head)


def _way_of_counting(columns: Mapping[str, int], head: Sequence[str]) -> tuple[str, ...]:
    """Return the columns that say how often a side came up."""
    sides, faces = (
        tuple(key for key in keys if key in columns)
        for keys in (("same", "other", "flips"), ("start", "heads", "tails", "flips"))
    )
    pairs = [key for key in PAIRS if key in columns]
    if pairs and {"same", "other"} & set(sides):
        named = listed(head[columns[key]] for key in (sides[0], pairs[0]))
        raise ObservationError(f"columns {named}; accepted: one way to count: {ACCEPTED}{ONE_SIDE}")
    by_end = not pairs and not {"same", "other"} & set(sides) and len({*faces} - {"start"}) > 1
    for way, is_so in ((sides, len(sides) > 1), (PAIRS, len(pairs) == len(PAIRS)), (faces, by_end)):
        if is_so:
            return way
    raise ObservationError(f"columns {', '.join(filter(None, head))}; accepted: {ACCEPTED}{ONE_SIDE}")


def _counts(cells: Mapping[str, tuple[str, str]], n: int) -> tuple[int, int, int, int]:
    """Return how often the same side came up, of how many flips, and heads, of how many; 0 of 0 if not known.

    Args:
        cells: name of the column and cell, by key.
        n: number of the row.
    """
    count = {key: _whole(*named, n) for key, named in cells.items() if key != "start"}
    if PAIRS[0] in count:
        heads, flips = count["heads to heads"] + count["tails to heads"], sum(count.values())
        return count["heads to heads"] + count["tails to tails"], flips, heads, flips
    first, other = ("same", "other") if {"same", "other"} & count.keys() else ("heads", "tails")
    flips = count.get("flips", count.get(first, 0) + count.get(other, 0))
    met = count.get(first, flips - count.get(other, 0))
    if not 0 <= met <= flips or met + count.get(other, flips - met) != flips:
        named = listed(f"{name} {cell}" for name, cell in cells.values())
        accepted = "no more than all flips, and in sum all flips"
        raise ObservationError(f"row {n}: {named}; accepted: {accepted}")
    if first == "same":
        return met, flips, 0, 0
    name, cell = cells.get("start", ("", "unknown"))
    known = {"heads": (met, flips), "tails": (flips - met, flips), "unknown": (0, 0)}
    if (side := _SIDES.get(cell.lower(), cell.lower())) not in known:
        accepted = "heads, tails, h or t, or unknown"
        raise ObservationError(f"column {name}: row {n} is {cell!r}, accepted: {accepted}")
    return *known[side], met, flips


def _whole(name: str, cell: str, n: int) -> int:
    """Return a count, from the name of its column, its cell, and the number of its row."""
    if not _COUNT.fullmatch(cell):
        accepted = "a whole number from 0, without a point or a comma"
        raise ObservationError(f"column {name}: row {n} is {cell!r}, accepted: {accepted}")
    return int(float(cell))
