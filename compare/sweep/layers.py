"""The arrays of a map and of a store of tosses: types, attributes, and what they hold without a toss."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.axes import Axis
from cointoss.compare.sweep.grid import Sweep
from cointoss.models.answers import COLUMNS, NOT_TOSSED, REFUSED
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Outcome


class Layer(NamedTuple):
    """An array over the dimensions of a store."""

    kind: type[np.generic]
    fill_value: float
    attributes: dict[str, Any]


OF_TOSSES = {name: Layer(one.kind, one.missing, one.attributes) for name, one in COLUMNS.items()}
"""The answers of tosses."""
LAYERS = {name: Layer(one.kind, one.fill_value, {}) for name, one in OF_TOSSES.items()} | {
    "margin": Layer(np.float64, np.nan, {})
}
"""All that there may be, without their attributes, which depend on what is asked for."""


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
    return {name: LAYERS[name]._replace(attributes=about) for name, about in attributes.items()}


def trust_layer(after: int | None) -> str:
    """Return the name of the array that says which pixels can be trusted, of a map with this `after`."""
    return "outcome_certain" if after is None else "trusted_impacts"


def holds_tosses(name: str, values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where an array, by its name, holds what a toss gave."""
    if name == "outcome":
        return np.isin(values, [*Outcome, REFUSED])
    if name == "outcome_certain":
        return np.isin(values, (0, 1, REFUSED))
    if name == "margin":
        return ~np.isnan(values)
    if name == "end_time":  # NaN, too, of what is no scenario
        return np.ones(values.shape, dtype=bool)
    return (values >= 0) | (values == REFUSED)


def bytes_per_pixel(sweep: Sweep) -> int:
    """Return what a pixel of a sweep's map takes on disk, before compression."""
    return sum(np.dtype(layer.kind).itemsize for layer in layers_of(sweep).values())


def axis_attributes(axis: Axis) -> dict[str, Any]:
    """Return the attributes of an axis, from which plots take its label."""
    return {"long_name": axis.word, "units": axis.unit}
