"""Write blocks into their places on a page, each between two comments."""

from collections.abc import Mapping
from pathlib import Path

from cointoss.compare.output.files import write_text


def fill(path: Path, blocks: Mapping[str, str]) -> None:
    """Write the blocks of a page, by the names of their places, where it has these."""
    page = written = path.read_text(encoding="utf-8")
    for name, block in blocks.items():
        before, after = f"<!-- written by: make pages, {name} -->\n\n", "\n\n<!-- end -->\n"
        head, place, rest = written.partition(before)
        if place:
            _, _, tail = f"\n\n{rest}".partition(after)
            written = head + before + block + after + tail
    if written != page:
        write_text(path, written)
