"""The air's friction on a strip of the wall, against adaptive quadrature in 20 digits."""

import tomllib
from pathlib import Path

import numpy as np
import pytest

from cointoss.analytic.air.wall_strip import phi_series, strip_change

HALF = 1.25e-3
STRIPS = tomllib.loads(Path(__file__).with_name("strips.toml").read_text(encoding="utf-8"))["strips"]


def strip(b, B, C, D):
    return np.array(strip_change(b, phi_series(b), HALF, B, C, D))


@pytest.mark.parametrize("held", STRIPS, ids=lambda row: f"{row['b']}-{row['middle']}-{row['along']}")
def test_a_strip_is_its_integrals(held):
    """With points at rest, near rest, all far from it."""
    b, D = held["b"], -40.0
    B, C = held["along"] * D * HALF, held["middle"] * D * HALF
    size = (abs(B) + abs(C) + abs(D) * HALF) ** b * 2 * HALF
    error = (strip(b, B, C, D) - held["integrals"]) / [1, HALF, HALF**2, 1, HALF, 1] / size
    # At six half lengths the closed form of the part with z² still loses three digits.
    assert np.abs(error).max() < 2e-13


@pytest.mark.parametrize("b", [0.1, 1.0])
def test_a_strip_that_moves_alike_everywhere_or_not_at_all(b):
    B, C = 0.3, -0.4
    bent = b * 0.5 ** (b - 2)
    expected = 2 * HALF * np.array([0.5**b + bent * C * C, 0, 0, bent * C * B, 0, 0.5**b + bent * B * B])
    expected[2] = expected[0] * HALF**2 / 3
    assert strip(b, B, C, 0.0) == pytest.approx(expected, rel=1e-14, abs=1e-20)
    assert not strip(b, 0.0, 0.0, 0.0).any()
