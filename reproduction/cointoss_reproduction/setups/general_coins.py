"""Coins that several studies toss: 16 classes with air and floor, and a cent that is spun on its edge."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from cointoss import Scenario
from cointoss.study import Array
from cointoss_reproduction.setups.releases import directions, released

SEED = 15
PAPER_OFFSET, THICKNESS = (-1e-3, -1e-3, -2e-4), 2e-3
"""C from B of the paper's imperfect coin, and how thick it is [m]; ζ is in proportion to the thickness."""
AIR = {"normal": 0.8, "tangential": 0.2}


def paper_coin(thickness: float, *, imperfect: bool = False) -> dict[str, Any]:
    """Return the paper's coin of some thickness [m] as a scenario describes it."""
    # A thin coin's ζ is 0, not -0.
    offset = (*PAPER_OFFSET[:2], 0.0 - thickness / 10) if imperfect else (0.0, 0.0, 0.0)
    return {
        "mass": 2e-3,
        "radius": 1.25e-2,
        "thickness": thickness,
        "center_of_mass": offset,
    }


def cent(thickness: float, *, offset: float = 1e-4, **floor: Any) -> dict[str, Any]:
    """Return a cent that is spun on its edge, its air and its floor as a scenario describes them.

    Args:
        thickness: of the coin [m].
        offset: of its mass centre towards heads [m].
        floor: what its floor has beside a restitution and resistance to rolling and pivoting.
    """
    return {
        "coin": {
            "mass": 2.5e-3,
            "radius": 9.525e-3,
            "thickness": thickness,
            "center_of_mass": (0.0, 0.0, offset),
        },
        "air": AIR,
        "floor": {"restitution": 0.3, "rolling_friction": 2e-5, "pivoting_friction": 1e-4, **floor},
        "release": {"position": (0.0, 0.0, 1.0)},
        "ending": {"max_time": 120.0},
    }


@dataclass(frozen=True, kw_only=True)
class CoinClass:
    """A coin, its air and its floor."""

    thick: bool
    imperfect: bool
    air: bool
    coulomb: bool

    @property
    def scenario(self) -> Scenario:
        """What is tossed."""
        return Scenario.model_validate(
            {
                "coin": paper_coin(THICKNESS if self.thick else 0.0, imperfect=self.imperfect),
                "air": AIR if self.air else {},
                "floor": {
                    "restitution": 0.6,
                    "contact": "coulomb" if self.coulomb else "smooth",
                    "friction": 0.2 if self.coulomb else 0.0,
                },
                "release": {"position": (0.0, 0.0, 0.4)},
            }
        )

    def starts(self, count: int) -> Array:
        """Draw states at release from a hand's height: every attitude, the spin mostly about one diameter.

        Args:
            count: how many; the draws are those of this class and this number.

        Returns:
            Position, velocity, Euler parameters and angular velocity, (count, 13).
        """
        number = 8 * self.thick + 4 * self.imperfect + 2 * self.air + self.coulomb
        rng = np.random.default_rng([SEED, number])
        height, velocity = rng.uniform(0.2, 0.6, count), rng.normal(0, 0.3, (count, 3))
        attitude = directions(rng, count)
        spin = [rng.normal(0, 10, count), rng.uniform(20, 60, count), rng.normal(0, 10, count)]
        return released(height, velocity, attitude, np.stack(spin, axis=1))
