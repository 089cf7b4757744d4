"""Basin entropy: how unsure the outcome is within a small box of a map."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import entr

from cointoss.compare.basins.maps import measured, outcome_map
from cointoss.models.records import Outcome


class Log2Test(StrEnum):
    """What the log 2 test says of the boundaries."""

    FRACTAL = "fractal"
    """Smooth boundaries could not give so much boundary entropy."""
    SILENT = "silent"
    """Smooth or fractal: the test is sufficient, not necessary."""


@dataclass(frozen=True, kw_only=True)
class BasinEntropy:
    """The entropies of a map's boxes, in nats."""

    basin: float | None
    """S_b, the mean over all boxes; None where there is no box to use."""
    boundary: float | None
    """S_bb, the mean over the boxes with more than one outcome; None where there is none."""
    boxes: int
    """Boxes used."""
    boundary_boxes: int
    """Boxes with more than one outcome, of those used."""

    @property
    def log_2_test(self) -> Log2Test:
        """Whether S_bb exceeds log 2.

        A smooth boundary parts two basins in nearly every box that it crosses, and two outcomes have at most
        the entropy log 2. So S_bb above log 2 shows a fractal boundary, if the boxes are small against the
        stripes. A map of only heads and tails never exceeds it: there the test is silent whatever the
        boundary.
        """
        exceeded = self.boundary is not None and self.boundary > np.log(2)
        return Log2Test.FRACTAL if exceeded else Log2Test.SILENT


def basin_entropy(outcomes: ArrayLike, *, box: int) -> BasinEntropy:
    """Return the basin entropy and the boundary basin entropy of a map.

    A. Daza, A. Wagemakers, B. Georgeot, D. Guéry-Odelin, M. A. F. Sanjuán, "Basin entropy: a new tool to
    analyze uncertainty in dynamical systems", Sci. Rep. 6, 31416 (2016). Pixels beyond the last whole box are
    left out; so are undecided pixels, and boxes less than half decided.

    Args:
        outcomes: the map, (y, x).
        box: side of a box; the source uses 5 [pixels].

    Raises:
        ValueError: for a box of less than 2 pixels, or larger than the map.
    """
    codes = measured(outcome_map(outcomes))
    if not 2 <= box <= min(codes.shape):
        raise ValueError(f"box: {box} pixels, accepted: 2 to {min(codes.shape)}, the map's shorter side")
    ny, nx = (n // box for n in codes.shape)
    boxes = codes[: ny * box, : nx * box].reshape(ny, box, nx, box)
    counts = np.array(
        [np.sum(boxes == outcome, axis=(1, 3)) for outcome in Outcome if outcome is not Outcome.UNDECIDED]
    ).reshape(-1, ny * nx)
    counts = counts[:, 2 * counts.sum(axis=0) >= box * box]
    entropy = entr(counts / counts.sum(axis=0)).sum(axis=0)
    mixed = np.sum(counts > 0, axis=0) > 1
    return BasinEntropy(
        basin=float(entropy.mean()) if entropy.size else None,
        boundary=float(entropy[mixed].mean()) if mixed.any() else None,
        boxes=entropy.size,
        boundary_boxes=int(mixed.sum()),
    )
