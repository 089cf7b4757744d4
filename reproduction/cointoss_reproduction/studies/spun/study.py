"""Which side does a coin show that was spun on its edge? Its faces along the offset of its mass centre."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from cointoss import Engine, Hand, Outcome, Scenario
from cointoss.study import (
    BLUE,
    GREY,
    VERMILION,
    Estimate,
    Plan,
    Progress,
    paragraphs,
    percent,
    share_of,
    stepping,
    table,
)
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.ends import Ends, alike, by_outcome, ended_as, on_edge, tosses

SEED = 80
FOLKLORE = 0.8
"""The share of tails that is told."""
EDGES = {"edge of 1.52 mm": 1.52e-3, "edge of 0.4 mm": 0.4e-3}
"""Thickness of the coin: a cent's, and as broad as the part of a rounded edge on which it stands [m]."""
SCATTERS = {"± 1°": 1.0, "± 10°": 10.0}
"""How far the normal is from the horizontal at the release: its standard deviation [deg]."""
OFFSETS = (0.0, 1e-5, 5e-5, 1e-4)
"""Of the mass centre towards heads [m]."""
RELIEF, FAR = f"{OFFSETS[1]:g}", f"{OFFSETS[-1]:g}"
"""About what relief can do, and more than that."""
BROAD, NARROW = (f"{edge}, ± 1°" for edge in EDGES)
"""The coins that are spun with care."""
COUNT = {"± 1°": 1000, "± 10°": 2000}
"""Spins of each."""
COUNT_MUJOCO = 400
COIN: dict[str, Any] = {
    "coin": {"mass": 2.5e-3, "radius": 9.525e-3},
    "air": {"normal": 0.8, "tangential": 0.2},
    "floor": {
        "contact": "coulomb",
        "restitution": 0.3,
        "friction": 0.3,
        "rolling_friction": 2e-5,
        "pivoting_friction": 1e-4,
    },
    "release": {"position": [0, 0, 1]},
    "ending": {"max_time": 120.0},
}
"""A cent on its floor, but for thickness and mass centre."""


@dataclass(frozen=True)
class SpunRecord:
    """How spun coins end."""

    ends: dict[str, dict[str, Ends]]
    """By edge and scatter, and by the offset [m]."""
    mujoco: dict[str, Ends]
    """By MuJoCo, of the offset `FAR`."""


def plan_of(edge: str, scatter: str, offset: float, count: int, engine: Engine = Engine.ANALYTIC) -> Plan:
    """Return the spins of a cent with an edge, a scatter and an offset [m]."""
    coin = {**COIN["coin"], "thickness": EDGES[edge], "center_of_mass": [0.0, 0.0, offset]}
    return Plan(
        scenario=Scenario.model_validate({**COIN, "coin": coin}),
        name=f"{edge}, {scatter}",
        hand=Hand(spun=True, psi_scatter=float(np.radians(SCATTERS[scatter])), up="either"),
        engines=(engine,),
        seed=SEED + OFFSETS.index(offset),
        tosses=count,
    )


def compute(progress: Progress, parts: int = 1, mujoco: int = COUNT_MUJOCO) -> SpunRecord:
    """Spin every coin, 1/`parts` of `COUNT` times, and some by MuJoCo `mujoco` times."""
    kinds = [(edge, scatter) for edge in EDGES for scatter in SCATTERS]
    step = stepping(progress, len(kinds) * len(OFFSETS) + len(EDGES))

    def spun(*kind: Any) -> Ends:
        return step(by_outcome(plan_of(*kind)))

    careful = next(iter(SCATTERS))
    return SpunRecord(
        ends={
            f"{edge}, {scatter}": {
                f"{offset:g}": spun(edge, scatter, offset, COUNT[scatter] // parts) for offset in OFFSETS
            }
            for edge, scatter in kinds
        },
        mujoco={
            f"{edge}, {careful}": spun(edge, careful, OFFSETS[-1], mujoco, Engine.MUJOCO) for edge in EDGES
        },
    )


def tails(ends: Ends) -> Estimate:
    """Return the share of tails among the coins that end on a face."""
    heads, others = (ended_as(ends, side) for side in (Outcome.HEADS, Outcome.TAILS))
    return share_of(others, heads + others, "spins that end on a face")


def measures(found: SpunRecord) -> dict[str, Any]:
    """Return what the claims name."""
    careful = {name: ends[FAR] for name, ends in found.ends.items() if name in found.mujoco}
    return {
        "off_folklore": {name: tails(ends[RELIEF]) - FOLKLORE for name, ends in found.ends.items()},
        "relief": 1e3 * OFFSETS[1],
        "far": 1e3 * OFFSETS[-1],
        "narrow": tails(careful[NARROW]),
        "narrow_mujoco": percent(tails(found.mujoco[NARROW])),
        "broad": tails(careful[BROAD]),
        "broad_mujoco": percent(tails(found.mujoco[BROAD])),
        "balanced": {name: tails(ends["0"]) - 1 / 2 for name, ends in found.ends.items()},
        "chance": {name: alike([ends, found.mujoco[name]]) for name, ends in careful.items()},
    }


def tables(found: SpunRecord) -> str:
    """Return the tables, in Markdown."""
    rows = [
        [name, f"{1e3 * float(offset):g}", f"{tosses(ends):,d}", percent(on_edge(ends)), percent(tails(ends))]
        for name, by_offset in found.ends.items()
        for offset, ends in by_offset.items()
    ]
    by_mujoco = [
        [name, f"{tosses(ends):,d}", percent(on_edge(ends)), percent(tails(ends))]
        for name, ends in found.mujoco.items()
    ]
    counted = "spins | on edge | tails of the others"
    return paragraphs(
        "The share of coins that stay on edge, and that of tails among the others, with 99 % intervals:",
        table(f"edge, scatter of the normal | mass centre off by [mm] | {counted}", rows),
        f"The same by MuJoCo, the mass centre off by {1e3 * OFFSETS[-1]:g} mm:",
        table(f"edge, scatter of the normal | {counted}", by_mujoco),
    )


def draw(found: SpunRecord) -> Figure:
    """Draw the share of tails over the offset."""
    picture = Figure(figsize=(7, 3.6))
    axes = picture.subplots()
    for name, by_offset in found.ends.items():
        parts = [tails(ends) for ends in by_offset.values()]
        value, low, high = np.array([part.ends for part in parts]).T
        color, style = VERMILION if "0.4" in name else BLUE, "o-" if "± 1°" in name else "o--"
        x = 1e3 * np.array([float(offset) for offset in by_offset])
        axes.errorbar(x, value, [value - low, high - value], fmt=style, color=color, capsize=2, label=name)
    axes.axhline(1 / 2, color=GREY, linewidth=0.8)
    axes.axhline(FOLKLORE, color=GREY, linestyle=":")
    axes.annotate("as is told", (0, FOLKLORE), (4, 3), textcoords="offset points", color=GREY)
    axes.set(xlabel="mass centre off towards heads [mm]", ylabel="tails of those on a face", ylim=(0, 1))
    axes.legend(loc="upper left", bbox_to_anchor=(1, 1))
    return picture


REPRODUCTION = study(
    __name__, compute, record=SpunRecord, measures=measures, tables=tables, draw={"tails": draw}
)
