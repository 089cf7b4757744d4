"""What `cointoss.study` offers the other houses; import-linter and pyright hold them to it."""

import re
from pathlib import Path

from cointoss import study

TOP = Path(__file__).parents[1]


def test_the_facade_offers_what_the_houses_ask_for_and_no_more():
    sources = [
        path.read_text(encoding="utf-8")
        for name in ("reproduction", "yardstick")
        for path in (TOP / name).rglob("*.py")
    ]
    asked = re.findall(r"^ *from cointoss\.study import (\([^)]*\)|.*)$", "\n".join(sources), re.MULTILINE)
    names = set(re.findall(r"\b(\w+)(?: as \w+)?\b", " ".join(asked)))
    assert set(study.__all__) - names == set()
