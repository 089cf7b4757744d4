"""The names that a module offers from elsewhere, each brought from its home when it is first used."""

import ast
from importlib import import_module
from pathlib import Path
from typing import Any

_OF_BOUNCE = ("Bounce", "PairBounce", "PairRest", "Rebounds", "bounce", "solref", "solref_of")
MOVED: dict[str, str] = {
    **{name: f"cointoss_bounce.{name} now; accepted: pip install cointoss-bounce" for name in _OF_BOUNCE},
    **{
        name: f"cointoss_yardstick.{name} now; accepted: pip install cointoss-yardstick"
        for name in ("Card", "conform")
    },
}
"""Names that are another distribution's now: what to import instead, and what to install for it."""


def homes_of(file: str) -> dict[str, tuple[str, str]]:
    """Return the home of each name that a module imports under `if TYPE_CHECKING`, and its name there.

    Args:
        file: the module's source.
    """
    tree = ast.parse(Path(file).read_text(encoding="utf-8"))
    blocks = (node for node in tree.body if isinstance(node, ast.If))
    imports = (node for block in blocks for node in block.body if isinstance(node, ast.ImportFrom))
    return {
        each.asname or each.name: (node.module or "", each.name) for node in imports for each in node.names
    }


def brought(homes: dict[str, tuple[str, str]], name: str, module: str) -> Any:
    """Return what a name of a module stands for.

    Raises:
        AttributeError: for a name that it does not offer.
        ImportError: for one that has moved, with its new place, which `from ... import` then says too.
    """
    if name not in homes:
        if name in MOVED:
            raise ImportError(f"{module}.{name} is {MOVED[name]}")
        from cointoss.models.errors import meant

        told = meant(name, homes).strip() or f"accepted: {', '.join(sorted(homes))}"
        raise AttributeError(
            f"{module} has no {name}; {told}", obj=None
        )  # of a module, Python would ask "Did you mean" once more
    home, name_there = homes[name]
    return getattr(import_module(home), name_there)
