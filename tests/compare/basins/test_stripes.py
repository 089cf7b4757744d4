"""Crossings of lines and widths of stripes, on made maps with known answers."""

import numpy as np

from cointoss.compare.basins.stripes import crossings, stripe_widths
from tests.helpers.made_maps import faces, halves, hyperbolas, line, stripes


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
