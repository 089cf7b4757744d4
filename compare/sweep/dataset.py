"""The answers of a batch as a dataset of xarray: codes or words over named dimensions."""

import json
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

import xarray as xr
from numpy.typing import NDArray

from cointoss.compare.sweep.batch import Batch
from cointoss.compare.sweep.pieces import How
from cointoss.compare.sweep.words import in_words
from cointoss.models.answers import COLUMNS


def dataset_of(batch: Batch, how: How, answers: Mapping[str, NDArray[Any]]) -> xr.Dataset:
    """Return the answers of a batch, its codes in words, with the values of what varies as coordinates.

    Args:
        batch: that was tossed.
        how: it was.
        answers: by name, over the dimensions of the batch.
    """
    about = {
        "scenario": batch.scenario.to_toml(),
        "engine": how.engine.value,
        "engine_settings": json.dumps(how.settings.as_dict()),
        "trust": how.trust or "",
        "law": "" if how.law is None else how.law.name,
        **how.processor.attributes,
        "versions": json.dumps({**how.engine.versions, "xarray": version("xarray")}),
    }
    variables = {
        name: (tuple(batch.sizes), array, COLUMNS[name].attributes) for name, array in answers.items()
    }
    return in_words(xr.Dataset(variables, batch.coordinates, about))
