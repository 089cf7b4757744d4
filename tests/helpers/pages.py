"""What a page of docs/ shows of a study."""

import re
from pathlib import Path

DOCS = Path(__file__).parents[2] / "docs"


def printed(page: str, study: str) -> str:
    """Give the part of a page that `cointoss reproduce` printed."""
    text = (DOCS / page).read_text(encoding="utf-8")
    begin, end = f"<!-- printed by: cointoss reproduce {study} -->\n\n", "\n\n<!-- end -->\n"
    return text.split(begin)[1].split(end)[0]


def pictures(page: str, study: str) -> set[str]:
    """Give the names of a study's pictures that a page shows."""
    text = (DOCS / page).read_text(encoding="utf-8")
    return set(re.findall(rf"\]\({study}/([\w-]+\.png)\)", text))


def saved_numbers(study: str) -> str:
    """Give the numbers of a study that come with its page."""
    return (DOCS / study / "numbers.json").read_text(encoding="utf-8")
