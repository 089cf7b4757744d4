"""Widths of stripes, on made maps with known answers."""

import pytest

from cointoss.compare.basins.stripes import stripe_widths
from tests.helpers.made_maps import halves, line, stripes


@pytest.mark.parametrize(
    ("outcomes", "spacing", "widths"),
    [
        (line("HHTHHHTT"), 0.5, [0.5, 1.5]),
        (stripes(2, 70, 7), 2.0, [14.0] * 16),
        (halves(3, 10), 1.0, []),
        (line("HTT?TTHT"), 1.0, [1.0]),
        (line("H"), 1.0, []),
    ],
)
def test_a_stripe_is_as_wide_as_its_pixels_between_two_boundaries(outcomes, spacing, widths):
    assert stripe_widths(outcomes, spacing=spacing).tolist() == widths
