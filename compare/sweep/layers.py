"""The arrays of a map: their types, their attributes, and what they hold where no toss was made."""

from typing import Any, NamedTuple

import numpy as np

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.grid import Sweep
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Outcome

NOT_TOSSED = -1
"""What `outcome` and `impacts` hold where no toss was made yet."""
NO_MARGIN = float("nan")
"""What `margin` holds there."""


class Layer(NamedTuple):
    """An array of a map."""

    kind: type[np.number]
    fill_value: float
    attributes: dict[str, Any]


def layers_of(sweep: Sweep) -> dict[str, Layer]:
    """Return the arrays of a sweep's map, by name."""
    meanings = meanings_of({NOT_TOSSED: "not_tossed", **Outcome.by_value()})
    layers = {
        "outcome": Layer(np.int8, NOT_TOSSED, {"long_name": "outcome", **meanings}),
        "impacts": Layer(np.int32, NOT_TOSSED, {"long_name": "number of impacts"}),
    }
    if sweep.margin is None:
        return layers
    from cointoss.compare.metrics.margin import quantity_of

    found = f"smallest change of the release's {sweep.margin} that was found to change the outcome"
    attributes = {"long_name": f"{found}; infinite: none up to 1 SI unit"}
    units = quantity_of(sweep.margin).unit
    return {**layers, "margin": Layer(np.float64, NO_MARGIN, {**attributes, "units": units})}


def bytes_per_pixel(sweep: Sweep) -> int:
    """Return what a pixel of a sweep's map takes on disk, before compression."""
    return sum(np.dtype(layer.kind).itemsize for layer in layers_of(sweep).values())


def axis_attributes(axis: Axis) -> dict[str, Any]:
    """Return the attributes of an axis, from which plots take its label."""
    return {"long_name": axis.word, "units": axis.unit}
