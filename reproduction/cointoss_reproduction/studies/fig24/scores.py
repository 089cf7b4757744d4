"""How many printed faces of Fig. 24 its readings share, beside what chance shares."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from cointoss.study import INK, SKY, VERMILION, Array


def draw_scores(
    axes: Axes,
    scores: Array,
    begins: NDArray[np.bool_],
    names: Sequence[str],
    chance: Array,
    bins: Sequence[float],
) -> None:
    """Draw how often each score occurs.

    Args:
        axes: into which they are drawn.
        scores: of the readings, (n,).
        begins: which of these begin as printed, (n,).
        names: of those that do, and of the others.
        chance: scores at random heights, of any shape; their histogram is scaled to that of n.
        bins: ends of the classes of scores.
    """
    kinds = [scores[begins], scores[~begins]]
    axes.hist(kinds, bins, stacked=True, color=[VERMILION, SKY], label=list(names))
    weights = np.full(chance.size, len(scores) / chance.size)
    axes.hist(chance.ravel(), bins, weights=weights, histtype="step", color=INK, label="at random heights")
