"""The uncertainty exponent, and how often its interval holds it, on made maps."""

from typing import Literal

import numpy as np
import pytest

from cointoss.compare.basins.uncertainty import _jackknife_error, uncertainty_exponent
from tests.helpers.made_maps import (
    UNDECIDED,
    cantor,
    faces,
    gaussian_faces,
    halves,
    stripes,
    uncertain_fraction,
)


def exponent(outcomes, epsilons, along: Literal["x", "y"] = "x", **options):
    found = uncertainty_exponent(outcomes, along=along, epsilons=epsilons, **options)
    assert found is not None
    return found


def test_stripes_have_as_many_uncertain_pixels_as_lie_within_epsilon_of_a_boundary():
    found = exponent(stripes(16, 1000, 100), [1, 2, 4, 8])
    epsilon = np.array([1, 2, 4, 8])
    # Nine boundaries, all farther than ε from the pixels at the ends, which are not known.
    assert found.fractions == pytest.approx(2 * 9 * epsilon / (1000 - 2 * epsilon), rel=1e-14)
    assert found.alpha == pytest.approx(1, abs=0.01)
    assert found.low < 1 < found.high < 1.02


def test_the_axis_chooses_where_uncertainty_is_looked_for():
    outcomes = stripes(1000, 1000, 100)
    assert uncertainty_exponent(outcomes, along="y", epsilons=[1, 2]) is None
    assert exponent(outcomes.T, [1, 2, 4], along="y").fractions.tolist() == (
        exponent(outcomes, [1, 2, 4]).fractions.tolist()
    )


def test_the_cantor_set_has_alpha_1_minus_its_dimension():
    # The colours of the gaps repeat every second level, and f with them: ε runs over powers of 9.
    found = exponent(cantor(13)[None], [9, 81, 729, 6561])
    alpha = 1 - np.log(2) / np.log(3)
    assert found.alpha == pytest.approx(alpha, abs=0.01)
    assert found.local == pytest.approx(np.full(3, alpha), abs=0.03)
    assert found.low < alpha < found.high < 0.4


@pytest.mark.parametrize("hurst", [0.3, 0.5, 1.0])
def test_the_sign_of_a_gaussian_field_has_the_fractions_of_three_gaussians(hurst):
    epsilons = np.array([1, 2, 4, 8])
    maps = [
        gaussian_faces((256, 256), scale=20, hurst=hurst, random=np.random.default_rng(seed))
        for seed in range(12)
    ]
    fractions = np.mean([exponent(outcomes, epsilons).fractions for outcomes in maps], axis=0)
    # Twelve maps of 256 by 256 scatter by a percent.
    assert fractions == pytest.approx(uncertain_fraction(epsilons, 20, hurst), rel=0.04)


ROW, COLUMN = np.indices((256, 256))
UPRIGHT, OBLIQUE, BENT = COLUMN, COLUMN + ROW, COLUMN + ROW * ROW // 512
"""Where on a line the pixels of a map lie whose boundaries all run one way."""


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    ("laid", "hurst", "at_least"),
    # The standard error of a coverage over 100 maps is 2 to 4 %.
    [(None, 0.5, 0.95), (None, 1.0, 0.95), (UPRIGHT, 0.5, 0.86), (OBLIQUE, 1.0, 0.82), (BENT, 0.5, 0.72)],
)
def test_the_interval_covers_the_slope(laid, hurst, at_least):
    random, epsilons, scale = np.random.default_rng(7), np.array([1, 2, 4, 8]), 10
    slope = np.polyfit(np.log(epsilons), np.log(uncertain_fraction(epsilons, scale, hurst)), 1)[0]
    if laid is None:
        drawn = [gaussian_faces((256, 256), scale=scale, hurst=hurst, random=random) for _ in range(25)]
    else:
        drawn = [gaussian_faces((512,), scale=scale, hurst=hurst, random=random)[laid] for _ in range(100)]
    found = [exponent(outcomes, epsilons) for outcomes in drawn]
    covered = np.mean([one.low <= slope <= one.high for one in found])
    assert covered >= at_least
    # Nor is it wide beyond need: the half width is 1.96 standard deviations where it is exact.
    half_width = np.median([one.high - one.alpha for one in found])
    assert 1 < half_width / np.std([one.alpha for one in found]) < 4


def test_the_interval_grows_with_the_confidence():
    outcomes = gaussian_faces((200, 200), scale=10, hurst=0.5, random=np.random.default_rng(3))
    half, most = exponent(outcomes, [1, 2, 4], confidence=0.5), exponent(outcomes, [1, 2, 4], confidence=0.99)
    assert half.alpha == most.alpha
    # Student's t at seven degrees of freedom: 0.711 and 3.499.
    assert (most.high - most.low) / (half.high - half.low) == pytest.approx(3.499 / 0.711, rel=1e-3)


def test_the_error_is_that_of_a_jackknife_over_eight_bands():
    """Quenouille's and Tukey's: (n - 1)/n times the sum of squares of the slopes without each."""
    uncertain, known = np.array([[3, 4, 2, 5, 6, 3, 4, 9], [5, 9, 3, 9, 13, 5, 9, 16]]), np.full((2, 8), 50)
    left = uncertain.sum(axis=1)[:, None] - uncertain
    without = np.log2(left[1] / left[0])
    error = np.sqrt(7 / 8 * np.sum((without - np.mean(without)) ** 2))
    counts = uncertain[:, None], known[:, None]
    assert _jackknife_error(np.array([1, 2]), *counts, np.arange(8)[None]) == pytest.approx(error, rel=1e-12)


@pytest.mark.parametrize("across", ["u", "v", "u + v", "u - v"])
def test_boundaries_in_one_band_of_any_direction_give_no_bound(across):
    """The middle of the fourth of eight bands of equal area, away from its edges."""
    v, u = np.indices((32, 256)) / np.array([32, 256])[:, None, None]
    place = {"u": u - 0.44, "v": v - 0.44, "u + v": u + v - 0.945, "u - v": u - v + 0.067}[across]
    outcomes = faces(np.abs(place) < 0.01)
    if across == "v":
        outcomes[np.abs(place) < 0.04] = stripes(32, 256, 32)[np.abs(place) < 0.04]
    found = exponent(outcomes, [1, 2, 4])
    assert (found.low, found.high) == (-np.inf, np.inf)


def test_undecided_pixels_leave_out_the_pairs_that_need_them():
    outcomes = stripes(64, 1000, 100)
    whole = exponent(outcomes, [1, 2, 4])
    outcomes[::2] = UNDECIDED
    assert exponent(outcomes, [1, 2, 4]).fractions.tolist() == whole.fractions.tolist()
    outcomes[:, 99::100] = UNDECIDED  # the left pixel of every boundary
    assert uncertainty_exponent(outcomes, along="x", epsilons=[1, 2]) is None
    assert uncertainty_exponent(np.zeros((64, 64), np.int8), along="x", epsilons=[1, 2]) is None


EPSILONS = "accepted: two or more increasing whole numbers from 1 to 8"


@pytest.mark.parametrize(
    ("epsilons", "confidence", "said"),
    [
        *(
            (given, 0.95, EPSILONS)
            for given in ([], [1], [2, 1], [1, 1], [0, 1], [1, 9], [1.0, 2.0], [[1, 2]])
        ),
        ([1, 2], 95, "confidence: 95"),
    ],
)
def test_what_cannot_be_fitted_is_refused(epsilons, confidence, said):
    with pytest.raises(ValueError, match=said):
        uncertainty_exponent(halves(64, 64), along="x", epsilons=epsilons, confidence=confidence)
