"""The arrays of a map: their types, their attributes, and what they hold where no toss was made."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.grid import Sweep
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Outcome

NOT_TOSSED = -1
"""What `outcome` and the counts hold where no toss was made yet."""
LAYERS: dict[str, tuple[type[np.number], float]] = {
    "outcome": (np.int8, NOT_TOSSED),
    "impacts": (np.int32, NOT_TOSSED),
    "margin": (np.float64, np.nan),
    "trusted_impacts": (np.int32, NOT_TOSSED),
    "outcome_certain": (np.int8, NOT_TOSSED),
}
"""Types of the arrays over both axes, and what they hold where no toss was made."""


class Layer(NamedTuple):
    """An array of a map."""

    kind: type[np.number]
    fill_value: float
    attributes: dict[str, Any]


def layers_of(sweep: Sweep) -> dict[str, Layer]:
    """Return the arrays of a sweep's map, by name."""
    meanings = meanings_of({NOT_TOSSED: "not_tossed", **Outcome.by_value()})
    attributes = {
        "outcome": {"long_name": "outcome", **meanings},
        "impacts": {"long_name": "number of impacts"},
    }
    if sweep.margin is not None:
        found = f"smallest change of the release's {sweep.margin} that was found to change the outcome"
        about = f"{found}; infinite: none up to 1 SI unit"
        attributes["margin"] = {"long_name": about, "units": sweep.quantity.unit}
    if sweep.trust and sweep.after is not None:
        upto = f"up to touch {sweep.after + 1}"
        about = f"number of leading impacts {upto} that the engine's own errors cannot have changed"
        attributes["trusted_impacts"] = {"long_name": about}
    elif sweep.trust:
        meanings = meanings_of({NOT_TOSSED: "not_tossed", 0: "uncertain", 1: "certain"})
        about = "whether the engine's own errors cannot change the outcome"
        attributes["outcome_certain"] = {"long_name": about, **meanings}
    return {name: Layer(*LAYERS[name], about) for name, about in attributes.items()}


def trust_layer(after: int | None) -> str:
    """Return the name of the array that says which pixels can be trusted, of a map with this `--after`."""
    return "outcome_certain" if after is None else "trusted_impacts"


def holds_tosses(name: str, values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where an array of a map, by its name, holds what a toss gave."""
    if name == "outcome":
        return np.isin(values, list(Outcome))
    if name == "outcome_certain":
        return np.isin(values, (0, 1))
    return ~np.isnan(values) if name == "margin" else values >= 0


def bytes_per_pixel(sweep: Sweep) -> int:
    """Return what a pixel of a sweep's map takes on disk, before compression."""
    return sum(np.dtype(layer.kind).itemsize for layer in layers_of(sweep).values())


def axis_attributes(axis: Axis) -> dict[str, Any]:
    """Return the attributes of an axis, from which plots take its label."""
    return {"long_name": axis.word, "units": axis.unit}
