"""Plots of tosses, in axes of one's own or new ones."""

import io
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss.compare.output.style import GREY, INK, STYLE
from cointoss.models.barriers import barrier
from cointoss.models.certificate import energies
from cointoss.models.interruptible import interruptible
from cointoss.models.palette import COLORS
from cointoss.models.records import Face, Toss
from cointoss.models.title import title_of_toss

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


def picture_of_toss(toss: Toss, name: str) -> bytes:
    """Draw the height, the tilt and the energy of a coin over time, as the content of a .png file.

    Args:
        toss: what is drawn.
        name: of its scenario.
    """
    hits, body = toss.impacts.time, toss.scenario.body
    times = np.sort(np.concatenate([np.linspace(0, toss.end_time, 4 * DRAWN), np.nextafter(hits, 0), hits]))
    states, least = toss.sample(times), min(barrier(body, side) for side in (1.0, -1.0))
    with rc_context(STYLE):
        figure = Figure(figsize=(8, 8))
        height, tilt, energy = figure.subplots(3, sharex=True)
        plot_toss(toss, height, color=INK)
        tilt.plot(times, np.degrees(np.arccos(states.normal[:, 2].clip(-1, 1))), color=INK)
        tilt.set(ylabel="tilt [deg]: 0 heads up, 180 tails up", ylim=(0, 180), yticks=range(0, 181, 45))
        energy.plot(times, 1e3 * energies(body, states), color=INK)
        energy.axhline(1e3 * least, color=GREY, linestyle="--", label="least energy to turn over")
        energy.set(xlabel="time [s]", ylabel="energy [mJ]", ylim=(0, None))
        energy.legend()
        height.set(xlabel="", ylim=(0, None))
        figure.suptitle(title_of_toss(toss.scenario, name), parse_math=False)
        return picture_bytes(figure)
