"""Random tosses counted one by one: how many a change of ε turns over, and how many end on their edge."""

from collections.abc import Iterator, Mapping
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from cointoss import Outcome, Scenario, toss_many
from cointoss.study import Array, Estimate, chance_alike, share_of
from cointoss_reproduction.frame.cells import Cells, estimate, kept_rows
from cointoss_reproduction.frame.selection import measured
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.edge_classes import (
    AS_SAID,
    DIAMETRAL,
    HANDS,
    EdgeClass,
    hand_of,
    nickel,
)
from cointoss_reproduction.setups.estimates import quotient
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES, AIR, SMOOTH, case_of

SEED = 271
FINEST = 1e-13
"""The smallest ε: below this, ε comes near the rounding of a height [m]."""
PIECE = 1_000_000
"""The number of tosses in memory at a time."""
FEWER = 10
"""A coin that may stand on its edge takes about as many times as long, so fewer of them are tossed."""
THICK = (0.35, 0.6)
"""h/D of the thick coins."""
COINS = {
    f"nickel, {hand}": (nickel(hand), f"factor == '{AS_SAID}' and wobble == '{hand}'") for hand in HANDS
} | {
    f"h/D = {aspect:g}, {DIAMETRAL}": (
        EdgeClass(name="plain counting", aspect=aspect, hand=hand_of(DIAMETRAL), floor={}),
        f"coin == '{DIAMETRAL}, h/D = {aspect:g}, χ = 0.5' and engine == 'analytic'",
    )
    for aspect in THICK
}
"""Coins that may end on their edge, and which rows of `edge` are of the same, by name."""
COMPARED = "accuracy in (1e-3, 1e-6) or (accuracy == 1e-9 and chi == 0.6)"
"""The rows with enough uncertain tosses to compare their share with that from branching."""
UNCOUNTED = "`cointoss reproduce predictability rotor edge` has not been run into this folder"


def uncertain(
    floor: str, chi: float, tosses: int = 40_000, out: Path | None = None
) -> Iterator[dict[str, Any]]:
    """Yield the counted share at each accuracy, beside those of `predictability` and `rotor`."""
    where = f"floor == '{floor}' and chi == {chi}"
    others = {
        "branching": ("share", kept_rows("predictability", out, f"{where} and quantity == 'height'")),
        "chain": ("predicted", kept_rows("rotor", out, where)),
    }
    known = {
        name: {row["accuracy"]: estimate(row, column) for row in rows}
        for name, (column, rows) in others.items()
    }
    for row in turned_over(case_of(floor, chi), tosses):
        found = {name: of.get(row["accuracy"]) for name, of in known.items()}
        yield row | found | {f"over_{name}": _over(row["share"], other) for name, other in found.items()}


def caught(caught_at: float, tosses: int = 40_000) -> Iterator[dict[str, Any]]:
    """Yield the counted share of coins caught in vacuum at each accuracy, beside the exact one."""
    scenario = case(air=False).replace("ending.caught", caught_at)
    for row in turned_over(scenario, tosses):
        exact = exact_share(caught_at, row["accuracy"], scenario.gravity)
        held = row["share"].low <= exact <= row["share"].high
        yield row | {"exact": exact, "left_out": int(not held), "over_exact": row["share"] / exact}


def exact_share(caught_at: float, accuracy: float, gravity: float, points: int = 20_000) -> float:
    """Return the share of coins caught in vacuum that ε more or less height turns over.

    A coin let go from z is caught after t = √(2 (z - caught_at)/g). Its face changes where ω t is an odd
    multiple of π/2. So at each z the uncertain spins are known; their share is averaged over z. Changes of
    the face are farther apart than 2 ε.

    Args:
        caught_at: height of C [m].
        accuracy: ε [m].
        gravity: g [m/s²].
        points: heights of the average.
    """
    z = HEIGHTS[0] + np.ptp(HEIGHTS) * (np.arange(points) + 0.5) / points
    early, late = (np.sqrt(2 * (z + step - caught_at) / gravity) for step in (-accuracy, accuracy))
    odd = pi * (np.arange(SPINS[1] * late.max() / pi)[:, None] + 0.5)
    uncertain_spins = np.clip(odd / early, *SPINS) - np.clip(odd / late, *SPINS)
    return float(uncertain_spins.sum() / (points * np.ptp(SPINS)))


def turned_over(scenario: Scenario, tosses: int) -> Iterator[dict[str, Any]]:
    """Yield at each accuracy how many tosses end otherwise ε higher or ε lower, until none of them does.

    Releases are uniform in height and spin, flat, at rest but for the spin.
    """
    accuracies = [accuracy for accuracy in ACCURACIES if accuracy >= FINEST]
    rng, changed = np.random.default_rng(SEED), np.zeros(len(accuracies), dtype=int)
    for count in _pieces(tosses):
        z, spin = rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count)

        def ended(step: float, z: Array = z, spin: Array = spin) -> Any:
            higher = {"release.position.z": z + step, "release.angular_velocity.xi": spin}
            return ends(scenario, higher)

        between = ended(0.0)
        changed += [np.sum((ended(-by) != between) | (ended(by) != between)) for by in accuracies]
    for accuracy, number in zip(accuracies, changed.tolist(), strict=True):
        share = share_of(number, tosses)
        yield {"accuracy": accuracy, "changed": number, "tosses": tosses, "share": share}
        if number == 0:
            return


def on_edge(coin: tuple[EdgeClass, str], tosses: int = 40_000, out: Path | None = None) -> dict[str, Any]:
    """Return the share of coins that end on their edge, beside the one that `edge` has counted."""
    (kind, where), count, edges = coin, max(tosses // FEWER, 1), 0
    for number, piece in enumerate(_pieces(count)):
        releases = kind.hand.releases(kind.scenario, piece, seed=SEED + number)
        edges += int(np.sum(ends(kind.scenario, releases) == str(Outcome.EDGE)))
    before = [(row["edges"], row["tosses"]) for row in kept_rows("edge", out, where)]
    numbers = [(met, of - met) for met, of in [(edges, count), *before]]
    return {
        "edges": edges,
        "coins": count,
        "on_edge": share_of(edges, count),
        "before": share_of(*before[0]) if before else None,
        "chance": chance_alike(numbers) if before else None,
    }


def ends(scenario: Scenario, vary: Mapping[str, Any]) -> Any:
    """Return how each of a batch of tosses ends, in words.

    Raises:
        KeyboardInterrupt: where one has left the batch short.
    """
    outcomes = toss_many(scenario, vary, progress=False).outcome.to_numpy()
    if np.any(outcomes == "not_tossed"):
        raise KeyboardInterrupt
    return outcomes


def _pieces(tosses: int) -> list[int]:
    """Return numbers of at most `PIECE` that add up to all."""
    return [min(PIECE, tosses - done) for done in range(0, tosses, PIECE)]


def _over(counted: Estimate, other: Any) -> Estimate | None:
    """Return what was counted over an estimate; None where one of them may be 0."""
    met = isinstance(other, Estimate) and min(counted.low, other.low) > 0
    return quotient(counted, other) if met else None


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what was counted over what other studies have found, where all of them have been run."""
    measures = {
        "over_branching": {"where": COMPARED, "key": ["floor", "chi", "accuracy"]},
        "over_chain": {"where": "accuracy == 1e-6", "key": ["floor", "chi"]},
        "chance": {"key": ["coin"]},
    }
    there = all(name in cells and cells[name].notna().any() for name in measures)
    of_each = {
        name: measured(cells, {"value": name, **said}) if there else {} for name, said in measures.items()
    }
    return {**of_each, "uncounted": "" if there else UNCOUNTED}


REPRODUCTION = study(
    __name__,
    Cells(uncertain, {"floor": (SMOOTH, AIR), "chi": (0.3, 0.6)}),
    Cells(caught, {"caught_at": (0.1,)}),
    Cells(on_edge, {"coin": COINS}),
    found=found,
)
