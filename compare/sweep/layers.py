"""The arrays of a map and of a store of tosses: types, attributes, and what they hold without a toss."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import COLUMNS, NOT_TOSSED, REFUSED, AnswerColumn
from cointoss.models.labelled import meanings_of
from cointoss.models.records import Outcome

LAYERS = {**COLUMNS, "margin": AnswerColumn(kind=np.float64, attributes={}, missing=np.nan)}
"""All arrays that there may be; what the attributes of a map's say depends on what is asked for."""


def map_layers(how: How) -> dict[str, AnswerColumn]:
    """Return the arrays of a map that is tossed so, by name."""
    attributes = {
        "outcome": {
            "long_name": "outcome",
            **meanings_of({NOT_TOSSED: "not_tossed", **Outcome.by_value()}),
        },
        "impacts": {"long_name": "number of impacts"},
    }
    if how.margin is not None:
        found = f"smallest change of the release's {how.margin} that was found to change the outcome"
        about = f"{found}; infinite: none up to 1 SI unit"
        attributes["margin"] = {"long_name": about, "units": how.quantity.unit}
    if how.trust and how.after is not None:
        about = f"number of leading impacts up to touch {how.after + 1} that the engine's own errors cannot"
        attributes["trusted_impacts"] = {"long_name": f"{about} have changed"}
    elif how.trust:
        attributes["outcome_certain"] = {
            "long_name": "whether the engine's own errors cannot change the outcome",
            **meanings_of({NOT_TOSSED: "not_tossed", 0: "uncertain", 1: "certain"}),
        }
    return {name: replace(LAYERS[name], attributes=about) for name, about in attributes.items()}


def trust_layer(after: int | None) -> str:
    """Return the name of the array that says which pixels can be trusted, of a map with this `after`."""
    return "outcome_certain" if after is None else "trusted_impacts"


def is_untrusted(after: int | None, trust: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Return where the engine's own errors may have decided the face or the outcome, in any shape.

    The face at touch n + 1 can be trusted where n + 1 impacts can. Where the toss ended before, its outcome
    is shown, which depends on more than its impacts: there it is not trusted. A final outcome can be trusted
    where it is certain.

    Args:
        after: n of the map; None where it shows final outcomes.
        trust: its `trust_layer`; below 0 where no toss was made yet.
    """
    return (trust >= 0) & (trust <= (after or 0))


def holds_tosses(name: str, values: NDArray[Any]) -> NDArray[np.bool_]:
    """Return where an array, by its name, holds what a toss gave."""
    if name == "margin":
        return ~np.isnan(values)
    if name == "end_time":  # NaN, too, of what is no scenario
        return np.ones(values.shape, dtype=bool)
    known = {"outcome": [*Outcome], "outcome_certain": [0, 1]}.get(name)
    return (values == REFUSED) | (values >= 0 if known is None else np.isin(values, known))
