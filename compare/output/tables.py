"""Tables in Markdown."""

from collections.abc import Iterable, Sequence


def table(head: Sequence[str], rows: Iterable[Sequence[str]], *, words: bool = False) -> str:
    """Return a table.

    Args:
        head: names of the columns.
        rows: cells, as many as columns; a bar in one is escaped.
        words: whether the columns after the first are words; numbers stand at the right.
    """
    ruled = ["---", *(["---" if words else "---:"] * (len(head) - 1))]
    return "\n".join([_line(head), f"| {' | '.join(ruled)} |", *map(_line, rows)])


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in cells)} |"
