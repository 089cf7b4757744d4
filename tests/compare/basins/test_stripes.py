"""Widths of stripes, on made maps with known answers."""

import numpy as np

from cointoss.compare.basins.stripes import stripe_widths
from tests.helpers.made_maps import halves, hyperbolas, line, stripes


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
        assert len(widths) == np.count_nonzero(np.diff(row)) - 1
        assert np.abs(widths - 1 / height).max() <= spacing * 1.001
