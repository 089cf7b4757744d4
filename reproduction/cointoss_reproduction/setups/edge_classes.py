"""Coins tossed by hand that may end on their edge, from thin ones to rods, and a nickel on many floors."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from cointoss import Hand, Scenario, analytic
from cointoss.study import Answers, Array, rows_from_states
from cointoss_reproduction.setups.ends import ends_of

SEED = 1993
DIAMETER, THICKNESS, MASS = 21.21e-3, 1.95e-3, 5e-3
"""The US nickel [m, m, kg]; the other coins have its width and its metal."""
NICKEL = THICKNESS / DIAMETER
"""h/D of the nickel."""
PUBLISHED = 1 / 6000
"""Murray and Teare's share of a nickel's tosses on edge."""
DIAMETRAL, WOBBLING = HANDS = ("about a diameter", "as people")
"""ψ = 90°; and with the scatter that explains the flips of 48 people."""
BASE: dict[str, Any] = {
    "contact": "coulomb",
    "restitution": 0.5,
    "friction": 0.3,
    "rolling_friction": 1e-4,
    "pivoting_friction": 1e-4,
}
"""The floor by default."""
AS_SAID, FREE, RESISTING = "as said", "δ = p = 0", "δ = p = 1 mm"
FACTORS: dict[str, dict[str, Any]] = {
    AS_SAID: {},
    "χ = 0.2": {"floor": {"restitution": 0.2}},
    "χ = 0.8": {"floor": {"restitution": 0.8}},
    "energetic restitution": {"floor": {"restitution_kind": "energetic"}},
    "smooth": {"floor": {"contact": "smooth", "friction": 0.0}},
    "μ = 0.1": {"floor": {"friction": 0.1}},
    "μ = 0.6": {"floor": {"friction": 0.6}},
    FREE: {"floor": {"rolling_friction": 0.0, "pivoting_friction": 0.0}},
    RESISTING: {"floor": {"rolling_friction": 1e-3, "pivoting_friction": 1e-3}},
    "plastic up to 10 mm/s": {"floor": {"restitution_threshold": 1e-2}},
    "vacuum": {"air": False},
    "from 0.3 m": {"hand": {"height": 0.3}},
    "40 rad/s": {"hand": {"spin": 40.0}},
    "250 rad/s": {"hand": {"spin": 250.0}},
}
"""What differs from χ = 0.5, μ = 0.3, δ = p = 0.1 mm, a release at 1 m with 120 rad/s, in air."""


@dataclass(frozen=True, kw_only=True)
class EdgeClass:
    """A coin, its air and floor, and the hand that tosses it."""

    name: str
    """The name of the class, which also seeds its draws."""
    aspect: float = NICKEL
    """h/D."""
    hand: Hand
    floor: Mapping[str, Any]
    """What differs from `BASE`."""
    air: bool = True

    @property
    def scenario(self) -> Scenario:
        """What is tossed."""
        h = self.aspect * DIAMETER
        return Scenario.model_validate(
            {
                "coin": {"mass": MASS * h / THICKNESS, "radius": DIAMETER / 2, "thickness": h},
                "air": {"normal": 0.8, "tangential": 0.2} if self.air else {},
                "floor": {**BASE, **self.floor},
                "release": {"position": [0, 0, 10 * DIAMETER]},
                "ending": {"max_time": 60.0},
            }
        )

    def starts(self, count: int) -> Array:
        """Draw states at release, with either side up as likely, (count, 13)."""
        rng = np.random.default_rng([SEED, zlib.crc32(self.name.encode()), 0])
        return self.hand.states(self.scenario.body, rng, count)

    def tossed(self, count: int) -> Answers:
        """Toss coins from those states, and return how each ends."""
        return analytic.toss_rows(rows_from_states(self.scenario, self.starts(count)))

    def ends(self, count: int, engine: str = "analytic") -> dict[str, int]:
        """Toss coins as `cointoss shares` does, and return how often they have each outcome, as a row."""
        seed = zlib.crc32(self.name.encode(), SEED)
        return ends_of(self.scenario, self.hand, count, engine=engine, seed=seed)


def hand_of(wobble: str, **other: Any) -> Hand:
    """Return the hand of one of `HANDS`, with either side up."""
    return Hand.people(up="either", **other) if wobble == WOBBLING else Hand(up="either", **other)


def nickel(wobble: str, factor: str = AS_SAID) -> EdgeClass:
    """Return the nickel of one of `HANDS`, with one of `FACTORS`."""
    other = FACTORS[factor]
    return EdgeClass(
        name=f"nickel, {wobble}, {factor}",
        hand=hand_of(wobble, **other.get("hand", {})),
        floor=other.get("floor", {}),
        air=other.get("air", True),
    )
