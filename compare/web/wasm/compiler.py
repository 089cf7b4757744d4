"""Compiled functions as an object file for another processor, in a process of its own, which is changed.

numba lowers Python for the machine that it runs on. Here its target has 32-bit addresses from the start: the
layout of arrays in memory is part of the code of every function. Nothing that is compiled so is run.
"""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

from collections.abc import Mapping
from typing import Any

from llvmlite import binding
from numba import _dynfunc, njit, types
from numba.core.cpu import CPUContext
from numba.core.registry import cpu_target
from numba.core.runtime import rtsys

from cointoss.models.kernel.fork.callee_code import Codegen, callee_codegen, spare_references
from cointoss.models.kernel.fork.entry import MEMORY, ROOM, declared, entry_module, returned_kind
from cointoss.models.kernel.fork.values import Passed

TRIPLE = "wasm32-unknown-unknown"
C_LIBRARY = {"malloc", "free", "memcpy", "memset", "sqrt"}
"""What the code may call of a C library that is linked to it; a root has one right answer."""
ROOM_OF_32_BITS = """
declare ptr @malloc(i32)

define ptr @NRT_room(i64 %size) {
  %length = trunc i64 %size to i32
  %block = call ptr @malloc(i32 %length)
  ret ptr %block
}
"""
COUNTING = """
declare void @NRT_MemInfo_call_dtor(ptr)

define ptr @NRT_MemInfo_data_fast(ptr %block) {
  %place = getelementptr i64, ptr %block, i32 3
  %address = load ptr, ptr %place
  ret ptr %address
}

define i64 @NRT_counted(ptr %block, i64 %more) {
  %none = icmp eq ptr %block, null
  br i1 %none, label %left, label %there
there:
  %before = load i64, ptr %block
  %after = add i64 %before, %more
  store i64 %after, ptr %block
  ret i64 %after
left:
  ret i64 1
}

define void @NRT_incref(ptr %block) {
  %count = call i64 @NRT_counted(ptr %block, i64 1)
  ret void
}

define void @NRT_decref(ptr %block) {
  %count = call i64 @NRT_counted(ptr %block, i64 -1)
  %unused = icmp eq i64 %count, 0
  br i1 %unused, label %freed, label %done
freed:
  call void @NRT_MemInfo_call_dtor(ptr %block)
  ret void
done:
  ret void
}
"""
"""What numba's runtime has beside `MEMORY`: the counting of references, in a block's first eight bytes."""


class _Nothing:
    """In the place of what would make and run machine code."""

    def __getattr__(self, name: str) -> Any:
        return lambda *_, **__: 0


def object_code(
    functions: Mapping[str, tuple[Any, tuple[Any, ...]]], triple: str = TRIPLE, features: str = "+bulk-memory"
) -> bytes:
    """Return an object file of WebAssembly, or for another processor, with an entry for each function.

    An entry takes the addresses of its numbers, of room for what it returns, and of room for an error's
    address; it returns 0 unless it failed. An array is passed as the numbers 0, 0, its size, 8, its address,
    its shape and its strides, each an integer of 64 bits.

    Args:
        functions: by the name of its entry, each compiled function and numba's types of its arguments.
        triple: the processor and the system, as LLVM names them.
        features: of the processor that are used.

    Raises:
        RuntimeError: where the code calls what a page does not have.
    """
    machine = _change_target(triple, features)
    codegen = Codegen()
    context = cpu_target.target_context.subtarget(enable_nrt=True, _internal_codegen=codegen)
    library = codegen.create_library("engine")
    whole = library._final_module
    for name, (function, kinds) in functions.items():
        function.dispatcher.compile(kinds)
        callee = function.dispatcher.overloads[kinds]
        description = callee.fndesc
        expected = context.call_conv.get_function_type(description.restype, description.argtypes).args[2:]
        kind = returned_kind(types.none)
        passed = Passed("", "q" * len(expected), [])
        entry = entry_module(context, description, name, passed, kind) if kind is not None else None
        if entry is None:
            raise RuntimeError(f"{name}: cannot be called by rows of numbers")
        library.add_ir_module(entry)
        callee.library.link_into(whole)
    for text in (MEMORY, COUNTING, ROOM_OF_32_BITS if triple == TRIPLE else ROOM):
        whole.link_in(binding.parse_assembly(text))
    for each in (*whole.functions, *whole.global_variables):
        if each.name not in functions and not each.is_declaration:
            each.linkage = "internal"
    spare_references(whole, codegen)
    whole.triple = triple
    library._optimize_final_module()
    whole.verify()
    if foreign := set(declared(whole)) - C_LIBRARY:
        raise RuntimeError(f"the engine calls {', '.join(sorted(foreign))}, which a page does not have")
    return machine.emit_object(whole)


def _change_target(triple: str, features: str) -> binding.TargetMachine:
    """Let numba compile for another processor from here on, and make no machine code."""
    binding.initialize_all_targets()
    binding.initialize_all_asmprinters()
    reloc = "default" if triple == TRIPLE else "pic"
    machine = binding.Target.from_triple(triple).create_target_machine(opt=3, features=features, reloc=reloc)
    njit(lambda: None)()  # numba makes its own runtime for this machine when it first compiles
    rtsys.initialize(cpu_target.target_context)
    whole_of_numba = cpu_target.target_context.codegen()
    _kept.append(whole_of_numba._engine)
    for codegen in (whole_of_numba, callee_codegen()):
        codegen._tm, codegen._target_data = machine, machine.target_data
        codegen._data_layout, codegen._engine = str(machine.target_data), _Nothing()
    rtsys.library._get_module_for_linking = lambda: binding.parse_assembly(f'target triple = "{triple}"')
    CPUContext.get_executable = lambda _, *described: _not_run(*described)
    return machine


_kept: list[Any] = []
"""What owns modules that numba still asks for their names."""


def _not_run(library: Any, description: Any, environment: Any) -> Any:
    return _dynfunc.make_function(
        description.lookup_module(), description.qualname, "never run", 0, environment, (library,)
    )
