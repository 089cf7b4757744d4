"""Fig. 30, section 5.2: boundaries under magnification, and how the share of uncertain tosses falls."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Picture
from numpy.typing import NDArray

import analytic
from compare.basins.picture import Axis, draw_panel
from compare.basins.stripes import crossings
from compare.findings import Finding, Result, paper_figure
from compare.planar_maps import HEIGHTS, SPINS, Grid, case, final_faces, releases
from compare.reproduction import Progress
from models.records import Array
from models.scenario import Scenario

MEDIA = ("air", "vacuum")
MAGNIFICATION = 10
STAGES = 12
"""A line through the map is magnified so many times, 1 included; the last is near rounding."""
ACCURACIES = 10.0 ** -np.arange(2, 11)
"""ε, the accuracy of the height at release [m]."""
SEED = 30
WINDOWS = ((0.05, 5.0), (5e-4, 0.05))
"""Height and spin of the enlarged maps [m, rad/s]."""
CENTER = (0.27, 41.0)
"""Of the enlarged maps [m, rad/s]."""


def make(progress: Progress, points: int = 250, lines: int = 20, tosses: int = 20_000) -> Result:
    """Enlarge the maps of Fig. 29(c, d) and lines through them, and toss at random within ε."""
    whole = 2 * (len(WINDOWS) + lines + 1)
    done = 0
    data: dict[str, NDArray[Any]] = {}
    findings = []
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        for number, (height, spin) in enumerate(WINDOWS):
            z, w = CENTER
            grid = Grid(
                heights=np.linspace(z - height / 2, z + height / 2, points),
                spins=np.linspace(w - spin / 2, w + spin / 2, points),
            )
            data[f"{medium}, enlargement {number}"] = final_faces(scenario, grid)
            progress(done := done + 1, whole)
        stripes = []
        for spin in np.linspace(*SPINS, lines + 2)[1:-1]:
            stripes.append(_magnified(scenario, float(spin)))
            progress(done := done + 1, whole)
        data[f"{medium}, crossings"] = np.array(stripes)
        data[f"{medium}, uncertain"] = uncertain = _uncertain(scenario, tosses)
        progress(done := done + 1, whole)
        last = np.array(stripes)[:, -1]
        alone = [np.flatnonzero(np.array(line) > 1)[-1] + 1 for line in stripes]
        widest = (HEIGHTS[1] - HEIGHTS[0]) / MAGNIFICATION ** np.array(alone, dtype=float)
        slope = float(np.polyfit(np.log(ACCURACIES[4:]), np.log(uncertain[4:]), 1)[0])
        local = np.diff(np.log(uncertain)) / np.diff(np.log(ACCURACIES))
        findings += [
            Finding(
                claim=f"under magnification the boundaries are smooth lines (in {medium})",
                ours=(
                    f"{np.sum(last == 1)} of {lines} boundaries are alone in the end; in the median from a "
                    f"window of {np.median(widest):.0e} m on"
                ),
                holds=np.all(last == 1),
            ),
            Finding(
                claim=f"the share of uncertain tosses falls as ε, as for a smooth boundary (in {medium})",
                ours=(
                    f"as ε^{slope:.2f} from 1e-6 m to 1e-10 m ({uncertain[4]:.1%} to {uncertain[-1]:.2%}); "
                    f"the local exponent rises from {local[:3].mean():.2f} at 1e-3 m to {local[-1]:.2f}"
                ),
                holds=slope > 0.9,
                expected=False,
            ),
            Finding(
                claim=f"an accuracy can be found within which a toss is predictable (in {medium})",
                ours=(
                    f"{1 - uncertain[-1]:.1%} of the tosses are, within 1e-10 m; within 1 mm "
                    f"{1 - uncertain[1]:.1%}"
                ),
                holds=uncertain[-1] < 0.02,
            ),
        ]
    return Result(findings=findings, draw=partial(_draw, data), data=data)


def _magnified(scenario: Scenario, spin: float, points: int = 1000) -> list[int]:
    """Count the boundaries on a line of heights, magnified time and again about one of them."""
    low, high = HEIGHTS
    counts = []
    for _ in range(STAGES):
        z = np.linspace(low, high, points)
        faces = analytic.toss_many(scenario, releases(z, np.full_like(z, spin))).outcome
        counts.append(int(crossings(faces)))
        changes = np.flatnonzero(faces[1:] != faces[:-1])
        middle = z[changes[len(changes) // 2] : changes[len(changes) // 2] + 2].mean()
        half = (high - low) / MAGNIFICATION / 2
        low, high = middle - half, middle + half
    return counts


def _uncertain(scenario: Scenario, tosses: int) -> Array:
    """Give the share of random tosses with another outcome at a height ε above or below, by ε."""
    rng = np.random.default_rng(SEED)
    z, w = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    outcome, above, below = (
        [analytic.toss_many(scenario, releases(z + step, w)).outcome for step in steps]
        for steps in ([0.0], ACCURACIES, -ACCURACIES)
    )
    return np.array(
        [np.mean((a != outcome[0]) | (b != outcome[0])) for a, b in zip(above, below, strict=True)]
    )


def _draw(data: dict[str, NDArray[Any]]) -> Picture:
    picture = Picture(figsize=(10, 6))
    grid = picture.subplots(2, 3)
    for row, medium in enumerate(MEDIA):
        for column, (height, spin) in enumerate(WINDOWS):
            axes = grid[row, column]
            z, w = CENTER
            draw_panel(
                axes,
                data[f"{medium}, enlargement {column}"],
                x=Axis(name="height", unit="m", start=z - height / 2, stop=z + height / 2),
                y=Axis(name="spin", unit="rad/s", start=w - spin / 2, stop=w + spin / 2),
            )
            axes.set_title(f"in {medium}, {height:g} m wide")
            axes.ticklabel_format(useOffset=False)
            axes.tick_params(axis="x", rotation=30)
            axes.grid(visible=False)
    alone, share = grid[:, 2]
    windows = (HEIGHTS[1] - HEIGHTS[0]) / MAGNIFICATION ** np.arange(STAGES)
    for medium, color in zip(MEDIA, ("#0072B2", "#D55E00"), strict=True):
        alone.loglog(
            windows, np.median(data[f"{medium}, crossings"], axis=0), "o-", color=color, label=medium
        )
        share.loglog(ACCURACIES, data[f"{medium}, uncertain"], "o-", color=color, label=medium)
    alone.set(xlabel="length of the line [m]", ylabel="boundaries on it (median)")
    share.loglog(ACCURACIES, 3e7 * ACCURACIES, ":", color="#5b6675", label="slope 1")
    share.set(xlabel="ε [m]", ylabel="share of uncertain tosses", ylim=(1e-3, 1.2))
    alone.legend()
    share.legend()
    return picture


FIGURE = paper_figure(
    paper="Fig. 30, section 5.2",
    title="boundaries under magnification, and the share of uncertain tosses",
    assumed=(
        "Where the paper enlarges is unsaid; here lines through the whole map, each magnified 10¹¹ times "
        "about one of its boundaries. Both sides of the dispute about these basins are right: every "
        "boundary, looked at closely enough, is a smooth line alone, and yet at all accuracies that can be "
        "met the share of uncertain tosses falls as for a fractal: stripes of all widths lie side by side."
    ),
    seconds=300,
    make=make,
    quick_seconds=40,
    quick=partial(make, points=80, lines=4, tosses=1500),
)
