"""How values pass between Python and an engine's library: as rows of 8-byte numbers, by their annotations.

A number is one of them, an enum's member its integer, a tuple its parts one after the other. An array is its
address, its size and its shape, as numba holds it.
"""

import ctypes
import types as python_types
from collections.abc import Callable, Iterator
from enum import IntEnum
from functools import cache
from typing import Annotated, Any, NamedTuple, Union, get_args, get_origin, get_type_hints

import numpy as np


class ValueKind(NamedTuple):
    """A kind of values."""

    form: str
    """The form of its numbers, as `struct` reads it."""
    of: Any = None
    """float, int, bool or an enum; a tuple's class; an array's dtype."""
    parts: "tuple[ValueKind, ...]" = ()
    """The kinds of a tuple's parts."""
    dimensions: int = 0
    """The number of an array's dimensions."""
    may_lack: bool = False
    """Whether the number may be None, for which numba compiles apart."""


NOTHING = ValueKind("")
"""The kind of what returns None."""


def kinds_of(function: Callable[..., Any]) -> tuple[tuple[ValueKind, ...], ValueKind]:
    """Return the kinds of a function's arguments and that of what it returns.

    Raises:
        TypeError: for an annotation that is none of the kinds.
    """
    *given, (_, returned) = get_type_hints(function, include_extras=True).items()
    return tuple(kind_of(hint) for _, hint in given), kind_of(returned)


@cache
def kind_of(hint: Any) -> ValueKind:
    """Return the kind that an annotation means.

    Raises:
        TypeError: for one that is none.
    """
    if hint is type(None):
        return NOTHING
    if hint is float:
        return ValueKind("d", float)
    if isinstance(hint, type) and issubclass(hint, int):
        return ValueKind("q", hint)
    if get_origin(hint) is Annotated:  # of an enum as its integer, or of an array
        array, dimensions = get_args(hint)
        if dimensions is int:
            return ValueKind("q", int)
        # NumPy means by it ndarray[shape, dtype[number]]; since 2.5 it is an alias of the number alone.
        (number,) = get_args(get_args(array)[-1]) or get_args(array)
        n, dtype = (1, dimensions.dtype) if isinstance(dimensions, Rows) else (dimensions, np.dtype(number))
        return ValueKind("q" * (5 + 2 * n), dtype, dimensions=n)
    if get_origin(hint) in (Union, python_types.UnionType) and set(get_args(hint)) == {float, type(None)}:
        return ValueKind("d", float, may_lack=True)
    if get_origin(hint) is tuple:
        return _tuple(tuple, get_args(hint))
    if isinstance(hint, type) and issubclass(hint, tuple):
        return _tuple(hint, get_type_hints(hint, include_extras=True).values())
    raise TypeError(f"{hint}: no kind of rows of numbers")


class Rows(NamedTuple):
    """Marks an annotation of an array of records, one axis."""

    dtype: np.dtype[Any]


def _tuple(of: type, hints: Any) -> ValueKind:
    parts = tuple(map(kind_of, hints))
    return ValueKind("".join(part.form for part in parts), of, parts)


def may_lack(kind: ValueKind) -> bool:
    """Return whether a number of such a value may be None."""
    return kind.may_lack or any(map(may_lack, kind.parts))


def write(kind: ValueKind, value: Any, form: list[str], numbers: list[Any]) -> bool:
    """Append a value's numbers and their form; return whether it lacks a number that may be None.

    Raises:
        TypeError: for what is no tuple where one is due, and an array of another dtype or number of axes, or
            one that is not contiguous.
    """
    if kind.parts:
        if not isinstance(value, tuple):
            raise TypeError(f"a {type(value).__name__}; accepted: a tuple")
        lacking = [write(part, one, form, numbers) for part, one in zip(kind.parts, value, strict=True)]
        return any(lacking)
    if kind.dimensions:
        flags = value.flags
        if not (
            value.dtype == kind.of and value.ndim == kind.dimensions and flags.c_contiguous and flags.aligned
        ):
            raise TypeError(
                f"an array of {value.dtype}, shape {value.shape}, strides {value.strides}; "
                f"accepted: {kind.of}, of {kind.dimensions} axes, contiguous"
            )
        numbers += [0, 0, value.size, value.itemsize, value.ctypes.data, *value.shape, *value.strides]
    elif value is None and kind.may_lack:
        form.append("q")
        numbers.append(0)
        return True
    else:
        numbers.append(value)
    form.append(kind.form)
    return False


def read(kind: ValueKind, numbers: Iterator[Any], release: Callable[[int], object]) -> Any:
    """Return a value of its numbers; an array is copied, and its own memory given back by `release`."""
    if kind.parts:
        parts = [read(part, numbers, release) for part in kind.parts]
        return tuple(parts) if kind.of is tuple else kind.of(*parts)
    if kind.dimensions:
        return _read_array(kind, [next(numbers) for _ in kind.form], release)
    if not kind.form:
        return None
    number = next(numbers)
    return kind.of(number) if kind.of is bool or issubclass(kind.of, IntEnum) else number


def _read_array(kind: ValueKind, numbers: list[int], release: Callable[[int], object]) -> Any:
    counted, _, _, _, address = numbers[:5]
    array = np.empty(tuple(numbers[5 : 5 + kind.dimensions]), kind.of)
    ctypes.memmove(array.ctypes.data, address, array.nbytes)
    if counted:
        release(counted)
    return array
