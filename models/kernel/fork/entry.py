"""The entry through which Python calls machine code without numba: it takes and returns rows of numbers."""

# numba describes few types.
# pyright: reportAttributeAccessIssue=false, reportPrivateImportUsage=false

import uuid
from collections.abc import Iterator
from typing import Any

from llvmlite import binding, ir
from numba.core import types
from numba.core.callconv import excinfo_ptr_t
from numba.core.compiler import CompileResult
from numba.core.environment import lookup_environment
from numba.core.registry import cpu_target
from numba.np.numpy_support import as_dtype

from cointoss.models.kernel.fork.callee_code import Codegen, spare_references
from cointoss.models.kernel.fork.machine_code import Kept
from cointoss.models.kernel.fork.values import Passed, Returned

MEMORY = """
declare ptr @NRT_room(i64)
declare void @free(ptr)

define noalias ptr @NRT_MemInfo_alloc_aligned(i64 %size, i32 %align) noinline {
  %wide = zext i32 %align to i64
  %room = add i64 %wide, 48
  %whole = add i64 %room, %size
  %block = call ptr @NRT_room(i64 %whole)
  %none = icmp eq ptr %block, null
  br i1 %none, label %failed, label %made
made:
  %start = ptrtoint ptr %block to i64
  %last = add i64 %start, %room
  %over = urem i64 %last, %wide
  %data = sub i64 %last, %over
  store i64 1, ptr %block
  %dtor = getelementptr i64, ptr %block, i64 1
  store i64 0, ptr %dtor
  %info = getelementptr i64, ptr %block, i64 2
  store i64 0, ptr %info
  %place = getelementptr i64, ptr %block, i64 3
  store i64 %data, ptr %place
  %length = getelementptr i64, ptr %block, i64 4
  store i64 %size, ptr %length
  %allocator = getelementptr i64, ptr %block, i64 5
  store i64 0, ptr %allocator
  ret ptr %block
failed:
  ret ptr null
}

define void @NRT_MemInfo_call_dtor(ptr %block) noinline {
  call void @free(ptr %block)
  ret void
}
"""
"""The part of numba's runtime that makes and frees arrays, with numba's layout of what counts references.

`NRT_room` is the machine's own: its C library counts bytes in 64 bits, or in 32.
"""
ROOM = """
declare ptr @malloc(i64)

define ptr @NRT_room(i64 %size) {
  %block = call ptr @malloc(i64 %size)
  ret ptr %block
}
"""
"""For a machine whose C library counts bytes in 64 bits."""
_INT, _WORD = ir.IntType(64), 8
_OTHERS = ("Py", "_Py", "NRT_", "numba_", "_ZN")
"""How the names of functions begin that only numba and Python itself have."""


def returned_kind(kind: Any) -> Returned | None:
    """Return how values of one of numba's types are returned, or None for those that are not."""
    if kind in (types.float64, types.int64, types.boolean, types.none):
        word = {types.boolean: "bool", types.none: "none"}.get(kind, "number")
        return Returned(word, "d" if kind == types.float64 else "q")
    if isinstance(kind, types.IntEnumMember) and kind.dtype == types.int64:
        return Returned("enum", "q", kind.instance_class)
    if isinstance(kind, types.BaseTuple):
        parts = [returned_kind(part) for part in kind.types]
        known = tuple(part for part in parts if part is not None)
        of = getattr(kind, "instance_class", None)
        whole = Returned("tuple", "".join(part.form for part in known), of, known)
        return whole if len(known) == len(parts) else None
    if type(kind) is types.Array and kind.layout == "C" and kind.aligned and kind.ndim > 0:
        return Returned("array", "q" * (5 + 2 * kind.ndim), as_dtype(kind.dtype), dimensions=kind.ndim)
    return None


def kept_code(callee: CompileResult, passed: Passed, kind: Returned) -> Kept | None:
    """Return machine code of a compiled function, or None where only numba can call it."""
    context = cpu_target.target_context.subtarget(enable_nrt=True, _internal_codegen=Codegen())
    codegen, description = context.codegen(), callee.fndesc
    library = codegen.create_library(callee.library.name)
    name = f"{description.mangled_name}.{uuid.uuid4().hex}"
    entry = entry_module(context, description, name, passed, kind)
    if entry is None:
        return None
    library.add_ir_module(entry)
    whole = library._final_module
    # Nothing else calls these functions here, so LLVM may change them as it likes.
    callee.library.link_into(whole, "private")
    whole.link_in(binding.parse_assembly(MEMORY))
    whole.link_in(binding.parse_assembly(ROOM))
    for function in whole.functions:
        if function.name.startswith("NRT_") and not function.is_declaration:
            function.linkage = "internal"
    spare_references(whole, codegen)
    for variable in whole.global_variables:
        if lookup_environment(variable.name) is not None:
            variable.linkage = "internal"  # Python's constants, which nothing here uses
    library._optimize_final_module()
    whole.verify()
    calls = tuple(declared(whole))
    kept = Kept(name, codegen._tm.emit_object(whole), calls, passed.form, kind)
    return kept if not any(each.startswith(_OTHERS) for each in calls) and kept.can_be_loaded else None


def declared(module: binding.ModuleRef) -> Iterator[str]:
    """Yield the names of what a module uses of others."""
    for each in (*module.functions, *module.global_variables):
        if each.is_declaration and not each.name.startswith("llvm."):
            yield each.name


def entry_module(
    context: Any, description: Any, name: str, passed: Passed, kind: Returned
) -> ir.Module | None:
    """Return the code of the entry, or None where numba passes other numbers."""
    module = context.create_module("entry")
    of_callee = context.call_conv.get_function_type(description.restype, description.argtypes)
    callee = ir.Function(module, of_callee, description.llvm_func_name)
    words = _INT.as_pointer()
    signature = ir.FunctionType(ir.IntType(32), [words, words, excinfo_ptr_t.as_pointer()])
    entry = ir.Function(module, signature, name)
    given, answer, error = entry.args
    builder = ir.IRBuilder(entry.append_basic_block())
    expected = of_callee.args[2:]
    if len(expected) != len(passed.form):
        return None
    numbers = [_loaded(builder, given, i, each) for i, each in enumerate(expected)]
    room = builder.alloca(of_callee.args[0].pointee)
    builder.store(ir.Constant(room.type.pointee, None), room)
    status = builder.call(callee, [room, error, *numbers])
    leaves = list(_leaves(builder, builder.load(room)))
    if len(leaves) != len(kind.form):
        return None
    for i, leaf in enumerate(leaves):
        builder.store(leaf, builder.gep(answer, [_INT(i)]), align=1)
    builder.ret(status)
    return module


def _loaded(builder: ir.IRBuilder, row: Any, number: int, kind: Any) -> Any:
    """Return a number of a row as a value of a type."""
    value = builder.load(builder.gep(row, [_INT(number)]), align=1)
    if isinstance(kind, ir.PointerType):
        return builder.inttoptr(value, kind)
    if isinstance(kind, ir.IntType):
        return value if kind.width == 64 else builder.trunc(value, kind)
    return builder.bitcast(value, kind)


def _leaves(builder: ir.IRBuilder, value: Any) -> Iterator[Any]:
    """Yield the numbers that a value consists of, as 8-byte integers."""
    kind = value.type
    if isinstance(kind, ir.LiteralStructType | ir.ArrayType):
        for i in range(len(kind)):
            yield from _leaves(builder, builder.extract_value(value, i))
    elif isinstance(kind, ir.PointerType):
        yield builder.ptrtoint(value, _INT)
    elif isinstance(kind, ir.IntType):
        yield value if kind.width == 64 else builder.sext(value, _INT)
    else:
        yield builder.bitcast(value, _INT)
