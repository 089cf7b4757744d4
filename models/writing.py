"""Write the tables of a scenario as TOML."""

import json
from typing import Any


def toml(tables: dict[str, Any]) -> str:
    """Return the text of a TOML file, from which the same numbers are read.

    Args:
        tables: by name, each of numbers, words and lists; what is no table comes before all tables.
    """
    plain = {name: entry for name, entry in tables.items() if not isinstance(entry, dict)}
    sections = [(f"[{name}]", part) for name, part in tables.items() if isinstance(part, dict)]
    blocks = [_lines(plain), *([heading, *_lines(part)] for heading, part in sections)]
    return "\n\n".join("\n".join(block) for block in blocks if block) + "\n"


def _lines(entries: dict[str, Any]) -> list[str]:
    return [f"{name} = {_value(entry)}" for name, entry in entries.items()]


def _value(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, str | bool):
        return json.dumps(value, ensure_ascii=False)
    return repr(float(value)) if isinstance(value, float) else str(value)
