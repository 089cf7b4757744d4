"""The agreement of two maps, near a boundary and away from it."""

import pytest

from cointoss.compare.basins.agreement import agreement
from tests.helpers.made_maps import HEADS, TAILS, UNDECIDED, halves, line


def test_agreement_tells_near_from_away_by_the_reference_alone():
    reference, other = halves(40, 40), halves(40, 40)
    other[:, 20] = HEADS  # the boundary one pixel off: near
    other[10, 5] = TAILS  # a wrong pixel makes no boundary of its own: away
    other[30, 30] = UNDECIDED
    found = agreement(reference, other, distance=2)
    # Away: all but two pixels along every side of each half.
    assert (found.away.agreeing, found.away.compared) == (36 * 32 - 2, 36 * 32 - 1)
    assert (found.near.agreeing, found.near.compared) == (1600 - 36 * 32 - 40, 1600 - 36 * 32)
    assert (found.undecided, found.away.fraction) == (1, (36 * 32 - 2) / (36 * 32 - 1))


def test_agreement_of_nothing_is_not_known():
    found = agreement([line("HHTT")], [line("????")], distance=1)
    assert (found.near.fraction, found.away.fraction, found.undecided) == (None, None, 4)
    with pytest.raises(ValueError, match="that of the reference"):
        agreement(halves(2, 4), halves(4, 2), distance=1)
