"""Gauss's rules are on every machine the nearest floats."""

import pytest
from flint import arb, ctx

from cointoss.analytic.air.quadrature import graded_rule


@pytest.mark.parametrize(("n", "grading"), [(1, 1), (5, 1), (16, 1), (28, 4), (32, 5), (48, 5)])
def test_nodes_and_weights_are_rounded_correctly(monkeypatch, n, grading):
    monkeypatch.setattr(ctx, "prec", 200)
    nodes, weights = graded_rule(n, grading)
    for i in range(n):
        x, weight = arb.legendre_p_root(n, n - 1 - i, weight=True)
        t = (1 + x) / 2
        assert nodes[i] == float((t**grading).mid())
        assert weights[i] == float((grading * t ** (grading - 1) * weight / 2).mid())
