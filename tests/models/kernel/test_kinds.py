"""The kinds of rows of numbers, by the annotations that mean them."""

from typing import Annotated, Any, TypeVar

import numpy as np
import pytest
from numpy.typing import NDArray
from typing_extensions import TypeAliasType

from cointoss.models.kernel.kinds import ValueKind, kind_of

Number = TypeVar("Number", bound=np.generic)
Alias = TypeAliasType("Alias", "np.ndarray[Any, np.dtype[Number]]", type_params=(Number,))
"""An array's hint as NumPy writes it since 2.5."""


@pytest.mark.parametrize("hint", [np.ndarray[Any, np.dtype[np.int32]], NDArray[np.int32], Alias[np.int32]])
def test_an_array_is_one_of_its_numbers_however_numpy_writes_its_hint(hint):
    assert kind_of(Annotated[hint, 2]) == ValueKind("q" * 9, np.dtype(np.int32), dimensions=2)
