"""What Python passes to machine code, and what it gets back, is what numba passes and returns."""

import resource
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
import pytest

from cointoss.models.kernel.fork.function import CompiledFunction
from cointoss.models.kernel.fork.values import passed

ROW = np.dtype([("time", float), ("face", np.int8), ("point", float, 3)], align=True)
ROWS = np.zeros(3, ROW)
ROWS["face"] = 1, -1, 7
READ_ONLY = np.arange(3.0)
READ_ONLY.flags.writeable = False


class Kind(IntEnum):
    EVEN = 2
    ODD = 3


class Inner(NamedTuple):
    exponent: float | None
    kind: Kind


class Outer(NamedTuple):
    inner: Inner
    vector: tuple[float, float, float]
    number: int


WHOLE = Outer(Inner(None, Kind.ODD), (1.0, 2.0, 3.0), -7)


def same(value):
    return value


def compiled_same():
    """Return a function that nothing has called yet."""
    return CompiledFunction(same)


def equal(one, other):
    if isinstance(one, np.ndarray):
        assert one.dtype == other.dtype
        return np.array_equal(one, other)
    if isinstance(one, tuple):
        return type(one) is type(other) and all(map(equal, one, other))
    return type(one) is type(other) and one == other


@pytest.mark.parametrize(
    "value",
    [
        *(1.5, np.float64(-0.0), np.inf, 7, -(2**63), 2**63 - 1, np.int64(-3), True, np.True_, None),
        *(Kind.EVEN, WHOLE, WHOLE._replace(inner=Inner(0.5, Kind.EVEN)), (), (1, 2.0, (True, None))),
        *(np.arange(3.0), np.zeros((2, 3)), np.arange(3), np.array([True, False]), ROWS, READ_ONLY),
        np.zeros((0, 3)),
    ],
    ids=repr,
)
def test_machine_code_returns_what_numba_returns(value):
    function = compiled_same()
    answer = function(value)
    assert function.made == 1, "without numba's wrapper"
    assert equal(answer, function.dispatcher.from_python(value))
    if isinstance(value, np.ndarray):
        assert answer is value


@pytest.mark.parametrize(
    "value",
    ["text", np.zeros((4, 4))[:, 0], 1j, np.float32(1.5), np.zeros(3, np.complex128), 2**63],
    ids=repr,
)
def test_what_machine_code_does_not_take_numba_passes(value):
    function = compiled_same()
    assert equal(function(value), function.dispatcher.from_python(value))
    assert function.made == 0


def test_each_type_of_arguments_has_machine_code_of_its_own():
    unlike: list[Any] = [
        *(1.0, 1, True, None, Kind.ODD, (1.0,), (1.0, 1.0), ((1.0,), 1.0), Inner(1.0, Kind.ODD)),
        *(np.zeros(1), np.zeros((1, 1)), np.zeros(1, int), np.zeros(1, np.int8), ROWS, READ_ONLY, ()),
    ]
    keys = [known.key for known in map(passed, [(value,) for value in unlike]) if known is not None]
    assert len(set(keys)) == len(unlike)
    alike = [passed((value,)) for value in (Outer(Inner(None, Kind.EVEN), (0.0, 0.0, 0.0), 1), WHOLE)]
    assert len({known.key for known in alike if known is not None}) == 1


def test_a_part_of_an_argument_is_returned_as_one():
    function, numbers = CompiledFunction(lambda x: x[1:]), np.arange(4.0)
    part = function(numbers)
    part[0] = 9.0
    assert numbers[1] == 9.0
    assert CompiledFunction(lambda pair: pair[1])((1.0, numbers)) is numbers


def test_arrays_that_are_returned_are_freed():
    filled, size = CompiledFunction(lambda n: (np.ones(n), np.ones(n).reshape(-1, 1))), 1_000_000
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(200):
        numbers, column = filled(size)
        assert numbers[-1] == column[-1, 0] == 1.0
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 200 * 8 * size / 1024 / 4


def test_an_error_is_raised_as_it_was_written():
    def root(x):
        if x < 0:
            raise FloatingPointError("of a negative number")
        return x**0.5

    function = CompiledFunction(root)
    assert function(4.0) == function(x=4.0) == 2.0
    with pytest.raises(FloatingPointError, match=r"^of a negative number$"):
        function(-1.0)
    with pytest.raises(TypeError):
        function(1.0, 2.0)


def test_defaults_and_names_take_their_places():
    def weighted(x, y=2.0, z=3.0):
        return x + 10 * y + 100 * z

    function = CompiledFunction(weighted)
    assert (function(1.0), function(1.0, z=0.0), function(1.0, 1.0, 1.0)) == (321.0, 21.0, 111.0)
