"""A claim of section 1: a nickel lands on its edge once in 6,000 tosses; which coin is fair three ways?"""

from collections.abc import Callable
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Ending, Engine
from cointoss.study import Estimate, chance_alike, percent, share, share_of
from cointoss_reproduction.frame.cells import Cells, Row
from cointoss_reproduction.frame.selection import measured
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.edge_classes import (
    AS_SAID,
    DIAMETER,
    DIAMETRAL,
    FACTORS,
    FREE,
    HANDS,
    NICKEL,
    PUBLISHED,
    SEED,
    WOBBLING,
    EdgeClass,
    hand_of,
    nickel,
)
from cointoss_reproduction.setups.ends import OUTCOMES, tally
from cointoss_reproduction.setups.estimates import difference
from cointoss_reproduction.studies.edge.laws import (
    ANGLE,
    DIE,
    SOLID_ANGLE,
    corner,
    edge_by_angle,
    edge_by_solid_angle,
    edge_of_die,
    fair,
)
from cointoss_reproduction.studies.edge.thrown import AS_QUOTED, FLOORS, QUOTED, SHAPES, THROWS, fitted_floor
from cointoss_reproduction.studies.edge.touches import LAWS, first_touches, let_go, way_to_rest

ASPECTS = (0.01, 0.05, 0.1, 0.2, 0.3, SOLID_ANGLE, 0.42, 0.5, ANGLE, 0.65, 0.75, 0.85, 1.0, 1.3, 2.0, 4.0)
CHIS = {f"χ = {chi:g}": chi for chi in (0.0, 0.2, 0.4, 0.6, 0.8)}
CURVE = {DIAMETRAL: 2400, WOBBLING: 120}
"""Tosses of each coin and restitution, by hand."""
MOST, SOME = {DIAMETRAL: 100_000, WOBBLING: 2000}, {DIAMETRAL: 8000, WOBBLING: 500}
"""Tosses of the nickel as described, and with one thing changed, by hand."""
SCATTERS = (0.1, 0.3, 1.0, 3.0, 30.0)
"""Standard deviations of ψ [deg]."""
BY_MUJOCO = {DIAMETRAL: 1000, WOBBLING: 100}
"""Tosses of each class by MuJoCo, by hand, twice as many of a square; the analytic engine makes 4 times as
many."""
LEAST = 4
"""Tosses of any class, however small the run."""
SHARED = {
    name: (
        wobble,
        EdgeClass(name=name, aspect=aspect, hand=hand_of(wobble), floor=floor | {"restitution": chi}),
    )
    for wobble, aspects, chis, resistance, floor in (
        (DIAMETRAL, (NICKEL, 0.35, 0.6), (0.5, 0.8), "", {}),
        (DIAMETRAL, (1.0,), (0.2,), "", {}),
        (WOBBLING, (NICKEL, 0.35, 0.6), (0.5, 0.8), "", {}),
        (WOBBLING, (NICKEL, 0.35), (0.5, 0.8), ", no resistance", FACTORS[FREE]["floor"]),
    )
    for aspect, chi in product(aspects, chis)
    for name in [f"{wobble}, h/D = {aspect:.2g}, χ = {chi:g}{resistance}"]
}
"""Hand and class of the coins that both engines toss, by name."""


def on_floor(wobble: str, factor: str, parts: int = 1) -> Row:
    """Toss nickels on one of the floors."""
    kind, count = nickel(wobble, factor), (MOST if factor == AS_SAID else SOME)[wobble]
    return {**_tossed("nickel", kind, count // parts), "scatter": float(np.degrees(kind.hand.psi_scatter))}


def scattered(scatter: float, parts: int = 1) -> Row:
    """Toss nickels about a diameter, with some scatter of ψ."""
    hand = hand_of(DIAMETRAL, psi_scatter=np.radians(scatter))
    return _tossed("scatter", EdgeClass(name=f"ψ = 90° ± {scatter:g}°", hand=hand, floor={}), 1000 // parts)


def followed(parts: int = 1) -> Row:
    """Follow people's nickels that come to rest on their edge; without resistance they may roll on."""
    times, ways = way_to_rest(nickel(WOBBLING), max(200 // parts, LEAST))
    free = nickel(WOBBLING, FREE).tossed(max(500 // parts, LEAST))
    quarters = product(
        {"time": times, "way": ways}.items(), {"first": 0.25, "median": 0.5, "third": 0.75}.items()
    )
    r, h = DIAMETER / 2, NICKEL * DIAMETER
    rise = np.hypot(r, h / 2) - r
    return {
        "of": "followed",
        "followed": len(times),
        **{f"{name}_{what}": np.quantile([*of] or [np.nan], part) for (what, of), (name, part) in quarters},
        **tally(free.outcome),
        "standing": int(np.sum(free.ending == Ending.STANDING)),
        "lean": float(np.degrees(corner(NICKEL))),
        "rise": rise,
        "push": (2 * 9.81 * rise) ** 0.5,
    }


def touching(turned: str, touches: int = 4000) -> Row:
    """Toss coins that turn in one way to a first touch on a floor without rebound; let some go at rest."""
    aspect, law, formula = LAWS[turned]
    kind = EdgeClass(name=turned, aspect=aspect, hand=hand_of(DIAMETRAL), floor={"restitution": 0.0})
    rng = np.random.default_rng(SEED)
    on_edge, energy = first_touches(kind, turned, rng, touches)
    return {
        "of": "touch",
        "aspect": aspect,
        "law": f"{formula} = {law(aspect):.3f}",
        "touched": share(on_edge),
        "let_go": share(let_go(kind, turned, rng, touches)),
        "energy": float(np.median(energy)),
    }


def curve(wobble: str, chi: float, parts: int = 1) -> list[Row]:
    """Toss coins from thin ones to rods, and find the one that is fair three ways."""
    rows = []
    for aspect in ASPECTS:
        name, floor = f"{wobble}, χ = {chi:g}, h/D = {aspect:.4g}", {"restitution": chi}
        kind = EdgeClass(name=name, aspect=aspect, hand=hand_of(wobble), floor=floor)
        row, die = _tossed("curve", kind, CURVE[wobble] // parts), edge_of_die(aspect)
        as_die = int(row["part"].low <= die <= row["part"].high)
        rows.append({**row, "line": f"χ = {chi:g}", "die": die, "as_die": as_die})
    edges, tosses = (np.array([row[name] for row in rows]) for name in ("edges", "tosses"))
    found = fair(np.array(ASPECTS), edges, tosses, np.random.default_rng(SEED))
    return [*rows, {"of": "fair", "restitution": chi, "fair": found}]


def by_law(line: Callable[[float], float]) -> list[Row]:
    """Return the shares on edge by a law of one formula, beside the curves of either hand."""
    points = product(HANDS, ASPECTS)
    return [{"of": "law", "wobble": hand, "aspect": h, "part": float(line(h))} for hand, h in points]


def by_both(coin: tuple[str, EdgeClass], parts: int = 1) -> list[Row]:
    """Toss coins of a class by both engines."""
    (wobble, kind), usual = coin, BY_MUJOCO[coin[0]]
    counts = {Engine.ANALYTIC: 4 * usual, Engine.MUJOCO: (2 if kind.aspect == 1 else 1) * usual}
    rows = [
        _tossed("both", replace(kind, name=f"{kind.name}, {engine}"), count // parts, engine)
        for engine, count in counts.items()
    ]
    chance = chance_alike([[row[name] for name in OUTCOMES] for row in rows])
    return [{**row, "wobble": wobble, "chance": chance} for row in rows]


def thrown(floor: str, shape: str, parts: int = 1) -> Row:
    """Toss coins as thick as those that were thrown, or return what is quoted of the throws."""
    aspect = float(shape)
    if floor == AS_QUOTED:
        part = share_of(QUOTED[shape], THROWS)
        return {"of": "thrown", "wobble": WOBBLING, "line": "thrown", "aspect": aspect, "part": part}
    wobble, other = FLOORS[floor]
    name = f"thrown, {floor}, h/D = {shape}"
    kind = EdgeClass(name=name, aspect=aspect, hand=hand_of(wobble), floor=other)
    return _tossed("thrown", kind, 800 // parts)


def _tossed(of: str, kind: EdgeClass, count: int, engine: Engine = Engine.ANALYTIC) -> Row:
    """Toss coins of a class, and return how they end."""
    ends = kind.ends(max(count, LEAST), engine)
    part = share_of(ends["edges"], ends["tosses"])
    return {"of": of, "engine": str(engine), "aspect": kind.aspect, "part": part, **ends}


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return how rare and common nickels on edge are, how far the fair coin is from the laws, and a fit."""
    of_nickels = {"where": "of == 'nickel'", "value": "part", "key": ["wobble", "factor"]}
    nickels = sorted(measured(cells, of_nickels).items(), key=lambda one: one[1].value)
    as_said = {wobble: dict(nickels)[f"{wobble}, {AS_SAID}"] for wobble in HANDS}
    as_published = [f"{percent(one)} ({name})" for name, one in nickels if one.low <= PUBLISHED <= one.high]
    of_fair = {"where": "of == 'fair' and chi == 'χ = 0.4'", "value": "fair", "key": ["wobble"]}
    fairest = measured(cells, of_fair)
    laws = {"angle": ANGLE, "solid_angle": SOLID_ANGLE, "die": DIE}
    return {
        "over": {wobble: one / PUBLISHED for wobble, one in as_said.items()},
        "rarest": dict(nickels[:1]),
        "commonest": dict(nickels[-1:]),
        "agreeing": " and of ".join(as_published) or "none",
        "more": difference(*(_flags(as_said[wobble]) for wobble in (WOBBLING, DIAMETRAL))),
        "off": {
            law: {wobble: one - aspect for wobble, one in fairest.items()} for law, aspect in laws.items()
        },
        "thrown": fitted_floor(cells),
    }


def _flags(part: Estimate) -> Any:
    return np.arange(part.count) < round(part.value * part.count)


REPRODUCTION = study(
    __name__,
    Cells(on_floor, {"wobble": HANDS, "factor": tuple(FACTORS)}),
    Cells(scattered, {"scatter": SCATTERS}),
    Cells(followed, {}),
    Cells(touching, {"turned": tuple(LAWS)}),
    Cells(curve, {"wobble": HANDS, "chi": CHIS}),
    Cells(
        by_law,
        {"line": {"by angle": edge_by_angle, "by solid angle": edge_by_solid_angle, "die": edge_of_die}},
    ),
    Cells(by_both, {"coin": SHARED}),
    Cells(thrown, {"floor": (AS_QUOTED, *FLOORS), "shape": SHAPES}),
    found=found,
)
