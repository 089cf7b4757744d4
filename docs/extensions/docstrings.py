"""Docstrings for autodoc: plain text with `code` and the sections Args, Returns and Raises."""

import inspect
import re
from typing import Any

from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, GoogleDocstring

import cointoss

SPECIAL = re.compile(r"(`[^`]+`)|([*|\\]|(?<=\w)_(?!\w))")
RAISED = re.compile(r":raises (\w+):")
SECTIONED = ("class", "exception", "function", "method")


def plain(line: str) -> str:
    """Return a line in which only `code` is markup to reStructuredText, and an |e| or S_ is none."""
    return SPECIAL.sub(lambda found: found[1] or f"\\{found[2]}", line)


def public(name: str) -> str:
    """Return a class's name as it is described: with `cointoss`, where that has it."""
    return f"~cointoss.{name}" if name in dir(cointoss) else name


def described(lines: list[str]) -> list[str]:
    """Return plain lines, with what is indented below a blank one as code."""
    shown: list[str] = []
    for above, line in zip(["", *lines], lines, strict=False):
        begins = line.startswith("    ") and not above
        shown += ["::", "", line] if begins else [line if shown[-3:-1] == ["::", ""] else plain(line)]
    return shown


def read(app: Sphinx, what: str, name: str, it: Any, options: Any, lines: list[str]) -> None:
    """Make reStructuredText of a docstring, with a link to the record that a function returns."""
    lines[:] = [] if lines and lines[0].startswith("Alias for field") else described(lines)
    if what not in SECTIONED:
        return
    sections = GoogleDocstring(lines, Config(napoleon_use_rtype=False), app, what, name, it, options).lines()
    lines[:] = [RAISED.sub(lambda found: f":raises {public(found[1])}:", line) for line in sections]
    returned = inspect.signature(it).return_annotation if what == "function" else None
    label = getattr(returned, "__name__", "")
    if public(label) != label:
        lines += ["", f":rtype: {public(label)}"]


def setup(app: Sphinx) -> dict[str, bool]:
    """Connect to autodoc."""
    app.connect("autodoc-process-docstring", read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
