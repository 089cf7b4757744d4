"""Whether the four packages of cointoss are imported from one folder, or a foreign one shadows one of them.

The package that holds this module may itself be shadowed, so each of the four runs this file by its path.
"""

from importlib.util import find_spec
from os.path import realpath
from pathlib import Path

PACKAGES = ("models", "analytic", "coin_mj", "compare")


def require_siblings(home: Path) -> None:
    """Check that each of the four packages would be imported from `home`.

    Raises:
        ImportError: naming the package found elsewhere, the one it shadows, and the way out.
    """
    for name in PACKAGES:
        found = find_spec(name)
        if found is not None and found.origin is not None:
            own = home / name / "__init__.py"
            if realpath(found.origin) != realpath(own):
                raise ImportError(
                    f"{found.origin} shadows cointoss's package {name}, {own}; "
                    "accepted: no other module of this name earlier on sys.path (rename it, or run elsewhere)"
                )


require_siblings(Path(__file__).parents[1])
