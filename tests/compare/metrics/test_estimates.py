"""Shares of samples, none of them and of none; and how large a sample would tell."""

import numpy as np
import pytest

from cointoss.compare.metrics.estimates import share, share_of


def test_a_share_of_none_has_an_interval_above_it():
    none = share(np.zeros(500, dtype=bool), counted="impacts")
    assert (none.value, none.low, none.count, none.counted) == (0, 0, 500, "impacts")
    assert 0.005 < none.high < 0.02


def test_a_share_of_no_trials_may_be_anything():
    for none in (share_of(0, 0, "spins"), share([], "spins")):
        assert np.isnan(none.value)
        assert (none.low, none.high, none.count, none.counted) == (0, 1, 0, "spins")
        assert none.needed(0.5) is none.needed(2.0) is None
    with pytest.raises(ValueError, match="accepted: a number from 0 to the count"):
        share_of(1, 0)


def test_as_many_as_it_says_would_tell():
    drawn = np.arange(400) % 100 < 52
    small = share(drawn)
    needed = small.needed(0.5)
    assert needed is not None
    assert small.low < 0.5 < small.high
    many = share(np.arange(needed) % 100 < 52)
    assert 0.497 < many.low < 0.503
