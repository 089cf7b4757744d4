"""Plots of tosses and of outcomes in matplotlib, which is imported when one is drawn."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from cointoss.models.notebook import COLORS

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Axes


def axes_or_new(ax: "Axes | None") -> "Axes":
    """Return the axes that are given, or those of a new figure of pyplot."""
    if ax is not None:
        return ax
    from matplotlib import pyplot

    return pyplot.subplots(layout="constrained")[1]


def draw_height(
    ax: "Axes",
    path: tuple[ArrayLike, ArrayLike],
    touches: Mapping[str, tuple[ArrayLike, ArrayLike]],
    **line: Any,
) -> None:
    """Draw the height of a coin's mass centre over time, and a dot at each touch of the floor.

    Args:
        ax: where.
        path: times [s] and heights [m].
        touches: times [s] and heights [m] of the touches, by the face that is up, "heads" or "tails".
        line: of matplotlib's line, such as its color and its label.
    """
    ax.plot(*path, **line)
    named = {text.get_label() for text in ax.get_lines()}
    for face, places in touches.items():
        label = f"{face} up at the touch"
        ax.plot(*places, "o", color=COLORS[face], label=None if label in named else label)
    ax.set(xlabel="time [s]", ylabel="height of the mass centre [m]")
    ax.legend()


def draw_counts(ax: "Axes", counts: Mapping[str, int]) -> None:
    """Draw how many tosses had each outcome, as bars."""
    bars = ax.bar(list(counts), list(counts.values()), color=[COLORS.get(name, "grey") for name in counts])
    ax.bar_label(bars)
    ax.set(xlabel="outcome", ylabel="tosses")
