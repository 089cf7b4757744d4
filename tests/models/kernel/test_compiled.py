"""Compiled functions are called by Python, by each other and by numba's."""

import importlib
import pickle
from concurrent.futures import ThreadPoolExecutor
from enum import IntEnum
from typing import Any, NamedTuple, cast

import numba
import numpy as np
import pytest
from numba.core.runtime.nrt import rtsys

from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.fork.function import CompiledFunction
from cointoss.models.kernel.fork.values import passed
from cointoss.models.kernel.vectors import add, apply


class Kind(IntEnum):
    ODD = 1


class Pair(NamedTuple):
    first: float
    second: float


@compiled
def squares(n):
    if n < 0:
        raise ValueError("fewer than none")
    return np.arange(n) ** 2.0


@compiled
def squares_from(pair, n, kind=Kind.ODD):
    found = squares(n)
    return found + pair.first, kind, "ab"[:1] == "a"


class Table(NamedTuple):
    scale: float
    numbers: np.ndarray


@compiled
def scaled_sum(n):
    table = Table(2.0, np.ones(n))
    for row in range(n):
        table = Table(table.scale, table.numbers + row)
    return table.scale * table.numbers.sum()


def test_a_function_of_records_has_one_name_in_every_process():
    """Where its callers were kept by a process that knew another name, they would call nothing."""

    def count(rows):
        return len(rows)

    function = CompiledFunction(count)
    rows = np.zeros(3, [("time", float), ("face", np.int8)])
    assert function(rows) == 3
    (description,) = (made.fndesc for made in function.dispatcher.overloads.values())
    kind: Any = numba.typeof(rows)
    assert "6RecordILi" in description.mangled_name
    assert f"6RecordILi{kind.dtype._code}E" not in description.mangled_name


def test_python_calls_a_function_with_what_it_calls():
    found, kind, same = squares_from(Pair(1.0, 2.0), 3)
    assert np.array_equal(found, [1, 2, 5])
    assert kind is Kind.ODD
    assert same
    assert np.array_equal(squares_from(n=2, pair=Pair(2.0, 2.0))[0], [2, 3])
    with pytest.raises(ValueError, match="fewer than none"):
        squares_from(Pair(1.0, 2.0), -1)


def test_no_references_are_counted_across_calls_that_cannot_fail():
    @compiled
    def double_first(numbers):
        numbers[0] *= 2
        return numbers[0]

    def sum_of_doubled(numbers):
        total = 0.0
        for _ in range(3):
            total += double_first(numbers) + double_first(numbers)
        return total

    summed = CompiledFunction(sum_of_doubled)
    assert summed(np.ones(1)) == 2 + 4 + 8 + 16 + 32 + 64
    given = passed((np.ones(1),))
    assert given is not None
    found = summed.dispatcher.machine_code(given, (np.ones(1),))
    assert b"sum_of_doubled" in found.code
    assert b"NRT_incref" not in found.code


@pytest.mark.parametrize(("compile_part", "calls"), [(compiled, True), (inlined, False)])
def test_an_inlined_function_is_never_called(compile_part, calls):
    """LLVM would call this one, which is long, from two places."""

    def part(x):
        for _ in range(3):
            for k in (1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0):
                x = np.sin(k * x) + np.exp(np.cos(x + k)) + np.log(1 + np.tan(x * x) ** 2)
        return x

    compiled_part = compile_part(part)

    def sum_of_two(x):
        return compiled_part(x) + compiled_part(x + 1)

    whole = CompiledFunction(sum_of_two)
    assert whole(0.5) == whole.dispatcher.from_python(0.5) == pytest.approx(part(0.5) + part(1.5))
    (found,) = whole.dispatcher.from_python.overloads.values()
    defined = [line for line in found.library.get_llvm_str().splitlines() if line.startswith("define")]
    assert any("4part" in line for line in defined) is calls


@compiled
def first_of_sum(numbers, others):
    if len(numbers) != len(others):
        raise ValueError("not as many")
    return (numbers + others)[0]


def test_numba_finds_our_functions_beside_their_machine_code():
    """Machine code of ours may expect other arguments: numba's callers must not find it by its name."""

    @compiled
    def of_one(numbers):
        return first_of_sum(numbers, numbers) + first_of_sum(numbers, numbers)

    @numba.njit
    def of_two(numbers, others):
        return first_of_sum(numbers, others)

    assert of_one(np.ones(2)) == 4.0
    assert of_two(np.ones(2), np.ones(2)) == 2.0


def test_what_numba_compiles_calls_our_functions():
    @numba.njit
    def plain(n):
        return squares_from(Pair(1.0, 0.0), n)[0].sum()

    signature: Any = numba.types.float64(numba.types.int64)

    @numba.cfunc(signature)
    def pointer(n):
        return squares_from(Pair(1.0, 0.0), n)[0].sum()

    assert plain(3) == pointer.ctypes(3) == 8.0


def test_code_that_lacks_what_it_calls_is_refused():
    def whole(numbers):
        return first_of_sum(numbers, numbers)

    function, numbers = CompiledFunction(whole), np.ones(2)
    function.dispatcher.compile((numba.typeof(numbers),))
    (made,) = function.dispatcher.overloads.values()
    called = made.library.callees.copy()
    made.library.callees.clear()
    for caller in (function, numba.njit(lambda numbers: function(numbers))):
        with pytest.raises(RuntimeError, match=r"calls .*first_of_sum.*remove the folders"):
            caller(numbers)
    made.library.callees += called
    assert function(numbers) == 2.0


def test_threads_compile_once():
    def third(x):
        return squares_from(Pair(x, x), 5)[0][2]

    slow = CompiledFunction(third)

    with ThreadPoolExecutor(8) as pool:
        assert set(pool.map(slow, [1.0] * 8)) == {5.0}
    assert slow.made == 1


def test_a_function_is_pickled_by_its_name():
    assert pickle.loads(pickle.dumps(add)) is add


def test_arrays_within_tuples_are_freed():
    by_numba = cast("Any", scaled_sum).dispatcher.from_python
    assert scaled_sum(3) == by_numba(3) == 2 * 3 * (1 + 0 + 1 + 2)
    counting = importlib.import_module("numba.core.runtime._nrt_python")
    counting.memsys_enable_stats()
    before = rtsys.get_allocation_stats()
    by_numba(3)
    after = rtsys.get_allocation_stats()
    counting.memsys_disable_stats()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free > 0


def test_a_swapped_argument_is_an_error_to_numba():
    v, M = (1.0, 2.0, 3.0), ((1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, 3.0))
    assert apply(M, v) == (1.0, 4.0, 9.0)
    with pytest.raises(numba.TypingError):
        apply(v, M)  # pyright: ignore[reportArgumentType]
