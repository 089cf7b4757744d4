"""Coins that every engine tosses: 16 classes of coin, air and floor, random tosses, and tosses of hands."""

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.batch import rows_from_states
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_quaternion, scenario
from tests.helpers.many import same_states

SEED = 15


def paper_coin(*, thick: bool, imperfect: bool) -> dict[str, Any]:
    """Return one of the paper's four coins; a thin one has its mass centre at ζ = 0."""
    xi, eta, zeta = PAPER_OFFSET if imperfect else (0.0, 0.0, 0.0)
    offset = [xi, eta, zeta if thick else 0.0]
    return {**ZLOTY, "thickness": ZLOTY["thickness"] if thick else 0.0, "center_of_mass": offset}


@dataclass(frozen=True, kw_only=True)
class CoinClass:
    """A coin, its air and its floor."""

    thick: bool
    imperfect: bool
    air: bool
    coulomb: bool

    @property
    def name(self) -> str:
        """The class in words."""
        words = (("thin", "thick"), ("ideal", "imperfect"), ("vacuum", "air"), ("smooth", "coulomb"))
        kinds = (self.thick, self.imperfect, self.air, self.coulomb)
        return ", ".join(pair[kind] for pair, kind in zip(words, kinds, strict=True))

    @property
    def scenario(self) -> Scenario:
        """What is tossed."""
        rough = {"contact": "coulomb", "friction": 0.2} if self.coulomb else {"contact": "smooth"}
        return scenario(
            coin=paper_coin(thick=self.thick, imperfect=self.imperfect),
            air=AIR if self.air else {},
            floor={"restitution": 0.6, **rough},
        )

    def starts(self, count: int) -> Array:
        """Draw states at release from a hand's height: every attitude, the spin mostly about one diameter.

        Args:
            count: how many; the draws are those of this class and this number.

        Returns:
            Position, velocity, Euler parameters and angular velocity, (count, 13).
        """
        rng, place = np.random.default_rng([SEED, CLASSES.index(self)]), np.zeros((count, 3))
        place[:, 2], velocity = rng.uniform(0.2, 0.6, count), rng.normal(0, 0.3, (count, 3))
        e = rng.normal(size=(count, 4))
        spin = [rng.normal(0, 10, count), rng.uniform(20, 60, count), rng.normal(0, 10, count)]
        turned = e / np.linalg.norm(e, axis=1, keepdims=True)
        return np.hstack([place, velocity, turned, np.stack(spin, axis=1)])

    def rows(self, count: int) -> Array:
        """Return the tosses from those states as rows, (count, m)."""
        return rows_from_states(self.scenario, self.starts(count))


CLASSES = tuple(
    CoinClass(thick=thick, imperfect=imperfect, air=air, coulomb=coulomb)
    for thick, imperfect, air, coulomb in product((False, True), repeat=4)
)


FLOORS = (("smooth", "kinematic", 0.95), ("coulomb", "kinematic", 0.7), ("coulomb", "energetic", 0.95))
"""A contact law, its kind of restitution, and the largest one that is drawn."""


def draw_toss(rng: np.random.Generator, *, imperfect: bool) -> Scenario:
    """Draw a toss from a hand's height: thick or thin coin, floor, air, restitution, friction and release."""
    thick, (law, kind, most), air = bool(rng.integers(2)), FLOORS[rng.integers(3)], rng.integers(2)
    floor = {"contact": law, "restitution_kind": kind, "restitution": rng.uniform(0.1, most)}
    floor["friction"] = rng.uniform(0.05, 0.8)
    release = {"quaternion": draw_quaternion(rng), "position": [0.0, 0.0, rng.uniform(0.05, 0.6)]}
    release["velocity"] = rng.uniform(-0.3, 0.3, 3).tolist()
    release["angular_velocity"] = rng.uniform(-40, 40, 3).tolist()
    coin = paper_coin(thick=thick, imperfect=imperfect)
    return scenario(coin=coin, air=AIR if air else {}, floor=floor, release=release)


def states_of_hands(rng: np.random.Generator, hands: int, *, aside: float) -> Array:
    """Draw the states at release of some hands, each with a habit of its own, (hands, 13).

    Heads is up, 7° from flat, as in Fig. 24; the coin goes up and spins mostly about η.

    Args:
        rng: the source of chance.
        hands: how many.
        aside: the spins about ξ and ζ are up to so much [rad/s].
    """
    height, upwards, xi, eta = (
        rng.uniform(low, high, hands) for low, high in ((0.8, 1.2), (1.0, 3.0), (-aside, aside), (20.0, 60.0))
    )
    zeta, nothing = rng.uniform(-aside, aside, hands), np.zeros(hands)
    return same_states(
        hands,
        position=np.stack([nothing, nothing, height], axis=1),
        velocity=np.stack([nothing, nothing, upwards], axis=1),
        quaternion=quaternion_from_angles((0.0, float(np.radians(7)), 0.0)),
        angular_velocity=np.stack([xi, eta, zeta], axis=1),
    )
