"""A user's own model: loaded, checked, and its geoms by name."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from numbers import Integral
from os.path import realpath
from pathlib import Path
from typing import SupportsIndex
from xml.etree import ElementTree

import mujoco
import numpy as np

from cointoss_bounce.errors import FieldError
from cointoss_bounce.recipe import LONGEST_STEP, SHORTEST_STEP, STEP_ACCEPTED
from cointoss_bounce.unlogged import unlogged

MOST_POINTS = 10_000_000
"""The most points of a height field; beyond the memory MuJoCo's loader fails without a message, or hangs."""
UNBOUNDED = ("_aabb", "_range", "_ctrlrange", "_forcerange", "_actrange", "_actfrcrange", "_lengthrange")
"""Endings of names of fields in which infinity may stand for no bound."""


def load_model(path: Path | str) -> mujoco.MjModel:
    """Return the model of an XML file, which MuJoCo's loader reads, with the files that it names.

    Raises:
        FieldError: naming the file and why it does not load.
    """
    if not Path(path).is_file():
        raise FieldError("model", str(path), "an XML file of MuJoCo that exists")
    _require_small_fields(Path(path))
    try:
        with unlogged():
            return mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, RuntimeError, MemoryError, mujoco.FatalError) as error:
        why = "; ".join(line.strip() for line in str(error).splitlines() if line.strip())
        raise FieldError("model", str(path), f"an XML file that MuJoCo loads ({why})") from None


def require_measurable(model: mujoco.MjModel) -> None:
    """Refuse a model with a step that suits no measurement, or with numbers that are not finite.

    Raises:
        FieldError: naming the field, its value and what is accepted.
    """
    step = float(model.opt.timestep)
    if not SHORTEST_STEP <= step <= LONGEST_STEP:
        raise FieldError("option timestep", step, STEP_ACCEPTED)
    for name, values in _numbers(model.opt, "option "):
        _require_finite(name, values)
    for name, values in _numbers(model, ""):
        if not name.endswith(UNBOUNDED):
            _require_finite(_named(model, name, values), values)


def geom_of(model: mujoco.MjModel, given: str | SupportsIndex) -> int:
    """Return the number of a geom, given its name or its number, also as text.

    Raises:
        FieldError: naming what was given and the geoms that exist.
    """
    if isinstance(given, str):
        found = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, given)
        if found < 0 and given.isascii() and given.isdigit():
            found = _whole(given)
    else:
        found = int(given) if isinstance(given, Integral) and not isinstance(given, bool) else -1
    if not 0 <= found < model.ngeom:
        known = [model.geom(number).name or str(number) for number in range(min(model.ngeom, 12))]
        more = ", ..." if model.ngeom > len(known) else ""
        names = ", ".join(known) or "it has none"
        raise FieldError("geom", given, f"a geom of the model, by name or number: {names}{more}")
    return found


def _numbers(part: object, prefix: str) -> list[tuple[str, np.ndarray]]:
    """Return the fields of floating point numbers of a model or of its options, by name."""
    fields = [(name, getattr(part, name)) for name in dir(part) if not name.startswith("_")]
    return [
        (prefix + name, np.asarray(value))
        for name, value in fields
        if isinstance(value, float | np.ndarray) and np.asarray(value).dtype.kind == "f"
    ]


def _named(model: mujoco.MjModel, name: str, values: np.ndarray) -> str:
    """Return a field's name with that of the first element whose numbers are not finite."""
    kind, _, field = name.partition("_")
    wrong = np.argwhere(~np.isfinite(values))
    if not len(wrong) or len(values) != getattr(model, f"n{kind}", None):
        return name
    number = int(wrong[0][0])
    return f"{kind} {getattr(model, kind)(number).name or number} {field}"


def _require_finite(name: str, values: np.ndarray) -> None:
    wrong = values[~np.isfinite(values)]
    if len(wrong):
        raise FieldError(name, float(wrong[0]), "finite numbers")


def _require_small_fields(path: Path) -> None:
    """Refuse a file whose height fields have more points than `MOST_POINTS`, before MuJoCo reads it."""
    waiting, seen = [path], set[str]()
    while waiting:
        file = waiting.pop()
        try:
            if realpath(file) in seen or not file.is_file():
                continue
            seen.add(realpath(file))
            elements = list(ElementTree.parse(file).iter())
        except (ElementTree.ParseError, ValueError, OSError):
            continue  # MuJoCo's loader says what is wrong with it
        for element in elements:
            if element.tag == "include":
                waiting += [folder / element.get("file", "") for folder in (path.parent, file.parent)]
            if element.tag == "hfield":
                _require_small_field(element)


def _require_small_field(field: ElementTree.Element) -> None:
    sides = [field.get(side, "0") for side in ("nrow", "ncol")]
    if _whole(sides[0]) * _whole(sides[1]) > MOST_POINTS:
        name = field.get("name", "without a name")
        accepted = f"at most {MOST_POINTS:,} points"
        raise FieldError(f"hfield {name} nrow x ncol", " x ".join(sides), accepted)


def _whole(text: str) -> int:
    """Return a whole number, written with spaces and a sign or without; -1 for what is none."""
    try:
        return int(text)
    except ValueError:
        return -1
