"""Machine code that Python calls without numba, whose import takes longer than a toss."""

import ctypes
import os
import pickle
import struct
import sys
import threading
from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple

import llvmlite
from llvmlite import binding

from cointoss.models.kernel.fork.values import Returned, returned

_loading = threading.Lock()


class Kept(NamedTuple):
    """Machine code of one function for one kind of arguments, as it is kept on disk."""

    name: str
    """Of its entry, which no other code has."""
    code: bytes
    """An object file."""
    calls: tuple[str, ...]
    """Functions of the C library, or of others that the process has loaded, that it calls."""
    passed: str
    """The form of its arguments, as `struct` reads it."""
    returned: Returned

    @property
    def can_be_loaded(self) -> bool:
        """Whether this process has all functions that it calls: LLVM would end the process without one."""
        return all(binding.address_of_symbol(name) for name in self.calls)


class MachineCode:
    """Loaded machine code."""

    def __init__(self, kept: Kept) -> None:
        """Load it."""
        self._passed, self._kind = struct.Struct("=" + kept.passed), kept.returned
        self._returned = struct.Struct("=" + kept.returned.form)
        with _loading:
            engine = _engine()
            engine.add_object_file(binding.ObjectFileRef.from_data(kept.code))
            engine.finalize_object()
            address = engine.get_function_address(kept.name)
        self._call = _ENTRY(address)

    def __call__(self, numbers: list[Any], arguments: Sequence[Any]) -> Any:
        """Run it, without Python's lock.

        Args:
            numbers: the arguments as `passed` returns them.
            arguments: the arguments themselves.
        """
        answer, error = ctypes.create_string_buffer(self._returned.size), ctypes.c_void_p()
        if self._call(self._passed.pack(*numbers), answer, ctypes.byref(error)) != 0:
            raise _raised(error)
        return returned(self._kind, iter(self._returned.unpack(answer)), arguments)


_ENTRY = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_char_p, ctypes.c_void_p, ctypes.c_void_p)
"""A function of arguments, of room for what it returns, and of room for an error's address."""


class _Error(ctypes.Structure):
    """What numba's code knows of an error: the pickled class, arguments and place."""

    _fields_ = (("pickled", ctypes.c_void_p), ("size", ctypes.c_int32))


def _raised(address: ctypes.c_void_p) -> Exception:
    error = ctypes.cast(address, ctypes.POINTER(_Error)).contents
    kind, arguments, _ = pickle.loads(ctypes.string_at(error.pickled, error.size))
    return kind(*arguments)


@cache
def _engine() -> Any:
    binding.initialize_native_target()
    binding.initialize_native_asmprinter()
    target = binding.Target.from_triple(binding.get_process_triple())
    return binding.create_mcjit_compiler(binding.parse_assembly(""), target.create_target_machine(jit=True))


@cache
def processor() -> str:
    """Return for what machine code is made: the processor as LLVM names it, and what limits its use."""
    can = binding.get_host_cpu_features().flatten()
    limits = {name: os.environ.get(f"NUMBA_{name}") for name in ("CPU_NAME", "CPU_FEATURES", "ENABLE_AVX")}
    made_by = f"llvmlite {llvmlite.__version__} Python {sys.version} {sys.platform}"
    return f"{binding.get_process_triple()} {binding.get_host_cpu_name()} {can} {limits} {made_by}"
