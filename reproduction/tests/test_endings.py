"""The study of how tosses end: what it counts, and when engines are told apart."""

import numpy as np
import pytest
from scipy.stats import fisher_exact

from cointoss.study import states_of
from cointoss_reproduction.studies.endings.study import (
    HEIGHTS,
    SPINS,
    apart,
    chance,
    drawn,
    ended,
    holm,
    one_by_one,
)

AIR, VACUUM = "thin, μ = 0.2, air", "2 mm, smooth"


def test_random_releases_are_in_the_ranges_that_the_page_names_and_turn_about_any_axis():
    states = states_of(drawn(VACUUM, 0, 2000))
    spins = np.linalg.norm(states[:, 10:], axis=1)
    assert [end(of) for of in (states[:, 2], spins) for end in (np.min, np.max)] == pytest.approx(
        [*HEIGHTS, *SPINS], rel=0.05
    )
    for directions in (states[:, 6:10].T, states[:, 10:].T / spins):
        assert np.cov(directions) == pytest.approx(np.eye(len(directions)) / len(directions), abs=0.04)


def test_each_engine_tosses_draws_of_its_own():
    assert ended(AIR, "analytic", by_analytic=100).items() >= {"faces": 100, "tosses": 100}.items()
    assert ended(AIR, "mujoco", by_mujoco=6).items() >= {"faces": 6, "tosses": 6}.items()
    assert (drawn(AIR, 0, 6) != drawn(AIR, 1, 6)).any(axis=1).all()


def test_tosses_that_both_engines_trust_to_the_last_end_alike():
    assert one_by_one(AIR, singles=2) == {"trusted": 1, "otherwise": 0, "kept": 1}


@pytest.mark.parametrize("counts", [[[0, 8, 2, 0], [0, 2, 8, 0]], [[40, 0, 3, 1], [30, 0, 1, 6]]])
def test_a_probability_by_permutation_is_the_exact_one(counts):
    """Of 2 x 2 tables with equal samples χ² orders as the probability does; else both are near."""
    met = np.array(counts)
    assert chance(met) == pytest.approx(fisher_exact(met[:, met.any(axis=0)])[1], abs=0.01)


def test_probabilities_are_adjusted_by_holm():
    assert holm([0.04, 0.01, 0.9, 0.03]) == pytest.approx([0.09, 0.04, 0.9, 0.09])


@pytest.mark.parametrize(
    ("counts", "share", "ends", "bound"),
    [
        ([[0, 400, 400, 200, 0, 0], [0, 400, 400, 0, 190, 10]], "edge", (-0.2, -0.2482, -0.151), 0.2482),
        ([[0, 500, 500, 0, 0, 0], [0, 0, 1000, 0, 0, 0]], "face", (0.0, -0.0054, 0.0054), 0.0054),
        ([[0, 500, 400, 100, 0, 0], [0, 500, 400, 100, 0, 0]], "face", (0.0, -0.0515, 0.0515), 0.0515),
    ],
)
def test_the_share_that_differs_most_has_an_interval_that_holds_for_all_shares_of_all_classes(
    counts, share, ends, bound
):
    most, found, farthest = apart(np.array(counts))
    assert (most, found.ends, farthest) == (
        share,
        pytest.approx(ends, abs=1e-4),
        pytest.approx(bound, abs=1e-4),
    )
