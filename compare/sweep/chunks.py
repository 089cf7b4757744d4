"""The files of a store: none is opened that is no plain file, and none decoded whose size is not the due one.

A Zarr folder names the codecs that its numbers are decoded by, and their sizes. A stranger's may name any.
"""

import json
import math
import os
import stat
from pathlib import Path
from typing import Any

from zarr.codecs import BytesCodec, ZstdCodec

from cointoss.compare.sweep.layout import FORMAT, TOSSES_FORMAT
from cointoss.models.bounded import read_bounded
from cointoss.models.errors import shown

DESCRIPTION = "zarr.json"
"""Name of the file that describes a store."""
MOST_DESCRIBED = 1 << 20
"""The most bytes of such a file."""
CODECS = [BytesCodec, ZstdCodec]
"""What a store's numbers are decoded by."""


class DamagedError(ValueError):
    """A file of a store that holds not what it should."""


def is_map(folder: Path) -> bool:
    """Return whether a folder says that it is a map, or a store of tosses, of this format."""
    try:
        said = json.loads(read_bounded(folder / DESCRIPTION, MOST_DESCRIBED))["attributes"]
        return said.get("cointoss_map") == FORMAT or said.get("cointoss_tosses") == TOSSES_FORMAT
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return False


def require_plain(folder: Path) -> None:
    """Refuse links, which lead elsewhere, pipes and devices, which may have no end, and long descriptions.

    Raises:
        DamagedError: naming the entry.
    """
    for outer, folders, files in os.walk(folder):
        for path in (Path(outer, name) for name in (*folders, *files)):
            found = path.lstat()
            if not (stat.S_ISREG(found.st_mode) or stat.S_ISDIR(found.st_mode)):
                raise DamagedError(f"{path.relative_to(folder)}: neither a file nor a folder")
            if path.name == DESCRIPTION and found.st_size > MOST_DESCRIBED:
                raise DamagedError(f"{path.relative_to(folder)}: more than {MOST_DESCRIBED} bytes")


def require_array(name: str, array: Any, most: int) -> None:
    """Refuse an array that is decoded by other codecs than ours, or by which a chunk would fill the memory.

    Args:
        name: of the array.
        array: Zarr's.
        most: numbers, of at most 8 bytes each, that it may have.

    Raises:
        DamagedError: naming the array.
    """
    if [type(codec) for codec in array.metadata.codecs] != CODECS:
        raise DamagedError(f"array {name}: codecs {shown(array.metadata.codecs)}, not bytes and zstd")
    outside = any(side > size for side, size in zip(array.chunks, array.shape, strict=True))
    if outside or math.prod(array.shape) > most or array.dtype.itemsize > 8:
        raise DamagedError(f"array {name}: chunks of {array.chunks} {array.dtype} in {array.shape}")


def require_chunk(file: Path, size: int) -> None:
    """Refuse a file that does not decode to `size` bytes.

    Raises:
        DamagedError: saying so.
        FileNotFoundError: where there is none.
    """
    with file.open("rb") as opened:
        stored, head = os.fstat(opened.fileno()).st_size, opened.read(18)
    # What can't be compressed becomes longer, by less than this.
    if stored > 2 * size + 1024 or _decoded_size(head) != size:
        raise DamagedError(f"does not decode to {size} bytes")


def _decoded_size(head: bytes) -> int | None:
    """Return how many bytes the Zstandard frame that begins so says it holds (RFC 8878, 3.1.1.1)."""
    if len(head) < 6 or head[:4] != b"\x28\xb5\x2f\xfd":
        return None
    single = head[4] >> 5 & 1
    length = (single, 2, 4, 8)[head[4] >> 6]
    start = 5 + (1 - single) + (0, 1, 2, 4)[head[4] & 3]
    field = head[start : start + length]
    return int.from_bytes(field, "little") + 256 * (length == 2) if len(field) == length > 0 else None
