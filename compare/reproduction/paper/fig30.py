"""Fig. 30, section 5.2: boundaries magnified to 1e-25 m, and how the share of uncertain tosses falls."""

from concurrent.futures import ThreadPoolExecutor
from fractions import Fraction
from functools import partial
from itertools import product
from os import cpu_count
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.compare.basins.picture import MapAxis, draw_panel
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import GREY
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import jackknife, share
from cointoss.compare.reproduction.parts import Part, kept
from cointoss.compare.reproduction.precision.magnified import MAGNIFICATION, Magnified, magnify
from cointoss.compare.reproduction.precision.planar_coin import planar_coin, units
from cointoss.compare.reproduction.precision.planar_state import HEIGHT, release
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.planar_maps import (
    HEIGHTS,
    MEDIA,
    SPINS,
    Grid,
    case,
    final_faces,
    releases,
)
from cointoss.compare.reproduction.setups.uncertain_shares import uncertain_shares
from cointoss.models.kernel.sources import source_hash
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

WINDOWS_BELOW = 25
"""A line through the map is magnified so many times, 1 included; the last is 4e-25 m long."""
POINTS = 50
"""On a line."""
ACCURACIES = 10.0 ** -np.arange(3, 25)
"""ε, the accuracy of the height at release [m]."""
DECADES = 3
"""α is the slope over so many of them."""
DOUBLES = (3, 4)
"""Index of the first and number of those for which doubles would do: 1e-6 m to 1e-10 m."""
SMOOTH, FRACTAL = 0.9, 0.8
"""An exponent α above the one is all but a smooth boundary's, below the other a fractal's."""
UPRIGHT = 1e-6
"""A coin stands when it comes so near to the upright coin at rest [m g r]."""
TENFOLDS = 3
"""Over so many magnifications it is seen to come nearer."""
SEED = 30
WINDOWS = ((0.05, 5.0), (5e-4, 0.05))
"""Height and spin of the enlarged maps [m, rad/s]."""
NEAR = (0.258, 39.0)
"""They are centred on the boundary of this spin that is nearest to this height [m, rad/s]."""
REACH = 0.02
"""How far it may be [m]."""
ACCURACY_MUJOCO = 1e-4
"""By which nearby tosses of MuJoCo differ [m]."""


def make(
    progress: Progress,
    parts: Path,
    points: int = 100,
    lines: int = 20,
    runs: int = 24,
    population: int = 60,
    tosses_mujoco: int = 200,
) -> Result:
    """Enlarge the maps of Fig. 29(c, d) and lines through them, and find the share of uncertain tosses."""
    whole = len(MEDIA) * (len(WINDOWS) + lines + runs) + 1
    done = 0
    rng = np.random.default_rng(SEED)
    data: dict[str, NDArray[Any]] = {}
    claims: list[Claim] = []
    heights, spins = rng.uniform(*HEIGHTS, tosses_mujoco), rng.uniform(*SPINS, tosses_mujoco)
    mujoco = _by_mujoco(case(air=True), heights, spins)
    progress(done := done + 1, whole)
    jobs = list(product(MEDIA, range(runs)))
    made: dict[str, list[Array]] = {medium: [] for medium in MEDIA}
    pool = ThreadPoolExecutor(cpu_count())
    try:
        for (medium, _), found in zip(
            jobs, pool.map(lambda job: _shares(parts, job[0], job[1], population), jobs), strict=True
        ):
            made[medium].append(found)
            progress(done := done + 1, whole)
    finally:
        # An interruption does not wait for the runs not yet begun.
        pool.shutdown(cancel_futures=True)
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
        for spin in np.linspace(*SPINS, lines + 2)[1:-1]:
            followed.append(_magnified(scenario, float(spin)))
            progress(done := done + 1, whole)
        data[f"{medium}, crossings"] = np.array([line.counts for line in followed])
        data[f"{medium}, off"] = off = np.array([line.from_upright.max(axis=1) for line in followed])
        data[f"{medium}, shares"] = shares = np.array(made[medium])
        claims += _claims(medium, followed, off, shares, mujoco if medium == "air" else "-")
    return Result(claims=claims, data=data)


def _shares(parts: Path, medium: str, number: int, population: int) -> Array:
    """Return f at each of `ACCURACIES` as a run of the splitting finds it; kept, so that it is made once."""

    def compute() -> Part:
        rng = np.random.default_rng([SEED, number])
        scenario = case(air=medium == "air")
        run = uncertain_shares(scenario, rng, levels=len(ACCURACIES), population=population)
        return {"shares": run.shares}

    made_by = source_hash("cointoss.compare.reproduction.setups.uncertain_shares")
    return kept(parts, f"{made_by}, {medium}, {number}, {population}", compute)["shares"]


def _claims(medium: str, followed: list[Magnified], off: Array, shares: Array, mujoco: str) -> list[Claim]:
    lines = len(followed)
    isolated = np.array([line.isolated_from for line in followed if line.isolated_from is not None])
    left = [int(line.counts[-1]) for line in followed if line.isolated_from is None]
    widest = _window(isolated)
    last, coarse = slope(shares, len(ACCURACIES) - 1 - DECADES, DECADES), slope(shares, 0, 1)
    doubles, f = slope(shares, *DOUBLES), shares.mean(axis=0)
    impacts = [line.impacts[-1].max() for line in followed]
    return [
        Claim(
            claim=f"under further magnification boundaries are smooth, no new structure (in {medium})",
            analytic=(
                f"{len(isolated)} of {lines} boundaries are isolated in the end, from windows of "
                f"{widest.min():.0e} to {widest.max():.0e} m on, half of them from {np.median(widest):.0e} m"
                + (f"; about the others are up to {max(left)} in a window of 4e-25 m" if left else "")
                + f"; their tosses make {min(impacts)} to {max(impacts)} impacts"
            ),
            criteria=[Criterion("isolated boundaries", len(isolated), "=", lines, "all that were magnified")],
        ),
        standing(medium, off),
        Claim(
            claim=f"by 1e-24 m the share of uncertain tosses falls as ε¹, a smooth boundary (in {medium})",
            analytic=(
                "α over three decades from "
                + ", ".join(
                    f"{ACCURACIES[i]:.0e} m: {slope(shares, i, DECADES).value:.2f}"
                    for i in range(0, len(ACCURACIES) - DECADES, DECADES)
                )
                + "; the share itself "
                + ", ".join(f"{f[i]:.1e}" for i in range(0, len(ACCURACIES), DECADES))
            ),
            mujoco=mujoco,
            expected=False,
            criteria=[Criterion("α from 1e-21 to 1e-24 m", last, ">", SMOOTH, "a smooth boundary has 1")],
        ),
        Claim(
            claim=f"for any release an accuracy exists that makes it predictable (in {medium})",
            criteria=[
                Criterion("share uncertain within 1e-24 m", f[-1], "<", 1e-6, "one toss in a million"),
            ],
        ),
        Claim(
            claim=(
                "(against the paper, Yue 2014, 2016) the outcome is as sensitive as of a fractal "
                f"(in {medium})"
            ),
            analytic=(
                f"at every accuracy that can be met: from 1e-6 to 1e-10 m α = {doubles.value:.2f}, so that "
                f"to halve the share takes a {2 ** (1 / doubles.value):.0f} times finer one, on a smooth "
                f"boundary twice; from 1 to 0.1 mm α = {coarse.value:.2f}"
            ),
            criteria=[
                Criterion("α from 1e-6 to 1e-10 m", doubles, "<", FRACTAL, "a smooth boundary has 1"),
            ],
        ),
    ]


def standing(medium: str, off: Array) -> Claim:
    """Return the claim that a boundary is the coin that comes to stand upright.

    Args:
        medium: air or vacuum.
        off: energy that the coin lacks, or has too much, to stand, by boundary and window, (n, m) [m g r].
    """
    stands = off[:, -1] < UPRIGHT
    last, before = (np.median(off[:, -1 - tenfolds]) for tenfolds in (0, TENFOLDS))
    return Claim(
        claim=f"most boundaries are the coin that comes to stand upright (in {medium})",
        analytic=(
            f"{stands.sum()} of {len(off)} are: the energy that the coin lacks, or has too much, to stand "
            f"upright at rest falls as the window's length; in the last, "
            f"{_window(np.array(WINDOWS_BELOW - 1)):.0e} m, it is {last:.0e} m g r in the median, in one "
            f"{10**TENFOLDS} times as long {before:.0e} m g r"
        ),
        criteria=[
            Criterion(
                f"share of those with less than {UPRIGHT:.0e} m g r", share(stands, "lines"), ">", 0.5, "most"
            )
        ],
    )


def slope(shares: Array, first: int, decades: int) -> Estimate:
    """Return α over some decades of `ACCURACIES`, with a jackknife's interval over the runs.

    Args:
        shares: f, by run and accuracy, (n, m).
        first: where it starts.
        decades: how many.
    """
    return jackknife(
        lambda kept: float(
            np.log10(shares[kept, first].mean() / shares[kept, first + decades].mean()) / decades
        ),
        len(shares),
        "runs",
        parts=len(shares),
    )


def _window(stage: NDArray[np.intp]) -> Array:
    """Return how long the lines of a stage are [m]."""
    return (HEIGHTS[1] - HEIGHTS[0]) / MAGNIFICATION ** stage.astype(float)


def _boundary_near(scenario: Scenario) -> float:
    """Return the height of the boundary that is the nearest to `NEAR` on a line through it [m]."""
    z = np.linspace(NEAR[0] - REACH, NEAR[0] + REACH, 4 * POINTS)
    faces = analytic.toss_many(scenario, releases(z, np.full_like(z, NEAR[1]))).outcome
    changes = z[np.flatnonzero(faces[1:] != faces[:-1])]
    return float(changes[np.argmin(np.abs(changes - NEAR[0]))])


def _magnified(scenario: Scenario, spin: float) -> Magnified:
    """Magnify a line of heights time and again about one of its boundaries."""
    own = units(scenario)
    low, high = (Fraction(height) / own.length for height in HEIGHTS)
    return magnify(
        planar_coin(scenario),
        release(own, height=HEIGHTS[0], spin=spin),
        row=HEIGHT,
        length=high - low,
        windows=WINDOWS_BELOW,
        points=POINTS,
    )


def _by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Return how many of MuJoCo's outcomes agree, and how many of its tosses are uncertain, in words."""
    start = releases(heights, spins)
    by_analytic = analytic.toss_many(scenario, start).outcome
    by_mujoco, nearby = (
        coin_mj.toss_many(scenario, releases(heights + step, spins), settings=coin_mj.FINE).outcome
        for step in (0.0, ACCURACY_MUJOCO)
    )
    nearby_analytic = analytic.toss_many(scenario, releases(heights + ACCURACY_MUJOCO, spins)).outcome
    return (
        f"{np.sum(by_mujoco == by_analytic)} of {len(heights)} outcomes as the analytic engine; "
        f"{ACCURACY_MUJOCO:.0e} m higher changes {np.sum(by_mujoco != nearby)} of them, of the analytic "
        f"engine's {np.sum(by_analytic != nearby_analytic)}"
    )


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(10, 6))
    grid = picture.subplots(2, 3)
    for row, medium in enumerate(MEDIA):
        for column, (height, spin) in enumerate(WINDOWS):
            axes = grid[row, column]
            z, w = data[f"{medium}, center"]
            draw_panel(
                axes,
                data[f"{medium}, enlargement {column}"],
                x=MapAxis(name="height", unit="m", start=z - height / 2, stop=z + height / 2),
                y=MapAxis(name="spin", unit="rad/s", start=w - spin / 2, stop=w + spin / 2),
            )
            axes.set_title(f"in {medium}, {height:g} m wide")
            axes.ticklabel_format(useOffset=False)
            axes.locator_params(axis="x", nbins=4)
            axes.grid(visible=False)
    counts, slopes = grid[:, 2]
    windows = _window(np.arange(WINDOWS_BELOW))
    for medium, color in MEDIA.items():
        crossings, shares = data[f"{medium}, crossings"], data[f"{medium}, shares"].mean(axis=0)
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


REPRODUCTION = Reproduction(
    paper="Fig. 30, section 5.2",
    title="boundaries under magnification, and the share of uncertain tosses",
    assumed=(
        "Where the paper enlarges is unsaid; here about 0.26 m and 39 rad/s, and lines through the whole "
        "map, each magnified 10²⁴ times about one of its boundaries, in arithmetic of 106 bits. How near a "
        "coin comes to standing is the least sum, over its last contact, of the energy of its motion, "
        "sliding aside, and that which its height lacks. A boundary that is followed is isolated in the end, "
        "but most are not by 1e-24 m, as the share shows: see PREDICTABILITY.md. An interrupted run goes on "
        "where it was."
    ),
    seconds=400,
    make=make,
    resumes=True,
    draw={"figure": _draw},
    quick_seconds=30,
    quick=partial(make, points=25, lines=4, runs=4, population=20, tosses_mujoco=10),
)
