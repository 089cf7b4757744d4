"""How all pictures look: the colours beside those of outcomes, and the style of plots."""

from collections.abc import Iterable
from itertools import cycle
from typing import Any, NamedTuple

from cointoss.models.palette import COLORS, EDGE, PERPETUAL, TRANSIENT
from cointoss.models.records import Outcome

# Okabe and Ito's colours, which the colour-blind can distinguish.
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", EDGE
PURPLE, ORANGE, SKY = PERPETUAL, "#E69F00", TRANSIENT
INK, GREY, PALE, GRID = "#1b2430", "#5b6675", "#9aa4b0", "#d9dee5"
"""The colours of letters, of axes, of what stands behind the rest, and of the grid."""
OUTCOMES = {outcome: COLORS[str(outcome)] for outcome in Outcome}
ANALYTIC, MUJOCO = BLUE, VERMILION
"""The engines."""
_BAR, _HEIGHT = 0.1, 0.5
LETTERS = {
    "H": ((-0.34, 0.0, _BAR, _HEIGHT), (0.34, 0.0, _BAR, _HEIGHT), (0.0, 0.0, 0.34, _BAR)),
    "T": ((0.0, _HEIGHT - _BAR, 0.44, _BAR), (0.0, 0.0, _BAR, _HEIGHT)),
}
"""Boxes in the plane of a face: x, y and half their sizes [radii]. Either letter is its own mirror image."""


class Look(NamedTuple):
    """What distinguishes an engine's toss from the others on a page and in a plot."""

    kind: str
    """The class of what shows it on a page; shared.css has its colours."""
    color: str
    line: str
    """The style of its line in a plot."""


_OWN = {"analytic": Look("analytic", ANALYTIC, "-"), "mujoco": Look("mujoco", MUJOCO, "--")}
_OTHERS = (GREEN, "-."), (PURPLE, ":"), (ORANGE, "-."), (SKY, ":")


def looks_of(engines: Iterable[str]) -> list[Look]:
    """Return the look of each engine; others than ours have theirs in turn."""
    others = (Look(f"other-{number}", *drawn) for number, drawn in enumerate(cycle(_OTHERS), start=1))
    return [_OWN.get(engine) or next(others) for engine in engines]


STYLE: Any = {
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "axes.edgecolor": GREY,
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "cointoss",
    "figure.constrained_layout.use": True,
}
