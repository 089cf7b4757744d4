"""The files that pages share, and pages that need no other file."""

import json
import re
from base64 import b64encode
from importlib import resources

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; "
    "img-src data: blob:; media-src data:"
)
"""The Content-Security-Policy of a page of one file: it loads nothing."""
ENGINE_POLICY = POLICY.replace("script-src", "script-src 'wasm-unsafe-eval'")
"""That of one that holds the engine, which it compiles."""
_IMPORTED = re.compile(r"""(from\s*["'])\./([\w.]+\.js)(["'])""")


def shared_files() -> dict[str, bytes]:
    """Return the files that pages share, three.js and its licence among them, by their names."""
    page = resources.files("cointoss.compare.web") / "page"
    entries = [entry for folder in (page, page / "three") for entry in folder.iterdir() if entry.is_file()]
    return {entry.name: entry.read_bytes() for entry in entries}


def import_map(modules: dict[str, str]) -> str:
    """Return an element that holds JavaScript modules, to be imported by their names.

    Args:
        modules: texts by names; they may import each other as "./NAME".
    """
    held = {
        name: "data:text/javascript;base64," + b64encode(_by_name(text).encode()).decode("ascii")
        for name, text in modules.items()
    }
    return f'<script type="importmap">{json.dumps({"imports": held})}</script>'


def data_element(data: object, *, id_: str) -> str:
    """Return an element that holds data as JSON."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    # A "</script>" in the data must not end it.
    return f'<script type="application/json" id="{id_}">{text.replace("<", chr(92) + "u003c")}</script>'


def _by_name(module: str) -> str:
    """Return a module's text with what it imports named as in the import map."""
    return _IMPORTED.sub(r"\1\2\3", module)
