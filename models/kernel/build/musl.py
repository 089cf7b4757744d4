"""musl's sine, logarithm and the like as LLVM's code, in place of each system's own.

They are compiled from the sources that ziglang brings, without fusing products and sums.
"""

# llvmlite has no types.
# pyright: reportAttributeAccessIssue=false

import re
import tempfile
from pathlib import Path

from llvmlite import binding

from cointoss.models.kernel.build.zig import run_zig

PREFIX = "musl."
"""The beginning of the functions' names in LLVM's code."""
FUNCTIONS = (
    *("acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp", "exp2", "expm1"),
    *("hypot", "lgamma", "log", "log1p", "log2", "pow", "sin"),
)
"""The functions of musl that compiled functions may call."""
_EXACT = {
    *("ceil", "copysign", "fabs", "floor", "fmod", "maxnum", "minnum", "nearbyint", "rint", "round", "sqrt"),
    "trunc",
}
"""Functions with one right answer, the same in every C library."""
_OF_NUMBERS = re.compile(r"(double|float) \((double|float)(, (double|float))*\)")
_OF_NUMBA = ("numba_cpow", "numba_gamma")
_SOURCES = (
    *("__cos", "__sin", "__rem_pio2", "__rem_pio2_large", "scalbn"),
    *("acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "hypot", "lgamma_r"),
    *("exp", "exp2", "exp_data", "expm1", "log", "log_data", "log1p", "log2", "log2_data", "pow", "pow_data"),
    *("__math_divzero", "__math_invalid", "__math_oflow", "__math_uflow", "__math_xflow"),
)
"""Files of musl that ziglang has."""
_OURS = """
#include "libm.h"

static double part(const double *y, int quarters)
{
    const double found = quarters & 1 ? __cos(y[0], y[1]) : __sin(y[0], y[1], 1);
    return quarters & 2 ? -found : found;
}

double sin(double x)
{
    double y[2];
    if (fabs(x) < 0x1p-26) return x;
    if (fabs(x) < 0x1.921fcp-1) return __sin(x, 0, 0);
    if (!(fabs(x) < INFINITY)) return x - x;
    return part(y, __rem_pio2(x, y));
}

double cos(double x)
{
    double y[2];
    if (fabs(x) < 0x1.921fcp-1) return __cos(x, 0);
    if (!(fabs(x) < INFINITY)) return x - x;
    return part(y, 1 + __rem_pio2(x, y));
}

double power(double x, double y)
{
    if (y == 0.5) return x == -INFINITY ? INFINITY : fabs(sqrt(x));
    return pow(x, y);
}

double lgamma(double x)
{
    int sign;
    return __lgamma_r(x, &sign);
}
"""
"""What ziglang left out of musl: how the sine and the cosine use its functions for an eighth of a turn.

And a power that is a root: LLVM makes one of each `x**0.5`, but does not know musl's function as a power.
"""
_OTHER_NAMES = {"power": "pow", "pow": "__pow"}
_FIRST = """
#include <math.h>
/* They have one right answer, which processors compute. */
#define sqrt __builtin_sqrt
#define fabs __builtin_fabs
#define floor __builtin_floor
/* Flags of exceptions, which nobody asks for, would keep a function from being moved or left out. */
#define fp_barrier(x) (x)
#define fp_force_eval(x) ((void)(x))
"""
"""Comes before each source."""
_OPTIONS = (
    *("-target", "wasm32-wasi", "-O2", "-g0", "-S", "-emit-llvm"),
    *("-Xclang", "-disable-lifetime-markers"),
    # No product is fused with a sum; nothing is computed in advance by this machine's own functions.
    *("-ffp-contract=off", "-fno-builtin", "-fno-math-errno"),
)


def call_musl(module: binding.ModuleRef) -> None:
    """Let a module call musl's functions before LLVM computes or changes any of them.

    Raises:
        RuntimeError: for a function that is not there.
    """
    for function in _declared(module):
        name = _name(function)
        if name in FUNCTIONS:
            function.name = f"{PREFIX}{name}"
        elif name in _OF_NUMBA or (_is_of_numbers(function) and name not in _EXACT):
            raise RuntimeError(f"compiled code calls {name}, which is not among {', '.join(FUNCTIONS)}")


def musl_code() -> bytes:
    """Return the functions as one module without a target.

    Where ziglang's musl has not all of them, `lowering.object_code` refuses the module that calls one.

    Raises:
        RuntimeError: where a source can't be compiled, in one line.
    """
    import ziglang

    musl = Path(ziglang.__path__[0], "lib", "libc", "musl")
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "first.h").write_text(_FIRST, encoding="utf-8")
        ours = Path(folder, "ours.c")
        ours.write_text(_OURS, encoding="utf-8")
        sources = [ours, *(musl / "src" / "math" / f"{name}.c" for name in _SOURCES)]
        whole, *others = (binding.parse_assembly(_llvm(source, musl, Path(folder))) for source in sources)
    for other in others:
        whole.link_in(other)
    for each in (*whole.functions, *whole.global_variables):
        if not each.is_declaration and each.linkage == binding.Linkage.external:
            each.linkage, each.name = "linkonce_odr", f"{PREFIX}{_OTHER_NAMES.get(each.name, each.name)}"
            if each.name in (f"{PREFIX}{name}" for name in FUNCTIONS) and each.name != f"{PREFIX}pow":
                each.add_function_attribute("noinline")  # a call costs little, a copy at each call much
    whole.verify()
    return whole.as_bitcode()


def _llvm(source: Path, musl: Path, folder: Path) -> str:
    """Return the code of a source in LLVM's language, for any processor."""
    target = folder / f"{source.stem}.ll"
    included = [f"-I{musl / part}" for part in ("src/internal", "src/include", "src/math", "arch/generic")]
    run_zig("cc", *_OPTIONS, *included, "-include", folder / "first.h", source, "-o", target)
    text = target.read_text(encoding="utf-8")
    # Not every processor has other names of functions, such as that of lgamma_r.
    left_out = r"^(target |source_filename|attributes |!|@\S+ = weak .*alias ).*\n"
    text = re.sub(left_out, "", text, flags=re.MULTILINE)
    return re.sub(r" #\d+|, !\S+ !\d+|\bhidden |\blocal_unnamed_addr ", "", text)


def _declared(module: binding.ModuleRef) -> list[binding.ValueRef]:
    """Return the functions that a module calls of a C library, of numba or of LLVM."""
    names = ("_ZN", PREFIX)
    return [each for each in module.functions if each.is_declaration and not each.name.startswith(names)]


def _name(function: binding.ValueRef) -> str:
    """Return the name of a function in C."""
    return re.sub(r"^llvm\.(\w+)\.f64$", r"\1", function.name)


def _is_of_numbers(function: binding.ValueRef) -> bool:
    return _OF_NUMBERS.fullmatch(str(function.global_value_type)) is not None
