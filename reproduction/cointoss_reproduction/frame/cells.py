"""A study's cells over its axes, as one long table: a row has names on the axes, and the cell's results."""

import csv
import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from inspect import signature
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from cointoss.study import Estimate, Progress, read_bounded, write_text
from cointoss_reproduction.frame.files import MOST_BYTES, TABLE, folder_of
from cointoss_reproduction.frame.provenance import sources

Row = dict[str, Any]
"""A row of a table, by the names of its columns."""
Rows = Mapping[str, Any] | pd.DataFrame
"""A row of a table, or several as a table."""
Cell = Callable[..., Rows | Iterable[Rows] | None]
"""Computes the rows for one value of each axis, and for the sizes of the run that its arguments name."""
Axis = Sequence[Any] | Mapping[Any, Any]
"""The values of an axis, by names where they have some."""
_WORDS = {"": None, "True": True, "False": False}
ENDS = (" low", " high", " count", " counted")
"""Suffixes of column names: an estimate's interval, the size of its sample, and what the sample counts."""


@dataclass(frozen=True)
class Cells:
    """A cell and the axes that it is computed over."""

    cell: Cell
    axes: Mapping[str, Axis]

    def asked(self) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
        """Yield, for each combination of the axes, its names and its values."""
        named = [
            list(axis.items()) if isinstance(axis, Mapping) else [(value, value) for value in axis]
            for axis in self.axes.values()
        ]
        for chosen in product(*named):
            names, values = zip(*chosen, strict=True) if chosen else ((), ())
            yield dict(zip(self.axes, names, strict=True)), dict(zip(self.axes, values, strict=True))


def table_of(
    parts: Sequence[Cells], progress: Progress, sizes: Mapping[str, Any], *, kept: Path | None = None
) -> pd.DataFrame:
    """Return all cells' rows as one table.

    Args:
        parts: what is computed.
        progress: called after each cell.
        sizes: of the run; a cell is given those that it names.
        kept: folder with the cells of an earlier run, which are read; new cells are written there.

    Raises:
        ValueError: for a name that is both an axis and a column.
    """
    asked = [(part.cell, *each) for part in parts for each in part.asked()]
    rows: list[dict[str, Any]] = []
    for done, (cell, names, values) in enumerate(asked, start=1):
        own = {name: size for name, size in sizes.items() if name in signature(cell).parameters}
        where = None if kept is None else kept / f"{_key(cell, names, own)}.json"
        found = _read(where) if where is not None else None
        if found is None:
            found = [_flat(row) for row in _rows(cell(**values, **own))]
            if where is not None:
                where.parent.mkdir(parents=True, exist_ok=True)
                write_text(where, json.dumps(found))
        for row in found:
            if twice := row.keys() & names.keys():
                raise ValueError(f"{', '.join(sorted(twice))}: an axis and a column; accepted: one of them")
            rows.append({**names, **row})
        progress(done, len(asked))
    return _frame(rows)


def read_table(path: Path) -> pd.DataFrame:
    """Read a table that was written, to the bit.

    Raises:
        ValueError, OSError: where it is no table.
    """
    head, *rows = csv.reader(read_bounded(path, MOST_BYTES).decode().splitlines())
    return _frame([dict(zip(head, map(_value, row), strict=True)) for row in rows])


def kept_rows(study: str, out: Path | None, where: str) -> list[dict[Any, Any]]:
    """Return the table of another study in the folder of all results; empty if that study has not run.

    Args:
        study: its name.
        out: the folder, where there is one.
        where: which rows, as pandas' query has it.
    """
    if out is None or not (path := folder_of(study, out) / TABLE).exists():
        return []
    return read_table(path).query(where, engine="python").to_dict("records")


def column(cells: pd.DataFrame, name: str, where: str = "") -> NDArray[Any]:
    """Return a column of the rows that `where`, a pandas query, selects."""
    rows = cells.query(where, engine="python") if where else cells
    return np.array(rows[name].dropna().tolist())


def estimate(row: Mapping[str, Any], column: str) -> Any:
    """Return a row's value in a column, with its interval if it has one."""
    value = row[column]
    if f"{column}{ENDS[0]}" not in row or pd.isna(row[f"{column}{ENDS[-1]}"]):
        return value
    low, high, count, counted = (row[column + end] for end in ENDS)
    return Estimate(float(value), float(low), float(high), int(count), str(counted))


def _frame(rows: list[dict[str, Any]]) -> pd.DataFrame:
    """Return rows as a table in which counts stay whole numbers where some rows have none."""
    table = pd.DataFrame(rows)
    for name in table:
        there = [row[name] for row in rows if row.get(name) is not None]
        if all(isinstance(value, int) and not isinstance(value, bool) for value in there):
            table[name] = table[name].astype("int64" if len(there) == len(rows) else "Int64")
    return table


def _value(text: str) -> Any:
    if text in _WORDS:
        return _WORDS[text]
    for kind in (int, float):
        with suppress(ValueError):
            return kind(text)
    return text


def _rows(found: Rows | Iterable[Rows] | None) -> Iterator[Mapping[Any, Any]]:
    if found is None:
        return
    for part in [found] if isinstance(found, Mapping | pd.DataFrame) else found:
        yield from part.to_dict("records") if isinstance(part, pd.DataFrame) else [part]


def _flat(row: Mapping[str, Any]) -> dict[str, Any]:
    flat: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, Estimate):
            flat |= {name + end: each for end, each in zip(("", *ENDS), asdict(value).values(), strict=True)}
        else:
            flat[name] = value.item() if isinstance(value, np.generic) else value
    return flat


def _key(cell: Cell, names: Mapping[str, Any], sizes: Mapping[str, Any]) -> str:
    said = json.dumps([sources(), cell.__module__, cell.__qualname__, {**names}, {**sizes}], default=str)
    return hashlib.sha256(said.encode()).hexdigest()[:16]


def _read(path: Path) -> list[dict[str, Any]] | None:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
