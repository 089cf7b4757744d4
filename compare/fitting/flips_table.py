"""Counts of flips, read from a table with a row for each person or series."""

import re
import warnings
from collections.abc import Mapping, Sequence

from cointoss.compare.fitting.cells import require_whole_rows
from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.compare.fitting.flips import Flips
from cointoss.compare.output.language import listed
from cointoss.models.unused import UnusedFieldWarning

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
_PAIR = re.compile(r"(h|t)(?:eads?|ails?)? ?(?:to|>|→)? ?(h|t)(?:eads?|ails?)?")
_AROUND = re.compile(r"^(?:n|number of|count of) (?=.)|(?<=.) (?:n|counts?)$")
_SIDES = {"h": "heads", "t": "tails"}
_COUNTED = {"same", "other", "flips", "heads", "tails", "edge", *PAIRS}


def key_of(name: str) -> str | None:
    """Return which of `NAMES` or `PAIRS` a column is; None for another."""
    plain = " ".join(re.split(r"[_\-.\s]+", re.sub(r"[(\[].*", "", name.lower()).strip()))
    plain = _AROUND.sub("", plain)
    if pair := _PAIR.fullmatch(plain):
        return f"{_SIDES[pair[1]]} to {_SIDES[pair[2]]}"
    return next((key for key, names in NAMES.items() if plain in names), None)


def is_of_flips(head: Sequence[str]) -> bool:
    """Return whether these are the names of the columns of counts of flips."""
    return sum(key_of(name) in _COUNTED for name in head) > 1


def flips_of(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Flips:
    """Return the counts of a table; rows with one person's name are added up.

    Args:
        head: names of the columns.
        rows: cells below.

    Raises:
        ObservationError: naming column, value and what is accepted.

    Warns:
        UnusedFieldWarning: for columns that are not used.
    """
    columns = _columns(head)
    way = _way_of_counting(columns, head)
    used = {*way, *(columns.keys() & {"person"})}
    if unused := [name for i, name in enumerate(head) if name and i not in {columns[key] for key in used}]:
        what = "column" if len(unused) == 1 else "columns"
        warnings.warn(f"{what} {', '.join(unused)}: not used", UnusedFieldWarning, stacklevel=2)
    if not rows:
        raise ObservationError("no rows; accepted: one or more, each a person or a series")
    require_whole_rows(rows, 1 + max(columns[key] for key in used), len(head))
    sums: dict[str, tuple[int, int]] = {}
    for n, row in enumerate(rows, start=1):
        person = row[columns["person"]] if "person" in columns else str(n)
        same, flips = _counts({key: (head[columns[key]], row[columns[key]]) for key in way}, n)
        before = sums.get(person, (0, 0))
        sums[person] = before[0] + same, before[1] + flips
    same, flips = zip(*sums.values(), strict=True)
    try:
        return Flips(same=same, flips=flips, people=tuple(sums))
    except ValueRefusedError as error:
        who = f"flips of {tuple(sums)[error.index]}"
        raise ObservationError(f"{who}: {error.value}, accepted: {error.accepted}") from None


def _columns(head: Sequence[str]) -> dict[str, int]:
    """Return what each column is; refuse two for one thing, and columns that count no sides."""
    found: dict[str, int] = {}
    for i, name in enumerate(head):
        key = key_of(name)
        if key == "edge":
            accepted = "none, and flips without those on the edge, which cointoss shares --vary counts"
            raise ObservationError(f"column {name}: accepted: {accepted}")
        if key in found:
            raise ObservationError(f"columns {head[found[key]]} and {name}; accepted: one of them")
        if key is not None:
            found[key] = i
    return found


def _way_of_counting(columns: Mapping[str, int], head: Sequence[str]) -> tuple[str, ...]:
    """Return the columns that say how often the same side came up."""
    has = columns.keys()
    sides = [key for key in ("same", "other", "flips") if key in has]
    pairs = [key for key in PAIRS if key in has]
    if pairs and {"same", "other"} & has:
        named = listed(head[columns[key]] for key in (sides[0], pairs[0]))
        raise ObservationError(f"columns {named}; accepted: one way to count: {ACCEPTED}")
    if len(sides) > 1:
        return tuple(sides)
    if len(pairs) == len(PAIRS):
        return PAIRS
    if {"start", "heads", "tails"} <= has and not (pairs or sides):
        return ("start", "heads", "tails")
    raise ObservationError(f"columns {', '.join(name for name in head if name)}; accepted: {ACCEPTED}")


def _counts(cells: Mapping[str, tuple[str, str]], n: int) -> tuple[int, int]:
    """Return how often the same side came up, and all flips of a row.

    Args:
        cells: name of the column and cell, by key.
        n: number of the row.
    """
    count = {key: _whole(*named, n) for key, named in cells.items() if key != "start"}
    if "start" in cells:
        name, cell = cells["start"]
        side = _SIDES.get(cell.lower(), cell.lower())
        if side not in _SIDES.values():
            raise ObservationError(f"column {name}: row {n} is {cell!r}, accepted: heads, tails, h or t")
        return count[side], count["heads"] + count["tails"]
    if PAIRS[0] in count:
        return count["heads to heads"] + count["tails to tails"], sum(count.values())
    flips = count.get("flips", count.get("same", 0) + count.get("other", 0))
    same = count.get("same", flips - count.get("other", 0))
    if not 0 <= same <= flips or same + count.get("other", flips - same) != flips:
        named = listed(f"{name} {cell}" for name, cell in cells.values())
        accepted = "no more than all flips, and in sum all flips"
        raise ObservationError(f"row {n}: {named}; accepted: {accepted}")
    return same, flips


def _whole(name: str, cell: str, n: int) -> int:
    """Return a count; refuse one with a point or a comma, which may stand between thousands.

    Args:
        name: of the column.
        cell: that has it.
        n: number of the row.
    """
    try:
        number = -1.0 if "." in cell else float(cell)
    except ValueError:
        number = -1.0
    if not (number >= 0 and number % 1 == 0):
        accepted = "a whole number from 0, without a point or a comma"
        raise ObservationError(f"column {name}: row {n} is {cell!r}, accepted: {accepted}")
    return int(number)
