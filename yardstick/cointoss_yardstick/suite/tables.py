"""The tables of cases.toml, and the names of the cases."""

import tomllib
from functools import cache
from importlib import resources
from typing import Any


@cache
def tables() -> dict[str, Any]:
    """Return what cases.toml holds."""
    text = (resources.files("cointoss_yardstick.suite") / "cases.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def case_names() -> list[str]:
    """Return the names of all cases, in the order of the file."""
    return [table["name"] for table in tables()["case"]]
