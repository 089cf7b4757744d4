"""Fig. 30, section 5.2: boundaries magnified to 1e-25 m, and how the share of uncertain tosses falls."""

from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Scenario, analytic
from cointoss.study import GREY, Array, MapAxis, Progress, share
from cointoss_reproduction.frame.cells import Cells, table_of
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.precision.magnified import MAGNIFICATION, Magnified, magnify
from cointoss_reproduction.precision.planar_coin import PlanarRelease, planar_coin, units
from cointoss_reproduction.setups.planar_maps import (
    HEIGHTS,
    MEDIA,
    SPINS,
    Grid,
    case,
    draw_titled,
    final_faces,
    planar_rows,
    toss_rows_by_mujoco,
)
from cointoss_reproduction.setups.uncertain_shares import (
    ACCURACIES,
    processes,
    slope_between,
    uncertain_shares,
)

WINDOWS_BELOW = 25
"""How many lines through the map there are, each magnified more, 1 included; the last is 4e-25 m long."""
POINTS = 50
"""Points on a line."""
DECADES = 3
"""α is the slope over this number of decades."""
DOUBLES = (3, 7)
"""Index of the first and the last decade for which doubles would suffice: 1e-6 m to 1e-10 m."""
UPRIGHT = 1e-6
"""A coin stands when its energy comes this near to that of the upright coin at rest [m g r]."""
TENFOLDS = 3
"""The number of magnifications over which the coin's approach to standing is measured."""
SEED = 30
WINDOWS = ((0.05, 5.0), (5e-4, 0.05))
"""Height and spin of the enlarged maps [m, rad/s]."""
NEAR = (0.258, 39.0)
"""Height and spin: the windows are centred on the boundary at this spin nearest to this height [m, rad/s]."""
REACH = 0.02
"""How far from this height the boundary may be [m]."""
ACCURACY_MUJOCO = 1e-4
"""The difference in height of nearby tosses by MuJoCo [m]."""


def make(
    progress: Progress,
    kept: Path,
    points: int = 100,
    lines: int = 20,
    on_line: int = POINTS,
    population: int = 1440,
    tosses_mujoco: int = 200,
) -> Findings:
    """Enlarge the maps of Fig. 29(c, d) and lines through them, and find the share of uncertain tosses."""
    whole = len(MEDIA) * (len(WINDOWS) + lines + 1) + 1
    weighed = table_of(
        [Cells(weights_of, {"medium": tuple(MEDIA)})],
        lambda done, _: progress(done, whole),
        {"population": population},
        kept=kept,
    )
    weights = dict(zip(weighed["medium"], zip(weighed["shares"], weighed["whole"], strict=True), strict=True))
    done = len(weights)
    rng = np.random.default_rng(SEED)
    data: Data = {}
    media: dict[str, dict[str, Any]] = {}
    heights, spins = rng.uniform(*HEIGHTS, tosses_mujoco), rng.uniform(*SPINS, tosses_mujoco)
    mujoco = _by_mujoco(case(air=True), heights, spins)
    progress(done := done + 1, whole)
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        z, w = _boundary_near(scenario), NEAR[1]
        data[f"{medium}, center"] = np.array([z, w])
        for number, (height, spin) in enumerate(WINDOWS):
            grid = Grid(
                heights=np.linspace(z - height / 2, z + height / 2, points),
                spins=np.linspace(w - spin / 2, w + spin / 2, points),
            )
            data[f"{medium}, enlargement {number}"] = final_faces(scenario, grid)
            progress(done := done + 1, whole)
        followed = []
        through = np.linspace(*SPINS, lines + 2)[1:-1].tolist()
        for line in processes().map(partial(_magnified, scenario, on_line), through):
            followed.append(line)
            progress(done := done + 1, whole)
        data[f"{medium}, crossings"] = np.array([line.counts for line in followed])
        data[f"{medium}, off"] = off = np.array([line.from_upright.max(axis=1) for line in followed])
        shares, all_weight = map(np.array, weights[medium])
        data[f"{medium}, shares"] = shares.mean(axis=0) / all_weight.mean(axis=0)
        media[medium] = _lines(followed) | _standing(off) | _slopes(shares, all_weight)
        media[medium]["mujoco"] = mujoco if medium == "air" else "-"
    return Findings(data=data, media=media)


def weights_of(medium: str, population: int) -> dict[str, list[list[float]]]:
    """Return the weight of uncertain tosses and all weight, by group of ancestors and accuracy, (n, m)."""
    found = uncertain_shares(case(air=medium == "air"), np.random.default_rng(SEED), population=population)
    return {"shares": found.shares.tolist(), "whole": found.whole.tolist()}


def _lines(followed: list[Magnified]) -> dict[str, Any]:
    """Return from where on boundaries are isolated, by the names of the claims."""
    isolated = np.array([line.isolated_from for line in followed if line.isolated_from is not None])
    left = [int(line.counts[-1]) for line in followed if line.isolated_from is None]
    widest = _window(isolated)
    return {
        "lines": len(followed),
        "isolated": len(isolated),
        "widest": widest,
        "half": np.median(widest),
        "others": f"; about the others are up to {max(left)} in a window of 4e-25 m" if left else "",
        "impacts": np.array([line.impacts[-1].max() for line in followed]),
    }


def _standing(off: Array) -> dict[str, Any]:
    """Return how near coins at a boundary come to standing upright, by the names of the claims.

    Args:
        off: energy that the coin lacks, or has too much, to stand, by boundary and window, (n, m) [m g r].
    """
    stands = off[:, -1] < UPRIGHT
    last, before = (np.median(off[:, -1 - tenfolds]) for tenfolds in (0, TENFOLDS))
    window = _window(np.array(WINDOWS_BELOW - 1))
    return {"standing": stands, "upright": share(stands, "lines")} | {
        "window": window,
        "last": last,
        "tenfolds": 10**TENFOLDS,
        "before": before,
    }


def _slopes(shares: Array, whole: Array) -> dict[str, Any]:
    """Return how the share of uncertain tosses falls, by the names of the claims.

    Args:
        shares: weight of uncertain tosses, by group of ancestors and accuracy, (n, m).
        whole: all weight, (n, m).
    """
    last, f = len(ACCURACIES) - 1, shares.mean(axis=0) / whole.mean(axis=0)
    slopes = {
        ACCURACIES[i]: slope_between(shares, whole, i, i + DECADES).value for i in range(0, last, DECADES)
    }
    doubles = slope_between(shares, whole, *DOUBLES)
    return {
        "slopes": ", ".join(f"{accuracy:.0e} m: {alpha:.2f}" for accuracy, alpha in slopes.items()),
        "shares": ", ".join(f"{x:.1e}" for x in f[::DECADES]),
        "finest": slope_between(shares, whole, last - DECADES, last),
        "uncertain": f[-1],
        "doubles": doubles,
        "finer": 2 ** (1 / doubles.value),
        "coarse": slope_between(shares, whole, 0, 1),
    }


def _window(stage: NDArray[np.intp]) -> Array:
    """Return how long the lines of a stage are [m]."""
    return (HEIGHTS[1] - HEIGHTS[0]) / MAGNIFICATION ** stage.astype(float)


def _boundary_near(scenario: Scenario) -> float:
    """Return the height of the boundary that is the nearest to `NEAR` on a line through it [m]."""
    z = np.linspace(NEAR[0] - REACH, NEAR[0] + REACH, 4 * POINTS)
    faces = analytic.toss_rows(planar_rows(scenario, z, np.full_like(z, NEAR[1]))).outcome
    changes = z[np.flatnonzero(faces[1:] != faces[:-1])]
    return float(changes[np.argmin(np.abs(changes - NEAR[0]))])


def _magnified(scenario: Scenario, points: int, spin: float) -> Magnified:
    """Magnify a line of heights time and again about one of its boundaries."""
    low, high = (Fraction(height) for height in HEIGHTS)
    return magnify(
        planar_coin(scenario),
        units(scenario),
        PlanarRelease(low, Fraction(spin)),
        length=high - low,
        windows=WINDOWS_BELOW,
        points=points,
    )


def _by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Return how many of MuJoCo's outcomes agree, and how many of its tosses are uncertain, in words."""
    both = np.concatenate([heights, heights + ACCURACY_MUJOCO]), np.tile(spins, 2)
    rows = planar_rows(scenario, *both)
    (by_analytic, nearby_analytic), (by_mujoco, nearby) = (
        toss_rows(rows).outcome.reshape(2, -1) for toss_rows in (analytic.toss_rows, toss_rows_by_mujoco)
    )
    return (
        f"{np.sum(by_mujoco == by_analytic)} of {len(heights)} outcomes as the analytic engine; "
        f"{ACCURACY_MUJOCO:.0e} m higher changes {np.sum(by_mujoco != nearby)} of them, of the analytic "
        f"engine's {np.sum(by_analytic != nearby_analytic)}"
    )


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(10, 6))
    grid = picture.subplots(2, 3)
    for row, medium in enumerate(MEDIA):
        for column, (height, spin) in enumerate(WINDOWS):
            axes = grid[row, column]
            z, w = data[f"{medium}, center"]
            draw_titled(
                axes,
                data[f"{medium}, enlargement {column}"],
                f"in {medium}, {height:g} m wide",
                x=MapAxis(name="height", unit="m", start=z - height / 2, stop=z + height / 2),
                y=MapAxis(name="spin", unit="rad/s", start=w - spin / 2, stop=w + spin / 2),
            )
            axes.ticklabel_format(useOffset=False)
            axes.locator_params(axis="x", nbins=4)
    counts, slopes = grid[:, 2]
    windows = _window(np.arange(WINDOWS_BELOW))
    for medium, color in MEDIA.items():
        crossings, shares = data[f"{medium}, crossings"], data[f"{medium}, shares"]
        counts.loglog(windows, crossings.T, "-", color=color, linewidth=0.3)
        counts.loglog(windows, np.median(crossings, axis=0), "o-", color=color, label=f"median, {medium}")
        local = np.log10(shares[:-DECADES] / shares[DECADES:]) / DECADES
        slopes.semilogx(ACCURACIES[:-DECADES], local, "o-", color=color, label=medium)
    counts.set(title="magnified lines", xlabel="length [m]", ylabel="boundaries on it")
    slopes.axhline(1, linestyle=":", color=GREY, label="a smooth boundary")
    slopes.set(
        title="local slope of the uncertain share",
        xlabel="ε [m]",
        ylabel=f"α over {DECADES} decades",
        ylim=(0, 1.2),
    )
    for axes in (counts, slopes):
        axes.legend()
        axes.invert_xaxis()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
