"""A file that is kept from one process to the next: one that is damaged, or another's, is as if missing."""

import hashlib
import os
import pickle
import uuid
from pathlib import Path
from typing import Any

from cointoss.models.kernel.base_folder import can_others_write, is_own

_DIGEST = hashlib.sha256().digest_size


def read_object(path: Path, about: str) -> Any:
    """Return the pickled object that a file keeps, or None as `read_kept` does.

    None too where it names what has gone: a folder of kept code outlives the sources whose types it names,
    and pickle may raise any error then.
    """
    data = read_kept(path, about)
    try:
        return None if data is None else pickle.loads(data)
    except Exception:
        return None


def read_kept(path: Path, about: str) -> bytes | None:
    """Return what a file keeps, or None where another user could have written it, or it keeps something else.

    A file begins with a digest, so that one whose bits have changed is as if it were missing.

    Args:
        path: of the file.
        about: what is kept, as it was when it was written.
    """
    try:
        with path.open("rb") as file:
            kept, described = file.read(), os.fstat(file.fileno())
    except OSError:
        return None
    if not is_own(described) or can_others_write(described):
        return None
    digest, data = kept[:_DIGEST], kept[_DIGEST:]
    return data if digest == _digest(about, data) else None


def write_kept(path: Path, about: str, data: bytes) -> None:
    """Keep data in a file, whole or not at all.

    Raises:
        OSError: where it cannot be written.
    """
    beside = path.with_name(f"{path.name}.{uuid.uuid4().hex}")
    try:
        with os.fdopen(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
            file.write(_digest(about, data) + data)
        beside.chmod(0o600)
        beside.replace(path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def _digest(about: str, data: bytes) -> bytes:
    return hashlib.sha256(f"{about}\n".encode() + data).digest()
