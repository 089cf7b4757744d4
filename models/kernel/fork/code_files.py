"""What is kept of compiled functions, and their files: one that is damaged is as if it were missing."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

import uuid
from contextlib import AbstractContextManager, suppress
from pathlib import Path
from typing import Any, ClassVar

from llvmlite import binding
from numba import _dynfunc
from numba.core import types
from numba.core.caching import CompileResultCacheImpl, FunctionCache, IndexDataCacheFile
from numba.core.compiler import CompileResult, compile_result
from numba.core.runtime import rtsys

from cointoss.models.kernel.code_cache import Locator, turn
from cointoss.models.kernel.fork.callee_code import CalleeCode
from cointoss.models.kernel.kept_file import read_object, write_kept


class FunctionFiles(CompileResultCacheImpl):
    """How a function is kept: in the folder of its module, in files whose names begin with a prefix."""

    _locator_classes: ClassVar = [Locator]
    prefix: ClassVar[str]

    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        """Return how the names of a function's files begin."""
        return self.prefix + super().get_filename_base(fullname, abiflags)


class CalleeFiles(FunctionFiles):
    """How a function compiled for callers is kept: its own code, and the names of those it calls."""

    prefix = "callee-"

    def reduce(self, data: CompileResult) -> Any:
        """Return what is kept of a compiled function."""
        code = data.library
        data.fndesc.typemap = data.fndesc.calltypes = None
        return (
            code.name,
            code.bitcode(),
            code.callee,
            code.callees,
            data.fndesc,
            data.environment,
            data.signature,
        )

    def rebuild(self, target_context: Any, reduced_data: Any) -> CompileResult:
        """Return the compiled function of what was kept."""
        name, bitcode, callee, callees, description, environment, signature = reduced_data
        code = CalleeCode.from_bitcode(name, bitcode, callees)
        code.callee = callee
        result = compiled_result(target_context, code, description, environment, signature)
        return result._replace(entry_point=name_for_callers(result))


class LinkedFiles(FunctionFiles):
    """How a function is kept as Python calls it: machine code alone, for its callers have their own kind.

    numba keeps code for callers beside it, which takes longer to read than the machine code.
    """

    prefix = "linked-"

    def reduce(self, data: CompileResult) -> Any:
        """Return what is kept of a compiled function."""
        code = data.library
        data.fndesc.typemap = data.fndesc.calltypes = None
        return (
            code.name,
            code._get_compiled_object(),
            data.fndesc,
            data.environment,
            data.signature,
            data._find_referenced_environments(),
        )

    def rebuild(self, target_context: Any, reduced_data: Any) -> CompileResult:
        """Return the compiled function of what was kept."""
        name, machine_code, description, environment, signature, environments = reduced_data
        codegen = target_context.codegen()
        # numba looks for what is defined in the code for callers.
        defined = f'define void @"{description.llvm_cpython_wrapper_name}"() {{ ret void }}'
        for_callers = binding.parse_assembly(defined).as_bitcode()
        library = codegen.unserialize_library((name, "object", (machine_code, for_callers)))
        for used in environments:
            codegen.set_env(used.env_name, used)
        result = compiled_result(target_context, library, description, environment, signature)
        return result._replace(
            entry_point=target_context.get_executable(library, description, environment),
            referenced_envs=environments,  # the code has their addresses
        )


def name_for_callers(result: CompileResult) -> Any:
    """Return what numba knows a compiled function by: a function of C, but this one cannot be called."""
    return _dynfunc.make_function(
        result.fndesc.lookup_module(),
        result.fndesc.qualname,
        "compiled for callers",
        0,
        result.environment,
        (result.library,),
    )


def compiled_result(
    context: Any, library: Any, description: Any, environment: Any, signature: Any
) -> CompileResult:
    """Return what numba holds of a compiled function."""
    return compile_result(
        typing_context=context.typing_context,
        target_context=context,
        library=library,
        fndesc=description,
        environment=environment,
        signature=signature,
        objectmode=False,
        lifted=(),
        reload_init=[],
        typing_error=None,
    )


class CodeFiles(IndexDataCacheFile):
    """The files of one function: an index, and the code for each kind of arguments.

    numba numbers the code's files, and two processes that compile at once may give one number to code for
    different arguments; then a third would run the one for the other.

    Machine code is run as it is read: see `read_object`.
    """

    def load(self, key: Any) -> Any:
        """Return what is kept for these kinds of arguments, or None."""
        name = self._load_index().get(key)
        return None if name is None else self._load(name)

    def _load_index(self) -> dict[Any, str]:
        """Return the names of the code's files by kinds of arguments."""
        return self._load(self._index_name) or {}

    def _load(self, name: str) -> Any:
        """Return what a file keeps, or None where it is missing, damaged, or another's."""
        return read_object(Path(self._cache_path, name), self._about(name))

    def _about(self, name: str) -> str:
        """Return what a file keeps: for one name, one version of numba and one source."""
        return f"{name} {self._version} {self._source_stamp}"

    def save(self, key: Any, data: Any) -> None:
        """Keep code in a new file, and after that say so in the index."""
        name = f"{Path(self._index_path).stem}.{uuid.uuid4().hex}.nbc"
        self._save_data(name, data)
        overloads = self._load_index()
        former = overloads.get(key)
        self._save_index({**overloads, key: name})
        if former is not None:
            Path(self._cache_path, former).unlink(missing_ok=True)

    def _save_index(self, overloads: dict[Any, str]) -> None:
        self._write(self._index_name, overloads)

    def _save_data(self, name: str, data: Any) -> None:
        self._write(name, data)

    def _write(self, name: str, data: Any) -> None:
        write_kept(Path(self._cache_path, name), self._about(name), self._dump(data))


class CodeCache(FunctionCache):
    """Keeps what is compiled of one function."""

    def __init__(self, py_func: Any, kind: type[FunctionFiles]) -> None:
        """Find the function's files of one kind."""
        self._impl_class = kind
        super().__init__(py_func)
        self._cache_file = CodeFiles(
            self._cache_path, self._impl.filename_base, self._impl.locator.get_source_stamp()
        )

    def turn(self) -> AbstractContextManager[bool]:
        """Let one process at a time compile this function; see `turn`."""
        return turn(str(Path(self._cache_path, self._impl.filename_base)))

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """Return what is kept for these types of arguments, or None.

        To read it numba would import all that it can compile, which takes longer than most tosses.
        """
        rtsys.initialize(target_context)
        with self._guard_against_spurious_io_errors():
            return self._load_overload(sig, target_context)

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep what was compiled; where nothing can be written, the next process compiles anew."""
        with suppress(OSError):
            super().save_overload(sig, data)

    def _index_key(self, sig: Any, codegen: Any) -> tuple[Any, ...]:
        # To numba two named tuples of one name and of the same types are one type.
        return *super()._index_key(sig, codegen), tuple(map(_fields, sig))


def _fields(kind: Any) -> Any:
    """Return the names of the fields of a type, if it is a tuple with or of named ones."""
    parts = tuple(map(_fields, kind.types)) if isinstance(kind, types.BaseTuple) else ()
    return getattr(kind, "fields", ()) if isinstance(kind, types.BaseNamedTuple) else (), parts
