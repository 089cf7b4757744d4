"""Basin entropy, on made maps with known answers."""

import numpy as np
import pytest
from scipy.special import entr

from cointoss.compare.basins.entropy import Log2Test, basin_entropy
from tests.helpers.made_maps import HEADS, UNDECIDED, halves, stripes


def test_one_outcome_has_no_basin_entropy():
    found = basin_entropy(np.full((20, 20), HEADS), box=5)
    assert (found.basin, found.boundary, found.boxes, found.boundary_boxes) == (0.0, None, 16, 0)


def test_basin_entropy_of_half_and_half():
    along_boxes, through_boxes = basin_entropy(halves(20, 40), box=5), basin_entropy(halves(20, 44), box=4)
    assert (along_boxes.basin, along_boxes.boundary) == (0.0, None)
    # The middle column of 11 boxes is half heads.
    assert through_boxes.boundary == pytest.approx(np.log(2), rel=1e-15)
    assert through_boxes.basin == pytest.approx(np.log(2) / 11, rel=1e-14)
    assert through_boxes.log_2_test is Log2Test.SILENT


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


def test_undecided_pixels_do_not_count_in_entropy():
    outcomes = halves(4, 12)
    outcomes[:2] = UNDECIDED
    found = basin_entropy(outcomes, box=4)
    assert (found.boxes, found.boundary) == (3, pytest.approx(np.log(2), rel=1e-15))
    outcomes[2, :4] = UNDECIDED  # now less than half of the first box is decided
    assert basin_entropy(outcomes, box=4).boxes == 2
    nothing = basin_entropy(np.zeros((8, 8), np.int8), box=4)
    assert (nothing.basin, nothing.boundary, nothing.boxes) == (None, None, 0)


@pytest.mark.parametrize("box", [1, 5])
def test_a_box_must_fit_the_map(box):
    with pytest.raises(ValueError, match="accepted: 2 to 4"):
        basin_entropy(halves(4, 12), box=box)
