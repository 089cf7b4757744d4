"""Long tables of a page in Markdown: each folds, and has a file of comma-separated values beside it."""

import re
from collections.abc import Iterator
from html import escape

from cointoss.study import cells, sheet

OPEN = 5
"""The most rows that stand open on a page."""
_NUMBER = r"-?[\d,]*\.?\d+(?:e[-+]?\d+)?"
_ESTIMATE = re.compile(rf"({_NUMBER})( %)? \[({_NUMBER}|-inf), ({_NUMBER}|inf)\]")
_THOUSANDS = re.compile(r"-?\d{1,3}(,\d{3})+(\.\d+)?")


def paragraphs(*blocks: str) -> str:
    """Return the blocks, empty ones left out, as paragraphs of one text."""
    return "\n\n".join(filter(None, blocks))


def folded(text: str) -> str:
    """Return Markdown in which each long table is folded under its first heading.

    Each has a link to its file of `sheets`, which lies beside the page.
    """
    return "\n\n".join(_folded(block, name) if name else block for block, name in _named(text))


def sheets(text: str) -> dict[str, str]:
    """Return the long tables of Markdown as comma-separated values, by the names of their files.

    An estimate with its interval, as in "0.3 % [0.2, 0.4]", becomes three columns.
    """
    return {name: _sheet(*_read(block)) for block, name in _named(text) if name}


def unfolding(summary: str, *blocks: str) -> str:
    """Return Markdown that unfolds below a line of HTML."""
    return "\n\n".join([f"<details>\n<summary>{summary}</summary>", *blocks, "</details>"])


def _named(text: str) -> Iterator[tuple[str, str]]:
    """Yield the blocks of a text, each long table with the name of its file and others with none."""
    number = 0
    for block in text.split("\n\n"):
        is_long = block.startswith("|") and block.count("\n") - 1 > OPEN
        number += is_long
        yield block, f"table-{number}.csv" if is_long else ""


def _read(block: str) -> tuple[list[str], list[list[str]]]:
    """Return the names of the columns of a table in Markdown, and its rows."""
    head, _, *rows = map(cells, block.splitlines())
    return head, rows


def _folded(block: str, address: str) -> str:
    (head, *_), rows = _read(block)
    named = re.sub(r"`([^`]+)`", r"<code>\1</code>", escape(head, quote=False))
    return unfolding(": ".join(filter(None, [named, f"{len(rows)} rows"])), block, f"[As CSV]({address})")


def _sheet(head: list[str], rows: list[list[str]]) -> str:
    columns: list[tuple[str, ...]] = []
    for name, *column in zip(head, *rows, strict=True):
        found = [_ESTIMATE.fullmatch(cell) for cell in column]
        if all(found):
            unit = " [%]" if all(one and one[2] for one in found) else ""
            parts = zip(*((one[1], one[3], one[4]) for one in found if one), strict=True)
            names = (f"{name}{unit}", f"{name}, low{unit}", f"{name}, high{unit}")
            columns += [(of, *part) for of, part in zip(names, parts, strict=True)]
        else:
            columns.append((name, *column))
    lines = [[_plain(cell) for cell in line] for line in zip(*columns, strict=True)]
    return sheet(lines[0], lines[1:])


def _plain(cell: str) -> str:
    """Return a number without the commas between its thousands; another cell as it is."""
    return cell.replace(",", "") if _THOUSANDS.fullmatch(cell) else cell
