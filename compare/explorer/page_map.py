"""A map as the explorer's page reads it."""

from base64 import b64encode
from dataclasses import asdict
from typing import Any

import numpy as np

from cointoss.compare.sweep.layers import NOT_TOSSED
from cointoss.compare.sweep.tossed_map import TossedMap
from cointoss.compare.web.playable import shown_outcomes

MOST_SHOWN = 4_000_000
"""Pixels on the page: of a larger map every second, third, ..."""
_KINDS = {"outcome": "<i1", "impacts": "<i4", "margin": "<f4", "trusted_impacts": "<i4", "untrusted": "<i1"}


def page_map(found: TossedMap) -> dict[str, Any]:
    """Return a map as JSON; arrays row by row in base64, little-endian."""
    sweep = found.sweep
    margin = sweep.quantity if sweep.margin else None
    untrusted = {} if found.untrusted is None else {"untrusted": found.untrusted}
    return {
        "name": found.name,
        "title": sweep.title,
        "engine": sweep.engine.value,
        "after": sweep.after,
        "stride": found.stride,
        "tossed": float(np.mean(found.outcome != NOT_TOSSED)),
        "axes": {
            name: asdict(axis) | {"word": axis.word, "unit": axis.printed_unit}
            for name, axis in (("x", sweep.x), ("y", sweep.y))
        },
        "outcomes": shown_outcomes(),
        "margin": margin and {"along": margin.name, "unit": margin.unit},
        "arrays": {
            name: b64encode(array.astype(_KINDS[name]).tobytes()).decode("ascii")
            for name, array in (found.layers | untrusted).items()
            if name in _KINDS
        },
    }
