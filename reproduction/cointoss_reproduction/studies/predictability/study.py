"""Is coin tossing predictable? The share of tosses left uncertain, by accuracy and restitution."""

from collections.abc import Mapping, Sequence
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np
from scipy.constants import hbar

from cointoss.study import Progress
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.frame.threads import all_cores
from cointoss_reproduction.precision.branching import Branches
from cointoss_reproduction.precision.planar_state import HEIGHT, SPIN, TILT
from cointoss_reproduction.setups.planar_maps import case
from cointoss_reproduction.setups.uncertain_shares import (
    ACCURACIES,
    CEILING,
    flat_share,
    joined,
    kept_run,
    level_of,
    share_at,
    slope_between,
)
from cointoss_reproduction.studies.predictability.pages import draw, tables
from cointoss_reproduction.studies.predictability.record import (
    AIR,
    FINE,
    HAND,
    NEARLY_SMOOTH,
    PREDICTABLE,
    QUANTUM,
    ROUGH,
    SHOWN,
    SMOOTH,
    WINDOWS,
    Case,
    Predictability,
    accuracy_for,
    within,
)

SEED = 2014
POPULATION = 400
"""Intervals of a run at each level but the first."""
FOLLOWED = 8
"""Boundaries of a run that are followed at each ε, on a smooth floor in vacuum."""
CHIS = {
    SMOOTH: (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
    AIR: (0.3, 0.6, 0.8),
    ROUGH: (0.3, 0.6),
}
"""By floor and medium. A rough floor adds energy above χ = √5/3, and a face is then never settled."""
RUNS = {SMOOTH: 3, AIR: 2, ROUGH: 4}
"""Independent runs of each case; in air a toss takes longest."""
FEW = 4
"""Above `NONE`, where nearly all tosses are uncertain and each takes long, so many times fewer intervals."""
NONE = 0.85
"""Restitution above which a toss is unpredictable."""
OTHERS = {"spin": SPIN, "tilt": TILT}
"""Other quantities of the release, in rad/s and rad, and their rows in a state."""
CHI = 0.6
"""At which these vary; the paper's."""
BOUNCY = 0.9
"""At this restitution a coin bounces long."""
FRACTAL = 0.8
"""α below it is a fractal's."""


def compute(
    progress: Progress,
    parts: Path,
    runs: Mapping[str, int] = RUNS,
    population: int = POPULATION,
    chis: Mapping[str, Sequence[float]] = CHIS,
    levels: int = len(ACCURACIES),
) -> Predictability:
    """Run the branching for every case; what an interrupted computation finished is not run again.

    Args:
        progress: called after each run.
        parts: folder of what is done.
        runs: independent runs of each case, by floor.
        population: intervals at each level.
        chis: restitutions by floor.
        levels: how many of `ACCURACIES`.
    """
    asked = [(floor, chi, "height") for floor in chis for chi in chis[floor]]
    asked += [(SMOOTH, CHI, quantity) for quantity in OTHERS]
    jobs = [(one, number) for number in range(max(runs.values())) for one in asked if number < runs[one[0]]]
    found: dict[tuple[str, float, str], list[Branches]] = {one: [] for one in asked}
    with all_cores() as pool:
        made = pool.map(lambda job: run_once(parts, *job, population=population, levels=levels), jobs)
        for done, ((one, _), run) in enumerate(zip(jobs, made, strict=True), start=1):
            found[one].append(run)
            progress(done, len(jobs))
    scenario = case(air=False)
    fall = sqrt(2 * scenario.release.position[2] / scenario.gravity)
    return Predictability(
        cases=[case_of(*one, found[one]) for one in asked],
        quantum_width=sqrt(hbar * fall / scenario.coin.mass),
    )


def case_of(floor: str, chi: float, quantity: str, runs: Sequence[Branches]) -> Case:
    """Return what several runs find of what they tossed."""
    groups = joined(runs)
    shares, whole, parted, energy = (
        numbers.mean(axis=0) for numbers in (groups.shares, groups.whole, groups.parted, groups.energy)
    )
    last = float(ACCURACIES[len(shares) - 1])
    shown = [accuracy for accuracy in SHOWN if accuracy >= last * 0.9]
    return Case(
        floor=floor,
        chi=chi,
        quantity=quantity,
        shares=np.minimum(shares / whole, CEILING).tolist(),
        parted=np.minimum(parted / whole, 1.0).tolist(),
        energy=float(energy[-1] / parted[-1]) if parted[-1] else 0.0,
        known={accuracy: share_at(groups, accuracy) for accuracy in shown},
        slopes=[slope_between(groups, *window) for window in within(last)],
        flat={x: part for x in shown if (part := flat_share(groups, x))},
        tosses=groups.tosses,
        undecided=groups.undecided,
    )


def run_once(
    parts: Path, asked: tuple[str, float, str], number: int, *, population: int, levels: int
) -> Branches:
    """Run the branching once for one case: releases uniform in height and spin, flat, at rest but for it."""
    floor, chi, quantity = asked
    scenario = case(air=floor == AIR, restitution=chi)
    if floor == ROUGH:
        scenario = scenario.replace("floor.contact", "perfectly_rough")
    row = OTHERS.get(quantity, HEIGHT)
    seed = SEED, number, list(CHIS).index(floor), round(100 * chi), row
    name = f"{floor}, {chi:g}, {quantity}"
    return kept_run(
        parts,
        name,
        scenario,
        seed,
        row=row,
        levels=levels,
        population=population // FEW if chi > NONE else population,
        followed=FOLLOWED if floor == SMOOTH and row == HEIGHT else 0,
    )


def measures(found: Predictability) -> dict[str, Any]:
    """Return what the claims name."""
    by_key = {(one.floor, one.chi): one for one in found.cases if one.quantity == "height"}
    smooth, bouncy = by_key[SMOOTH, CHI], by_key.get((SMOOTH, BOUNCY))
    last, end = WINDOWS[len(smooth.slopes) - 1]
    return {
        "nearly_smooth": NEARLY_SMOOTH,
        "end": end,
        "last": last,
        "hand_end": WINDOWS[0][1],
        "soft": by_key[SMOOTH, 0.0].slopes[0],
        "floors": {
            floor: {
                "alpha": by_key[floor, CHI].slopes[-1],
                "share": by_key[floor, CHI].known[QUANTUM],
                "headline": _headline(smooth, end) if floor == SMOOTH else "",
            }
            for floor in (SMOOTH, AIR, ROUGH)
        },
        "alphas": {
            f"α from {WINDOWS[at][0]:.0e} to {WINDOWS[at][1]:.0e} m": smooth.slopes[at]
            for at in (1, len(smooth.slopes) - 1)
        },
        "bouncy": {SMOOTH: {"share": bouncy.known[QUANTUM]}} if bouncy else {},
    }


def _headline(one: Case, end: float) -> str:
    """Return what was found of the dispute, in a few sentences."""
    f, fine = one.shares, accuracy_for(one, PREDICTABLE)
    return (
        f"They are smooth, but nobody can see it. At χ = {one.chi:g} the share of uncertain tosses falls as "
        f"ε^{one.slopes[1].value:.2f} at 1 µm, and down to {end:.0e} m still as "
        f"ε^{one.slopes[-1].value:.2f}; smooth boundaries have ε^1. Released within 1 mm, "
        f"{f[level_of(HAND)]:.0%} of the tosses are uncertain; within 1 nm, {f[level_of(FINE)]:.1%}. For 99% "
        f"of them to be predictable the release must be exact to {fine:.0e} m. On a floor without "
        "restitution the boundaries are smooth at every accuracy."
    )


REPRODUCTION = recorded(
    __name__,
    compute,
    record=Predictability,
    measures=measures,
    tables=tables,
    draw={"predictability": draw},
)
