"""Functions as numba's dispatchers: compiled for compiled callers, linked with all they call for Python."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

from contextlib import nullcontext
from copy import copy
from functools import partial
from inspect import signature
from operator import attrgetter
from typing import Any

from numba import typeof
from numba.core import types
from numba.core.compiler import Compiler, CompileResult
from numba.core.compiler_lock import global_compiler_lock
from numba.core.dispatcher import _FunctionCompiler
from numba.core.environment import Environment, lookup_environment
from numba.core.registry import CPUDispatcher, cpu_target
from numba.core.sigutils import normalize_signature

from cointoss.models.kernel.code_cache import is_kept, kept_functions
from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.fork.callee_code import (
    Callee,
    CalleeCompiler,
    Codegen,
    spare_references,
)
from cointoss.models.kernel.fork.code_files import (
    CalleeFiles,
    CodeCache,
    FunctionFiles,
    LinkedFiles,
    compiled_result,
    name_for_callers,
)
from cointoss.models.kernel.fork.entry import kept_code, returned_kind
from cointoss.models.kernel.fork.machine_code import Kept
from cointoss.models.kernel.fork.values import Passed

_kept = partial(kept_functions, CalleeFiles.prefix)
_OPTIONS = {"nopython": True, "nogil": True, "error_model": "numpy"}
_WITHOUT_WRAPPERS = {**_OPTIONS, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


class _Dispatcher(CPUDispatcher):
    """numba's, but that it does not time what it compiles: each function within others times it anew."""

    _kind: type[FunctionFiles]
    """How the code is kept."""

    def compile(self, sig: Any) -> Any:
        """Compile for arguments of these types, or read what is kept of an earlier process."""
        arguments, returned = normalize_signature(sig)
        with global_compiler_lock:
            if tuple(arguments) not in self.overloads:
                self._add(sig, arguments, returned)
        return self.overloads[tuple(arguments)].entry_point

    def _add(self, sig: Any, arguments: Any, returned: Any) -> None:
        self._find_cache()
        with self._compiling_counter:
            if self._is_found(sig):
                return
            turn = self._cache.turn() if isinstance(self._cache, CodeCache) else nullcontext(False)
            with turn as was_waited_for:
                if was_waited_for and self._is_found(sig):
                    return
                self._cache_misses[sig] += 1
                result = self._compiler.compile(arguments, returned)
                self.add_overload(result)
                self._cache.save_overload(sig, result)

    def _find_cache(self) -> None:
        if not isinstance(self._cache, CodeCache) and is_kept(self.__module__):
            self._cache = CodeCache(self.py_func, self._kind)

    def _is_found(self, sig: Any) -> bool:
        """Read what is kept for these types of arguments, if anything is."""
        result = self._cache.load_overload(sig, self.targetctx)
        if result is not None:
            self._cache_hits[sig] += 1
            self.targetctx.insert_user_function(result.entry_point, result.fndesc, [result.library])
            self.add_overload(result)
        return result is not None


class CallerDispatcher(_Dispatcher):
    """A function compiled for its compiled callers."""

    _kind = CalleeFiles
    lock = global_compiler_lock
    """Held by the one thread that compiles."""

    def __init__(self, function: Any, *, inlined: bool = False) -> None:
        """Compile nothing yet; `function` is the `CompiledFunction`."""
        self.function = function
        # numba asks for it three times.
        function.py_func.__dict__["__signature__"] = signature(function.py_func)
        super().__init__(function.py_func, targetoptions={**_WITHOUT_WRAPPERS, "forceinline": inlined})
        self._compiler = _ForCallers(self)
        self._from_python: _FromPython | None = None

    def machine_code(self, given: Passed, arguments: tuple[Any, ...]) -> Kept | None:
        """Return machine code that Python calls without numba, or None where numba has to call it.

        Args:
            given: the arguments as they are passed.
            arguments: the arguments themselves.
        """
        kinds = tuple(map(typeof, arguments))
        if self.from_python.is_found(kinds):
            return None
        with compiling.one(self.py_func.__module__, _kept):
            self.compile(kinds)
            callee = self.overloads[kinds]
            kind = returned_kind(callee.signature.return_type)
            if kind is None:
                return None
            # The code may all have been read from disk: see `CodeCache.load_overload`.
            cpu_target.target_context.refresh()
            with compiling.linking():
                return kept_code(callee, given, kind)

    @property
    def from_python(self) -> "_FromPython":
        """The function as Python calls it by numba, with arguments or an answer that only numba knows."""
        if self._from_python is None:
            with global_compiler_lock:
                self._from_python = self._from_python or _FromPython(self)
        return self._from_python

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return the function for a call in compiled code: for a literal it is that for any number."""
        return super().get_call_template(
            tuple(map(types.unliteral, args)), {name: types.unliteral(kind) for name, kind in kws.items()}
        )

    def __reduce__(self) -> Any:
        """Return the dispatcher of the function, which goes by its name."""
        return attrgetter("dispatcher"), (self.function,)


class _ForCallers(_FunctionCompiler):
    """Compiles a function to `CalleeCode`."""

    def __init__(self, dispatcher: CallerDispatcher) -> None:
        super().__init__(
            dispatcher.py_func, dispatcher.targetdescr, dispatcher.targetoptions, {}, CalleeCompiler
        )
        self._dispatcher = dispatcher

    def _customize_flags(self, flags: Any) -> Any:
        flags.no_compile = True
        return flags

    def _compile_core(self, args: Any, return_type: Any) -> CompileResult:
        with compiling.one(self.py_func.__module__, _kept):
            result = super()._compile_core(args, return_type)
        result.library.callee = Callee(self._dispatcher.function, result.signature.args)
        result.library.finalize()
        result = result._replace(entry_point=name_for_callers(result))
        self.targetdescr.target_context.insert_user_function(
            result.entry_point, result.fndesc, [result.library]
        )
        return result


class _FromPython(_Dispatcher):
    """A compiled function as Python calls it."""

    _kind = LinkedFiles

    def __init__(self, caller: CallerDispatcher) -> None:
        super().__init__(caller.py_func, targetoptions=_OPTIONS)
        self._compiler = _Linker(caller)

    def is_found(self, kinds: tuple[Any, ...]) -> bool:
        """Return whether machine code for these types of arguments is there, or kept."""
        if kinds not in self.overloads:
            self._find_cache()
            self._is_found(kinds)
        return kinds in self.overloads


class _Linker(_FunctionCompiler):
    """Makes machine code of a function and all it calls."""

    def __init__(self, caller: CallerDispatcher) -> None:
        super().__init__(caller.py_func, cpu_target, _OPTIONS, {}, Compiler)
        self._function = caller

    def _compile_core(self, args: Any, *_: Any) -> CompileResult:
        with compiling.one(self.py_func.__module__, _kept):
            self._function.compile(args)
            with compiling.linking():
                return self._linked(self._function.overloads[args])

    def _linked(self, callee: CompileResult) -> CompileResult:
        # The wrapper keeps constants of its own, lest one who knew the function without them has too few.
        description = copy(callee.fndesc)
        description.env_name += "_from_python"
        environment = Environment.from_fndesc(description)
        # The code may all have been read from disk: see `CodeCache.load_overload`.
        cpu_target.target_context.refresh()
        context = cpu_target.target_context.subtarget(enable_nrt=True, _internal_codegen=Codegen())
        library = context.codegen().create_library(callee.library.name)
        library.enable_object_caching()
        context.create_cpython_wrapper(library, description, environment, None, release_gil=True)
        # Nothing else calls these functions here, so LLVM may change them as it likes.
        # Internal ones would still be found by their names.
        callee.library.link_into(library._final_module, "private")
        spare_references(library._final_module, context.codegen())
        for variable in library._final_module.global_variables:
            if lookup_environment(variable.name) is not None:
                variable.linkage = "linkonce_odr"  # Most are not used, and LLVM removes them.
        library.finalize()
        for variable in library._final_module.global_variables:
            used = lookup_environment(variable.name)
            if used is not None:
                context.codegen().set_env(variable.name, used)
        result = compiled_result(context, library, description, environment, callee.signature)
        return result._replace(entry_point=context.get_executable(library, description, environment))
