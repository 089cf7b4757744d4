"""The measures on outcome maps, on made maps with known answers."""

import numpy as np
import pytest
from scipy.special import entr

from cointoss.compare.basins.agreement import agreement
from cointoss.compare.basins.boundary import boundary_pixels, distance_to_doubt
from cointoss.compare.basins.entropy import Log2Test, basin_entropy
from cointoss.compare.basins.fractions import fractions
from cointoss.compare.basins.stripes import crossings, stripe_widths
from cointoss.models.records import Outcome
from tests.helpers.made_maps import EDGE, HEADS, TAILS, UNDECIDED, faces, halves, hyperbolas, stripes


def line(text):
    return np.array([{"H": HEADS, "T": TAILS, "E": EDGE, "?": UNDECIDED}[letter] for letter in text], np.int8)


def test_fractions_count_every_outcome_and_the_undecided():
    assert fractions(line("HHHTTE??")) == {
        Outcome.UNDECIDED: 0.25,
        Outcome.HEADS: 0.375,
        Outcome.TAILS: 0.25,
        Outcome.EDGE: 0.125,
        Outcome.PERPETUAL: 0.0,
    }
    assert fractions(halves(3, 8))[Outcome.HEADS] == 0.5


@pytest.mark.parametrize(
    ("outcomes", "said"),
    [
        (np.zeros((0, 3), np.int8), "at least one"),
        (np.ones((3, 3)), "float64"),
        (np.ones((3, 3), bool), "bool"),
        (np.full((3, 3), 5), "5 is no outcome, accepted: 0 to 4"),
        (np.full((3, 3), -1), "-1 is no outcome"),
        (np.ones(3, int), r"shape \(3,\)"),
    ],
)
def test_what_is_no_outcome_map_is_refused(outcomes, said):
    with pytest.raises(ValueError, match=said):
        boundary_pixels(outcomes)


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


def test_agreement_tells_near_from_away_by_the_reference_alone():
    reference, other = halves(40, 40), halves(40, 40)
    other[:, 20] = HEADS  # the boundary one pixel off: near
    other[10, 5] = TAILS  # a wrong pixel makes no boundary of its own: away
    other[30, 30] = UNDECIDED
    found = agreement(reference, other, distance=2)
    # Away: all but two pixels along every side of each half.
    assert (found.away.agreeing, found.away.compared) == (36 * 32 - 2, 36 * 32 - 1)
    assert (found.near.agreeing, found.near.compared) == (1600 - 36 * 32 - 40, 1600 - 36 * 32)
    assert found.undecided == 1
    assert found.away.fraction == (36 * 32 - 2) / (36 * 32 - 1)


def test_agreement_of_nothing_is_not_known():
    found = agreement([line("HHTT")], [line("????")], distance=1)
    assert (found.near.fraction, found.away.fraction, found.undecided) == (None, None, 4)
    with pytest.raises(ValueError, match="that of the reference"):
        agreement(halves(2, 4), halves(4, 2), distance=1)


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
    random = np.random.default_rng(1)
    two = basin_entropy(random.integers(1, 3, size=(300, 300)), box=5)
    assert two.log_2_test is Log2Test.SILENT


def test_the_log_2_test_finds_three_intermingled_basins():
    random = np.random.default_rng(2)
    found = basin_entropy(random.integers(1, 4, size=(1000, 1000)), box=5)
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


def test_crossings_of_a_line():
    assert crossings(line("HHTHTT")) == 3
    assert crossings(line("H??H?T?")) == 1
    assert crossings(line("??HT")) == 1
    assert crossings(line("????")) == 0
    assert crossings(line("H")) == 0


def test_crossings_of_hyperbolas_grow_with_the_rows_height():
    y = np.arange(1, 9)
    outcomes = hyperbolas(np.linspace(1e-3, 10 - 1e-3, 2000), y)
    # x y passes 1, 2, ... up to 10 y, which the row does not reach.
    assert crossings(outcomes).tolist() == (10 * y - 1).tolist()


def test_crossings_after_n_impacts_that_double_the_phase():
    phase = (np.arange(1 << 14) + 0.5) / (1 << 14)
    after = np.array([faces(2.0**n * phase % 1 < 0.5) for n in range(10)])
    assert crossings(after).tolist() == [2 ** (n + 1) - 1 for n in range(10)]
    # Every second point still sees all: the line is fine enough.
    assert crossings(after[:, ::2]).tolist() == crossings(after).tolist()
    assert crossings(after[:, None, :]).shape == (10, 1)


def test_half_the_points_tell_a_line_that_is_too_coarse():
    coarse = faces(2.0**13 * (np.arange(1 << 14) + 0.5) / (1 << 14) % 1 < 0.5)
    assert crossings(coarse) == len(coarse) - 1
    assert crossings(coarse[::2]) == 0


def test_widths_of_stripes():
    assert stripe_widths(line("HHTHHHTT"), spacing=0.5).tolist() == [0.5, 1.5]
    assert stripe_widths(stripes(2, 70, 7), spacing=2.0).tolist() == [14.0] * 16
    assert stripe_widths(halves(3, 10), spacing=1.0).size == 0
    assert stripe_widths(line("HTT?TTHT"), spacing=1.0).tolist() == [1.0]
    assert stripe_widths(line("H"), spacing=1.0).size == 0


def test_widths_of_stripes_between_hyperbolas_are_those_between_whole_numbers():
    x, y = np.linspace(0.005, 10, 4001), np.array([1.0, 2.0, 4.0])
    outcomes, spacing = hyperbolas(x, y), x[1] - x[0]
    for row, height in zip(outcomes, y, strict=True):
        widths = stripe_widths(row, spacing=spacing)
        assert len(widths) == crossings(row) - 1
        assert np.abs(widths - 1 / height).max() <= spacing * 1.001
