"""A user's own model: loaded, checked, and its geoms by name."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

from numbers import Integral
from os import PathLike
from os.path import realpath
from pathlib import Path
from typing import SupportsIndex
from xml.etree import ElementTree

import mujoco
import numpy as np

from cointoss_bounce.accepted import BOUNDS, require
from cointoss_bounce.errors import FieldError
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
    is_path = isinstance(path, str | PathLike)
    require(
        "model",
        str(path) if is_path else path,
        is_path and Path(path).is_file(),
        "an XML file of MuJoCo that exists, or an MjModel",
    )
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
    step, (least, most, accepted) = float(model.opt.timestep), BOUNDS["timestep"]
    require("option timestep", step, least <= step <= most, accepted)
    for part, prefix in ((model.opt, "option "), (model, "")):
        for name in (each for each in dir(part) if not each.startswith("_") and not each.endswith(UNBOUNDED)):
            values = np.asarray(getattr(part, name))
            wrong = np.argwhere(~np.isfinite(values)).tolist() if values.dtype.kind == "f" else []
            for first in map(tuple, wrong):
                raise FieldError(prefix + _named(model, name, first), float(values[first]), "finite numbers")


def _named(model: mujoco.MjModel, name: str, place: tuple[int, ...]) -> str:
    """Return a field's name, with that of the element where the field has one for each of its kind."""
    kind, _, field = name.partition("_")
    if not place or getattr(model, f"n{kind}", None) != len(getattr(model, name, ())):
        return name
    return f"{kind} {getattr(model, kind)(place[0]).name or place[0]} {field}"


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
