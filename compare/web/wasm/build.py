"""Builds engine.wasm: `python -m cointoss.compare.web.wasm.build FILE`."""

import json
import os
import subprocess
import sys
import tempfile
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from cointoss.compare.output.files import written_whole
from cointoss.compare.web.wasm.carried import SECTION, sources
from cointoss.models.kernel import libm_build
from cointoss.models.kernel.fork import TESTED, numba_version
from cointoss.models.kernel.libm import read_code
from cointoss.models.kernel.sources import is_as_imported

ENTRIES = {
    "examine": ("numbers", "numbers"),
    "toss_each": ("table", "integer", "table"),
    "toss_one": ("numbers", "numbers", "table", "table", "numbers"),
    "sample_path": ("numbers", "table", "numbers", "table", "table"),
}
"""The functions of `interface`, and their arguments: rows of numbers, tables of two axes, an integer."""
STACK = 1 << 20
"""Bytes of the stack."""


def build(out: Path) -> None:
    """Compile the engine, link it, and write it.

    Raises:
        RuntimeError: where numba or the linker cannot do it, in one line.
    """
    if numba_version().rpartition(".")[0] not in TESTED:
        raise RuntimeError(f"numba {numba_version()}: accepted for WebAssembly: {', '.join(TESTED)}")
    if find_spec("ziglang") is None:
        raise RuntimeError("ziglang is missing, which links WebAssembly: pip install --group docs")
    if read_code() is None:
        libm_build.build()
    with tempfile.TemporaryDirectory() as folder:
        # Code for a page is never mixed with that for this machine.
        os.environ["NUMBA_CACHE_DIR"] = folder
        os.environ["COINTOSS_LIBM"] = "musl"
        from numba import types

        from cointoss.compare.web.wasm import interface
        from cointoss.compare.web.wasm.compiler import object_code

        kinds = {
            "numbers": types.Array(types.float64, 1, "C"),
            "table": types.Array(types.float64, 2, "C"),
            "integer": types.int64,
        }
        functions = {
            name: (getattr(interface, name), tuple(kinds[kind] for kind in arguments))
            for name, arguments in ENTRIES.items()
        }
        code = Path(folder) / "engine.o"
        code.write_bytes(object_code(functions))
        linked = Path(folder) / "engine.wasm"
        _link(code, linked)
        if not is_as_imported(interface.__name__):
            raise RuntimeError("its sources have changed while they were compiled: build it again")
        with written_whole(out) as aside:
            aside.write_bytes(linked.read_bytes() + _section(_description()))


def _link(code: Path, linked: Path) -> None:
    """Link an object file with the memory of a C library."""
    exported = [f"-Wl,--export={name}" for name in (*ENTRIES, "malloc", "free")]
    command = [
        *(sys.executable, "-m", "ziglang", "cc", "-target", "wasm32-wasi", "-mexec-model=reactor", "-O3"),
        *(str(code), *exported, "-Wl,--no-entry", "-Wl,--strip-all", f"-Wl,-z,stack-size={STACK}"),
        *("-o", str(linked)),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode:
        raise RuntimeError(f"the linker failed: {done.stderr.strip().splitlines()[-1]}")


def _description() -> dict[str, object]:
    """Return what engine.js has to know of the engine."""
    from cointoss.compare.web.wasm import interface
    from cointoss.compare.web.wasm.fields import described
    from cointoss.models.faults import ACCEPTED
    from cointoss.models.records import Ending, Outcome

    return {
        "version": version("cointoss-dynamics"),
        "sources": sources(),
        "fields": described(),
        "faults": {fault.value: sentence for fault, sentence in ACCEPTED.items()},
        "answer": interface.ANSWER,
        "examined": interface.EXAMINED,
        "impact": interface.IMPACT,
        "piece": interface.PIECE,
        "outcomes": Outcome.by_value(),
        "endings": {ending.value: [str(ending), ending.sentence] for ending in Ending},
    }


def _section(about: dict[str, object]) -> bytes:
    """Return a custom section of WebAssembly that holds JSON."""
    name, text = SECTION.encode(), json.dumps(about).encode()
    content = _leb128(len(name)) + name + text
    return b"\0" + _leb128(len(content)) + content


def _leb128(number: int) -> bytes:
    """Return a whole number as WebAssembly writes it, seven bits a byte."""
    parts = [number >> shift & 0x7F for shift in range(0, max(number.bit_length(), 1), 7)]
    return bytes([*(part | 0x80 for part in parts[:-1]), parts[-1]])


def main(arguments: list[str]) -> int:
    """Build the file that is named, and return the exit status."""
    if len(arguments) != 1:
        print("usage: python -m cointoss.compare.web.wasm.build FILE", file=sys.stderr)
        return 2
    try:
        build(Path(arguments[0]))
    except (RuntimeError, OSError, ImportError) as problem:
        print(f"engine.wasm: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
