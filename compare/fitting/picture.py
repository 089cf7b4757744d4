"""A fit as a picture: the toss over the observer's time with what was seen, and the residuals below."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.output.style import BLUE, GREY, PALE, STYLE, VERMILION
from cointoss.models.palette import COLORS
from cointoss.models.records import Face

if TYPE_CHECKING:
    from cointoss.compare.fitting.fit import Fit

DRAWN = 800
"""The number of times at which a path is drawn."""
MARGIN = 0.05
"""How much longer than the last observation the picture is, as a part of the time."""


def plot_fit(fit: "Fit", ax: Axes | None = None) -> Axes:
    """Draw the height of the fitted toss over the observer's time, with what was seen."""
    axes, seen, path, clock = axes_or_new(ax), fit.observed, fit.toss, fit.clock
    last = float(max(seen.touch_times.max(initial=-np.inf), seen.times.max(initial=-np.inf)))
    end = min(path.end_time, (1 + MARGIN) * (last - clock))
    times = np.linspace(0, max(end, 0), DRAWN)
    axes.plot(times + clock, path.sample(times).position[:, 2], color=BLUE, label="fitted toss")
    tested, shown = fit.tested[: len(seen.touch_times)], set[str]()
    for number, time, face, counts in zip(
        seen.touch_numbers, seen.touch_times, seen.faces, tested, strict=True
    ):
        label = "touch that was seen" if counts else "touch beyond the horizon of trust"
        axes.axvline(
            time,
            color=VERMILION if counts else PALE,
            linestyle="-" if counts else ":",
            linewidth=0.9,
            label="_" if label in shown else label,
        )
        shown.add(label)
        told = f"{number}" + (f" {Face(face).symbol}" if face else "")
        axes.annotate(
            told, (time, 1), xycoords=("data", "axes fraction"), ha="center", va="bottom", fontsize=7.5
        )
    heights = np.isfinite(seen.heights)
    if heights.any():
        axes.errorbar(
            seen.times[heights],
            seen.heights[heights],
            seen.height_sd[heights],
            fmt=".",
            color=COLORS["edge"],
            markersize=4,
            linewidth=0.8,
            label="height that was seen",
        )
    axes.set(xlabel="observer's time [s]", ylabel="height of the mass centre [m]")
    axes.legend(fontsize=8, loc="upper right", frameon=True, framealpha=0.9, edgecolor="none")
    return axes


def draw_fit(fit: "Fit") -> Figure:
    """Draw a fit, and below it by how many standard deviations it misses each number."""
    with rc_context(STYLE):
        picture = Figure(figsize=(7, 5))
        above, below = picture.subplots(2, 1, height_ratios=(3, 1.3), sharex=True)
        plot_fit(fit, above).set(xlabel="")
        can = "can" if fit.is_possible else "cannot"
        above.set_title(f"this model {can} do what was seen", pad=16)
        below.axhspan(-2, 2, color=PALE, alpha=0.25)
        below.axhline(0, color=GREY, linewidth=0.8)
        for chosen, color in ((fit.tested, BLUE), (~fit.tested, PALE)):
            below.plot(fit.times[chosen], fit.residuals[chosen], "o", color=color, markersize=3.5)
        below.set(xlabel="observer's time [s]", ylabel="residual [sd]")
        return picture
