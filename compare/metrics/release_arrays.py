"""Many releases picked, put together and changed."""

from collections.abc import Sequence
from dataclasses import fields, replace

import numpy as np
from numpy.typing import NDArray

from cointoss.models.records import Array
from cointoss.models.releases import Releases


def chosen(releases: Releases, which: slice | NDArray[np.intp]) -> Releases:
    """Return some of many releases."""
    return Releases(**{item.name: getattr(releases, item.name)[which] for item in fields(Releases)})


def joined(parts: Sequence[Releases]) -> Releases:
    """Return the releases of several, one after the other."""
    return Releases(
        **{item.name: np.concatenate([getattr(one, item.name) for one in parts]) for item in fields(Releases)}
    )


def moved(
    releases: Releases, *, position: Array | float = 0.0, angular_velocity: Array | float = 0.0
) -> Releases:
    """Return releases from elsewhere or with more spin.

    Args:
        releases: those to change.
        position: added to the positions of C, space frame [m].
        angular_velocity: added to ω, body frame [rad/s].
    """
    spins = releases.angular_velocity + angular_velocity
    return replace(releases, position=releases.position + position, angular_velocity=spins)
