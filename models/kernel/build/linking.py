"""Object files linked by ziglang, for each system that has a library."""

import subprocess
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from cointoss.models.kernel.build.lowering import LlvmTarget
from cointoss.models.kernel.library import AVX2, RELEASE


class System(NamedTuple):
    """A system and processor for which an engine is linked."""

    triple: str
    """The system's name in LLVM."""
    zig: str
    """The system's name in ziglang, with the oldest C library or system that the library needs."""

    @property
    def targets(self) -> dict[str, LlvmTarget]:
        """The kinds of its processor for which there is code, by what the symbols end with."""
        plain = {"": LlvmTarget(self.triple)}
        return (
            {**plain, AVX2: LlvmTarget(self.triple, "+avx2")} if self.triple.startswith("x86_64") else plain
        )


SYSTEMS = {
    "linux-x86_64": System("x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17"),
    "linux-aarch64": System("aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17"),
    "darwin-arm64": System("arm64-apple-macosx11.0.0", "aarch64-macos.11.0"),
    "darwin-x86_64": System("x86_64-apple-macosx10.15.0", "x86_64-macos.10.15"),
    "win32-amd64": System("x86_64-pc-windows-gnu", "x86_64-windows-gnu"),
}
"""The systems by their names, see `cointoss.models.kernel.library.SYSTEM`."""
_HAS_AVX2 = """
#include <cpuid.h>

int has_avx2(void)
{
    unsigned a, b, c, d, low, high;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE)) return 0;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return (low & 6) == 6 && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & bit_AVX2) != 0;
}
"""
"""Whether processor and system have vectors of four numbers."""


def link(codes: Sequence[bytes], symbols: Sequence[str], system: System, folder: Path) -> bytes:
    """Return the library of object files, with a function `has_avx2` where that is a question.

    Args:
        codes: the object files.
        symbols: that the library shows.
        system: for which it is.
        folder: for what is made meanwhile.

    Raises:
        RuntimeError: where it can't be linked, in one line.
    """
    options, shown = ["-shared"], [*symbols, RELEASE]
    if system.triple.startswith("x86_64"):
        source = folder / "has_avx2.c"
        source.write_text(_HAS_AVX2)
        options.append(str(source))
        shown.append("has_avx2")
    if "linux" in system.triple:
        script = folder / "shown.map"
        names = " ".join(f'"{name}";' for name in shown)
        script.write_text(f"{{ global: {names} local: *; }};\n")
        options.append(f"-Wl,--version-script={script}")
    return linked(codes, system.zig, options, folder)


def linked(codes: Sequence[bytes], target: str, options: Sequence[str], folder: Path) -> bytes:
    """Return what ziglang links of object files with these options.

    Raises:
        RuntimeError: where it can't, in one line.
    """
    if find_spec("ziglang") is None:
        raise RuntimeError("ziglang is missing, which links it: pip install --group dev")
    files = [folder / f"{number}.o" for number in range(len(codes))]
    for file, code in zip(files, codes, strict=True):
        file.write_bytes(code)
    made = folder / "made"
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, "-O2", "-s", *map(str, files)]
    done = subprocess.run([*command, *options, "-o", str(made)], capture_output=True, text=True, check=False)
    if done.returncode:
        lines = done.stderr.strip().splitlines() or ["it says nothing"]
        raise RuntimeError(f"the linker failed: {lines[-1]}")
    return made.read_bytes()
