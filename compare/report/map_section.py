"""What a report shows of the outcome maps of both engines."""

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, kw_only=True)
class MapSection:
    """Maps over two fields of the scenario, one by each engine, and how far they agree."""

    picture: bytes
    """PNG: the map by the analytic engine, that by MuJoCo, and where they differ."""
    numbers: dict[str, Any]
    """The dictionary `map` of numbers.json: `axes`, `after`, `fractions` and `settings` by engine,
    `agreement`, the share that is `untrusted` by the analytic engine or None, and the `command` that makes
    the maps again."""
