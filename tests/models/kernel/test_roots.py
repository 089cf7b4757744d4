"""Roots in a bracket: against known ones, and that the bracket never loses its root."""

import math

import pytest

from cointoss.models.kernel.roots import bracket_between, is_narrow, narrowed, next_try

CASES = {
    "line": (lambda x: 0.3 - x, 0.3),
    "inverse parabola": (lambda x: (0.9 - math.sqrt(0.25 + 0.8 * x)) / 0.4, 0.7),
    "cosine": (math.cos, math.pi / 2),
    "steep": (lambda x: 1 - math.exp(40 * (x - 1.7)), 1.7),
    "flat": (lambda x: (0.9 - x) ** 9, 0.9),
    "a step": (lambda x: 1.0 if x < 1.234 else -1.0, 1.234),
}


@pytest.mark.parametrize("name", CASES)
def test_a_root_is_bracketed_to_the_tolerance_in_few_tries(name):
    f, root = CASES[name]
    tolerance, bracket, tries = 1e-13, bracket_between(0.0, f(0.0), 2.0, f(2.0)), 0
    while not is_narrow(bracket, tolerance):
        x = next_try(bracket)
        assert min(bracket.low, bracket.high) < x < max(bracket.low, bracket.high)
        bracket = narrowed(bracket, x, f(x), tolerance)
        tries += 1
        # Near a root of order nine the values are nothing but rounding.
        assert bracket.low <= root + 1e-15
        assert bracket.high >= root - 1e-15
    assert bracket.high - bracket.low <= 2 * tolerance
    # Bisection takes 43.
    most = {"line": 4, "inverse parabola": 4, "cosine": 12, "steep": 20, "flat": 60, "a step": 50}
    assert tries <= most[name]
