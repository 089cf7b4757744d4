"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Picture
from numpy.typing import NDArray

from compare.basins.picture import Axis, draw_panel
from compare.basins.stripes import crossings, stripe_widths
from compare.findings import Finding, Result, paper_figure
from compare.planar_maps import HEIGHTS, SPINS, case, faces_after, releases, whole_grid
from compare.reproduction import Progress

MEDIA = ("air", "vacuum")
SHOWN = (0, 2, 5, 9)
COUNTED = 10
"""Boundaries are counted after 0 to so many impacts, less one."""
SPIN = 40.0
"""Of the line on which they are counted [rad/s]."""
HEIGHT_AXIS = Axis(name="height", unit="m", start=HEIGHTS[0], stop=HEIGHTS[1])
SPIN_AXIS = Axis(name="spin", unit="rad/s", start=SPINS[0], stop=SPINS[1])


def make(progress: Progress, points: int = 300, line: int = 100_000) -> Result:
    """Map the face after each number of impacts, and count the boundaries along a fine line."""
    grid = whole_grid(points)
    z = np.linspace(*HEIGHTS, line)
    data: dict[str, NDArray[Any]] = {}
    findings = []
    done, whole = 0, len(MEDIA) * (len(SHOWN) + COUNTED)
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        for n in SHOWN:
            data[f"{medium}, map {n}"] = faces_after(scenario, grid.releases, n).reshape(grid.shape)
            progress(done := done + 1, whole)
        counts, coarser, widths = [], [], []
        for n in range(COUNTED):
            faces = faces_after(scenario, releases(z, np.full_like(z, SPIN)), n)
            counts.append(int(crossings(faces)))
            coarser.append(int(crossings(faces[::2])))
            w = stripe_widths(faces, spacing=(HEIGHTS[1] - HEIGHTS[0]) / (line - 1))
            widths.append(np.median(w) if len(w) else np.nan)
            progress(done := done + 1, whole)
        N = np.array(counts)
        data |= {f"{medium}, boundaries": N, f"{medium}, widths": np.array(widths)}
        # Where every second point misses few, the line is fine enough.
        fine = int(np.argmax(np.append(np.array(coarser) < 0.9 * N, True)))
        growth = N[1:fine] / N[: fine - 1]
        findings += [
            Finding(
                claim=f"the more impacts, the more boundaries (in {medium})",
                ours=f"N = {', '.join(map(str, N[:fine]))} after 0 to {fine - 1} impacts",
                holds=np.all(growth > 1),
            ),
            Finding(
                claim=f"their number grows faster than exponentially (in {medium})",
                ours=f"from impact to impact by {', '.join(f'{factor:.1f}' for factor in growth)}",
                holds=np.all(np.diff(growth) > 0),
                expected=False,
            ),
        ]
        if medium == "air":
            findings.append(
                Finding(
                    claim="stripes become narrower than any hand is accurate (section 5.3)",
                    ours=f"median width {widths[fine - 1]:.1g} m after {fine - 1} impacts",
                    holds=widths[fine - 1] < 1e-3,
                )
            )
    return Result(findings=findings, draw=partial(_draw, data), data=data)


def _draw(data: dict[str, NDArray[Any]]) -> Picture:
    picture = Picture(figsize=(11, 7))
    grid = picture.add_gridspec(3, len(SHOWN))
    for row, medium in enumerate(MEDIA):
        for column, n in enumerate(SHOWN):
            axes = picture.add_subplot(grid[row, column])
            draw_panel(axes, data[f"{medium}, map {n}"], x=HEIGHT_AXIS, y=SPIN_AXIS)
            axes.set_title(f"n = {n}, in {medium}")
            axes.grid(visible=False)
    growth = picture.add_subplot(grid[2, :2])
    width = picture.add_subplot(grid[2, 2:])
    for medium, color in zip(MEDIA, ("#0072B2", "#D55E00"), strict=True):
        growth.semilogy(data[f"{medium}, boundaries"], "o-", color=color, label=medium)
        width.semilogy(data[f"{medium}, widths"], "o-", color=color, label=medium)
    growth.set(xlabel="impacts n", ylabel="boundaries N on a line")
    width.set(xlabel="impacts n", ylabel="median stripe [m]")
    growth.legend()
    return picture


FIGURE = paper_figure(
    paper="Fig. 31, section 5.3",
    title="the face after 0, 2, 5 and 9 impacts; boundaries and stripes against the number of impacts",
    assumed=(
        "Axes and the line are unsaid; here those of Fig. 29 and the line of spin 40 rad/s. Counts are given "
        "up to where every second point of the line would miss a tenth of them."
    ),
    seconds=120,
    make=make,
    quick_seconds=30,
    quick=partial(make, points=100, line=10_000),
)
