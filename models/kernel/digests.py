"""Digests of the project's sources."""

import hashlib
from functools import cache
from pathlib import Path

HOME = Path(__file__).parents[2]
"""The folder that holds the project's parts."""
ENGINES = ("models", "analytic", "coin_mj")
"""The parts of which the engines are made."""


def digest_of(file: Path) -> str:
    """Return the digest of a file's content, empty where it cannot be read or is none, but a device."""
    try:
        return hashlib.sha256(file.read_bytes()).hexdigest() if file.is_file() else ""
    except OSError:
        return ""


@cache
def digest_of_parts(*parts: str) -> str:
    """Return the digest of all Python sources in parts of the project, such as "analytic"."""
    digest = hashlib.sha256()
    for part in parts:
        for file in sorted(Path(HOME, part).rglob("*.py")):
            digest.update(f"{file.relative_to(HOME)} {digest_of(file)}\n".encode())
    return digest.hexdigest()[:16]


def code_digest() -> str:
    """Return the digest of all the sources that tosses and studies are made of."""
    return digest_of_parts(*ENGINES, "compare")
