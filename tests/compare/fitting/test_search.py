"""The search of a fit: what minima are compared by, and one that is met while the intervals are measured."""

import numpy as np

from cointoss.analytic import toss
from cointoss.compare.fitting.misfit import Misfit, Predicted
from cointoss.compare.fitting.observed import Observed
from cointoss.compare.fitting.search import LeastSquaresSearch, Minimum
from cointoss.compare.sweep.axes import Span
from tests.helpers.draws import scenario

COIN = scenario(floor={"restitution": 0.8}, release={"position": [0, 0, 0.4]}, ending={"max_impacts": 5})


def minimum(residuals: list[float], tested: list[bool]) -> Minimum:
    """Return a minimum with these residuals."""
    predicted = Predicted(
        residuals=np.array(residuals),
        is_tested=np.array(tested),
        touch_times=np.zeros(len(tested)),
    )
    return Minimum(values=np.zeros(1), predicted=predicted, covariance=np.eye(1), determined=1)


def test_values_that_nothing_could_test_do_not_win():
    explains = minimum([1.0, -1.0, 1.0], [True, True, True])
    untested = minimum([0.0, 9.0, 9.0], [True, False, False])
    assert untested.chi_square == 0 < explains.chi_square == 3
    assert explains.score < untested.score


def test_a_better_minimum_met_while_intervals_are_measured_is_among_those_found():
    """All that is known before is a restitution two thousandths too high."""
    times = toss(COIN).impacts.time
    misfit = Misfit(
        scenario=COIN,
        spans=(
            Span(field="floor.restitution", start=0.7, stop=0.9, unit=""),
            Span(field="release.position.z", start=0.39, stop=0.41, unit="m"),
        ),
        observed=Observed(touch_times=times, touch_sd=1e-3),
    )
    search, values = LeastSquaresSearch(misfit, starts=1, seed=0), np.array([0.802, 0.4])
    known = Minimum(
        values=values, predicted=misfit.predicted(values), covariance=np.diag([1e-6, 1e-6]), determined=2
    )
    minima = [known]
    ends = search._ends(minima, np.empty((0, 2)), [])
    best = min(minima, key=lambda each: each.score)
    assert best.chi_square < 1e-3 < 1 < known.chi_square
    assert abs(best.values[0] - 0.8) < 1e-6
    assert np.all((ends[:, 0] < [0.8, 0.4]) & ([0.8, 0.4] < ends[:, 1]))
