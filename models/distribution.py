"""The name under which pip installs cointoss, and the versions of what is installed."""

from collections.abc import Iterable

DISTRIBUTION = "cointoss-dynamics"
"""The name in pyproject.toml; the index has another project under `cointoss`."""


def versions_of(packages: Iterable[str]) -> dict[str, str]:
    """Return the installed version of each package, this one being "cointoss"."""
    from importlib.metadata import version  # its import takes as long as a toss

    return {name: version(DISTRIBUTION if name == "cointoss" else name) for name in packages}
