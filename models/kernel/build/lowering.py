"""Compiled functions as one module of LLVM's code, for any processor, in a process of its own.

numba compiles each function by itself: it optimises it with all that it calls, makes machine code for this
machine, and wrappers for Python. Here numba is changed: the code of each function is left as it is. All of
it is linked into one module, the same for addresses of 64 bits and of 32. For either the module is tidied
up, and references to arrays are no longer counted where no error can occur. For each processor it is
optimised as a whole.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false
# pyright: reportIncompatibleMethodOverride=false

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from enum import IntEnum
from typing import Any, NamedTuple

from llvmlite import binding, ir
from numba import _dynfunc, from_dtype, njit, types
from numba.core.callconv import excinfo_ptr_t
from numba.core.codegen import JITCodeLibrary, JITCPUCodegen
from numba.core.cpu import CPUContext
from numba.core.registry import CPUDispatcher, cpu_target
from numba.core.runtime import rtsys
from numba.core.runtime.context import NRTContext

from cointoss.models.kernel.build.musl import call_musl, musl_code
from cointoss.models.kernel.build.runtime import OF_RUNTIME, of_runtime
from cointoss.models.kernel.compiled import _Compiled
from cointoss.models.kernel.kinds import ValueKind

C_LIBRARY = {"malloc", "free", "memcpy", "memset", "memmove", "__heap_base"}
"""What the code may use of a system's C library, or of a page's linker."""
_WORD = ir.IntType(64)
_OPTIONS = {
    "nopython": True,
    "nogil": True,
    "error_model": "numpy",
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}


class LlvmTarget(NamedTuple):
    """A processor and a system, as LLVM names them."""

    triple: str
    features: str = ""
    """The features that the processor's plainest kind does not have."""
    processor: str = ""
    """The plainest kind, empty for the first of all."""

    @property
    def is_narrow(self) -> bool:
        """Whether its addresses have 32 bits."""
        return self.triple.startswith("wasm32")

    def machine(self) -> binding.TargetMachine:
        """Return LLVM's target machine."""
        binding.initialize_all_targets()
        binding.initialize_all_asmprinters()
        return binding.Target.from_triple(self.triple).create_target_machine(
            cpu=self.processor, features=self.features, opt=3, reloc="default" if self.is_narrow else "pic"
        )


class EntryRequest(NamedTuple):
    """A function that Python calls by its symbol."""

    symbol: str
    function: Any
    """A compiled one."""
    given: tuple[ValueKind, ...]
    returned: ValueKind
    lacks: bool
    """Whether the number that may be None is None."""


def lowered(asked: Sequence[EntryRequest]) -> bytes:
    """Return LLVM's bitcode of one module, an entry for each function asked for and all that they call.

    An entry takes the addresses of its numbers, of room for what it returns, and of room for an error's
    address; it returns 0 unless it failed. See `cointoss.models.kernel.kinds` for the numbers.

    Args:
        asked: the functions.

    Raises:
        RuntimeError: for a function that returns another kind than its annotation says.
    """
    _change_numba()
    whole = _Code(cpu_target.target_context.codegen(), "engine")
    kept = []
    for each in asked:
        kinds = tuple(_numba_type(kind, each.lacks) for kind in each.given)
        dispatcher = each.function.dispatcher
        dispatcher.compile(kinds)
        result = dispatcher.overloads[kinds]
        if result.signature.return_type != (wanted := _numba_type(each.returned, False)):
            raise RuntimeError(
                f"{each.symbol}: returns {result.signature.return_type}, is annotated {wanted}"
            )
        whole.add_ir_module(_entry(each, result.fndesc))
        result.library.add_to(whole._final_module, kept)
    module = whole._final_module
    module.link_in(binding.parse_bitcode(musl_code()), preserve=True)
    return module.as_bitcode()


def prepared(code: bytes, target: LlvmTarget, symbols: Collection[str]) -> bytes:
    """Return a module with numba's runtime, tidied up for a target and all others with addresses as wide.

    Args:
        code: the module, as LLVM's bitcode.
        target: for which it is.
        symbols: of the entries that are kept, with what they call.
    """
    module = with_parts(code, of_runtime(is_narrow=target.is_narrow), (*symbols, *OF_RUNTIME), target)
    _spare_references(module, target.machine())
    module.verify()
    return module.as_bitcode()


def with_parts(
    code: bytes, parts: Iterable[str], shown: Collection[str], target: LlvmTarget
) -> binding.ModuleRef:
    """Return a module for a target, with more code in it, of which some functions alone can be called.

    Args:
        code: the module, as LLVM's bitcode.
        parts: what is linked in, in LLVM's language.
        shown: the names of what can be called.
        target: for which it is.
    """
    module = binding.parse_bitcode(code)
    module.triple, module.data_layout = target.triple, str(target.machine().target_data)
    for text in parts:
        part = binding.parse_assembly(text)
        part.triple, part.data_layout = module.triple, module.data_layout
        module.link_in(part)
    for each in (*module.functions, *module.global_variables):
        if not each.is_declaration:
            each.linkage = "external" if each.name in shown else "internal"
    return module


def object_code(code: bytes, target: LlvmTarget, symbols: Mapping[str, str]) -> bytes:
    """Return an object file of a module that was prepared for addresses as wide, optimised as a whole.

    Args:
        code: the module, as LLVM's bitcode.
        target: for which it is.
        symbols: new names of functions.

    Raises:
        RuntimeError: where it calls what a system may not have.
    """
    module, machine = binding.parse_bitcode(code), target.machine()
    for name, new in symbols.items():
        module.get_function(name).name = new
    optimise(module, target, machine)
    if foreign := foreign_to(module) - C_LIBRARY:
        raise RuntimeError(f"the engine calls {', '.join(sorted(foreign))}, which a system may not have")
    return machine.emit_object(module)


def optimise(module: binding.ModuleRef, target: LlvmTarget, machine: binding.TargetMachine) -> None:
    """Optimise a module as a whole for a target."""
    module.triple, module.data_layout = target.triple, str(machine.target_data)
    for level, vectors in ((0, False), (3, True)):  # the first brings references into one function
        builder = _pass_builder(machine, level, vectors=vectors)
        passes = builder.getModulePassManager()
        passes.add_refprune_pass()
        passes.run(module, builder)
    module.verify()


def _pass_builder(machine: binding.TargetMachine, level: int, *, vectors: bool) -> binding.PassBuilder:
    options = binding.create_pipeline_tuning_options(speed_level=level)
    options.loop_vectorization = options.slp_vectorization = vectors
    return binding.create_pass_builder(machine, options)


def foreign_to(module: binding.ModuleRef) -> set[str]:
    """Return the names of what a module uses and does not have."""
    every = (*module.functions, *module.global_variables)
    return {each.name for each in every if each.is_declaration and not each.name.startswith("llvm.")}


class _Code(JITCodeLibrary):
    """The code of one function, with the functions it calls beside it; nothing is optimised."""

    def __init__(self, codegen: Any, name: str) -> None:
        super().__init__(codegen, name)
        self.callees: list[_Code] = []

    def add_linking_library(self, library: Any) -> None:
        """Take note of a function that this one calls."""
        if isinstance(library, _Code):
            self.callees.append(library)

    def _optimize_functions(self, ll_module: binding.ModuleRef) -> None:
        call_musl(ll_module)

    def add_to(self, module: binding.ModuleRef, kept: "list[_Code]") -> None:
        """Add this code and that of all it calls to a module, but for what is `kept` there."""
        todo = [self]
        while todo:
            code = todo.pop()
            if code not in kept:
                kept.append(code)
                module.link_in(code._final_module, preserve=True)
                todo += code.callees


class _Codegen(JITCPUCodegen):
    """Makes code of which none is run."""

    _library_class = _Code

    def __init__(self, own: Any) -> None:
        vars(self).update(vars(own))
        self._engine = _Nothing()


class _Nothing:
    """What stands in the place of what would make and run machine code."""

    def __getattr__(self, name: str) -> Any:
        return lambda *_, **__: 0


class _References(NRTContext):
    """numba's counting of references, but that only what holds an array is taken apart to find it."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self._holding: dict[Any, bool] = {}

    def get_meminfos(self, builder: Any, ty: Any, val: Any) -> Any:
        """Return what counts references to `val`, with types."""
        if ty not in self._holding:
            self._holding[ty] = self._context.data_model_manager[ty].contains_nrt_meminfo()
        return super().get_meminfos(builder, ty, val) if self._holding[ty] else []


class _Dispatcher(CPUDispatcher):
    """A function compiled for its compiled callers, for a literal as for any number."""

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Return the function for a call in compiled code."""
        return super().get_call_template(
            tuple(map(types.unliteral, args)), {name: types.unliteral(kind) for name, kind in kws.items()}
        )


def _change_numba() -> None:
    """Let numba make no machine code from here on."""
    njit(lambda: None)()  # numba makes its own runtime for this machine when it first compiles
    context, typing = cpu_target.target_context, cpu_target.typing_context
    rtsys.initialize(context)
    own = context.codegen()
    _kept.append(own._engine)
    context._internal_codegen = _Codegen(own)
    context.cached_internal_func.clear()
    context.nrt = _References(context, True)
    typing.resolve_function_type = _remembered(typing.resolve_function_type)
    CPUContext.get_executable = lambda _, *described: _not_run(*described)
    _Compiled.dispatched = lambda function: _Dispatcher(
        function.py_func,
        targetoptions={**_OPTIONS, "forceinline": function.inlined},
    )


_kept: list[Any] = []
"""What owns modules that numba still asks for their names."""


def _remembered(resolve: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that finds the types of a call, for which numba asks again and again, once."""
    known: dict[Any, Any] = {}

    def resolved(function: Any, arguments: Any, named: Any) -> Any:
        if not isinstance(function, types.Type):
            return resolve(function, arguments, named)
        call = function, arguments, *dict(named).items()
        if call not in known:
            known[call] = resolve(function, arguments, named)
        return known[call]

    return resolved


def _not_run(library: Any, description: Any, environment: Any) -> Any:
    return _dynfunc.make_function(
        description.lookup_module(), description.qualname, "never run", 0, environment, (library,)
    )


def _spare_references(module: binding.ModuleRef, machine: binding.TargetMachine) -> None:
    """Remove the counting of references to arrays across calls that cannot fail.

    numba counts across every call, lest an error leaves a count behind, and removes what it can by looking at
    one function at a time. Where nothing else calls a module's functions it is known which calls cannot fail.
    """
    passes = binding.create_new_module_pass_manager()
    for step in (
        *("global_dead_code_eliminate", "sroa", "instruction_combine", "simplify_cfg", "aggressive_dce"),
        *("ipsccp", "simplify_cfg", "sroa", "refprune"),
    ):
        getattr(passes, f"add_{step}_pass")()
    passes.run(module, _pass_builder(machine, 0, vectors=False))


def _numba_type(kind: ValueKind, lacks: bool) -> Any:
    """Return numba's type of a kind; of a number that may be None, None's if it `lacks`."""
    if kind.parts:
        of = None if kind.of is tuple else kind.of
        return types.BaseTuple.from_types([_numba_type(part, lacks) for part in kind.parts], of)
    if kind.dimensions:
        return types.Array(from_dtype(kind.of), kind.dimensions, "C")
    if kind.of is None or (kind.may_lack and lacks):
        return types.none
    if issubclass(kind.of, IntEnum):
        return types.IntEnumMember(kind.of, types.int64)
    return {float: types.float64, int: types.int64, bool: types.boolean}[kind.of]


def _entry(asked: EntryRequest, description: Any) -> ir.Module:
    """Return the code of an entry.

    Raises:
        RuntimeError: where numba passes other numbers than the kinds say.
    """
    context = cpu_target.target_context
    module = context.create_module("entry")
    of_callee = context.call_conv.get_function_type(description.restype, description.argtypes)
    callee = ir.Function(module, of_callee, description.llvm_func_name)
    words = _WORD.as_pointer()
    signature = ir.FunctionType(ir.IntType(32), [words, words, excinfo_ptr_t.as_pointer()])
    entry = ir.Function(module, signature, asked.symbol)
    given, answer, error = entry.args
    builder = ir.IRBuilder(entry.append_basic_block())
    expected = of_callee.args[2:]
    numbers = [_loaded(builder, given, i, each) for i, each in enumerate(expected)]
    room = builder.alloca(of_callee.args[0].pointee)
    builder.store(ir.Constant(room.type.pointee, None), room)
    status = builder.call(callee, [room, error, *numbers])
    leaves = list(_leaves(builder, builder.load(room))) if asked.returned.form else []
    if (len(expected), len(leaves)) != (
        sum(len(kind.form) for kind in asked.given),
        len(asked.returned.form),
    ):
        raise RuntimeError(f"{asked.symbol}: numba passes {len(expected)} numbers and returns {len(leaves)}")
    for i, leaf in enumerate(leaves):
        builder.store(leaf, builder.gep(answer, [_WORD(i)]), align=1)
    builder.ret(status)
    return module


def _loaded(builder: ir.IRBuilder, row: Any, number: int, kind: Any) -> Any:
    """Return a number of a row as a value of a type."""
    value = builder.load(builder.gep(row, [_WORD(number)]), align=1)
    if isinstance(kind, ir.PointerType):
        return builder.inttoptr(value, kind)
    if isinstance(kind, ir.IntType):
        return value if kind.width == 64 else builder.trunc(value, kind)
    return builder.bitcast(value, kind)


def _leaves(builder: ir.IRBuilder, value: Any) -> Iterable[Any]:
    """Yield the numbers that a value consists of, as 8-byte integers."""
    kind = value.type
    if isinstance(kind, ir.LiteralStructType | ir.ArrayType):
        for i in range(len(kind)):
            yield from _leaves(builder, builder.extract_value(value, i))
    elif isinstance(kind, ir.PointerType):
        yield builder.ptrtoint(value, _WORD)
    elif isinstance(kind, ir.IntType):
        yield value if kind.width == 64 else builder.zext(value, _WORD)
    else:
        yield builder.bitcast(value, _WORD)
