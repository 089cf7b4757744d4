"""How all pictures look: the colours beside those of outcomes, and the style of plots."""

from typing import Any

from matplotlib.colors import LinearSegmentedColormap

from cointoss.models.palette import COLORS, EDGE, HEADS, PERPETUAL, TAILS, TRANSIENT
from cointoss.models.records import Outcome

# Okabe and Ito's colours, which the colour-blind can distinguish.
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", EDGE
PURPLE, ORANGE, SKY = PERPETUAL, "#E69F00", TRANSIENT
INK, GREY, PALE, GRID = "#1b2430", "#5b6675", "#9aa4b0", "#d9dee5"
"""The colours of letters, of axes, of what stands behind the rest, and of the grid."""
OUTCOMES = {outcome: COLORS[str(outcome)] for outcome in Outcome}
ANALYTIC, MUJOCO = BLUE, VERMILION
"""The engines."""
SHARE_OF_HEADS = LinearSegmentedColormap.from_list("share of heads", [TAILS, "#FFFFFF", HEADS])
"""The colours of a share of heads from 0 to 1."""

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
