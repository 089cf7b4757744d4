"""Code of compiled functions for their compiled callers: LLVM's, without machine code of its own.

numba optimises every function and makes machine code of it, with a wrapper for Python and one for C, though a
function that only compiled functions call runs as a copy within them. Here its code is only tidied up.
What Python calls is linked with the code of all it calls, optimised as one, and made into machine code once.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

import hashlib
from functools import cache
from typing import Any, NamedTuple

from llvmlite import binding
from numba.core import types
from numba.core.bytecode import FunctionIdentity
from numba.core.codegen import CPUCodegen, JITCodeLibrary, JITCPUCodegen
from numba.core.compiler import Compiler, CompileResult
from numba.core.compiler_machinery import PassManager
from numba.core.funcdesc import default_mangler
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys
from numba.core.runtime.context import NRTContext
from numba.core.typed_passes import AnnotateTypes, DumpParforDiagnostics, InlineOverloads
from numba.core.untyped_passes import (
    ExtractByteCode,
    FindLiterallyCalls,
    InlineClosureLikes,
    InlineInlinables,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    WithLifting,
)

from cointoss.models.kernel.fork.libm_code import call_musl, link_musl
from cointoss.models.kernel.libm import PREFIX
from cointoss.models.kernel.sources import part_of, source_hash


class Callee(NamedTuple):
    """A compiled function and the types of its arguments."""

    function: Any
    arguments: tuple[Any, ...]

    def code(self) -> "CalleeCode":
        """Return its code; compiled, or read from disk, if that was not done yet."""
        self.function.dispatcher.compile(self.arguments)
        return self.function.dispatcher.overloads[self.arguments].library


class CalleeCode(JITCodeLibrary):
    """The code of one function, with what it uses of numba's own; compiled functions it calls by name."""

    def __init__(self, codegen: Any, name: str) -> None:
        """Start without code."""
        super().__init__(codegen, name)
        self.callee: Callee | None = None
        """Whose code this is; None for a function of numba's own."""
        self.callees: list[Callee] = []
        """Whom it calls."""

    def add_linking_library(self, library: Any) -> None:
        """Take the code of a function that this one calls."""
        if not isinstance(library, CalleeCode):
            # numba's runtime library is linked to every function, and so once to all of them.
            if library is not rtsys.library:
                self._linking_libraries.append(library)
        elif library.callee:
            self.callees.append(library.callee)
        else:
            library._ensure_finalized()
            self._linking_libraries.append(library)
            self.callees += library.callees

    def finalize(self) -> None:
        """Take no more code: nothing is optimised."""
        self._raise_if_finalized()
        for library in dict.fromkeys(self._linking_libraries):
            own = (
                library._shareable() if isinstance(library, CalleeCode) else library._get_module_for_linking()
            )
            self._final_module.link_in(own, preserve=True)
        # Other processes give the names of numba's own functions to others.
        for function in self._final_module.functions:
            if function.linkage == binding.Linkage.linkonce_odr:
                function.linkage = binding.Linkage.internal
        self.callees = list(dict.fromkeys(self.callees))
        self._finalize_dynamic_globals()
        self._finalized = True

    def _optimize_functions(self, ll_module: binding.ModuleRef) -> None:
        # numba runs all of LLVM's passes on each function. What is linked later is optimised as a whole.
        call_musl(ll_module)
        ll_module.data_layout = self._codegen._data_layout
        passes = binding.create_new_module_pass_manager()
        passes.add_sroa_pass()
        passes.add_instruction_combine_pass()
        passes.add_simplify_cfg_pass()
        passes.add_aggressive_dce_pass()
        passes.run(ll_module, _plain_pass_builder(self._codegen))

    @classmethod
    def from_bitcode(cls, name: str, bitcode: bytes, callees: list[Callee]) -> "CalleeCode":
        """Return the code that was kept on disk."""
        code = cls(callee_codegen(), name)
        code._final_module, code.callees, code._finalized = binding.parse_bitcode(bitcode), callees, True
        return code

    def bitcode(self) -> bytes:
        """Return the code as it is kept on disk, without its callees."""
        return self._final_module.as_bitcode()

    def link_into(self, module: binding.ModuleRef, linkage: str = "linkonce_odr") -> None:
        """Add this code and that of all it calls, with this linkage, to a module that calls it."""
        exported = _exported(module)
        found = {self.callee}
        codes: list[CalleeCode] = [self]
        for code in codes:
            # The linker leaves out what is not external and not called by what is there already.
            module.link_in(code._final_module, preserve=True)
            for callee in code.callees:
                if callee not in found:
                    found.add(callee)
                    codes.append(callee.code())
        for name in _exported(module) - exported:
            module.get_function(name).linkage = linkage
        module.link_in(rtsys.library._get_module_for_linking(), preserve=True)
        link_musl(module, linkage)
        _require_all_that_is_called(module)

    def _get_module_for_linking(self) -> binding.ModuleRef:
        whole = callee_codegen().create_library(self.name)._final_module
        self.link_into(whole)
        return whole

    def _shareable(self) -> binding.ModuleRef:
        """Return the code as one that several functions may bring along."""
        module = self._final_module.clone()
        for name in _exported(module):
            module.get_function(name).linkage = "linkonce_odr"
        return module


def _require_all_that_is_called(module: binding.ModuleRef) -> None:
    """Raise where a module calls one of our functions that it lacks: LLVM would call address 0 instead."""
    declared = [each.name for each in module.functions if each.is_declaration]
    lacking = [name for name in declared if name.startswith(("_ZN", PREFIX))]
    if lacking:
        raise RuntimeError(
            f"compiled code calls {', '.join(lacking)}, which was kept under another name; "
            "remove the folders cointoss.* from $NUMBA_CACHE_DIR, or from cointoss in your cache"
        )


def spare_references(module: binding.ModuleRef, codegen: JITCPUCodegen) -> None:
    """Remove the counting of references to arrays across calls that cannot fail.

    numba counts across every call, lest an error leaves a count behind, and removes what it can by looking at
    one function at a time. Where nothing else calls a module's functions it is known which calls cannot fail.
    """
    passes = binding.create_new_module_pass_manager()
    passes.add_ipsccp_pass()
    passes.add_simplify_cfg_pass()
    passes.add_sroa_pass()
    passes.add_refprune_pass()
    passes.run(module, _plain_pass_builder(codegen))


def _plain_pass_builder(codegen: CPUCodegen) -> Any:
    return codegen._pass_builder(opt=0, loop_vectorize=False, slp_vectorize=False)


def _exported(module: binding.ModuleRef) -> set[str]:
    return {
        function.name
        for function in module.functions
        if not function.is_declaration and function.linkage == binding.Linkage.external
    }


class Codegen(JITCPUCodegen):
    """numba's own, but that LLVM makes one vector of numbers that the same is done to side by side."""

    def __init__(self) -> None:
        """Share the processor and the settings with numba's own."""
        vars(self).update(vars(cpu_target.target_context.codegen()))

    def _pass_builder(self, **settings: Any) -> Any:
        return super()._pass_builder(**{"slp_vectorize": True, **settings})


class CalleeCodegen(Codegen):
    """Makes code for callers."""

    _library_class = CalleeCode

    def __init__(self) -> None:
        """Start without functions of numba's own."""
        super().__init__()
        self.own_functions: dict[Any, Any] = {}
        """numba's own functions as code for callers."""
        self.typing = _Typing(cpu_target.typing_context)
        self.holding_arrays: dict[Any, bool] = {}
        """Whether values of a type hold arrays."""


@cache
def callee_codegen() -> CalleeCodegen:
    """Return the one there is; made at the first use, for it starts LLVM."""
    return CalleeCodegen()


class _Typing:
    """numba's typing, which remembers the types of what its own operators and functions give.

    numba goes through all it knows to add, from arrays to dates, for each plus sign.
    """

    def __init__(self, context: Any) -> None:
        self._context = context
        self._known: dict[Any, Any] = {}

    def __getattr__(self, name: str) -> Any:
        return getattr(self._context, name)

    def resolve_function_type(self, func: Any, args: Any, kws: Any) -> Any:
        if kws or not isinstance(func, types.Function):
            return self._context.resolve_function_type(func, args, kws)
        key = func, tuple(args)
        if key not in self._known:
            self._known[key] = self._context.resolve_function_type(func, args, kws)
        return self._known[key]


def _mangled(name: str, kinds: Any, **tags: Any) -> str:
    """Return the name of a function for these kinds of arguments, the same in every process.

    numba names records by a number that counts the types met so far.
    """
    mangled = default_mangler(name, kinds, **tags)
    for kind in kinds:
        record = kind.dtype if isinstance(kind, types.Array) else kind
        if isinstance(record, types.Record):
            number = int(hashlib.sha256(str(record.dtype).encode()).hexdigest()[:15], 16)
            mangled = mangled.replace(f"6RecordILi{record._code}E", f"6RecordILi{number}E")
    return mangled


class _References(NRTContext):
    """numba's counting of references to arrays, but that only what holds one is taken apart to find it.

    numba takes every tuple apart to its last number, twice for each name it is given: a quarter of all
    instructions.
    """

    def get_meminfos(self, builder: Any, ty: Any, val: Any) -> Any:
        """Return what counts references to `val`, with types."""
        holding = callee_codegen().holding_arrays
        if ty not in holding:
            holding[ty] = self._context.data_model_manager[ty].contains_nrt_meminfo()
        return super().get_meminfos(builder, ty, val) if holding[ty] else []


# For closures, `with`, `literally` and `literal_unroll`, functions inlined by numba, listings and loops in
# parallel.
_NOT_NEEDED = {
    AnnotateTypes,
    DumpParforDiagnostics,
    FindLiterallyCalls,
    InlineClosureLikes,
    InlineInlinables,
    InlineOverloads,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    WithLifting,
}


class CalleeCompiler(Compiler):
    """numba's compiler, but that it makes code for callers."""

    def __init__(self, *arguments: Any) -> None:
        """Prepare to compile one function; the arguments are numba's."""
        super().__init__(*arguments)
        context = self.state.targetctx
        context._internal_codegen = callee_codegen()
        context.cached_internal_func = callee_codegen().own_functions
        context.mangler = _mangled
        context.nrt = _References(context, True)
        self.state.typingctx = callee_codegen().typing

    def define_pipelines(self) -> list[PassManager]:
        """Return numba's passes, without those for what compiled functions here do not contain."""
        (pipeline,) = super().define_pipelines()
        needed = PassManager(pipeline.pipeline_name)
        needed.passes = [step for step in pipeline.passes if step[0] not in _NOT_NEEDED]
        needed.finalize()
        return [needed]

    def compile_extra(self, func: Any) -> CompileResult:
        """Compile a function under the name that it has in every process: code kept on disk calls it so."""
        identity = FunctionIdentity.from_function(func)
        if part_of(identity.modname) and "<locals>" not in identity.func_qualname:
            identity.unique_id = int(source_hash(identity.modname), 16)
            identity.unique_name = f"{identity.func_qualname}${identity.unique_id}"
        self.state.func_id = identity
        ExtractByteCode().run_pass(self.state)
        self.state.lifted, self.state.lifted_from = (), None
        return self._compile_bytecode()
