"""Where the basins of a map meet."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cointoss.compare.basins.maps import measured, outcome_map
from cointoss.models.records import Array, Outcome


def boundary_pixels(outcomes: ArrayLike) -> NDArray[np.bool_]:
    """Return which pixels have another outcome beside, above or below them, (y, x).

    An undecided pixel is no boundary, nor does it make one of its neighbours.
    """
    codes = measured(outcome_map(outcomes))
    boundary = np.zeros(codes.shape, dtype=bool)
    for first, second in ((np.s_[:, :-1], np.s_[:, 1:]), (np.s_[:-1], np.s_[1:])):
        a, b = codes[first], codes[second]
        differ = (a != b) & (a != Outcome.UNDECIDED) & (b != Outcome.UNDECIDED)
        boundary[first] |= differ
        boundary[second] |= differ
    return boundary


def distance_to_doubt(outcomes: ArrayLike) -> Array:
    """Return each pixel's distance to the nearest that is not known to share its outcome, (y, x) [pixels].

    That is one with another outcome, an undecided one, or one outside the map. It is measured between the
    pixels' centres, so it is at least 1; for an undecided pixel it is 0.
    """
    # A map alone does not need it.
    from scipy.ndimage import distance_transform_edt

    codes = np.pad(measured(outcome_map(outcomes)), 1, constant_values=Outcome.UNDECIDED)
    known = [outcome for outcome in Outcome if outcome is not Outcome.UNDECIDED]
    distance = sum(np.asarray(distance_transform_edt(codes == outcome)) for outcome in known)
    return np.asarray(distance)[1:-1, 1:-1]
