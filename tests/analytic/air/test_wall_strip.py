"""The air's friction on a strip of the wall, against adaptive quadrature in 20 digits."""

from typing import Any

import mpmath
import numpy as np
import pytest

from cointoss.analytic.air.wall_strip import phi_series, strip_change

HALF = 1.25e-3


def strip(b, B, C, D):
    return np.array(strip_change(b, phi_series(b), HALF, B, C, D))


def by_quadrature(b, B, C, D):
    """The integrals from their definition, in pieces that shrink towards where T is least."""
    slowest, width = (-C / D, abs(B / D)) if D != 0 else (0.0, 0.0)
    near = [slowest + sign * k * width for k in (0, 1, 5, 30) for sign in (-1, 1)]
    ends = sorted({-HALF, HALF, *(z for z in near if abs(z) < HALF)})

    def integral(power_of_z, derivative):
        def integrand(z):
            x = mpmath.mpf(C) + mpmath.mpf(D) * z
            square = x * x + mpmath.mpf(B) ** 2
            if square == 0:
                return mpmath.mpf(0)
            bent = b * square ** (mpmath.mpf(b) / 2 - 1)
            size = square ** (mpmath.mpf(b) / 2)
            return (
                z**power_of_z
                * {"xx": size + bent * x * x, "xB": bent * x * B, "BB": size + bent * B * B}[derivative]
            )

        with mpmath.workdps(20):
            found: Any = mpmath.quad(integrand, [mpmath.mpf(z) for z in ends])
            return float(found)

    return np.array(
        [integral(k, "xx") for k in (0, 1, 2)] + [integral(k, "xB") for k in (0, 1)] + [integral(0, "BB")]
    )


@pytest.mark.slow_after_first
@pytest.mark.parametrize("b", [1e-3, 0.5, 1 - 1e-6, 1.0])
@pytest.mark.parametrize(
    ("middle", "along"),
    [
        (0, 0),
        (0.4, 0),
        (1, 0),
        (1, 1e-9),
        (1 + 1e-9, 1e-9),
        (0.4, 1e-2),
        (0, 0.7),
        (1, 1.5),
        (3, 0.7),
        (6, 1),
        (9, 20),
    ],
)
def test_a_strip_is_its_integrals(b, middle, along):
    """Middle and along are C and B over D h/2: points of the strip at rest, near rest, all far from it."""
    D = -40.0
    B, C = along * D * HALF, middle * D * HALF
    size = (abs(B) + abs(C) + abs(D) * HALF) ** b * 2 * HALF
    error = (strip(b, B, C, D) - by_quadrature(b, B, C, D)) / [1, HALF, HALF**2, 1, HALF, 1] / size
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


def test_both_series_of_the_potential_meet():
    for b in (0.3, 1.0):
        below, above = (strip(b, 1.0, part * 4 / 3, 1 / HALF) for part in (1 - 1e-9, 1 + 1e-9))
        assert above == pytest.approx(below, rel=1e-8)
