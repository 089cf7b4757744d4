"""Basin entropy, on made maps with known answers."""

import numpy as np
import pytest
from scipy.special import entr

from cointoss.compare.basins.entropy import Log2Test, basin_entropy
from tests.helpers.made_maps import HEADS, TAILS, UNDECIDED, halves, line, stripes

LOG2 = np.log(2)
ONE_LEFT = line("HHHHT" * 5).reshape(5, 5)
CORNER = np.full((5, 5), HEADS)
CORNER[4, 4] = TAILS
HALF_KNOWN = halves(4, 12)
HALF_KNOWN[:2] = UNDECIDED
LESS_KNOWN = HALF_KNOWN.copy()
LESS_KNOWN[2, :4] = UNDECIDED
# Boundaries 17 pixels apart cut boxes of 5 everywhere alike.
CUT = np.arange(1, 5) / 5
MEAN = np.mean(entr(CUT) + entr(1 - CUT))


@pytest.mark.parametrize(
    ("outcomes", "box", "basin", "boundary", "boxes", "mixed"),
    [
        (np.full((20, 20), HEADS), 5, 0.0, np.nan, 16, 0),
        # Along the boxes, and through the middle column of 11 boxes.
        (halves(20, 40), 5, 0.0, np.nan, 32, 0),
        (halves(20, 44), 4, LOG2 / 11, LOG2, 55, 5),
        # Pixels beyond the last whole box are left out.
        (halves(5, 7), 4, entr(0.25) + entr(0.75), entr(0.25) + entr(0.75), 1, 1),
        (ONE_LEFT, 5, entr(0.2) + entr(0.8), entr(0.2) + entr(0.8), 1, 1),
        (CORNER, 5, entr(0.04) + entr(0.96), entr(0.04) + entr(0.96), 1, 1),
        # Undecided pixels do not count, nor do boxes of which less than half is decided.
        (HALF_KNOWN, 4, LOG2 / 3, LOG2, 3, 1),
        (LESS_KNOWN, 4, LOG2 / 2, LOG2, 2, 1),
        (stripes(10, 850, 17), 5, MEAN * 4 / 17, MEAN, 340, 80),
        (np.zeros((8, 8), np.int8), 4, np.nan, np.nan, 0, 0),
    ],
)
def test_the_entropy_of_boxes_is_that_of_their_shares(outcomes, box, basin, boundary, boxes, mixed):
    found = basin_entropy(outcomes, box=box)
    entropies = np.array([found.basin, found.boundary], dtype=float)  # NaN for none
    assert entropies == pytest.approx([basin, boundary], rel=1e-14, nan_ok=True)
    assert (found.boxes, found.boundary_boxes, found.log_2_test) == (boxes, mixed, Log2Test.SILENT)


Y, X = np.mgrid[-1:1:300j, -1:1:300j]
SECTORS = (np.arctan2(Y, X) // (2 * np.pi / 3) % 3 + 1).astype(np.int8)
TWO, THREE = (np.random.default_rng(1).integers(1, most, size=(300, 300)) for most in (3, 4))


@pytest.mark.parametrize(
    ("outcomes", "said"), [(SECTORS, Log2Test.SILENT), (TWO, Log2Test.SILENT), (THREE, Log2Test.FRACTAL)]
)
def test_the_log_2_test_is_silent_on_smooth_basins_and_on_two_of_any_kind(outcomes, said):
    found = basin_entropy(outcomes, box=5)
    assert found.boundary_boxes > 50
    assert found.log_2_test is said


@pytest.mark.parametrize("box", [1, 5])
def test_a_box_must_fit_the_map(box):
    with pytest.raises(ValueError, match="accepted: 2 to 4"):
        basin_entropy(halves(4, 12), box=box)
