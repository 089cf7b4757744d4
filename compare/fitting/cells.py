"""The cells of a CSV file, as programs and people write them."""

import csv
import re
import warnings
from collections.abc import Sequence
from pathlib import Path

from cointoss.compare.fitting.errors import ObservationError
from cointoss.models.bounded import TooLargeError, read_bounded
from cointoss.models.unused import UnusedFieldWarning

LARGEST = 10_000_000
"""The most bytes of a file."""
BEFORE_HEADER = 5
"""Lines above that with the names; Tracker writes the name of the track there."""
_DECIMAL_COMMA = re.compile(r"^([-+]?\d+),(\d+(?:[eE][-+]?\d+)?)$")


def read_cells(path: Path) -> list[list[str]]:
    """Return the cells of a file that are neither empty lines nor comments.

    Raises:
        ObservationError: for what is no CSV file in UTF-8, naming it.
    """
    try:
        lines = read_bounded(path, LARGEST).decode("utf-8-sig").splitlines()
        lines = [line for line in lines if line.strip() and not line.startswith("#")]
        mark = max(";\t,", key=lambda mark: sum(line.count(mark) > 0 for line in lines[:BEFORE_HEADER]))
        rows = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=mark)]
    except (csv.Error, TooLargeError) as error:
        raise ObservationError(
            f"{path}: {error}; accepted: a CSV file of at most {LARGEST:,} bytes"
        ) from None
    except FileNotFoundError:
        raise ObservationError(f"{path}: no such file; accepted: a CSV file") from None
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "no text"
        raise ObservationError(f"{path}: can't be read ({reason}); accepted: a CSV file in UTF-8") from None
    return rows if mark == "," else [[_DECIMAL_COMMA.sub(r"\1.\2", cell) for cell in row] for row in rows]


def require_whole_rows(rows: Sequence[Sequence[str]], least: int, columns: int) -> None:
    """Refuse a table with a row that has too few cells, or any beyond its columns.

    Args:
        rows: below that with the names.
        least: cells that are needed.
        columns: how many there are.
    """
    for n, cells in enumerate(rows, start=1):
        if len(cells) < least or any(cells[columns:]):
            raise ObservationError(
                f"row {n} has {len(cells)} cells; accepted: {columns}, one for each column; "
                "decimal commas need semicolons or tabs between the cells"
            )


def columns_of(keys: Sequence[str | None], head: Sequence[str]) -> dict[str, int]:
    """Return the place of each column by its key; refuse two with one key.

    Args:
        keys: of the columns; None for one that is not used.
        head: their names.
    """
    found: dict[str, int] = {}
    for i, key in enumerate(keys):
        if key in found:
            raise ObservationError(f"columns {head[found[key]]} and {head[i]}; accepted: one of them")
        if key is not None:
            found[key] = i
    return found


def warn_of_unused_columns(names: Sequence[str]) -> None:
    """Warn of columns that are not used, those without a name aside."""
    if unused := [name for name in names if name]:
        what = "column" if len(unused) == 1 else "columns"
        warnings.warn(f"{what} {', '.join(unused)}: not used", UnusedFieldWarning, stacklevel=2)
