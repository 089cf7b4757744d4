"""Tables in Markdown, and as comma-separated values."""

import csv
import re
from collections.abc import Iterable, Sequence
from io import StringIO


def table(head: Sequence[str] | str, rows: Iterable[Sequence[str]], *, words: bool = False) -> str:
    """Return a table.

    Args:
        head: names of the columns, or all in one text, with bars between them.
        rows: cells, one for each column; a bar in a cell is escaped.
        words: whether the columns after the first are words; numbers stand at the right.
    """
    head = head.split(" | ") if isinstance(head, str) else head
    ruled = ["---", *(["---" if words else "---:"] * (len(head) - 1))]
    return "\n".join([_line(head), f"| {' | '.join(ruled)} |", *map(_line, rows)])


def sheet(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table as comma-separated values."""
    written = StringIO()
    csv.writer(written, lineterminator="\n").writerows([head, *rows])
    return written.getvalue()


def cells(line: str) -> list[str]:
    """Return the cells of a row of a table in Markdown."""
    return [cell.strip().replace(r"\|", "|") for cell in re.split(r"(?<!\\)\|", line.strip())[1:-1]]


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
