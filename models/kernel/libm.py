"""Whose sine and logarithm compiled functions call: the system's, or musl's, the same on every machine."""

import hashlib
import os
from functools import cache
from pathlib import Path

FILE = Path(__file__).with_name("musl.bc")
"""musl's functions as LLVM's code, after the hash of that code: `libm_build` makes it."""
PREFIX = "musl."
"""How their names begin there."""
FUNCTIONS = (
    *("acos", "acosh", "asin", "asinh", "atan", "atan2", "atanh", "cos", "exp", "exp2", "expm1"),
    *("hypot", "lgamma", "log", "log1p", "log2", "pow", "sin"),
)
"""Those that compiled functions may call."""


def check_libm() -> None:
    """Check which functions are asked for, and that they are there.

    Raises:
        ImportError: in one line.
    """
    asked = os.environ.get("COINTOSS_LIBM", "")
    if asked not in ("", "musl"):
        raise ImportError(f"COINTOSS_LIBM = {asked!r}: accepted: musl, or unset")
    if asked and read_code() is None:
        problem = "is damaged; remove it, and" if FILE.exists() else "is missing;"
        raise ImportError(f"COINTOSS_LIBM = 'musl': {FILE} {problem} make libm builds it")


@cache
def musl() -> bytes | None:
    """Return musl's functions, or None where those of the system are called."""
    check_libm()
    return read_code() if os.environ.get("COINTOSS_LIBM") else None


@cache
def libm_digest() -> str:
    """Return the hash of musl's functions, empty where those of the system are called."""
    code = musl()
    return "" if code is None else hashlib.sha256(code).hexdigest()[:16]


def with_digest(code: bytes) -> bytes:
    """Return what the file holds: the hash of the code, then the code."""
    return hashlib.sha256(code).digest() + code


def read_code() -> bytes | None:
    """Return the code in the file, or None where there is none or its hash is another."""
    try:
        content = FILE.read_bytes()
    except OSError:
        return None
    code = content[hashlib.sha256().digest_size :]
    return code if content == with_digest(code) else None
