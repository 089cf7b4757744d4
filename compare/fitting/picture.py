"""A toss over the observer's time, with what was seen."""

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from cointoss.compare.fitting.observed import Observed
from cointoss.compare.output.plots import axes_or_new
from cointoss.compare.output.style import BLUE, PALE, VERMILION
from cointoss.models.palette import COLORS
from cointoss.models.records import Face, Toss

DRAWN = 800
"""The number of times at which a path is drawn."""
MARGIN = 0.05
"""How much longer than the last observation the picture is, as a part of the time."""


def plot_seen(
    seen: Observed, toss: Toss, clock: float, tested: NDArray[np.bool_], ax: Axes | None = None
) -> Axes:
    """Draw the height of a toss over the observer's time, with what was seen.

    Args:
        seen: touches and frames.
        toss: which explains them.
        clock: the observer's clock at the release [s].
        tested: which touches lie within the horizon of trust, (n,).
        ax: where; by default in a new figure of pyplot.
    """
    axes = axes_or_new(ax)
    last = float(max(seen.touch_times.max(initial=-np.inf), seen.times.max(initial=-np.inf)))
    times = np.linspace(0, max(min(toss.end_time, (1 + MARGIN) * (last - clock)), 0), DRAWN)
    axes.plot(times + clock, toss.sample(times).position[:, 2], color=BLUE, label="fitted toss")
    for is_tested, color, line, label in (
        (True, VERMILION, "-", "touch that was seen"),
        (False, PALE, ":", "touch beyond the horizon of trust"),
    ):
        for time in seen.touch_times[tested == is_tested]:
            axes.axvline(time, color=color, linestyle=line, linewidth=0.9, label=label)
            label = "_"
    for number, time, face in zip(seen.touch_numbers, seen.touch_times, seen.faces, strict=True):
        up = f" {Face(face).symbol}" if face else ""
        place = {"xycoords": ("data", "axes fraction"), "ha": "center", "va": "bottom"}
        axes.annotate(f"{number}{up}", (time, 1), fontsize=7.5, **place)
    if (heights := seen.measured["heights"]).any():
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
