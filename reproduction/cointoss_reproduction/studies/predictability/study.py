"""Is coin tossing predictable? The share of tosses left uncertain, by accuracy and restitution."""

from collections.abc import Iterator, Mapping, Sequence
from math import log10
from typing import Any

import numpy as np
import pandas as pd

from cointoss_reproduction.frame.cells import Cells, estimate
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.precision.branching import Branches
from cointoss_reproduction.setups.uncertain_shares import (
    ACCURACIES,
    AIR,
    CHIS,
    ROUGH,
    SMOOTH,
    case_of,
    flat_share,
    share_at,
    slope_between,
    uncertain_shares,
)
from cointoss_reproduction.studies.predictability.picture import draw

SEED = 2014
CHI = 0.6
"""The restitution at which spin and tilt vary, too [rad/s, rad]; it is the paper's."""
AXES = {"floor": tuple(CHIS), "chi": CHIS[SMOOTH], "quantity": ("height", "spin", "tilt")}
POPULATION = {SMOOTH: 1200, AIR: 800, ROUGH: 1600}
"""Intervals at each level but the first; in air a toss takes longest."""
FEW = 4
"""The factor by which there are fewer intervals above `NONE`, where nearly all tosses are uncertain and each
takes long."""
NONE = 0.85
"""Restitution above which a toss is unpredictable."""
WINDOWS = {1e-3: 1e-6, 1e-6: 1e-9, 1e-9: 1e-12, 1e-12: 1e-18, 1e-18: 1e-24}
"""α is the slope between two accuracies [m]."""
HAND, FINE, QUANTUM = 1e-3, 1e-9, 1e-16
"""Accuracies [m]: a hand's, an atom's size, and about the coin's quantum width."""
PREDICTABLE = 0.01
"""At most this share uncertain: 99 % of all tosses are predictable."""
NEARLY_SMOOTH = 0.9
"""α above it is all but a smooth boundary's."""
FRACTAL = 0.8
"""α below it is a fractal's."""
BOUNCY = 0.9
"""At this restitution a coin bounces long."""


def uncertain(
    floor: str,
    chi: float,
    quantity: str,
    parts: int = 1,
    followed: int = 24,
    levels: int = len(ACCURACIES),
    chis: Mapping[str, Sequence[float]] = CHIS,
) -> list[dict[str, Any]] | None:
    """Return what 1/`parts` of the intervals show at each accuracy, and in the last row of them all.

    Releases are uniform in height and spin, flat, at rest but for the spin. On a smooth floor in vacuum
    `followed` boundaries are followed at each accuracy.
    """
    if chi not in chis.get(floor, ()) or (quantity != "height" and (floor, chi) != (SMOOTH, CHI)):
        return None
    seed = SEED, list(CHIS).index(floor), round(100 * chi), AXES["quantity"].index(quantity)
    found = uncertain_shares(
        case_of(floor, chi),
        np.random.default_rng(seed),
        quantity=quantity,
        levels=levels,
        population=POPULATION[floor] // parts // (FEW if chi > NONE else 1),
        followed=followed if floor == SMOOTH and quantity == "height" else 0,
    )
    rows = list(of_each(found))
    x, f = -np.log10([row["accuracy"] for row in rows]), [row["share"].value for row in rows]
    fine = accuracy_for(x, f, PREDICTABLE)
    rows[-1] |= {"fine": fine, "tosses": found.tosses, "undecided": found.undecided}
    return rows


def of_each(found: Branches) -> Iterator[dict[str, Any]]:
    """Yield what was found at each accuracy: f, the share that parts, α of the window that starts there."""
    shares, whole, parted, energy = (
        numbers.mean(axis=0) for numbers in (found.shares, found.whole, found.parted, found.energy)
    )
    accuracies = ACCURACIES[: len(shares)]
    for level, accuracy in enumerate(accuracies):
        end = WINDOWS.get(accuracy)
        yield {
            "accuracy": accuracy,
            "share": share_at(found.shares, found.whole, level),
            "parted": min(parted[level] / whole[level], 1.0),
            "energy": energy[level] / parted[level] if parted[level] else 0.0,
            "window": f"{accuracy:.0e} to {end:.0e}" if end in accuracies else None,
            "alpha": slope_between(found.shares, found.whole, level, accuracies.index(end))
            if end in accuracies
            else None,
            "flat": flat_share(found, level),
        }


def accuracy_for(x: Any, f: Sequence[float], share: float) -> float:
    """Return the accuracy 10^-x at which f falls to a share, interpolated; infinite or NaN beyond all [m]."""
    below = np.flatnonzero(np.array(f) <= share)
    if len(below) == 0 or below[0] == 0:
        return float("nan" if len(below) == 0 else "inf")
    sides = [below[0], below[0] - 1]
    return float(10 ** -np.interp(log10(share), np.log10(np.array(f)[sides]), x[sides]))


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name and no measure selects: the last window of the run, and cases of it."""
    rows = {
        (row["floor"], row["chi"], row["accuracy"]): row
        for row in cells.to_dict("records")
        if row["quantity"] == "height"
    }

    def of(floor: str, chi: float, accuracy: float, column: str) -> Any:
        return estimate(rows[floor, chi, accuracy], column)

    last = min(accuracy for (*_, accuracy), row in rows.items() if isinstance(row["window"], str))
    end, bouncy = WINDOWS[last], (SMOOTH, BOUNCY, QUANTUM)
    fine = of(SMOOTH, CHI, min(accuracy for *_, accuracy in rows), "fine")
    headline = (
        f"They are smooth, but nobody can see it. At χ = {CHI:g} the share of uncertain tosses falls as "
        f"ε^{of(SMOOTH, CHI, 1e-6, 'alpha').value:.2f} at 1 µm, and down to {end:.0e} m still as "
        f"ε^{of(SMOOTH, CHI, last, 'alpha').value:.2f}; smooth boundaries have ε^1. Released within 1 mm, "
        f"{of(SMOOTH, CHI, HAND, 'share').value:.0%} of the tosses are uncertain; within 1 nm, "
        f"{of(SMOOTH, CHI, FINE, 'share').value:.1%}. For 99% "
        f"of them to be predictable the release must be exact to {fine:.0e} m. On a floor without "
        "restitution the boundaries are smooth at every accuracy."
    )
    return {
        "last": last,
        "end": end,
        "hand_end": WINDOWS[HAND],
        "soft": of(SMOOTH, 0.0, HAND, "alpha"),
        "floors": {
            floor: {
                "share": of(floor, CHI, QUANTUM, "share"),
                "headline": headline if floor == SMOOTH else "",
            }
            for floor in CHIS
        },
        "alphas": {
            f"α from {first:.0e} to {WINDOWS[first]:.0e} m": of(SMOOTH, CHI, first, "alpha")
            for first in (1e-6, last)
        },
        "bouncy": {SMOOTH: {"share": of(*bouncy, "share")}} if bouncy in rows else {},
    }


REPRODUCTION = study(__name__, Cells(uncertain, AXES), found=found, draw={"predictability": draw})
