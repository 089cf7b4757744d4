"""How two engines differ at their matched impacts."""

from dataclasses import dataclass

import numpy as np

from models.records import Array, Impacts


@dataclass(frozen=True, kw_only=True, eq=False)
class Differences:
    """Differences of impacts matched by their number, of a against b; arrays are read-only."""

    time: Array
    """Of the touches, a - b, (n,) [s]."""
    impulse: Array
    """|S_a - S_b|/|S_a|, (n,)."""
    angular_velocity: Array
    """|ω_a' - ω_b'|/|ω_a'| after the impact, (n,); infinite where only ω_b' turns."""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for array in (self.time, self.impulse, self.angular_velocity):
            array.setflags(write=False)


def match(a: Impacts, b: Impacts) -> Differences:
    """Match the impacts of two tosses by their number, as many as both have."""
    n = min(len(a), len(b))
    return Differences(
        time=a.time[:n] - b.time[:n],
        impulse=_relative(a.impulse[:n], b.impulse[:n]),
        angular_velocity=_relative(a.angular_velocity_after[:n], b.angular_velocity_after[:n]),
    )


def _relative(a: Array, b: Array) -> Array:
    apart, size = np.linalg.norm(a - b, axis=1), np.linalg.norm(a, axis=1)
    return np.divide(apart, size, out=np.where(apart > 0, np.inf, 0.0), where=size > 0)
