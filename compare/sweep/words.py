"""The words of a dataset and the codes that stand for them in files."""

from collections.abc import Hashable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from cointoss.models.answers import COLUMNS, NOT_TOSSED

if TYPE_CHECKING:
    import xarray as xr

WORDED = {name: column.words for name, column in COLUMNS.items() if column.words is not None}
"""The variables that are words in memory and codes in files, with what their codes mean."""


def words_of(name: str, codes: NDArray[Any]) -> NDArray[np.str_]:
    """Return the codes of a variable in words, of NumPy's strings, of any shape; words as they are."""
    if codes.dtype.kind in "UTO":
        return codes.astype(str)
    known = WORDED[name]
    first = min(known)
    words = np.array([known.get(code, "") for code in range(first, max(known) + 1)])
    return words[codes.astype(np.intp) - first]


def codes_of(name: str, words: NDArray[Any]) -> NDArray[Any]:
    """Return the words of a variable as codes, of any shape; codes as they are."""
    kind = COLUMNS[name].kind if name in COLUMNS else words.dtype
    if words.dtype.kind not in "UTO":
        return words.astype(kind)
    known = {word: code for code, word in WORDED[name].items()}
    each, inverse = np.unique(words.astype(str), return_inverse=True)
    # What xarray puts where there was nothing, as after `where`, is no toss.
    codes = np.array([known.get(word, NOT_TOSSED) for word in each.tolist()], dtype=kind)
    return codes[inverse].reshape(words.shape)


def in_codes(dataset: "xr.Dataset") -> "xr.Dataset":
    """Return a dataset whose words are codes, which CF's attributes `flag_values` explain."""
    return dataset.assign(
        {
            name: (dataset[name].dims, codes_of(name, dataset[name].values), column.attributes)
            for name, column in COLUMNS.items()
            if name in dataset
        }
    )


def in_words(dataset: "xr.Dataset") -> "xr.Dataset":
    """Return a dataset whose codes are words, those of coordinates too; attributes explain no codes then."""
    new: dict[Hashable, Any] = {
        name: (dataset[name].dims, words_of(name, dataset[name].values), {"long_name": about["long_name"]})
        for name, about in ((name, COLUMNS[name].attributes) for name in WORDED)
        if name in dataset
    }
    if (certain := dataset.get("outcome_certain")) is not None:
        new["outcome_certain"] = certain.copy(data=certain.values == 1)
    for name, one in dataset.coords.items():
        if "flag_values" in one.attrs and one.dtype.kind in "iuf":
            known = dict(zip(one.attrs["flag_values"], one.attrs["flag_meanings"].split(), strict=True))
            words = np.array([known[int(code)] for code in one.values.ravel()]).reshape(one.shape)
            new[name] = (one.dims, words, {"long_name": one.attrs["long_name"]})
    return dataset.assign(new)
