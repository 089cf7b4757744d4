"""How values of Python pass to machine code and back: as rows of 8-byte numbers.

A number is one of them, an enum's member its integer, a tuple its parts one after the other. An array is its
address, size and shape, as numba holds it.
"""

import ctypes
from collections.abc import Iterator, Sequence
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

_LIMIT = 2**63
_MOST_REMEMBERED = 64


class Passed(NamedTuple):
    """Arguments of a call."""

    key: str
    """The types of the arguments, in words: one text for each kind of machine code."""
    form: str
    """The form of the numbers, as `struct` reads it."""
    numbers: list[Any]


class Returned(NamedTuple):
    """A kind of values that machine code returns."""

    kind: str
    """"number", "bool", "none", "enum", "tuple" or "array"."""
    form: str
    """The form of its numbers, as `struct` reads it."""
    of: Any = None
    """The class of an enum or of a named tuple, or the dtype of an array."""
    parts: tuple["Returned", ...] = ()
    dimensions: int = 0


def passed(arguments: Sequence[Any]) -> Passed | None:
    """Return the arguments as numbers, or None where there is one that this module does not know."""
    keys, form, numbers = [], [], []
    for argument in arguments:
        simple = _SIMPLE.get(type(argument))
        if simple is not None:
            key, one = simple
            if key == "int" and not -_LIMIT <= argument < _LIMIT:
                return None
            numbers.append(argument)
        else:
            whole = _passed(argument)
            if whole is None:
                return None
            key, one, more = whole
            numbers += more
        keys.append(key)
        form.append(one)
    return Passed(";".join(keys), "".join(form), numbers)


_SIMPLE = {
    float: ("float", "d"),
    np.float64: ("float", "d"),
    int: ("int", "q"),
    np.int64: ("int", "q"),
    bool: ("bool", "q"),
}
"""Types of which a value is one number: itself."""
_remembered: dict[int, tuple[Any, Passed]] = {}
"""By its address, each named tuple whose parts cannot change: a toss passes the same coin again and again."""
_dtype_names: dict[int, tuple[np.dtype[Any], str | None]] = {}


def _passed(value: Any) -> Passed | None:
    if isinstance(value, tuple):
        return _tuple(value)
    if type(value) is np.ndarray:
        return _array(value)
    if isinstance(value, IntEnum):
        return Passed(_name(type(value)), "q", [value.value])
    if isinstance(value, np.bool_):
        return Passed("bool", "q", [bool(value)])
    return Passed("None", "q", [0]) if value is None else None


def _tuple(value: tuple[Any, ...]) -> Passed | None:
    known = _remembered.get(id(value))
    if known is not None and known[0] is value:
        return known[1]
    whole = passed(value)
    if whole is None:
        return None
    fields = getattr(value, "_fields", None)
    if fields is None:
        return whole._replace(key=f"({whole.key})")
    whole = whole._replace(key=f"{_name(type(value))}{fields}({whole.key})")
    if "-array of" not in whole.key:
        _remember(_remembered, value, whole)
    return whole


def _array(value: np.ndarray[Any, Any]) -> Passed | None:
    name, flags = _dtype_name(value.dtype), value.flags
    if name is None or value.ndim == 0 or not (flags.c_contiguous and flags.aligned):
        return None
    numbers = [0, 0, value.size, value.itemsize, value.ctypes.data, *value.shape, *value.strides]
    key = f"{value.ndim}-array of {name}{'' if flags.writeable else ', read-only'}"
    return Passed(key, "q" * len(numbers), numbers)


def _dtype_name(dtype: np.dtype[Any]) -> str | None:
    """Return a text for a dtype of numbers or of records of numbers, None for others."""
    known = _dtype_names.get(id(dtype))
    if known is not None and known[0] is dtype:
        return known[1]
    is_known = dtype.isnative and (dtype.kind in "fib" or dtype.names is not None) and not dtype.hasobject
    name = str(dtype) if is_known else None
    _remember(_dtype_names, dtype, name)
    return name


def _remember(known: dict[int, tuple[Any, Any]], value: Any, about: Any) -> None:
    """Remember something of a value that cannot change; kept with it, its address stays its own."""
    if len(known) >= _MOST_REMEMBERED:
        known.clear()
    known[id(value)] = value, about


def _name(kind: type) -> str:
    return f"{kind.__module__}.{kind.__qualname__}"


def returned(kind: Returned, numbers: Iterator[Any], arguments: Sequence[Any]) -> Any:
    """Return the value of some kind that machine code has returned.

    Args:
        kind: of the value.
        numbers: those returned; as many are taken as the kind has.
        arguments: of the call: an array among them may be returned.
    """
    if kind.kind == "tuple":
        parts = [returned(part, numbers, arguments) for part in kind.parts]
        return tuple(parts) if kind.of is None else kind.of(*parts)
    if kind.kind == "array":
        return _returned_array(kind, [next(numbers) for _ in kind.form], arguments)
    number = next(numbers)
    if kind.kind == "enum":
        return kind.of(number)
    if kind.kind == "bool":
        return bool(number)
    return None if kind.kind == "none" else number


def _returned_array(kind: Returned, numbers: list[int], arguments: Sequence[Any]) -> np.ndarray[Any, Any]:
    counted, _, _, _, address = numbers[:5]
    shape = tuple(numbers[5 : 5 + kind.dimensions])
    if not counted:  # no memory of its own: an argument's, or a constant's
        for argument in _arrays(arguments):
            offset = address - argument.ctypes.data
            if offset == 0 and argument.shape == shape and argument.dtype == kind.of:
                return argument
            if 0 <= offset < argument.nbytes:
                return np.ndarray(shape, kind.of, argument.data, offset)
    array = np.empty(shape, kind.of)
    ctypes.memmove(array.ctypes.data, address, array.nbytes)
    if counted:
        _release(counted)
    return array


def _arrays(values: Sequence[Any]) -> Iterator[np.ndarray[Any, Any]]:
    for value in values:
        if isinstance(value, np.ndarray):
            yield value
        elif isinstance(value, tuple):
            yield from _arrays(value)


def _release(address: int) -> None:
    """Give back memory of which machine code has counted the references: see `entry.MEMORY`."""
    references = ctypes.c_size_t.from_address(address)
    references.value -= 1
    if references.value == 0:
        _free(address)


_free = ctypes.CDLL(None).free
_free.argtypes, _free.restype = [ctypes.c_void_p], None
