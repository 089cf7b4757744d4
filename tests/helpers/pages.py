"""What a page of docs/ shows of a study."""

import re
from pathlib import Path

from cointoss.compare.reproduction.result import folder_of

DOCS = Path(__file__).parents[2] / "docs"


def pictures(page: str, study: str) -> set[str]:
    """Return the names of a study's pictures that a page shows."""
    text = (DOCS / page).read_text(encoding="utf-8")
    return set(re.findall(rf"\]\(reproduction/{study}/([\w-]+\.png)\)", text))


def saved(study: str) -> Path:
    """Return the folder of what a study saved beside its page."""
    return folder_of(study, DOCS)
