"""The files of a report's folder, and whether a folder may take them."""

import json
from pathlib import Path

from cointoss.compare.output import files
from cointoss.compare.output.files import UnwritableError

OF_THE_FILM = ("report.html", "toss.mp4")
FILES = (*OF_THE_FILM, "numbers.json", "path-analytic.csv", "path-mujoco.csv")

NOT_ASKED = "None was asked for; cointoss video draws one."
"""Why a report has no video where its command was told so."""


def require_folder(folder: Path, source: str) -> None:
    """Check that a report in `folder` would replace nothing but an earlier report.

    Args:
        folder: of the report; it need not exist.
        source: the scenario, which must not be one of the files replaced.

    Raises:
        UnwritableError: naming the folder, the file in the way, and why.
    """
    in_the_way = files.require_folder(folder, FILES, source)
    if in_the_way and not _is_of_a_report(folder / "numbers.json"):
        raise UnwritableError(
            f"{folder}: {in_the_way[0].name} is in the way and belongs to no report; "
            "accepted: a folder without files of these names, or that of an earlier report"
        )


def _is_of_a_report(numbers: Path) -> bool:
    """Return whether numbers.json is a report's: one names the versions that computed it."""
    try:
        return "cointoss" in json.loads(numbers.read_bytes())["versions"]
    except (OSError, ValueError, RecursionError, LookupError, TypeError):
        return False
