"""The calls of a C library's functions in LLVM's code, led to musl's."""

# llvmlite has no types.
# pyright: reportAttributeAccessIssue=false

import re

from llvmlite import binding

from cointoss.models.kernel.libm import FUNCTIONS, PREFIX, musl

_EXACT = {
    *("ceil", "copysign", "fabs", "floor", "fmod", "maxnum", "minnum", "nearbyint", "rint", "round", "sqrt"),
    "trunc",
}
"""Functions with one right answer, the same in every C library."""
_OF_NUMBERS = re.compile(r"(double|float) \((double|float)(, (double|float))*\)")
_OF_NUMBA = ("numba_cpow", "numba_gamma")


def call_musl(module: binding.ModuleRef) -> None:
    """Let a module call musl's functions, if it is asked for, before LLVM computes or changes any of them.

    Raises:
        RuntimeError: for a function that is not there.
    """
    if musl() is None:
        return
    for function in _declared(module):
        name = _name(function)
        if name in FUNCTIONS:
            function.name = f"{PREFIX}{name}"
        elif name in _OF_NUMBA or (_is_of_numbers(function) and name not in _EXACT):
            raise RuntimeError(f"compiled code calls {name}, which is not among {', '.join(FUNCTIONS)}")


def link_musl(module: binding.ModuleRef, linkage: str) -> None:
    """Add musl's functions to a module, if it is asked for, with this linkage.

    Raises:
        RuntimeError: where code that numba has compiled by itself calls those of the system.
    """
    code = musl()
    if code is None:
        return
    if other := [_name(function) for function in _declared(module) if _name(function) in FUNCTIONS]:
        raise RuntimeError(f"numba's own code calls {', '.join(other)} of the system")
    module.link_in(binding.parse_bitcode(code), preserve=True)
    for each in (*module.functions, *module.global_variables):
        if each.name.startswith(PREFIX):
            each.linkage = linkage


def _declared(module: binding.ModuleRef) -> list[binding.ValueRef]:
    """Return the functions that a module calls of a C library, of numba or of LLVM."""
    names = ("_ZN", PREFIX)
    return [each for each in module.functions if each.is_declaration and not each.name.startswith(names)]


def _name(function: binding.ValueRef) -> str:
    """Return the name of a function in C."""
    return re.sub(r"^llvm\.(\w+)\.f64$", r"\1", function.name)


def _is_of_numbers(function: binding.ValueRef) -> bool:
    return _OF_NUMBERS.fullmatch(str(function.global_value_type)) is not None
