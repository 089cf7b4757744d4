"""numba's type of a vector, as numba keeps it with compiled code."""

import pickle

from numba.core.serialize import dumps

from cointoss.models.kernel.vector_type import NUMBERS


def test_another_process_reads_the_same_type():
    assert b"vector_type" in dumps(NUMBERS)
    assert pickle.loads(dumps(NUMBERS)) is NUMBERS
