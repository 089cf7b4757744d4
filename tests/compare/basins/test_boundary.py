"""The pixels at a boundary, and the distance to it."""

from functools import partial

import numpy as np
import pytest

from cointoss.compare.basins.agreement import agreement
from cointoss.compare.basins.boundary import boundary_pixels, distance_to_doubt
from cointoss.compare.basins.entropy import basin_entropy
from cointoss.compare.basins.stripes import stripe_widths
from cointoss.models.records import Outcome
from tests.helpers.made_maps import HEADS, TAILS, halves, line


@pytest.mark.parametrize(
    ("outcomes", "said"),
    [
        (np.zeros((0, 3), np.int8), "at least one"),
        (np.ones((3, 3)), "float64"),
        (np.ones((3, 3), bool), "bool"),
        (np.full((3, 3), 6), "6 is no outcome, accepted: 0 to 5"),
        (np.full((3, 3), -1), "-1 is no outcome"),
        (np.ones(3, int), r"shape \(3,\)"),
    ],
)
def test_what_is_no_outcome_map_is_refused(outcomes, said):
    with pytest.raises(ValueError, match=said):
        boundary_pixels(outcomes)


def test_a_transient_is_left_out_as_the_undecided_are():
    transient = halves(8, 8)
    transient[3, 3:6] = Outcome.TRANSIENT
    undecided = np.where(transient == Outcome.TRANSIENT, Outcome.UNDECIDED, transient)
    for measure in (boundary_pixels, distance_to_doubt, partial(stripe_widths, spacing=1.0)):
        assert np.array_equal(measure(transient), measure(undecided))
    assert basin_entropy(transient, box=2) == basin_entropy(undecided, box=2)
    assert agreement(halves(8, 8), transient, distance=1) == agreement(halves(8, 8), undecided, distance=1)


def test_boundary_pixels_lie_on_both_sides_of_a_boundary_and_not_at_the_undecided():
    assert boundary_pixels(halves(2, 6)).astype(int).tolist() == [[0, 0, 1, 1, 0, 0]] * 2
    assert boundary_pixels(halves(2, 6).T).T.astype(int).tolist() == [[0, 0, 1, 1, 0, 0]] * 2
    assert not boundary_pixels([line("HH?TT")]).any()
    # Pixels that meet at a corner are not neighbours.
    assert boundary_pixels([line("HT"), line("?H")]).astype(int).tolist() == [[1, 1], [0, 1]]


def test_distance_to_doubt_counts_the_other_outcome_the_undecided_and_the_outside():
    assert distance_to_doubt(halves(99, 10))[49].tolist() == [1, 2, 3, 2, 1, 1, 2, 3, 2, 1]
    assert distance_to_doubt([line("HHH?H")] * 3)[1].tolist() == [1, 2, 1, 0, 1]
    one = np.full((9, 9), HEADS)
    one[4, 4] = TAILS
    assert distance_to_doubt(one)[[4, 3, 2], [3, 3, 2]] == pytest.approx([1, 2**0.5, 8**0.5])
