"""The engine's file, where the package carries it, and the scripts by which a page uses it."""

import json
from importlib import resources

from cointoss.models.distribution import versions_of
from cointoss.models.kernel.digests import digest_of_parts
from cointoss.models.records import UnusableEngineError

SECTION = "cointoss"
"""Name of the last part of the file, which says what made it."""
FILE = "engine.wasm"
"""A wheel carries it in this folder, where `make report` builds it in a checkout."""


def engine_scripts() -> dict[str, bytes]:
    """Return the scripts by which a page uses the engine, by their names."""
    folder = resources.files("cointoss.compare.web.wasm")
    return {name: (folder / name).read_bytes() for name in ("engine.js", "workers.js")}


def engine_bytes() -> bytes:
    """Return the engine's file.

    Raises:
        UnusableEngineError: where it was not built, or of other sources.
    """
    file = resources.files("cointoss.compare.web.wasm") / FILE
    content = file.read_bytes() if file.is_file() else b""
    if made_of(content) != sources():
        raise UnusableEngineError("engine.wasm: not built, or of other sources; make report builds it")
    return content


def sources() -> str:
    """Return the version, and the digest of all that is compiled and of what compiles it."""
    version, digest = versions_of(["cointoss"]), digest_of_parts("models", "analytic", "compare/web/wasm")
    return f"{version['cointoss']} {digest}"


def made_of(content: bytes) -> str:
    """Return the hash of the sources of an engine's file, empty where it has none."""
    _, found, about = content.rpartition(SECTION.encode() + b"{")
    try:
        return str(json.loads(b"{" + about)["sources"]) if found else ""
    except (ValueError, KeyError):
        return ""
