"""Crossings of lines, on made maps with known answers."""

import numpy as np

from cointoss import Outcome
from cointoss_reproduction.setups.crossings import crossings
from tests.helpers.made_maps import faces, hyperbolas, line


def test_crossings_of_a_line():
    assert crossings(line("HHTHTT")) == 3
    assert crossings(passed := line("H??H?T?")) == 1
    assert crossings(np.where(passed == Outcome.UNDECIDED, Outcome.TRANSIENT, passed)) == 1
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
