"""The tosses of the edge study: which are made, and the record of how they end."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from cointoss import Engine
from cointoss.study import Estimate, Progress, code_digest, share, stepping
from cointoss_reproduction.frame.parts import kept
from cointoss_reproduction.setups.edge_classes import (
    DIAMETRAL,
    HANDS,
    NICKEL,
    SEED,
    WOBBLING,
    EdgeClass,
    edge_by_angle,
    edge_by_solid_angle,
    ends_of,
    hand_of,
)
from cointoss_reproduction.setups.edge_thrown import FLOORS, QUOTED, thrown
from cointoss_reproduction.setups.edge_touches import (
    ANYHOW,
    TURNED,
    endings_of,
    first_touches,
    let_go,
    tossed,
    way_to_rest,
)
from cointoss_reproduction.setups.ends import Ends

ANGLE, SOLID_ANGLE = 3**-0.5, 8**-0.5
"""h/D at which C is on the edge's side in a third of all turns about a diameter, and of all attitudes."""
SQUARE = "h/D = 1,"
"""In the names of the classes of such coins."""
SQUARES = 2
"""So many times more of them are tossed by MuJoCo."""
ASPECTS = (0.01, 0.05, 0.1, 0.2, 0.3, SOLID_ANGLE, 0.42, 0.5, ANGLE, 0.65, 0.75, 0.85, 1, 1.3, 2, 4)
LAWS = {
    DIAMETRAL: (ANGLE, edge_by_angle, "(2/π) atan(h/D)"),
    ANYHOW: (SOLID_ANGLE, edge_by_solid_angle, "(h/D)/√(1 + (h/D)²)"),
}
"""For each way of turning: the h/D at which its law gives a third, the law, and its formula."""
SLIPPERY = {"contact": "smooth", "friction": 0.0}
FACTORS: dict[str, dict[str, Any]] = {
    "as said": {},
    "χ = 0.2": {"floor": {"restitution": 0.2}},
    "χ = 0.8": {"floor": {"restitution": 0.8}},
    "energetic restitution": {"floor": {"restitution_kind": "energetic"}},
    "smooth": {"floor": SLIPPERY},
    "μ = 0.1": {"floor": {"friction": 0.1}},
    "μ = 0.6": {"floor": {"friction": 0.6}},
    "δ = p = 0": {"floor": {"rolling_friction": 0.0, "pivoting_friction": 0.0}},
    "δ = p = 1 mm": {"floor": {"rolling_friction": 1e-3, "pivoting_friction": 1e-3}},
    "plastic up to 10 mm/s": {"floor": {"restitution_threshold": 1e-2}},
    "vacuum": {"air": False},
    "from 0.3 m": {"hand": {"height": 0.3}},
    "40 rad/s": {"hand": {"spin": 40.0}},
    "250 rad/s": {"hand": {"spin": 250.0}},
}
"""What is other than χ = 0.5, μ = 0.3, δ = p = 0.1 mm, from 1 m with 120 rad/s, in air."""
FREE = "δ = p = 0"


@dataclass(frozen=True, kw_only=True)
class Sizes:
    """How many tosses are made of what."""

    aspects: tuple[float, ...] = ASPECTS
    """h/D of the coins."""
    chis: tuple[float, ...] = (0.0, 0.2, 0.4, 0.6, 0.8)
    curve: Mapping[str, int] = field(default_factory=lambda: {DIAMETRAL: 2400, WOBBLING: 120})
    """Tosses of each coin and restitution, by hand."""
    nickel: Mapping[str, int] = field(default_factory=lambda: {DIAMETRAL: 100_000, WOBBLING: 2000})
    """Tosses of the nickel as said."""
    factor: Mapping[str, int] = field(default_factory=lambda: {DIAMETRAL: 8000, WOBBLING: 500})
    """Tosses of the nickel with something other."""
    factors: tuple[str, ...] = tuple(FACTORS)[1:]
    wobbles: tuple[float, ...] = (0.1, 0.3, 1.0, 3.0, 30.0)
    """Scatters of ψ [deg]."""
    wobble: int = 1000
    thrown: int = 800
    """Tosses of each thrown coin and floor."""
    touches: int = 4000
    ways: int = 200
    free: int = 500
    """Tosses of people's nickel without resistance whose endings are told apart."""
    mujoco: Mapping[str, int] = field(default_factory=lambda: {DIAMETRAL: 1000, WOBBLING: 100})
    """Tosses of each class by MuJoCo, by hand; the analytic engine makes four times as many."""
    shared: tuple[tuple[str, float, float, bool], ...] = (
        *((DIAMETRAL, aspect, chi, True) for aspect in (NICKEL, 0.35, 0.6) for chi in (0.5, 0.8)),
        (DIAMETRAL, 1.0, 0.2, True),
        *((WOBBLING, aspect, chi, True) for aspect in (NICKEL, 0.35, 0.6) for chi in (0.5, 0.8)),
        *((WOBBLING, aspect, chi, False) for aspect in (NICKEL, 0.35) for chi in (0.5, 0.8)),
    )
    """Hand, h/D and χ of the coins that both engines toss, and whether the floor resists."""


FULL = Sizes()
QUICK = Sizes(
    aspects=(0.01, ANGLE, 1.0, 4.0),
    chis=(0.0, 0.6),
    curve={DIAMETRAL: 60, WOBBLING: 4},
    nickel={DIAMETRAL: 1000, WOBBLING: 30},
    factor={DIAMETRAL: 100, WOBBLING: 30},
    factors=(FREE,),
    wobbles=(1.0,),
    wobble=20,
    thrown=10,
    touches=200,
    ways=10,
    free=150,
    mujoco={DIAMETRAL: 4, WOBBLING: 4},
    shared=((DIAMETRAL, 0.6, 0.8, True),),
)


@dataclass(frozen=True)
class FirstTouch:
    """How often C is on the edge's side at the first touch, where a floor does not rebound, and later."""

    touched: Estimate
    """At the first touch of a toss."""
    let_go: Estimate
    """At the end, of coins let go at rest just above the floor."""
    energy: float
    """Left after the first touch of a toss, over that of the pass over the rim; the median."""


@dataclass(frozen=True)
class EdgeRecord:
    """What the tosses show."""

    touches: dict[str, FirstTouch]
    """By how the coin was turned."""
    curves: dict[str, dict[str, dict[str, Ends]]]
    """By hand, χ and h/D."""
    nickel: dict[str, dict[str, Ends]]
    """By hand and what was other."""
    wobbles: dict[str, Ends]
    """Of the nickel, by the scatter of ψ [deg]."""
    times: list[float]
    """Of people's nickels that end on edge: from the last impact to the end [s]."""
    ways: list[float]
    """Of C in this time, as the crow flies [m]."""
    free: Ends
    """Of people's nickels without resistance, by outcome and ending."""
    engines: dict[str, dict[str, Ends]]
    """By class and engine."""
    thrown: dict[str, dict[str, Ends]]
    """By one of `FLOORS` and h/D."""


def record_of(progress: Progress, parts: Path, sizes: Sizes = FULL) -> EdgeRecord:
    """Toss coins from thin ones to rods, nickels on many floors, and some by both engines.

    Args:
        progress: called as the work goes on.
        parts: folder of what an interrupted run had done.
        sizes: how many of what.
    """
    curves, engines = len(sizes.chis) * len(sizes.aspects), 2 * len(sizes.shared)
    by_hand = len(HANDS) * (curves + 1 + len(sizes.factors))
    others = len(TURNED) + len(sizes.wobbles) + 2 + len(FLOORS) * len(QUOTED)
    step = stepping(progress, by_hand + engines + others)

    def ends(kind: EdgeClass, count: int, engine: Engine = Engine.ANALYTIC) -> Ends:
        return step(ends_of(kind, count, parts, engine))

    def by_aspect(wobble: str, chi: float) -> dict[str, Ends]:
        name, hand = f"{wobble}, χ = {chi:g}, h/D =", hand_of(wobble)
        kinds = [
            EdgeClass(name=f"{name} {aspect:.4g}", aspect=aspect, hand=hand, floor={"restitution": chi})
            for aspect in sizes.aspects
        ]
        return {f"{kind.aspect:.6g}": ends(kind, sizes.curve[wobble]) for kind in kinds}

    def by_factor(wobble: str, factor: str) -> Ends:
        many = sizes.factor if FACTORS[factor] else sizes.nickel
        return ends(nickel(wobble, factor), many[wobble])

    def by_scatter(scatter: float) -> Ends:
        hand = replace(hand_of(DIAMETRAL), psi_scatter=np.radians(scatter))
        kind = EdgeClass(name=f"ψ = 90° ± {scatter:g}°", hand=hand, floor={})
        return ends(kind, sizes.wobble)

    def by_engine(wobble: str, aspect: float, chi: float, resists: bool) -> tuple[str, dict[str, Ends]]:
        name = f"{wobble}, h/D = {aspect:.2g}, χ = {chi:g}{'' if resists else ', no resistance'}"
        floor = {"restitution": chi, **({} if resists else FACTORS[FREE]["floor"])}
        found = {}
        for engine, times in ((Engine.ANALYTIC, 4), (Engine.MUJOCO, 1)):
            kind = EdgeClass(name=f"{name}, {engine}", aspect=aspect, hand=hand_of(wobble), floor=floor)
            many = times * sizes.mujoco[wobble] * (SQUARES if aspect == 1 and engine == Engine.MUJOCO else 1)
            found[engine.value] = ends(kind, many, engine)
        return name, found

    touches = {turned: step(_touch(turned, sizes.touches, parts)) for turned in TURNED}
    name = f"{code_digest()}-ways-{sizes.ways}"
    ways = step(kept(parts, name, partial(way_to_rest, nickel(WOBBLING), sizes.ways)))
    free = step(endings_of(nickel(WOBBLING, FREE), sizes.free))
    return EdgeRecord(
        touches=touches,
        curves={wobble: {f"{chi:g}": by_aspect(wobble, chi) for chi in sizes.chis} for wobble in HANDS},
        nickel={
            wobble: {factor: by_factor(wobble, factor) for factor in ("as said", *sizes.factors)}
            for wobble in HANDS
        },
        wobbles={f"{scatter:g}": by_scatter(scatter) for scatter in sizes.wobbles},
        times=ways["times"].tolist(),
        ways=ways["ways"].tolist(),
        free=free,
        engines=dict(by_engine(*one) for one in sizes.shared),
        thrown={
            floor: {aspect: ends(thrown(floor, aspect), sizes.thrown) for aspect in QUOTED}
            for floor in FLOORS
        },
    )


def nickel(wobble: str, factor: str = "as said") -> EdgeClass:
    """Return the nickel of one of `HANDS`, with one of `FACTORS`."""
    other = FACTORS[factor]
    return EdgeClass(
        name=f"nickel, {wobble}, {factor}",
        hand=hand_of(wobble, **other.get("hand", {})),
        floor=other.get("floor", {}),
        air=other.get("air", True),
    )


def _touch(turned: str, count: int, parts: Path) -> FirstTouch:
    """Look at the first touches of coins that are turned so, and let some go at rest."""
    kind = EdgeClass(name=turned, aspect=LAWS[turned][0], hand=hand_of(DIAMETRAL), floor={"restitution": 0.0})
    name = f"{code_digest()}-touches-{turned.replace(' ', '-')}-{count}"
    rng = np.random.default_rng(SEED)

    def part() -> dict[str, Any]:
        touched = first_touches(kind, tossed(kind, turned, rng, count))
        return {**touched, "let_go": let_go(kind, turned, rng, count)["on_edge"]}

    found = kept(parts, name, part)
    return FirstTouch(share(found["on_edge"]), share(found["let_go"]), float(np.median(found["energy"])))
