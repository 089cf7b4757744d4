"""Coins tossed by hand that may end on their edge: their classes, and how many tosses end how."""

import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import Engine, Hand, Scenario
from cointoss.study import Array, Plan, code_digest
from cointoss_reproduction.frame.parts import Part, kept
from cointoss_reproduction.setups.ends import Ends, by_outcome

SEED = 1993
DIAMETER, THICKNESS, MASS = 21.21e-3, 1.95e-3, 5e-3
"""Of the US nickel [m, m, kg]; the other coins are as wide, and of its metal."""
NICKEL = THICKNESS / DIAMETER
"""Its h/D."""
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
"""The floor where nothing else is said."""
AIR = {"normal": 0.8, "tangential": 0.2}
LONGEST = 60.0
"""Of a toss [s]."""


@dataclass(frozen=True, kw_only=True)
class EdgeClass:
    """A coin, its air and floor, and the hand that tosses it."""

    name: str
    """Of the class; its draws follow from it."""
    aspect: float = NICKEL
    """h/D."""
    hand: Hand
    floor: Mapping[str, Any]
    """What is other than in `BASE`."""
    air: bool = True

    @property
    def scenario(self) -> Scenario:
        """What is tossed."""
        h = self.aspect * DIAMETER
        return Scenario.model_validate(
            {
                "coin": {"mass": MASS * h / THICKNESS, "radius": DIAMETER / 2, "thickness": h},
                "air": AIR if self.air else {},
                "floor": {**BASE, **self.floor},
                "release": {"position": [0, 0, 10 * DIAMETER]},
                "ending": {"max_time": LONGEST},
            }
        )

    def starts(self, count: int) -> Array:
        """Draw states at release, with either side up as likely, (count, 13)."""
        rng = np.random.default_rng([SEED, zlib.crc32(self.name.encode()), 0])
        return self.hand.states(self.scenario.body, rng, count)


def hand_of(wobble: str, **other: Any) -> Hand:
    """Return the hand of one of `HANDS`, with either side up."""
    return Hand.people(up="either", **other) if wobble == WOBBLING else Hand(up="either", **other)


def ends_of(kind: EdgeClass, count: int, parts: Path, engine: Engine = Engine.ANALYTIC) -> Ends:
    """Toss the coins of a class as `cointoss shares` does, and count their outcomes.

    Args:
        kind: the class.
        count: how many tosses.
        parts: folder of what an interrupted run had done.
        engine: that tosses.
    """
    plan = Plan(
        scenario=kind.scenario,
        name=kind.name,
        hand=kind.hand,
        engines=(engine,),
        seed=zlib.crc32(kind.name.encode(), SEED),
        tosses=count,
    )

    def compute() -> Part:
        ends = by_outcome(plan)
        return {"ends": np.array(list(ends)), "counts": np.array(list(ends.values()))}

    label = zlib.crc32(repr(kind).encode())
    part = kept(parts, f"{code_digest()}-{engine}-{label:08x}-{count}", compute)
    return dict(zip(part["ends"].tolist(), part["counts"].tolist(), strict=True))


def corner(aspect: float | Array) -> Any:
    """Return the angle between coin and vertical below which a resting coin falls onto its edge [rad]."""
    return np.arctan(aspect)


def edge_by_angle(aspect: float | Array) -> Any:
    """Return the part of all turns about a diameter in which C is on the edge's side: (2/π) atan(h/D)."""
    return 2 / np.pi * corner(aspect)


def edge_by_solid_angle(aspect: float | Array) -> Any:
    """Return the part of all attitudes in which C is on the edge's side: (h/D)/√(1 + (h/D)²)."""
    return np.sin(corner(aspect))


def edge_of_die(aspect: float | Array) -> Any:
    """Return the share on edge of a planar die with sides h and D (Pender and Uhrin 2014, arXiv 1407.6307).

    It lands on h over on D as (c - D)/(c - h) atan(h/D)/atan(D/h), c its diagonal.
    """
    c = np.hypot(1, aspect)
    edge_over_face = (c - 1) / (c - aspect) * np.arctan(aspect) / np.arctan(1 / aspect)
    return edge_over_face / (1 + edge_over_face)


def three_way(
    aspects: NDArray[Any], edges: NDArray[Any], counts: NDArray[Any], rng: np.random.Generator, draws: int
) -> tuple[float, Array]:
    """Return the h/D at which a third of the tosses end on edge, and draws of it by chance, (draws,).

    The share is taken to be linear in ln(h/D) between two neighbours; NaN where it does not reach a third.

    Args:
        aspects: h/D of the coins, increasing, (n,).
        edges: numbers of tosses on edge, (n,).
        counts: numbers of tosses, (n,).
        rng: the source of chance.
        draws: how many samples of the same sizes are drawn.
    """
    shares = edges / counts
    drawn = rng.binomial(counts, shares, (draws, len(counts))) / counts
    return _crossing(np.log(aspects), shares), np.array([_crossing(np.log(aspects), one) for one in drawn])


def _crossing(x: Array, shares: Array) -> float:
    """Return exp(x) where the shares last rise through a third, NaN where they do not."""
    rising = np.flatnonzero((shares[:-1] < 1 / 3) & (shares[1:] >= 1 / 3))
    if not len(rising):
        return float("nan")
    i = rising[-1]
    return float(np.exp(x[i] + (1 / 3 - shares[i]) / (shares[i + 1] - shares[i]) * (x[i + 1] - x[i])))
