"""The files of a report's folder, and whether a folder may take them."""

import json
import re
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from cointoss.compare.output import files
from cointoss.compare.output.files import UnwritableError

OF_THE_FILM = ("report.html", "toss.mp4")
FILES = (*OF_THE_FILM, "numbers.json", "path-analytic.csv", "path-mujoco.csv")
"""The files of every report; the paths of other engines lie beside them."""
_LONGEST = 80

NOT_ASKED = "None was asked for; cointoss video draws one."
"""Why a report has no video where its command was asked for none."""


def slug_of(engine: str) -> str:
    """Return an engine's name as a part of a file's name; empty for a name without letters and digits."""
    return "-".join(re.findall("[a-z0-9]+", engine.lower()))[:_LONGEST]


def path_name(engine: str) -> str:
    """Return the name of the file of a path."""
    return f"path-{slug_of(engine)}.csv"


def names_in(folder: Path, engines: Iterable[str]) -> tuple[str, ...]:
    """Return the names of the files that a report in `folder` writes or replaces."""
    return tuple(dict.fromkeys([*FILES, *map(path_name, engines), *_earlier(folder)]))


def require_folder(folder: Path, source: str, engines: Iterable[str] = ()) -> None:
    """Check that a report in `folder` would replace nothing but an earlier report.

    Args:
        folder: of the report; it need not exist.
        source: the scenario, which must not be one of the files replaced.
        engines: whose tosses the report shows.

    Raises:
        UnwritableError: naming the folder, the file in the way, and why.
    """
    earlier = _earlier(folder)
    there = files.require_folder(folder, names_in(folder, engines), source)
    in_the_way = [path for path in there if path.name not in earlier]
    if in_the_way:
        raise UnwritableError(
            f"{folder}: {in_the_way[0].name} is in the way and belongs to no report; "
            "accepted: a folder without files of these names, or that of an earlier report"
        )


def _earlier(folder: Path) -> tuple[str, ...]:
    """Return the names of an earlier report's files: its numbers.json names its versions and engines."""
    with suppress(OSError, ValueError, RecursionError, LookupError, TypeError, AttributeError):
        numbers = json.loads((folder / "numbers.json").read_bytes())
        if "cointoss" in numbers["versions"]:
            return (*FILES, *(path_name(toss["engine"]) for toss in numbers["tosses"]))
    return ()
