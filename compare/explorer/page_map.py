"""A map as the explorer's page reads it."""

from base64 import b64encode
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from cointoss.compare.sweep.maps import asked_of, axes_of, layers_in, title_of, untrusted_in
from cointoss.compare.web.playable import shown_outcomes
from cointoss.models.answers import NOT_TOSSED

if TYPE_CHECKING:
    import xarray as xr

MOST_SHOWN = 4_000_000
"""Pixels on the page: of a larger map every second, third, ..."""
_KINDS = {"outcome": "<i1", "impacts": "<i4", "margin": "<f4", "trusted_impacts": "<i4", "untrusted": "<i1"}


def page_map(found: "xr.Dataset", name: str) -> dict[str, Any]:
    """Return a map of this name as JSON; arrays row by row in base64, little-endian."""
    (_, how), layers, (y, x) = asked_of(found), layers_in(found), axes_of(found)
    untrusted = untrusted_in(found)
    return {
        "name": name,
        "title": title_of(found),
        "engine": how.engine.value,
        "after": how.after,
        "stride": int(found.attrs.get("stride", 1)),
        "tossed": float(np.mean(layers["outcome"] != NOT_TOSSED)),
        "axes": {
            side: asdict(axis) | {"word": axis.word, "unit": axis.printed_unit}
            for side, axis in (("x", x), ("y", y))
        },
        "outcomes": shown_outcomes(),
        "margin": how.margin and {"along": how.margin, "unit": how.quantity.unit},
        "arrays": {
            layer: b64encode(array.astype(_KINDS[layer]).tobytes()).decode("ascii")
            for layer, array in (layers | ({} if untrusted is None else {"untrusted": untrusted})).items()
            if layer in _KINDS
        },
    }
