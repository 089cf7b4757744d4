"""The names that a module offers from elsewhere, each brought from its home when it is first used."""

import ast
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple


class Home(NamedTuple):
    """Where a name comes from."""

    module: str
    name: str


def homes_of(file: str) -> dict[str, Home]:
    """Return the home of each name that a module imports under `if TYPE_CHECKING`.

    Args:
        file: the module's source.
    """
    tree = ast.parse(Path(file).read_text(encoding="utf-8"))
    blocks = (node for node in tree.body if isinstance(node, ast.If))
    imports = (node for block in blocks for node in block.body if isinstance(node, ast.ImportFrom))
    return {
        each.asname or each.name: Home(node.module or "", each.name)
        for node in imports
        for each in node.names
    }


def brought(homes: dict[str, Home], name: str, module: str) -> Any:
    """Return what a name of a module stands for.

    Raises:
        AttributeError: for a name that it does not offer.
    """
    if name not in homes:
        raise AttributeError(f"{module} has no {name}; accepted: {', '.join(sorted(homes))}")
    home = homes[name]
    return getattr(import_module(home.module), home.name)
