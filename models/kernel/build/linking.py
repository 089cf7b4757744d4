"""Object files linked by ziglang, for each system that has a library."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from cointoss.models.kernel.build.lowering import LlvmTarget
from cointoss.models.kernel.build.zig import run_zig
from cointoss.models.kernel.library import AVX2, HAS_AVX2, RELEASE
from cointoss.models.kernel.manifest import BROWSER

STACK = 1 << 20
"""Bytes of the stack in a page."""


class System(NamedTuple):
    """A system and processor for which an engine is linked."""

    triple: str
    """The system's name in LLVM."""
    zig: str
    """The system's name in ziglang, with the oldest C library or system that the library needs."""

    @property
    def shown(self) -> tuple[str, ...]:
        """The symbols of its runtime that a library shows, beside those of its entries."""
        if self.triple.startswith("wasm32"):
            return "malloc", "free"
        return (RELEASE, HAS_AVX2) if self.triple.startswith("x86_64") else (RELEASE,)

    @property
    def targets(self) -> dict[str, LlvmTarget]:
        """The kinds of its processor for which there is code, by what the symbols end with."""
        plain = {"": LlvmTarget(self.triple, "+bulk-memory" if self.triple.startswith("wasm32") else "")}
        return plain | {AVX2: LlvmTarget(self.triple, "+avx2")} if HAS_AVX2 in self.shown else plain


SYSTEMS = {
    "linux-x86_64": System("x86_64-unknown-linux-gnu", "x86_64-linux-gnu.2.17"),
    "linux-aarch64": System("aarch64-unknown-linux-gnu", "aarch64-linux-gnu.2.17"),
    "darwin-arm64": System("arm64-apple-macosx11.0.0", "aarch64-macos.11.0"),
    "darwin-x86_64": System("x86_64-apple-macosx10.15.0", "x86_64-macos.10.15"),
    "win32-amd64": System("x86_64-pc-windows-gnu", "x86_64-windows-gnu"),
    BROWSER: System("wasm32-unknown-unknown", "wasm32-freestanding"),
}
"""The systems by their names, see `cointoss.models.kernel.manifest.SYSTEM`."""
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


def link(codes: Sequence[bytes], shown: Sequence[str], system: System, folder: Path) -> bytes:
    """Return the library of object files, with a function `has_avx2` where that is a question.

    Args:
        codes: the object files.
        shown: the symbols that it shows.
        system: for which it is.
        folder: for what is made meanwhile.

    Raises:
        RuntimeError: where it can't be linked, in one line.
    """
    files = [folder / f"{number}.o" for number in range(len(codes))]
    for file, code in zip(files, codes, strict=True):
        file.write_bytes(code)
    made, options = folder / "made", ["-target", system.zig, "-shared", "-O2", "-s"]
    if system.triple.startswith("wasm32"):
        exported = [f"--export={name}" for name in shown]
        options = ["--no-entry", "--stack-first", "-z", f"stack-size={STACK}", "--strip-all"]
        run_zig("wasm-ld", *options, *exported, *files, "-o", made)
        return made.read_bytes()
    if HAS_AVX2 in shown:
        files.append(folder / "has_avx2.c")
        files[-1].write_text(_HAS_AVX2)
    if "linux" in system.triple:
        script = folder / "shown.map"
        names = " ".join(f'"{name}";' for name in shown)
        script.write_text(f"{{ global: {names} local: *; }};\n")
        options.append(f"-Wl,--version-script={script}")
    run_zig("cc", *options, *files, "-o", made)
    return made.read_bytes()
