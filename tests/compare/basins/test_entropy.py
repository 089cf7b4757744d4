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
        (np.zeros((8, 8), np.int8), 4, np.nan, np.nan, 0, 0),
    ],
)
def test_the_entropy_of_boxes_is_that_of_their_shares(outcomes, box, basin, boundary, boxes, mixed):
    found = basin_entropy(outcomes, box=box)
    entropies = np.array([found.basin, found.boundary], dtype=float)  # NaN for none
    assert entropies == pytest.approx([basin, boundary], rel=1e-14, nan_ok=True)
    assert (found.boxes, found.boundary_boxes) == (boxes, mixed)
    assert found.log_2_test is Log2Test.SILENT, "of two outcomes"


def test_boundary_entropy_of_upright_stripes_is_the_mean_over_where_the_boundary_cuts_the_box():
    box, width = 5, 17  # without common divisor: the boundary cuts the boxes everywhere alike
    found = basin_entropy(stripes(10, box * width * 10, width), box=box)
    cut = np.arange(1, box) / box
    mean = np.mean(entr(cut) + entr(1 - cut))
    assert found.boundary == pytest.approx(mean, rel=1e-12)
    assert found.basin == pytest.approx(mean * (box - 1) / width, rel=1e-12)


def test_the_log_2_test_is_silent_on_three_smooth_basins_and_on_two_of_any_kind():
    y, x = np.mgrid[-1:1:300j, -1:1:300j]
    sectors = (np.arctan2(y, x) // (2 * np.pi / 3) % 3 + 1).astype(np.int8)
    smooth = basin_entropy(sectors, box=5)
    assert smooth.boundary_boxes > 50
    assert smooth.log_2_test is Log2Test.SILENT
    two = basin_entropy(np.random.default_rng(1).integers(1, 3, size=(300, 300)), box=5)
    assert two.log_2_test is Log2Test.SILENT


def test_the_log_2_test_finds_three_intermingled_basins():
    found = basin_entropy(np.random.default_rng(2).integers(1, 4, size=(1000, 1000)), box=5)
    # Of k outcomes drawn n times the entropy falls short of log k by (k - 1)/(2 n), and a little more.
    assert found.boundary == pytest.approx(np.log(3) - 1 / 25, abs=3e-3)
    assert found.basin == found.boundary
    assert found.log_2_test is Log2Test.FRACTAL


@pytest.mark.parametrize("box", [1, 5])
def test_a_box_must_fit_the_map(box):
    with pytest.raises(ValueError, match="accepted: 2 to 4"):
        basin_entropy(halves(4, 12), box=box)
