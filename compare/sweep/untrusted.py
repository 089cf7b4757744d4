"""The pixels of a map whose face the horizon of trust does not cover."""

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.sweep.grid import Sweep


def untrusted_pixels(sweep: Sweep, trusted_impacts: NDArray[np.int32]) -> NDArray[np.bool_]:
    """Return the pixels whose face or outcome the trusted impacts do not cover, (y, x).

    Of the face at touch n + 1, a pixel is covered where n + 1 impacts are trusted. Where the toss ended
    before, its outcome is shown, which depends on more than its impacts; and so does any final outcome: the
    horizon ends with the last impact, so it covers none.

    Args:
        sweep: of the map.
        trusted_impacts: of each pixel, below 0 where no toss was made yet, (y, x).
    """
    most = np.inf if sweep.after is None else sweep.after
    return (trusted_impacts >= 0) & (trusted_impacts <= most)
