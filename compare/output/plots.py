"""Plots of tosses, in axes of one's own or new ones."""

import io
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss.models.interruptible import interruptible
from cointoss.models.palette import COLORS
from cointoss.models.records import Face, Toss

DRAWN = 600
"""The number of times at which a path is drawn."""


def axes_or_new(ax: Axes | None) -> Axes:
    """Return the axes that are given, or those of a new figure of pyplot."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def picture_bytes(figure: Figure, suffix: str = ".png", dpi: float = 150) -> bytes:
    """Return the content of a picture's file, of a suffix as in ".png"; that of .svg names no date."""
    drawn = io.BytesIO()
    no_date = {"Date": None} if suffix == ".svg" else None
    interruptible(lambda: figure.savefig(drawn, format=suffix[1:], dpi=dpi, metadata=no_date))
    return drawn.getvalue()


def plot_toss(toss: Toss, ax: Axes | None = None, **line: Any) -> Axes:
    """Draw the height of a coin's mass centre over time, and a dot at each touch of the floor.

    Args:
        toss: what is drawn.
        ax: where.
        line: of matplotlib's line, such as its color and its label.
    """
    axes, times, impacts = axes_or_new(ax), np.linspace(0, toss.end_time, DRAWN), toss.impacts
    axes.plot(times, toss.sample(times).position[:, 2], **line)
    named = {text.get_label() for text in axes.get_lines()}
    for face in Face:
        up, label = impacts.face == face, f"{face} up at the touch"
        dots = axes.plot(impacts.time[up], impacts.position[up, 2], "o", color=COLORS[str(face)])
        dots[0].set_label("_" if label in named else label)
    axes.set(xlabel="time [s]", ylabel="height of the mass centre [m]")
    axes.legend()
    axes.set_title(f"{toss.outcome}, by the engine {toss.engine}")
    return axes
