"""The style of all plots."""

from typing import Any

STYLE: Any = {
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#d9dee5",
    "grid.linewidth": 0.6,
    "axes.edgecolor": "#5b6675",
    "lines.linewidth": 1.4,
    "legend.frameon": False,
    "svg.fonttype": "path",
    "svg.hashsalt": "cointoss",
    "figure.constrained_layout.use": True,
}
