"""Arrays of numbers in compiled code."""

from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.compiled import compiled

Array = NDArray[np.float64]
Row = Annotated[NDArray[np.float64], 1]
"""An array of one axis, which an engine's library takes."""
Table = Annotated[NDArray[np.float64], 2]
Cube = Annotated[NDArray[np.float64], 3]
Codes = Annotated[NDArray[np.int8], 1]
Counts = Annotated[NDArray[np.int32], 1]
Flags = Annotated[NDArray[np.bool_], 1]


@compiled
def copy_into(target: Array, source: Array | tuple[float, ...]) -> None:
    """Copy as many numbers as `target` has from `source`, an array or a tuple.

    In compiled code `target[:] = source` costs seconds of compiling, for the text of an error.
    """
    for i in range(len(target)):
        target[i] = source[i]


@compiled
def three(row: Array | tuple[float, ...], first: int) -> tuple[float, float, float]:
    """Return three numbers of a row."""
    return row[first], row[first + 1], row[first + 2]


@compiled
def four(row: Array | tuple[float, ...], first: int) -> tuple[float, float, float, float]:
    """Return four numbers of a row."""
    return row[first], row[first + 1], row[first + 2], row[first + 3]


@compiled
def doubled(table: Array) -> Array:
    """Return the table with twice its rows."""
    larger = np.empty((2 * len(table), table.shape[1]))
    for i in range(len(table)):
        copy_into(larger[i], table[i])
    return larger
