"""The answers of a batch as a dataset of xarray: codes or words over named dimensions."""

import json
from collections.abc import Mapping
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.batch import Batch, Varied, attributes_of
from cointoss.compare.sweep.pieces import How
from cointoss.models.answers import COLUMNS
from cointoss.models.scenario import Scenario

if TYPE_CHECKING:
    import xarray as xr


def dataset_of(batch: Batch, how: How, answers: Mapping[str, NDArray[Any]]) -> "xr.Dataset":
    """Return the answers of a batch, its codes in words, with the values of what varies as coordinates.

    Args:
        batch: that was tossed.
        how: it was.
        answers: by name, over the dimensions of the batch.
    """
    import xarray

    from cointoss.compare.sweep import accessor  # registers `Dataset.cointoss`

    dims = tuple(batch.sizes)
    variables = {
        name: (
            dims,
            array,
            {key: value for key, value in COLUMNS[name].attributes.items() if key != "flag_values"},
        )
        for name, array in answers.items()
    }
    coordinates = {one.field: _coordinate(one, batch.scenario) for one in batch.varied}
    made = xarray.Dataset(variables, coordinates, about(batch, how))
    return accessor.in_words(made)


def _coordinate(one: Varied, described: Scenario) -> tuple[Any, ...]:
    """Return the dimensions of a field that varies, its values, words as such, and attributes."""
    attributes = attributes_of(one, described)
    if one.words is None:
        return one.dims, one.values, attributes
    words = np.array([one.words[code] for code in one.values.ravel().tolist()]).reshape(one.values.shape)
    return one.dims, words, {"long_name": attributes["long_name"]}


def about(batch: Batch, how: How) -> dict[str, Any]:
    """Return what made the answers: the scenario, the engine, its settings and the versions."""
    return {
        "scenario": batch.scenario.to_toml(),
        "engine": how.engine.value,
        "engine_settings": json.dumps(how.settings.as_dict()),
        "trust": how.trust or "",
        "law": "" if how.law is None else how.law.name,
        "versions": json.dumps({**how.engine.versions, "xarray": version("xarray")}),
    }
