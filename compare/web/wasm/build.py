"""Makes engine.wasm where a file is not of its sources: `python -m cointoss.compare.web.wasm.build FILE`."""

import json
import sys
from importlib.metadata import version
from pathlib import Path

from cointoss.compare.web.wasm.carried import SECTION, made_of, sources
from cointoss.models.kernel.base_folder import EngineMissingError, base_folder
from cointoss.models.kernel.building import build_once, library_file
from cointoss.models.kernel.manifest import BROWSER, SYSTEM

MODULE = "cointoss.analytic.entries"
"""The engine."""


def build(out: Path, library: Path | None = None) -> None:
    """Write the engine's library for a browser, with what engine.js has to know.

    Args:
        out: the file.
        library: as it was linked; else it is built, where there is none, and with it that for this system.

    Raises:
        EngineMissingError: where it can't be built, in one line.
    """
    if library is None:
        build_once(MODULE, base_folder() / "engines", [SYSTEM, BROWSER])
        library = library_file(MODULE, BROWSER)
    # A build has no locks, by which other files are written aside; half a file is not of these sources.
    out.write_bytes(library.read_bytes() + _section())


def _section() -> bytes:
    """Return a custom section of WebAssembly: as JSON, what engine.js has to know of the engine."""
    from cointoss.analytic import by_rows
    from cointoss.compare.web.wasm.fields import described
    from cointoss.models import rows
    from cointoss.models.answers import ANSWER
    from cointoss.models.faults import ACCEPTED
    from cointoss.models.fields import PLACES
    from cointoss.models.records import Ending, Outcome

    about = {
        "version": version("cointoss-dynamics"),
        "sources": sources(),
        "fields": [described(*field) for field in PLACES.items()],
        "faults": {fault.value: sentence for fault, sentence in ACCEPTED.items()},
        "answer": ANSWER,
        "examined": rows.EXAMINED,
        "impact": by_rows.IMPACT,
        "piece": by_rows.PIECE,
        "outcomes": Outcome.by_value(),
        "endings": {ending.value: [str(ending), ending.sentence] for ending in Ending},
    }
    name = SECTION.encode()
    content = _leb128(len(name)) + name + json.dumps(about).encode()
    return b"\0" + _leb128(len(content)) + content


def _leb128(number: int) -> bytes:
    """Return a whole number as WebAssembly writes it, seven bits a byte."""
    parts = [number >> shift & 0x7F for shift in range(0, max(number.bit_length(), 1), 7)]
    return bytes([*(part | 0x80 for part in parts[:-1]), parts[-1]])


def main(arguments: list[str]) -> int:
    """Make the file that is named, unless it is of these sources, and return the exit status."""
    if len(arguments) not in (1, 2):
        print("usage: python -m cointoss.compare.web.wasm.build FILE [LIBRARY]", file=sys.stderr)
        return 2
    out, *library = map(Path, arguments)
    try:
        if not out.is_file() or made_of(out.read_bytes()) != sources():
            build(out, *library)
        elif not library:
            library_file(MODULE)
    except (EngineMissingError, OSError) as problem:
        print(f"engine.wasm: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
