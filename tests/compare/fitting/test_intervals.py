"""Regions of χ² in closed form: parabolas, bent valleys, deeper minima on the way, and edges of the spans."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from cointoss.compare.fitting.descent import Descent, squares
from cointoss.compare.fitting.intervals import Known, Region, region_of
from cointoss.compare.fitting.misfit import Misfit
from cointoss.compare.fitting.observed import Observed
from cointoss.compare.sweep.axes import Span
from cointoss.models.records import Array
from tests.helpers.draws import scenario

ABOVE = 6.63


class Formula:
    """A misfit whose residuals are a formula of points from 0 to 1."""

    def __init__(self, formula: Callable[[Array], Array], size: int) -> None:
        self.formula, self.known_slopes = formula, {}
        self.spans = [Span(field=str(i), start=0.0, stop=1.0, unit="") for i in range(size)]
        self.times = np.zeros(len(formula(np.zeros((1, size)))[0]))

    def residuals(self, values: Array, until: float) -> Array:
        assert until == 0
        return self.formula(values)


def region(
    formula: Callable[[Array], Array], points: list[list[float]], earlier: tuple[Known, ...] = ()
) -> Region:
    misfit: Any = Formula(formula, len(points[0]))
    descent, rows, known = Descent(misfit), np.arange(len(misfit.times)), np.array(points)
    missed = descent.residuals(known, rows)
    return region_of(
        descent,
        rows,
        [*earlier, Known(known, descent.information(known, missed, rows))],
        limits=np.tile([0.0, 1.0], (descent.size, 1)),
        above=ABOVE,
        rng=np.random.default_rng(1),
    )


def parabola(p):
    """The sum of x and y is known to 1e-3, the difference to 0.1: each to half the root of their squares."""
    return np.column_stack([(p[:, 0] + p[:, 1] - 1) / 1e-3, (p[:, 0] - p[:, 1]) / 0.1])


def bent(p):
    """y is x, seen by exp 60 y: Newton's steps from afar are of 1/60, those along the valley exact."""
    return np.column_stack([np.expm1(60 * (p[:, 1] - p[:, 0])) / 1e-3, (p[:, 0] - 0.5) / 0.1])


def torn(p):
    """From x = 0.6 on y is 0.8, before 0.2, and no slope leads from one to the other."""
    y = np.where(p[:, 0] < 0.6, 0.2, 0.8)
    return np.column_stack([np.tanh((p[:, 1] - y) / 0.05) / 0.02, (p[:, 0] - 0.5) / 0.1])


FAR = ABOVE**0.5 * np.array([np.hypot(1e-3, 0.1) / 2, 0.1, 1e-3])
WITHOUT_Y = Known(np.array([[0.5, 0.5]]), np.array([[[100.0, 0.0], [0.0, 0.0]]]))


@pytest.mark.parametrize(
    ("formula", "point", "earlier", "ends", "within"),
    [
        (parabola, [0.5, 0.5], (), [[0.5 - FAR[0], 0.5 + FAR[0]]] * 2, 0.01 * FAR[0]),
        (bent, [0.5, 0.5], (), [[0.5 - FAR[1], 0.5 + FAR[1]]] * 2, 0.01 * FAR[1]),
        (
            torn,
            [0.5, 0.2],
            (WITHOUT_Y,),
            [[0.5 - FAR[1], 0.5 + FAR[1]], [0.2 - FAR[2], 0.8 + (ABOVE - 1) ** 0.5 * 1e-3]],
            [[0.01 * FAR[1]] * 2, [1e-4, 6e-3]],
        ),
        # It ends with its span.
        (lambda p: (p - 0.1) / 0.1, [0.1], (), [[0.0, 0.1 + FAR[1]]], 2e-3),
    ],
)
def test_a_region_has_the_ends_of_its_formula(formula, point, earlier, ends, within):
    found = region(formula, [point], earlier)
    assert np.all(np.abs(found.ends - ends) <= within), found.ends


def test_a_deeper_minimum_that_is_met_on_the_way_is_told():
    def two(p):
        near, deep = np.exp(-(((p - 0.3) / 0.1) ** 2)), np.exp(-(((p - 0.6) / 0.1) ** 2))
        return 3 * (2 - near - 2 * deep)

    found = region(two, [[0.3]])
    assert found.least < 8
    assert 0.5 < found.best[0] < 0.7
    assert found.least == pytest.approx(two(found.best)[0] ** 2)


def test_slopes_at_the_end_of_a_span_are_those_within_it():
    """No coin is thinner than 0."""
    seen = Observed(touch_times=[0.3, 0.7, 1.1], touch_sd=1e-3)
    misfit = Misfit(
        scenario=scenario(release={"position": [0, 0, 0.4]}),
        spans=(Span(field="coin.thickness", start=2e-3, stop=0.0, unit="m"),),
        observed=seen,
    )
    at_end, within = (Descent(misfit).slopes_at(np.array([x]), np.arange(3)) for x in (1.0, 1 - 1e-5))
    assert at_end == pytest.approx(within, rel=1e-3)
    assert np.abs(at_end).max() > 1


def test_a_step_that_leads_too_far_is_damped_until_it_does_not():
    """Undamped, every step from 0.6 passes over the minimum at 0.5 to where the misfit is larger."""
    misfit: Any = Formula(lambda points: np.arctan(100 * (points - 0.5)), 1)
    descent, start, rows = Descent(misfit), np.array([[0.6]]), np.arange(1)
    missed = descent.residuals(start, rows)
    there, missed_there = descent.descended(start, missed, rows)
    assert squares(missed_there)[0] < 0.8 * squares(missed)[0]
    assert 0.4 < there[0, 0] < 0.6
