"""Builds engine.wasm where a file is not of its sources: `python -m cointoss.compare.web.wasm.build FILE`."""

import json
import sys
import tempfile
import time
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

from cointoss.compare.output.files import write_bytes
from cointoss.compare.web.wasm.carried import SECTION, made_of, sources
from cointoss.models.kernel.building import NEEDED, told
from cointoss.models.kernel.digests import digest_of_parts

ENTRIES = ("examine", "toss_each", "toss_one", "sample_path")
"""The entries of the analytic engine that a page calls."""
STACK = 1 << 20
"""Bytes of the stack."""


def build(out: Path) -> None:
    """Compile the engine, link it, and write it, in a process that does nothing else.

    Raises:
        RuntimeError: where it can't be done, in one line.
    """
    if missing := [each for each in NEEDED if find_spec(each) is None]:
        raise RuntimeError(f"{', '.join(missing)} is missing, which makes it: pip install --group dev")
    from cointoss.models.kernel.build.__main__ import alone, asked_of
    from cointoss.models.kernel.build.linking import linked
    from cointoss.models.kernel.build.lowering import LlvmTarget, lowered, object_code

    target, before = LlvmTarget("wasm32-unknown-unknown", "+bulk-memory"), sources()
    exported = [f"-Wl,--export={name}" for name in (*ENTRIES, "malloc", "free")]
    options = ["-mexec-model=reactor", "-O3", *exported, "-Wl,--no-entry", "-Wl,--strip-all"]
    with told("building the engine for a browser, once", time.monotonic()):
        asked = asked_of(alone("cointoss.analytic.entries"), ENTRIES)
        code = object_code(lowered(asked, target), target, {})
        with tempfile.TemporaryDirectory() as folder:
            engine = linked([code], "wasm32-wasi", [*options, f"-Wl,-z,stack-size={STACK}"], Path(folder))
    digest_of_parts.cache_clear()
    if sources() != before:
        raise RuntimeError("its sources have changed while they were compiled: build it again")
    write_bytes(out, engine + _section(_description()))


def _description() -> dict[str, object]:
    """Return what engine.js has to know of the engine."""
    from cointoss.analytic import by_rows
    from cointoss.compare.web.wasm.fields import described
    from cointoss.models import rows
    from cointoss.models.answers import ANSWER
    from cointoss.models.faults import ACCEPTED
    from cointoss.models.records import Ending, Outcome

    return {
        "version": version("cointoss-dynamics"),
        "sources": sources(),
        "fields": described(),
        "faults": {fault.value: sentence for fault, sentence in ACCEPTED.items()},
        "answer": ANSWER,
        "examined": rows.EXAMINED,
        "impact": by_rows.IMPACT,
        "piece": by_rows.PIECE,
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
    """Build the file that is named, unless it is of these sources, and return the exit status."""
    if len(arguments) != 1:
        print("usage: python -m cointoss.compare.web.wasm.build FILE", file=sys.stderr)
        return 2
    out = Path(arguments[0])
    try:
        if not out.is_file() or made_of(out.read_bytes()) != sources():
            build(out)
    except (RuntimeError, OSError, ImportError) as problem:
        print(f"engine.wasm: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
