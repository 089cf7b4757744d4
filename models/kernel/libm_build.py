"""Builds musl.bc, musl's functions as LLVM's code: `python -m cointoss.models.kernel.libm_build`."""

# llvmlite has no types.
# pyright: reportAttributeAccessIssue=false

import os
import re
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from cointoss.models.kernel.libm import FILE, FUNCTIONS, PREFIX, with_digest

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


def build(out: Path = FILE) -> None:
    """Compile the functions, and write them as one module without a target.

    Raises:
        RuntimeError: where ziglang is missing or does not have musl's functions, in one line.
    """
    found = find_spec("ziglang")
    if found is None or found.origin is None:
        raise RuntimeError("ziglang is missing, which has musl's sources: pip install --group docs")
    from llvmlite import binding

    musl = Path(found.origin).parent / "lib" / "libc" / "musl"
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
    foreign = [each.name for each in whole.functions if each.is_declaration]
    if other_names := [name for name in foreign if not name.startswith("llvm.")]:
        raise RuntimeError(f"musl calls {', '.join(other_names)}, which is not among its sources here")
    defined = {each.name for each in whole.functions}
    if missing := [name for name in FUNCTIONS if f"{PREFIX}{name}" not in defined]:
        raise RuntimeError(f"ziglang's musl has no {', '.join(missing)}")
    aside = out.with_name(f"{out.name}.{os.getpid()}")
    aside.write_bytes(with_digest(whole.as_bitcode()))
    aside.replace(out)


def _llvm(source: Path, musl: Path, folder: Path) -> str:
    """Return the code of a source in LLVM's language, for any processor."""
    if not source.is_file():
        raise RuntimeError(f"ziglang has no {source.name}: pip install --group docs")
    target = folder / f"{source.stem}.ll"
    included = [f"-I{musl / part}" for part in ("src/internal", "src/include", "src/math", "arch/generic")]
    command = [sys.executable, "-m", "ziglang", "cc", *_OPTIONS, *included]
    command += ["-include", str(folder / "first.h"), str(source), "-o", str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"the compiler failed: {done.stderr.strip().splitlines()[-1]}")
    text = target.read_text(encoding="utf-8")
    text = re.sub(r"^(target |source_filename|attributes |!).*\n", "", text, flags=re.MULTILINE)
    return re.sub(r" #\d+|, !\S+ !\d+|\bhidden |\blocal_unnamed_addr ", "", text)


def main() -> int:
    """Build the file where the package looks for it, and return the exit status."""
    try:
        build()
    except (RuntimeError, OSError) as problem:
        print(f"{FILE.name}: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
