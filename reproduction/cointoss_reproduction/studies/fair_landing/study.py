"""A claim of section 2: a coin that bounces is less fair than one that lands softly or is caught."""

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import ContactLaw, Face, Floor, Scenario, analytic, load
from cointoss.study import (
    BLUE,
    GREY,
    INK,
    VERMILION,
    Array,
    Estimate,
    Progress,
    jackknife,
    mean,
    rows_from_states,
    scatter_of_shares,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.hands import states_of_hands
from cointoss_reproduction.setups.kellers_map import caught
from cointoss_reproduction.setups.planar_maps import faces_after, toss_rows_by_mujoco

SEED = 2
SPREAD = 0.05
"""Of the tosses of one hand, relative."""
ONE_AXIS, ALL_AXES = "about one axis", "about all axes"
ASIDE = {ONE_AXIS: 0.0, ALL_AXES: 10.0}
"""Spins about ξ and ζ of the two kinds of tosses, at most [rad/s]."""
SMOOTH, ROUGH = "bounced, smooth floor", "bounced, rough floor"
FLOORS = {
    SMOOTH: Floor(restitution=0.6, contact=ContactLaw.SMOOTH),
    ROUGH: Floor(restitution=0.6, contact=ContactLaw.COULOMB, friction=0.2),
}
CAUGHT, SOFT = "caught", "soft floor"
LANDINGS = (CAUGHT, SOFT, *FLOORS)


def make(progress: Progress, hands: int = 1000, each: int = 20, tosses_mujoco: int = 300) -> Findings:
    """Let hands toss a thin ideal coin with two kinds of spin, and end each toss in four ways."""
    found = Findings()
    scenario = load("fig29")
    rng = np.random.default_rng(SEED)
    heads: dict[tuple[str, str], Array] = {}
    whole = len(ASIDE) * len(LANDINGS) + 1
    first_faces, tossed, bounced = np.empty(0, dtype=np.int8), np.empty((0, 13)), []
    for kind, aside in ASIDE.items():
        tossed = states_of_hands(rng, hands, each, spread=SPREAD, aside=aside)
        first_faces = faces_after(rows_from_states(scenario, tossed), 0)
        back = np.where(caught(scenario, tossed) > 0, Face.HEADS, Face.TAILS)
        bounced = [
            analytic.toss_rows(rows_from_states(_on(scenario, floor), tossed)).outcome
            for floor in FLOORS.values()
        ]
        for landing, face in zip(LANDINGS, (back, first_faces, *bounced), strict=True):
            heads[kind, landing] = np.mean((face == Face.HEADS).reshape(hands, each), axis=1)
            progress(len(heads), whole)
    every = slice(None, None, len(tossed) // tosses_mujoco)
    few = tossed[every]
    first_mujoco = faces_after(rows_from_states(scenario, few), 0, toss_rows_by_mujoco)
    found.same = int(np.sum(first_mujoco == first_faces[every]))
    by_mujoco = toss_rows_by_mujoco(rows_from_states(_on(scenario, FLOORS[SMOOTH]), few)).outcome
    found.heads_few = [float(np.mean(faces == Face.HEADS)) for faces in (by_mujoco, bounced[0][every])]
    progress(whole, whole)
    bias = {key: scatter_of_shares(shares, each) for key, shares in heads.items()}
    found.together = {key: mean(shares, "hands") for key, shares in heads.items()}
    found.biases = "; ".join(
        f"spin {kind} " + ", ".join(f"{bias[kind, landing]:.2f} {landing}" for landing in LANDINGS)
        for kind in ASIDE
    )
    found.few = len(few)
    found.bias = {
        f"bias {bounced} less that otherwise (spin {kind})": _less_fair(
            heads, kind, bounced, lambda shares: scatter_of_shares(shares, each)
        )
        for kind in ASIDE
        for bounced in FLOORS
    }
    found.off = {bounced: _less_fair(heads, ALL_AXES, bounced, _off_half) for bounced in FLOORS}
    found.data = {f"{kind}, {landing}": shares for (kind, landing), shares in heads.items()}
    return found


def _on(scenario: Scenario, floor: Floor) -> Scenario:
    return scenario.replace("floor", floor)


def _less_fair(
    heads: dict[tuple[str, str], Array], kind: str, bounced: str, measure: Callable[[Array], float]
) -> Estimate:
    """Return a measure of unfairness after bouncing less its largest without, with a jackknife over hands."""
    after, others = heads[kind, bounced], [heads[kind, landing] for landing in LANDINGS[:2]]

    def excess(kept: NDArray[np.bool_]) -> float:
        return measure(after[kept]) - max(measure(shares[kept]) for shares in others)

    return jackknife(excess, len(after), "hands")


def _off_half(shares: Array) -> float:
    """Return how far all hands together are off 1/2."""
    return abs(float(shares.mean()) - 1 / 2)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 4.2))
    bins = np.linspace(0, 1, 22)
    grid = picture.subplots(len(ASIDE), len(LANDINGS), sharex=True, sharey=True)
    for row, kind in zip(grid, ASIDE, strict=True):
        for axes, landing in zip(row, LANDINGS, strict=True):
            shares = data[f"{kind}, {landing}"]
            axes.hist(shares, bins.tolist(), color=VERMILION if landing in FLOORS else BLUE)
            axes.axvline(0.5, color=GREY, linewidth=0.8)
            axes.axvline(shares.mean(), color=INK, linestyle="--", linewidth=1)
        row[0].set_ylabel(f"spin {kind}\nhands")
    for axes, landing in zip(grid[0], LANDINGS, strict=True):
        axes.set_title(landing)
    for axes in grid[-1]:
        axes.set(xlabel="a hand's part of heads", xlim=(0, 1), xticks=(0, 0.5, 1))
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
