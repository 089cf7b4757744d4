"""The names under which pip installs packages, and the versions of what is installed."""

from collections.abc import Iterable

DISTRIBUTION = "cointoss-dynamics"
"""The name in pyproject.toml; the index has another project under `cointoss`."""
_DISTRIBUTIONS = {"cointoss": DISTRIBUTION, "mujoco": "mujoco-core"}
"""The names under which pip installs packages, where they differ."""


def versions_of(packages: Iterable[str]) -> dict[str, str]:
    """Return the installed version of each package, by the names under which they are imported."""
    from importlib.metadata import version  # its import takes as long as a toss

    return {name: version(_DISTRIBUTIONS.get(name, name)) for name in packages}
