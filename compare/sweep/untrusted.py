"""The pixels of a map that the engine's own errors may have decided."""

import numpy as np
from numpy.typing import NDArray


def untrusted_pixels(after: int | None, trust: NDArray[np.integer]) -> NDArray[np.bool_]:
    """Return the pixels whose face or outcome the engine's own errors may have decided, (y, x).

    The face at touch n + 1 can be trusted where n + 1 impacts can. Where the toss ended before, its outcome
    is shown, which depends on more than its impacts: there it is not trusted. A final outcome can be trusted
    where it is certain.

    Args:
        after: n of the map; None where it shows final outcomes.
        trust: its array of trusted impacts, or of whether the outcome is certain; below 0 where no toss was
            made yet, (y, x).
    """
    return (trust >= 0) & (trust <= (0 if after is None else after))
