"""Arrays of numbers in compiled code."""

import numpy as np
from numpy.typing import NDArray

from cointoss.models.kernel.compiled import compiled

Array = NDArray[np.float64]


@compiled
def copy_into(target: Array, source: Array | tuple[float, ...]) -> None:
    """Copy as many numbers as `target` has from `source`, an array or a tuple.

    In compiled code `target[:] = source` costs seconds of compiling, for the text of an error.
    """
    for i in range(len(target)):
        target[i] = source[i]
