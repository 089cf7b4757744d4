"""Section 5.1, after Kechen: whether the initial states that lead to heads are spread uniformly."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import Face
from cointoss.study import Array
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import jackknife, scatter_of_shares
from cointoss_reproduction.setups.planar_maps import HEIGHTS, LANDINGS, SPINS, case, planar_rows

SEED = 37
CELLS = (1, 2, 4, 8, 16, 32)
"""Numbers of cells along each side of the map."""
SHOWN, FINEST = "8", "32"
"""Cells along each side whose spread is shown."""
UNIFORM, LEAN = 0.15, 0.06
"""A spread and a bias that are small."""
HABITS: dict[str, Callable[[Array, Array], Array]] = {
    "low": lambda z, _: 1 - z,
    "fast": lambda _, w: w,
    "at the corner": lambda z, w: (1 - z) ** 2 * (1 - w) ** 2,
    "about the middle": lambda z, w: np.exp(-((z - 0.5) ** 2 + (w - 0.5) ** 2) / (2 * 0.2**2)),
    "about a quarter": lambda z, w: np.exp(-((z - 0.25) ** 2 + (w - 0.25) ** 2) / (2 * 0.1**2)),
}
"""Densities of a hand's releases over the map, whose axes both run from 0 to 1."""


def landed(landing: Callable[[Array], NDArray[np.int8]], tosses: int = 200_000) -> Iterator[dict[str, Any]]:
    """Toss from everywhere in the map, and count heads cell by cell and for each habit of a hand."""
    z, w = np.random.default_rng(SEED).uniform(size=(2, tosses))
    over_map = (low + (high - low) * part for (low, high), part in ((HEIGHTS, z), (SPINS, w)))
    heads = landing(planar_rows(case(air=True), *over_map)) == Face.HEADS
    for cells in CELLS:

        def spread(kept: NDArray[np.bool_], cells: int = cells) -> float:
            return spread_over_cells(z[kept], w[kept], heads[kept], cells)

        yield {"cells": cells, "spread": jackknife(spread, tosses)}
    densities = {name: density(z, w) for name, density in HABITS.items()}
    for name, weights in densities.items():
        # The standard error of a share of one half with these weights.
        error = (weights**2).sum() ** 0.5 / weights.sum() / 2
        yield {"habit": name, "heads": np.average(heads, weights=weights), "error": error}

    def off_half(kept: NDArray[np.bool_]) -> float:
        shares = [np.average(heads[kept], weights=weights[kept]) for weights in densities.values()]
        return max(abs(share - 1 / 2) for share in shares)

    yield {"off_half": jackknife(off_half, tosses)}


def spread_over_cells(z: Array, w: Array, heads: NDArray[np.bool_], cells: int) -> float:
    """Return the root of the mean square of p - 1/2 over the cells of the map, less what counting adds.

    Args:
        z: heights, from 0 to 1 over the map, (n,).
        w: spins, from 0 to 1 over the map, (n,).
        heads: whether a toss ends so, (n,).
        cells: along each side.
    """
    cell = np.floor(z * cells).astype(int) + cells * np.floor(w * cells).astype(int)
    count = np.bincount(cell, minlength=cells**2)
    p = np.bincount(cell, weights=heads, minlength=cells**2) / np.maximum(count, 1)
    return scatter_of_shares(p[count > 1], count[count > 1])


REPRODUCTION = study(__name__, Cells(landed, {"landing": LANDINGS}))
