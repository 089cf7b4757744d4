"""The files that pages share, and pages that need no other file."""

import json
import re
from base64 import b64encode
from collections.abc import Mapping
from importlib import resources

POLICY = (
    "default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; "
    "img-src data: blob:; media-src data:"
)
"""The Content-Security-Policy of a page of one file: it loads nothing."""
ENGINE_POLICY = POLICY.replace("script-src", "script-src 'wasm-unsafe-eval'")
"""The Content-Security-Policy of a page of one file that holds the engine, which it compiles."""
_SCRIPT = re.compile(r'<script type="module" src="([\w.]+)"></script>')
_IMPORTED = re.compile(r"""(from\s*["'])\./([\w.]+\.js)(["'])""")


def shared_files() -> dict[str, bytes]:
    """Return the files that pages share, three.js and its licence among them, by their names."""
    page = resources.files("cointoss.compare.web") / "page"
    entries = [entry for folder in (page, page / "three") for entry in folder.iterdir() if entry.is_file()]
    return {entry.name: entry.read_bytes() for entry in entries}


def files_of(package: str) -> dict[str, bytes]:
    """Return the files of a package's page, and those that pages share, by their names."""
    page = resources.files(package) / "page"
    return {**shared_files(), **{entry.name: entry.read_bytes() for entry in page.iterdir()}}


def one_file(files: Mapping[str, bytes], data: object, policy: str) -> str:
    """Return a page as one text that loads nothing: its styles, its modules in an import map, and its data.

    Args:
        files: of the page by name, index.html among them, and three.js's LICENSE.
        data: what its scripts read from the element `data`, as JSON.
        policy: its Content-Security-Policy.
    """
    texts = {name: content.decode("utf-8") for name, content in files.items()}
    page = texts["index.html"].replace(
        '<meta charset="utf-8">',
        f'<meta charset="utf-8">\n<meta http-equiv="Content-Security-Policy" content="{policy}">',
    )
    for name, text in texts.items():
        page = page.replace(f'<link rel="stylesheet" href="{name}">', f"<style>\n{text}</style>")
    modules = {name: text for name, text in texts.items() if name.endswith(".js")}
    parts = [f"<!-- three.js:\n{texts['LICENSE']}-->", import_map(modules), data_element(data, id_="data")]
    begun = '<script type="module">import "{}";</script>'
    return _SCRIPT.sub(lambda found: "\n".join([*parts, begun.format(found[1])]), page)


def import_map(modules: dict[str, str]) -> str:
    """Return an element that holds JavaScript modules, to be imported by their names.

    Args:
        modules: texts by names; they may import each other as "./NAME".
    """
    # What a module imports is named as in the map.
    named = {name: _IMPORTED.sub(r"\1\2\3", text).encode() for name, text in modules.items()}
    held = {
        name: "data:text/javascript;base64," + b64encode(text).decode("ascii") for name, text in named.items()
    }
    return f'<script type="importmap">{json.dumps({"imports": held})}</script>'


def data_element(data: object, *, id_: str) -> str:
    """Return an element that holds data as JSON."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    # A "</script>" in the data must not end it.
    return f'<script type="application/json" id="{id_}">{text.replace("<", chr(92) + "u003c")}</script>'
