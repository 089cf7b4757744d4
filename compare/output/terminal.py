"""Text and tables in Markdown, laid out for a terminal."""

import re
import textwrap
from collections.abc import Sequence
from itertools import zip_longest

from cointoss.compare.output.tables import cells

GAP = "  "
"""The gap between two columns."""
_TIED = "\N{NO-BREAK SPACE}"


def laid_out(markdown: str, width: int) -> str:
    """Return paragraphs and tables in Markdown with lines of at most a width, where words allow it.

    Args:
        markdown: paragraphs, and tables as `cointoss.compare.output.tables` makes them, blank lines between.
        width: of the terminal.
    """
    parts = [
        # A paragraph may begin with an absolute value.
        _table(part, width) if part.startswith("|") and "\n|" in part else textwrap.fill(_plain(part), width)
        for part in markdown.split("\n\n")
    ]
    return "\n\n".join(parts).replace(_TIED, " ")


def _table(markdown: str, width: int) -> str:
    head, ruled, *rows = [[_plain(cell) for cell in cells(line)] for line in markdown.splitlines()]
    numbers = [mark.endswith(":") for mark in ruled]
    widths = _widths(list(zip(head, *rows, strict=True)), width)
    tall = [_lines(row, widths) for row in (head, *rows)]
    spaced = any(len(lines) > 1 for lines in tall[1:])

    def line(cells: Sequence[str]) -> str:
        placed = zip(cells, widths, numbers, strict=True)
        return GAP.join(
            f"{cell:>{wide}}" if right else f"{cell:{wide}}" for cell, wide, right in placed
        ).rstrip()

    top, *below = ["\n".join(map(line, lines)) for lines in tall]
    rule = "─" * (sum(widths) + len(GAP) * (len(widths) - 1))
    return "\n".join([top, rule, ("\n\n" if spaced else "\n").join(below)])


def _plain(text: str) -> str:
    """Return text without the marks of bold and of code, the words of an interval in brackets tied."""
    return re.sub(r"\[[^]]*\]", lambda found: found[0].replace(" ", _TIED), re.sub(r"\*\*|`", "", text))


def _widths(columns: Sequence[Sequence[str]], width: int) -> list[int]:
    """Return the widths of columns: of their cells, the widest narrowed until all fit or words break."""
    widths = [max(map(len, cells)) for cells in columns]
    least = [max((len(word) for cell in cells for word in cell.split(" ")), default=0) for cells in columns]
    room = width - len(GAP) * (len(columns) - 1)
    while sum(widths) > room and widths != least:
        _, widest = max((wide, i) for i, wide in enumerate(widths) if wide > least[i])
        widths[widest] -= 1
    return widths


def _lines(row: Sequence[str], widths: Sequence[int]) -> list[tuple[str, ...]]:
    """Return the lines of a row, each a piece of every cell."""
    wrapped = [textwrap.wrap(cell, max(wide, 1)) for cell, wide in zip(row, widths, strict=True)]
    return list(zip_longest(*wrapped, fillvalue="")) or [tuple("" for _ in row)]
