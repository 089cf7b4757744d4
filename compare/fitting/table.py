"""What was seen of a coin, read from a CSV file as phyphox, Tracker and a person write it."""

import csv
import re
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.compare.fitting.observed import LEAST_SD, Observed
from cointoss.models.bounded import TooLargeError, read_bounded
from cointoss.models.errors import FieldError
from cointoss.models.parts import LARGEST as LARGEST_SD
from cointoss.models.records import Array
from cointoss.models.units import in_si
from cointoss.models.unused import UnusedFieldWarning

LARGEST = 10_000_000
"""Bytes of a file."""
BEFORE_HEADER = 5
"""Lines above that with the names; Tracker writes the name of the track there."""
NAMES = {
    "time": (("t", "time"), "s"),
    "touch": (("touch", "bounce", "impact"), ""),
    "face": (("face", "up"), ""),
    "height": (("z", "height"), "m"),
    "tilt": (("tilt", "theta", "θ"), "rad"),
    **{f"e{i}": ((f"e{i}",), "") for i in range(4)},
    "sd_time": (("sd_t", "sd_time"), "s"),
    "sd_height": (("sd_z", "sd_y", "sd_height"), "m"),
    "sd_attitude": (("sd_tilt", "sd_theta", "sd_e", "sd_attitude"), "rad"),
}
"""Columns: the names accepted, in any case, each perhaps with a unit in brackets, and the unit without."""
DEVIATIONS = {"time": "s", "height": "m", "attitude": "rad"}
"""What has a standard deviation, and its unit."""
FRAME = ("height", "tilt", "e0", "e1", "e2", "e3")
ACCEPTED = (
    "t or time; of touches: touch, face, sd_t; of frames of a film: z, height or y; tilt or theta; e0 to e3; "
    "sd_z, sd_tilt; each perhaps with a unit, as in t (ms)"
)
_IN_ONE_ROW = re.compile(r"(start|stop|stop \d+|bounce \d+)", re.IGNORECASE)
"""Touches as phyphox's acoustic stopwatch and its (in)elastic collision export them: one row, 0 for none."""
_HEADING = re.compile(r"(?P<name>[^(\[]*?)\s*(?:[(\[](?P<unit>[^)\]]*)[)\]])?")
_MISSING = ("", "nan", "?")
_DIMENSIONS = {"s": "time", "m": "length", "rad": "angle"}
_OF_COLUMNS = {
    "touch_times": "time",
    "touch_sd": "sd_time",
    "touch_numbers": "touch",
    "faces": "face",
    "times": "time",
    "heights": "height",
    "height_sd": "sd_height",
    "tilts": "tilt",
    "tilt_sd": "sd_attitude",
    "quaternions": "e0",
    "quaternion_sd": "sd_attitude",
}
"""The column of each array of `Observed`."""


@dataclass(frozen=True)
class Heading:
    """The name of a column, and its unit where it has one."""

    name: str
    unit: str

    @classmethod
    def of(cls, cell: str) -> "Heading":
        """Read "Time (s)", "t [ms]" or "t"."""
        match = _HEADING.fullmatch(cell.strip())
        return cls(match["name"].strip(), (match["unit"] or "").strip()) if match else cls(cell.strip(), "")

    @property
    def key(self) -> str | None:
        """What of `NAMES` it is."""
        name = self.name.lower().replace("sd ", "sd_").replace("sigma_", "sd_")
        return next((key for key, (names, _) in NAMES.items() if name in names), None)

    def factor(self, unit: str) -> float:
        """Return its unit in `unit`, SI; 1 where it has none or needs none.

        Raises:
            ObservationError: for a unit of something else.
        """
        if not (self.unit and unit):
            return 1.0
        try:
            return in_si(f"1 {self.unit}", unit)
        except ValueError:
            accepted = f"a unit of {_DIMENSIONS[unit]}, such as {unit}"
            raise ObservationError(f"column {self.name}: in {self.unit}, accepted: {accepted}") from None


def read_observed(path: str | PathLike[str], sd: Mapping[str, float] | None = None) -> Observed:
    """Read what was seen from a CSV file; commas, semicolons or tabs between its cells, # before a comment.

    A row is a touch where it has a number in the column `touch`, or where no column is of a film; another is
    a frame. phyphox's acoustic stopwatch and its (in)elastic collision export the touches in one row.

    Args:
        path: of the file.
        sd: standard deviations of "time" [s], "height" [m] and "attitude" [rad], where the file has none.

    Raises:
        ObservationError: naming the file, what is wrong and what is accepted.
        FieldError: for a standard deviation that nothing has.

    Warns:
        UnusedFieldWarning: for columns that are not used.
    """
    require_deviations(sd or {})
    try:
        return _observed(_rows(Path(path)), sd or {})
    except ObservationError as error:
        raise ObservationError(f"{path}: {error}") from None
    except TooLargeError as error:
        raise ObservationError(
            f"{path}: {error}; accepted: a CSV file of at most {LARGEST:,} bytes"
        ) from None
    except FileNotFoundError:
        raise ObservationError(f"{path}: no such file; accepted: a CSV file") from None
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "no text"
        raise ObservationError(f"{path}: can't be read ({reason}); accepted: a CSV file in UTF-8") from None


def require_deviations(sd: Mapping[str, float]) -> None:
    """Refuse standard deviations that nothing has.

    Raises:
        FieldError: naming what is to have it, its value and what is accepted.
    """
    for name, value in sd.items():
        if not LEAST_SD <= value <= LARGEST_SD:
            bounds = f"{LEAST_SD:g} to {LARGEST_SD:g} {DEVIATIONS[name]}"
            raise FieldError(name, value, f"a standard deviation from {bounds}")


def _rows(path: Path) -> list[list[str]]:
    """Return the cells of a file that are neither empty lines nor comments."""
    lines = read_bounded(path, LARGEST).decode("utf-8-sig").splitlines()
    lines = [line for line in lines if line.strip() and not line.startswith("#")]
    mark = max(";\t,", key=lambda mark: sum(line.count(mark) > 0 for line in lines[:BEFORE_HEADER]))
    try:
        rows = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=mark)]
    except csv.Error as error:
        raise ObservationError(f"{error}; accepted: a CSV file") from None
    return rows if mark == "," else [[_with_point(cell) for cell in row] for row in rows]


def _with_point(cell: str) -> str:
    """Return a number written with a decimal comma with a point; another cell as it is."""
    return cell.replace(",", ".") if re.fullmatch(r"[-+]?\d+,\d+(?:[eE][-+]?\d+)?", cell) else cell


def _observed(rows: list[list[str]], sd: Mapping[str, float]) -> Observed:
    for at, row in enumerate(rows[:BEFORE_HEADER]):
        headings = [Heading.of(cell) for cell in row]
        if any(_IN_ONE_ROW.fullmatch(heading.name) for heading in headings):
            return _of_one_row(headings, rows[at + 1 :], sd)
        if any(heading.key == "time" for heading in headings):
            _require_whole(rows[at + 1 :], len(headings))
            return _of_columns(_columns(headings), rows[at + 1 :], sd)
    raise ObservationError(f"no column of times; accepted: {ACCEPTED}")


def _require_whole(rows: list[list[str]], width: int) -> None:
    """Refuse rows with more cells than headings: a decimal comma between commas would be lost."""
    for n, row in enumerate(rows, start=1):
        if any(row[width:]):
            cells = f"row {n} has {len(row)} cells; accepted: {width}, one for each column"
            raise ObservationError(f"{cells}; decimal commas need semicolons or tabs between the cells")


def _of_one_row(headings: Sequence[Heading], rows: list[list[str]], sd: Mapping[str, float]) -> Observed:
    if len(rows) != 1:
        raise ObservationError(f"{len(rows)} rows of touches; accepted: one, as phyphox exports them")
    times = [
        heading.factor("s") * _number(cell, heading, "s", 1)
        for cell, heading in zip(rows[0], headings, strict=False)
        if _IN_ONE_ROW.fullmatch(heading.name)
    ]
    heard = np.array([time for time in times if time > 0])
    return Observed(touch_times=heard, touch_sd=_sd({}, "time", len(heard), sd))


def _columns(headings: Sequence[Heading]) -> dict[str, tuple[int, Heading]]:
    """Return which cell of a row each column is; y is the height where no other column is."""
    found: dict[str, tuple[int, Heading]] = {}
    unused: list[str] = []
    for i, heading in enumerate(headings):
        key = heading.key
        if key is None:
            unused += [heading.name] if heading.name else []
        elif key in found:
            raise ObservationError(f"columns {found[key][1].name} and {heading.name}; accepted: one of them")
        else:
            found[key] = (i, heading)
    y = [i for i, heading in enumerate(headings) if heading.name.lower() == "y"]
    if y and "height" not in found:
        if len(y) > 1:
            raise ObservationError("column y twice; accepted: one track")
        found["height"] = (y[0], headings[y[0]])
        unused = [name for name in unused if name.lower() != "y"]
    if unused:
        columns = "column" if len(unused) == 1 else "columns"
        warnings.warn(f"{columns} {', '.join(unused)}: not used", UnusedFieldWarning, stacklevel=2)
    return found


def _of_columns(
    columns: Mapping[str, tuple[int, Heading]], rows: list[list[str]], sd: Mapping[str, float]
) -> Observed:
    width = max((i for i, _ in columns.values()), default=0) + 1
    short = next((n for n, row in enumerate(rows, start=1) if len(row) < width), None)
    if short is not None:
        raise ObservationError(f"row {short} has {len(rows[short - 1])} cells; accepted: one for each column")
    values = {
        key: heading.factor(unit := NAMES[key][1])
        * np.array([_number(row[i], heading, unit, n) for n, row in enumerate(rows, 1)])
        for key, (i, heading) in columns.items()
        if key != "face"
    }
    some = [key for key in FRAME if key in values]
    if any(key.startswith("e") for key in some) and not all(f"e{i}" in values for i in range(4)):
        raise ObservationError(f"columns {', '.join(some)}; accepted: all of e0, e1, e2 and e3, or none")
    if not np.isfinite(values["time"]).all():
        late = int(np.argmin(np.isfinite(values["time"]))) + 1
        raise ObservationError(f"column {columns['time'][1].name}: row {late} has no time")
    is_touch = np.isfinite(values["touch"]) if "touch" in values else np.full(len(rows), not some)
    letters = [row[columns["face"][0]][:1] or "?" for row in rows] if "face" in columns else []

    def of_frames(key: str) -> Array:
        return values[key][~is_touch] if key in values else np.empty(0)

    def sd_of(what: str, among: NDArray[np.bool_], *, of: Sequence[str]) -> Array:
        is_seen = among.any() and any(key in values for key in of)
        return _sd(values, what, len(rows), sd)[among] if is_seen else np.empty(0)

    made: dict[str, Any] = {
        "touch_times": values["time"][is_touch],
        "touch_sd": sd_of("time", is_touch, of=["time"]),
        "touch_numbers": values["touch"][is_touch] if "touch" in values else np.empty(0),
        "faces": "".join(letter for letter, is_heard in zip(letters, is_touch, strict=False) if is_heard),
        "times": values["time"][~is_touch],
        "heights": of_frames("height"),
        "height_sd": sd_of("height", ~is_touch, of=["height"]),
        "tilts": of_frames("tilt"),
        "tilt_sd": sd_of("attitude", ~is_touch, of=["tilt"]),
        "quaternions": np.column_stack([of_frames(f"e{i}") for i in range(4)]),
        "quaternion_sd": sd_of("attitude", ~is_touch, of=["e0"]),
    }
    try:
        return Observed(**made)
    except ValueRefusedError as error:
        of_touches = error.name.startswith(("touch", "face"))
        row = np.flatnonzero(is_touch if of_touches else ~is_touch)[error.index]
        i, heading = columns[_OF_COLUMNS[error.name]]
        cell = f"{rows[row][i] or 'empty'} {heading.unit}".strip()
        where = f"column {heading.name}: row {row + 1} is {cell}"
        raise ObservationError(f"{where}, accepted: {error.accepted}") from None


def _sd(values: Mapping[str, Array], what: str, n: int, given: Mapping[str, float]) -> Array:
    """Return standard deviations, (n,): those of the file, else what was given for it."""
    found = values.get(f"sd_{what}", np.full(n, np.nan))
    if what in given:
        return np.where(np.isfinite(found), found, given[what])
    if f"sd_{what}" not in values:
        accepted = f"a column {NAMES[f'sd_{what}'][0][0]}, or --sd-{what}"
        raise ObservationError(f"no standard deviation of {what}; accepted: {accepted}")
    return found


def _number(cell: str, heading: Heading, unit: str, row: int) -> float:
    """Return a cell in the column's unit; NaN where nothing was measured."""
    if cell.lower() in _MISSING:
        return float("nan")
    try:
        return float(cell)
    except ValueError:
        accepted = f"a number [{heading.unit or unit}]" if unit else "a number"
        raise ObservationError(
            f"column {heading.name}: row {row} is {cell!r}, accepted: {accepted}"
        ) from None
