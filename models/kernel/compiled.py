"""Compile a function with numba when it is first called, and keep its code for the next process."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

from collections.abc import Callable
from contextlib import nullcontext, suppress
from copy import copy
from inspect import signature
from typing import Any, ParamSpec, TypeVar

from llvmlite import binding
from numba import _dynfunc
from numba.core import types
from numba.core.compiler import Compiler, CompileResult, compile_result
from numba.core.compiler_lock import global_compiler_lock
from numba.core.dispatcher import _FunctionCompiler
from numba.core.environment import Environment, lookup_environment
from numba.core.registry import CPUDispatcher, cpu_target
from numba.core.sigutils import normalize_signature

from cointoss.models.kernel.callee_code import Callee, CalleeCode, CalleeCompiler, Codegen, spare_references
from cointoss.models.kernel.code_cache import CALLEE, CodeCache, LocatedImpl, kept_functions
from cointoss.models.kernel.compiling import compiling
from cointoss.models.kernel.sources import is_as_imported, part_of

P = ParamSpec("P")
R = TypeVar("R")
_OPTIONS = {"nopython": True, "nogil": True, "error_model": "numpy"}
_WITHOUT_WRAPPERS = {**_OPTIONS, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}


class _Dispatcher(CPUDispatcher):
    """numba's, but that it does not time what it compiles: each function within others times it anew."""

    def compile(self, sig: Any) -> Any:
        """Compile for arguments of these types, or read what is kept of an earlier process."""
        arguments, returned = normalize_signature(sig)
        with global_compiler_lock:
            if tuple(arguments) not in self.overloads:
                self._add(sig, arguments, returned)
        return self.overloads[tuple(arguments)].entry_point

    def _add(self, sig: Any, arguments: Any, returned: Any) -> None:
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

    def _is_found(self, sig: Any) -> bool:
        """Read what is kept for these types of arguments, if anything is."""
        result = self._cache.load_overload(sig, self.targetctx)
        if result is not None:
            self._cache_hits[sig] += 1
            self.targetctx.insert_user_function(result.entry_point, result.fndesc, [result.library])
            self.add_overload(result)
        return result is not None


class CompiledFunction(_Dispatcher):
    """A function compiled for its compiled callers; called from Python, it is made into machine code.

    See `cointoss.models.kernel.callee_code`.
    """

    def __init__(self, function: Callable[..., Any], *, inlined: bool = False) -> None:
        """Compile nothing yet; an `inlined` function goes into its compiled callers, without a call."""
        # numba asks for it three times.
        function.__dict__["__signature__"] = signature(function)
        super().__init__(function, targetoptions={**_WITHOUT_WRAPPERS, "forceinline": inlined})
        self._compiler = _ForCallers(self)
        self._from_python: _FromPython | None = None

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        """Run the machine code."""
        return self.from_python(*arguments, **named)

    @property
    def from_python(self) -> CPUDispatcher:
        """The function as Python calls it."""
        if self._from_python is None:
            with global_compiler_lock:
                self._from_python = self._from_python or _FromPython(self)
        return self._from_python

    def compile(self, sig: Any) -> Any:
        """Compile for arguments of these types, or read what is kept of an earlier process."""
        _keep_code(self, _CalleeCache)
        return super().compile(sig)

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return the function for a call in compiled code: for a literal it is that for any number."""
        return super().get_call_template(
            tuple(map(types.unliteral, args)), {name: types.unliteral(kind) for name, kind in kws.items()}
        )

    def __reduce__(self) -> Any:
        """Return the function by its name."""
        return self.__qualname__


class _ForCallers(_FunctionCompiler):
    """Compiles a function to `CalleeCode`."""

    def __init__(self, dispatcher: CompiledFunction) -> None:
        super().__init__(
            dispatcher.py_func, dispatcher.targetdescr, dispatcher.targetoptions, {}, CalleeCompiler
        )
        self._dispatcher = dispatcher

    def _customize_flags(self, flags: Any) -> Any:
        flags.no_compile = True
        return flags

    def _compile_core(self, args: Any, return_type: Any) -> CompileResult:
        with compiling.one(self.py_func.__module__, kept_functions):
            result = super()._compile_core(args, return_type)
        result.library.callee = Callee(self._dispatcher, result.signature.args)
        result.library.finalize()
        result = result._replace(entry_point=_name_for_callers(result))
        self.targetdescr.target_context.insert_user_function(
            result.entry_point, result.fndesc, [result.library]
        )
        return result


def _name_for_callers(result: CompileResult) -> Any:
    """Return what numba knows a compiled function by: a function of C, but this one cannot be called."""
    return _dynfunc.make_function(
        result.fndesc.lookup_module(),
        result.fndesc.qualname,
        "compiled for callers",
        0,
        result.environment,
        (result.library,),
    )


class _CalleeImpl(LocatedImpl):
    """How a function compiled for callers is kept: its own code, and the names of those it calls."""

    def get_filename_base(self, fullname: str, abiflags: str) -> str:
        return CALLEE + super().get_filename_base(fullname, abiflags)

    def reduce(self, data: CompileResult) -> Any:
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
        name, bitcode, callee, callees, description, environment, signature = reduced_data
        code = CalleeCode.from_bitcode(name, bitcode, callees)
        code.callee = callee
        result = _result(target_context, code, description, environment, signature)
        return result._replace(entry_point=_name_for_callers(result))


class _CalleeCache(CodeCache):
    _impl_class = _CalleeImpl


class _LinkedImpl(LocatedImpl):
    """How a function is kept as Python calls it: machine code alone, for its callers have their own kind.

    numba keeps code for callers beside it, which takes longer to read than the machine code.
    """

    def reduce(self, data: CompileResult) -> Any:
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
        name, machine_code, description, environment, signature, environments = reduced_data
        codegen = target_context.codegen()
        # numba looks for what is defined in the code for callers.
        defined = f'define void @"{description.llvm_cpython_wrapper_name}"() {{ ret void }}'
        for_callers = binding.parse_assembly(defined).as_bitcode()
        library = codegen.unserialize_library((name, "object", (machine_code, for_callers)))
        for used in environments:
            codegen.set_env(used.env_name, used)
        result = _result(target_context, library, description, environment, signature)
        return result._replace(
            entry_point=target_context.get_executable(library, description, environment),
            referenced_envs=environments,  # the code has their addresses
        )


class _LinkedCache(CodeCache):
    _impl_class = _LinkedImpl


class _FromPython(_Dispatcher):
    """A compiled function as Python calls it."""

    def __init__(self, compiled_function: CompiledFunction) -> None:
        super().__init__(compiled_function.py_func, targetoptions=_OPTIONS)
        self._compiler = _Linker(compiled_function)

    def compile(self, sig: Any) -> Any:
        _keep_code(self, _LinkedCache)
        return super().compile(sig)


class _Linker(_FunctionCompiler):
    """Makes machine code of a function and all it calls."""

    def __init__(self, compiled_function: CompiledFunction) -> None:
        super().__init__(compiled_function.py_func, cpu_target, _OPTIONS, {}, Compiler)
        self._function = compiled_function

    def _compile_core(self, args: Any, *_: Any) -> CompileResult:
        with compiling.one(self.py_func.__module__, kept_functions):
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
        result = _result(context, library, description, environment, callee.signature)
        return result._replace(entry_point=context.get_executable(library, description, environment))


def _result(context: Any, library: Any, description: Any, environment: Any, signature: Any) -> CompileResult:
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


def _keep_code(dispatcher: CPUDispatcher, cache: type[CodeCache]) -> None:
    """Keep what is compiled of a function from here on, if it is one of ours and of sources as they are."""
    module = dispatcher.__module__
    if isinstance(dispatcher._cache, cache) or not part_of(module):
        return
    if is_as_imported(module):
        with suppress(OSError):  # no folder can be made, as on a full disk
            dispatcher._cache = cache(dispatcher.py_func)


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """Compile `function` when it is first called, without the GIL, and keep the code on disk.

    Code of functions outside this project is not kept.
    """
    compiling.declared[function.__module__] += 1
    return CompiledFunction(function)


def inlined(function: Callable[P, R]) -> Callable[P, R]:
    """Compile `function` as `compiled` does, into each of its compiled callers.

    For what is called many times over with many numbers, which a call would pass through memory.
    """
    compiling.declared[function.__module__] += 1
    return CompiledFunction(function, inlined=True)
