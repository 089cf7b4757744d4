"""Four numbers side by side in one vector of the processor, for compiled functions that else take one.

To numba the vector is a number: its sums, products, quotients, roots and comparisons are those of each lane
by itself, so that a lane gets what its number would get alone, to the bit. A function that is to take either
chooses between two numbers by `where`, `min` and `max`, since the lanes may choose differently.
"""

from typing import Any

import numpy as np

from cointoss.models.kernel.compiled import ForCompiledCode

WIDTH = 4
Lanes = Any
"""A vector; where Python runs a function, an array of numpy's."""


def _of_numba(name: str) -> Any:
    """Return what makes an intrinsic of numba's."""

    def make() -> Any:
        from cointoss.models.kernel import vector_type

        return getattr(vector_type, name)

    return make


def _write(table: Any, row: int, column: int, a: Any) -> None:
    table[row, column : column + WIDTH] = a


where = ForCompiledCode(_of_numba("where"), lambda condition, a, b: a if condition else b)
"""Return a where a condition holds, else b: of two numbers, or in each lane; (condition, a, b)."""
in_lanes = ForCompiledCode(_of_numba("in_lanes"))
"""Return an array whose last axis has four numbers as an array of vectors; (array)."""
four = ForCompiledCode(_of_numba("four"), lambda *numbers: np.array(numbers))
"""Return a vector of four numbers."""
read_four = ForCompiledCode(_of_numba("read_four"), lambda table, i, j: table[i, j : j + WIDTH].copy())
"""Return four numbers of a row of a table, from a column on, as a vector; (table, row, column)."""
write_four = ForCompiledCode(_of_numba("write_four"), _write)
"""Set what `read_four` returns; (table, row, column, vector)."""
