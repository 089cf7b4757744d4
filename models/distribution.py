"""The name under which pip installs cointoss, and the versions of what is installed."""

from collections.abc import Iterable
from importlib.metadata import version

DISTRIBUTION = "cointoss-dynamics"
"""As in pyproject.toml; the index has another project under `cointoss`."""


def versions_of(packages: Iterable[str]) -> dict[str, str]:
    """Return the installed version of each package, this one being "cointoss"."""
    return {name: version(DISTRIBUTION if name == "cointoss" else name) for name in packages}
