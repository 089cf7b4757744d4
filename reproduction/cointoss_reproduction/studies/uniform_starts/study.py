"""Section 5.1, after Kechen: whether the initial states that lead to heads are spread uniformly."""

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Face, analytic
from cointoss.study import GREY, SHARE_OF_HEADS, Array, Estimate, Progress, jackknife, scatter_of_shares
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import HEIGHTS, LANDINGS, SPINS, case, faces_after, planar_rows

SEED = 37
CELLS = np.array([1, 2, 4, 8, 16, 32])
"""Cells along each side of the map."""
SHOWN = 8
"""Cells along each side whose spread is shown."""
UNIFORM, LEAN = 0.15, 0.06
"""A spread and a bias that are small."""
HABITS = ("low", "fast", "at the corner", "about the middle", "about a quarter")
"""Densities of a hand's releases over the map."""


def make(progress: Progress, tosses: int = 200_000) -> Findings:
    """Toss from everywhere in the map, and count heads cell by cell and for each habit of a hand."""
    rng = np.random.default_rng(SEED)
    z, w = rng.uniform(size=(2, tosses))
    rows = planar_rows(case(air=True), _between(*HEIGHTS, z), _between(*SPINS, w))
    soft = faces_after(rows, 0) == Face.HEADS
    progress(1, 2)
    bouncing = analytic.toss_rows(rows).outcome == Face.HEADS
    progress(2, 2)
    heads = dict(zip(LANDINGS, (soft, bouncing), strict=True))
    spread = {
        landing: np.array([spread_over_cells(z, w, up, n) for n in CELLS]) for landing, up in heads.items()
    }
    densities = _densities(z, w)
    # The standard error of a share of one half with these weights.
    errors = np.array([(weights**2).sum() ** 0.5 / weights.sum() / 2 for weights in densities])
    shares = {
        landing: np.array([np.average(up, weights=weights) for weights in densities])
        for landing, up in heads.items()
    }

    def spread_at(landing: str, cells: int = SHOWN) -> Estimate:
        up = heads[landing]
        return jackknife(lambda kept: spread_over_cells(z[kept], w[kept], up[kept], cells), tosses)

    def off_half(landing: str) -> Estimate:
        up = heads[landing]
        return jackknife(
            lambda kept: max(
                abs(np.average(up[kept], weights=weights[kept]) - 1 / 2) for weights in densities
            ),
            tosses,
        )

    finer = zip(CELLS[1:], spread["bouncing"][1:], strict=True)
    data: Data = {"height": z, "spin": w, "cells": CELLS, "error": errors}
    for landing, up in heads.items():
        data |= {
            f"{landing}, heads": up,
            f"{landing}, spread": spread[landing],
            f"{landing}, shares": shares[landing],
        }
    return Findings(
        data=data,
        spread={landing: spread[landing][CELLS == SHOWN][0] for landing in LANDINGS},
        spread_at={landing: spread_at(landing) for landing in LANDINGS},
        spread_finest=spread_at("bouncing", int(CELLS[-1])),
        shares={landing: ", ".join(f"{one:.1%}" for one in shares[landing]) for landing in LANDINGS},
        error=errors.max(),
        off_half={landing: off_half(landing) for landing in LANDINGS},
        finer=", ".join(f"{value:.2f} ({n}²)" for n, value in finer),
    )


def _densities(z: Array, w: Array) -> list[Array]:
    """Return the densities of `HABITS`; both axes of the map run from 0 to 1."""
    middle, quarter = (
        np.exp(-((z - at) ** 2 + (w - at) ** 2) / (2 * width**2)) for at, width in ((0.5, 0.2), (0.25, 0.1))
    )
    return [1 - z, w, (1 - z) ** 2 * (1 - w) ** 2, middle, quarter]


def _between(low: float, high: float, part: Array) -> Array:
    return low + (high - low) * part


def _shares(z: Array, w: Array, heads: NDArray[np.bool_], cells: int) -> tuple[Array, NDArray[np.intp]]:
    """Return the share of heads in each cell, and the number of its tosses, (cells cells)."""
    cell = np.floor(z * cells).astype(int) + cells * np.floor(w * cells).astype(int)
    count = np.bincount(cell, minlength=cells**2)
    return np.bincount(cell, weights=heads, minlength=cells**2) / np.maximum(count, 1), count


def spread_over_cells(z: Array, w: Array, heads: NDArray[np.bool_], cells: int) -> float:
    """Return the root of the mean square of p - 1/2 over the cells of the map, less what counting adds.

    Args:
        z: heights, from 0 to 1 over the map, (n,).
        w: spins, likewise, (n,).
        heads: whether a toss ends so, (n,).
        cells: along each side.
    """
    p, count = _shares(z, w, heads, cells)
    return scatter_of_shares(p[count > 1], count[count > 1])


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(11, 3.3))
    *maps, spread, habits = picture.subplots(1, 4)
    for axes, landing in zip(maps, LANDINGS, strict=True):
        p, _ = _shares(data["height"], data["spin"], data[f"{landing}, heads"], 2 * SHOWN)
        axes.imshow(
            p.reshape(2 * SHOWN, -1),
            origin="lower",
            cmap=SHARE_OF_HEADS,
            norm=Normalize(0, 1),
            extent=(*HEIGHTS, *SPINS),
            aspect="auto",
        )
        axes.set(title=landing, xlabel="height [m]")
        axes.grid(visible=False)
    maps[0].set_ylabel("spin [rad/s]")
    maps[1].set_yticklabels([])
    picture.colorbar(ScalarMappable(Normalize(0, 1), SHARE_OF_HEADS), ax=maps, label="share of heads")
    for i, (landing, color) in enumerate(LANDINGS.items()):
        spread.semilogx(data["cells"], data[f"{landing}, spread"], "o-", color=color, label=landing, base=2)
        at = np.arange(len(HABITS)) + 0.35 * (i - 0.5)
        habits.barh(at, data[f"{landing}, shares"], 0.33, color=color)
    spread.set(title="spread over the cells", xlabel="cells along a side", ylim=(0, 0.55))
    spread.legend()
    habits.axvline(0.5, color=GREY, linewidth=0.8)
    habits.set(title="by the hand's habit", xlabel="share of heads", xlim=(0, 1), axisbelow=True)
    habits.set_yticks(range(len(HABITS)), HABITS)
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
