"""Whether the four packages of cointoss are imported from one folder, or a foreign one shadows one of them.

The package that holds this module may itself be shadowed, so each of the four, and `cointoss`, runs this file
by its path.
"""

import sys
from importlib.util import find_spec
from os.path import realpath
from pathlib import Path

PACKAGES = ("models", "analytic", "coin_mj", "compare")


def require_siblings(home: Path) -> None:
    """Check that each of the four packages was or would be imported from `home`.

    Raises:
        ImportError: naming the package found elsewhere, the one it shadows, and the way out.
    """
    for name in PACKAGES:
        own, found = home / name / "__init__.py", _origin(name)
        if found is not None and realpath(found) != realpath(own):
            raise ImportError(
                f"{found} shadows cointoss's package {name}, {own}; accepted: no other module of this name "
                "imported before, or earlier on sys.path (rename it, or run elsewhere)"
            )


def _origin(name: str) -> str | None:
    """Return where a package was, or would be, imported from; None where there is none of this name."""
    if name in sys.modules:
        module = sys.modules[name]
        return getattr(module, "__file__", None) or str(module)
    found = find_spec(name)
    return found and found.origin


require_siblings(Path(__file__).parents[1])
