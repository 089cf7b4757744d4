"""Section 5.3: the accuracy ε of a release against the width W of the stripes of the basins."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import mean_share, ratio_of_medians
from cointoss_reproduction.setups.planar_maps import HEIGHTS, LANDINGS, SPINS, case, planar_rows

SEED = 53
LADDER = np.geomspace(1e-10, 0.1, 91)
"""Steps of the height by which a boundary is sought, 10 in a decade [m]."""
RATIOS = 10.0 ** np.arange(-2, 5)
"""The ratios ε/W."""
W_100, TEN = "0.01", "10"
"""The names of two of these ratios."""
WIDEST = 0.1
"""Largest ε [m]: the release must stay above the floor."""
HAND = 1e-3
"""An accuracy that a hand may reach [m]."""
FEWEST = 5
"""The fewest tosses for which a ratio is given."""


def released(centers: int = 200, count: int = 60) -> Iterator[Rows]:
    """Measure the stripe of each random release, and toss within ε of it."""
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, centers), rng.uniform(*SPINS, centers)
    widths = {landing: stripe_widths(landing, heights, spins) for landing in LANDINGS}
    for landing, width in widths.items():
        for ratio in RATIOS:
            within = width * ratio <= WIDEST
            shares = _alike(landing, heights, spins, np.where(within, width * ratio, 0), count, rng)
            if within.sum() >= FEWEST:
                yield {"landing": landing, "ratio": ratio, "alike": mean_share(shares[within], "releases")}
        shares = _alike(landing, heights, spins, np.full(centers, HAND), count, rng)
        yield {"landing": landing, "at_hand": mean_share(shares, "releases")}
        below = np.arange(1, centers + 1) / centers
        yield pd.DataFrame({"landing": landing, "width": np.sort(width), "below": below})
    yield {"over_soft": ratio_of_medians(widths["bouncing"], widths["soft floor"], rng, "releases")}


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return the width below which a tenth of the releases of bouncing coins lie."""
    return {"tenth": cells[cells.landing == "bouncing"].width.quantile(0.1)}


def _faces(landing: str, heights: Array, spins: Array) -> NDArray[np.int8]:
    return LANDINGS[landing](planar_rows(case(air=True), heights, spins))


def stripe_widths(landing: str, heights: Array, spins: Array) -> Array:
    """Return how far apart the boundaries above and below releases are, as `LADDER` finds them, (n,) [m].

    Args:
        landing: one of `LANDINGS`.
        heights: of the releases, (n,) [m].
        spins: about ξ, (n,) [rad/s].
    """
    steps = np.concatenate([[0.0], LADDER, -LADDER])
    tossed = heights[:, None] + steps
    faces = _faces(landing, tossed.ravel(), np.repeat(spins, len(steps))).reshape(tossed.shape)
    other = (faces[:, 1:] != faces[:, :1]).reshape(len(heights), 2, len(LADDER))
    return np.where(other.any(axis=2), LADDER[np.argmax(other, axis=2)], LADDER[-1]).sum(axis=1)


def _alike(
    landing: str, heights: Array, spins: Array, accuracy: Array, count: int, rng: np.random.Generator
) -> Array:
    """Return for each release which part of `count` tosses within its accuracy ends as itself, (n,)."""
    aimed = _faces(landing, heights, spins)
    tossed = heights[:, None] + accuracy[:, None] * rng.uniform(-1, 1, (len(heights), count))
    faces = _faces(landing, tossed.ravel(), np.repeat(spins, count)).reshape(tossed.shape)
    return np.mean(faces == aimed[:, None], axis=1)


REPRODUCTION = study(__name__, Cells(released, {}), found=found)
