"""What was seen of a coin, read from a CSV file as phyphox, Tracker and a person write it."""

import math
import re
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from cointoss.compare.fitting.cells import (
    BEFORE_HEADER,
    columns_of,
    read_cells,
    require_whole_rows,
    warn_of_unused_columns,
)
from cointoss.compare.fitting.errors import ObservationError, ValueRefusedError
from cointoss.compare.fitting.observed import LEAST_SD, Observed
from cointoss.compare.sweep.axes import number
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.errors import FieldError, shown
from cointoss.models.quantities import LARGEST as LARGEST_SD
from cointoss.models.units import in_si

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
EULER = ("e0", "e1", "e2", "e3")
ACCEPTED = (
    "t or time; of touches: touch, face, sd_t; of frames of a film: z, height or y; tilt or theta; e0 to e3; "
    "sd_z, sd_tilt; each perhaps with a unit, as in t (ms)"
)
_IN_ONE_ROW = re.compile(r"(start|stop|stop \d+|bounce \d+)", re.IGNORECASE)
"""Touches as phyphox's acoustic stopwatch and its (in)elastic collision export them: one row, 0 for none."""
_NONE = re.compile(r"nan|\?|[0.,]*(e[-+]?\d+)?", re.IGNORECASE)
_HEADING = re.compile(r"(?P<name>[^(\[]*?)\s*(?:[(\[](?P<unit>[^)\]]*)[)\]])?")
_MISSING = ("", "nan", "?")
_DIMENSIONS = {"s": "time", "m": "length", "rad": "angle"}
_ARRAYS = {
    "touch_times": ("time", "time"),
    "touch_sd": ("sd_time", "time"),
    "touch_numbers": ("touch", "touch"),
    "faces": ("face", "face"),
    "times": ("time", "time"),
    "heights": ("height", "height"),
    "height_sd": ("sd_height", "height"),
    "tilts": ("tilt", "tilt"),
    "tilt_sd": ("sd_attitude", "tilt"),
    "quaternions": ("e0", "e0"),
    "quaternion_sd": ("sd_attitude", "e0"),
}
"""The column of each array of `Observed`, and that without which it is left out."""


class Heading(NamedTuple):
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
        """What of `NAMES` it is; None for another."""
        name = self.name.lower().replace("sd ", "sd_").replace("sigma_", "sd_")
        return next((key for key, (names, _) in NAMES.items() if name in names), None)

    def numbers(self, cells: Sequence[str], unit: str) -> list[float]:
        """Return its cells, row by row, in `unit`, SI; NaN where nothing was measured.

        Raises:
            ObservationError: for a unit of something else, and for a cell that is no number.
        """
        try:
            factor = in_si(f"1 {self.unit}", unit) if self.unit and unit else 1.0
        except ValueError:
            accepted = f"a unit of {_DIMENSIONS[unit]}, such as {unit}"
            raise ObservationError(f"column {self.name}: in {self.unit}, accepted: {accepted}") from None
        found = []
        for n, cell in enumerate(cells, start=1):
            try:
                found.append(math.nan if cell.lower() in _MISSING else factor * float(cell))
            except ValueError:
                accepted = f"a number [{self.unit or unit}]" if unit else "a number"
                raise ObservationError(
                    f"column {self.name}: row {n} is {cell!r}, accepted: {accepted}"
                ) from None
        return found


def read_seen(path: str | PathLike[str], sd: Mapping[str, float | str] | None = None) -> Observed:
    """Read what was seen from a CSV file; commas, semicolons or tabs between its cells, # before a comment.

    A row is a touch where it has a number in the column `touch`, or where no column is of a film; another is
    a frame. phyphox's acoustic stopwatch and its (in)elastic collision export the touches in one row.

    Args:
        path: of the file.
        sd: standard deviations of "time" [s], "height" [m] and "attitude" [rad], in SI or as texts with a
            unit, where the file has none.

    Raises:
        ObservationError: naming the file, what is wrong and what is accepted.
        FieldError: for a standard deviation that nothing has.

    Warns:
        UnusedFieldWarning: for columns that are not used.
    """
    deviations, rows = _deviations({} if sd is None else sd), read_cells(Path(path))
    try:
        return _seen(rows, deviations)
    except ObservationError as error:
        raise ObservationError(f"{path}: {error}") from None


def _deviations(given: Mapping[str, float | str]) -> dict[str, float]:
    """Return standard deviations in SI, by the column that they stand for; refuse those that nothing has."""
    if not (isinstance(given, Mapping) and set(given) <= set(DEVIATIONS)):
        raise ObservationError(
            f'sd: {shown(given)}, accepted: a dict such as {{"time": "1 ms"}}, of {", ".join(DEVIATIONS)}'
        )
    found = {}
    for name, value in given.items():
        unit = DEVIATIONS[name]
        try:
            sd = number(name, value, unit)
        except SweepError:
            sd = math.nan
        if not LEAST_SD <= sd <= LARGEST_SD:
            bounds = f"{LEAST_SD:g} to {LARGEST_SD:g} {unit}"
            raise FieldError(f"sd.{name}", value, f"a standard deviation from {bounds}")
        found[f"sd_{name}"] = sd
    return found


def _seen(rows: list[list[str]], sd: Mapping[str, float]) -> Observed:
    for at, row in enumerate(rows[:BEFORE_HEADER]):
        headings, below = [Heading.of(cell) for cell in row], rows[at + 1 :]
        in_one_row = [i for i, heading in enumerate(headings) if _IN_ONE_ROW.fullmatch(heading.name)]
        if in_one_row:
            if len(below) != 1:
                raise ObservationError(
                    f"{len(below)} rows of touches; accepted: one, as phyphox exports them"
                )
            times = [
                (cell,) for i, cell in enumerate(below[0]) if i in in_one_row and not _NONE.fullmatch(cell)
            ]
            return _of_columns({"time": (0, headings[in_one_row[0]])}, times, sd)
        if any(heading.key == "time" for heading in headings):
            columns = _columns(headings)
            require_whole_rows(below, 1 + max(i for i, _ in columns.values()), len(headings))
            return _of_columns(columns, below, sd)
    raise ObservationError(f"no column of times; accepted: {ACCEPTED}; cointoss flips takes counts")


def _columns(headings: Sequence[Heading]) -> dict[str, tuple[int, Heading]]:
    """Return which cell of a row each column is; y is the height where no other column is."""
    keys = [heading.key for heading in headings]
    if "height" not in keys:
        keys = ["height" if one.name.lower() == "y" else one.key for one in headings]
    found = columns_of(keys, [one.name for one in headings])
    warn_of_unused_columns([one.name for key, one in zip(keys, headings, strict=True) if key is None])
    return {key: (i, headings[i]) for key, i in found.items()}


def _of_columns(
    columns: Mapping[str, tuple[int, Heading]], rows: Sequence[Sequence[str]], sd: Mapping[str, float]
) -> Observed:
    """Return what the rows of a table say; NaN stands for a column that is not there."""
    values = {key: np.full(len(rows), sd.get(key, math.nan)) for key in NAMES}
    for key, (i, heading) in columns.items():
        cells = [row[i] for row in rows]
        if key == "face":
            values[key] = np.array([cell[:1] or "?" for cell in cells], dtype=str)
        else:
            numbers = np.array(heading.numbers(cells, NAMES[key][1]))
            values[key] = np.where(np.isnan(numbers), values[key], numbers)
    if 0 < len(columns.keys() & set(EULER)) < 4:
        raise ObservationError(f"columns {', '.join(columns)}; accepted: all of e0, e1, e2 and e3, or none")
    is_of_film = bool(columns.keys() & {"height", "tilt", "e0"})
    is_touch = np.isfinite(values["touch"]) if "touch" in columns else np.full(len(rows), not is_of_film)
    values["e0"] = np.column_stack([values[key] for key in EULER])
    rows_of = {name: np.flatnonzero(is_touch == name.startswith(("touch", "face"))) for name in _ARRAYS}
    made: dict[str, Any] = {
        name: values[key][rows_of[name]] for name, (key, needed) in _ARRAYS.items() if needed in columns
    }
    try:
        return Observed(**{**made, "faces": "".join(made.get("faces", ""))})
    except ValueRefusedError as error:
        key, row = _ARRAYS[error.name][0], rows_of[error.name][error.index]
        if key not in columns:
            accepted = f"a column {NAMES[key][0][0]}, or --{key.replace('_', '-')}"
            raise ObservationError(f"no standard deviation of {key[3:]}; accepted: {accepted}") from None
        i, heading = columns[key]
        cell = f"{rows[row][i] or 'empty'} {heading.unit}".strip()
        where = f"column {heading.name}: row {row + 1} is {cell}"
        raise ObservationError(f"{where}, accepted: {error.accepted}") from None
