"""The least squares of a misfit with very many minima, from many starts and touch by touch.

Each impact multiplies a change of the release, so the misfit of all touches has thousands of minima, and
that of the first touches few. The search minimises the misfit of the first touches first. It keeps points
from the whole region that these allow, draws many neighbours within their errors, and selects from them by
the next observations, until all are used.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import chi2, qmc

from cointoss.compare.fitting.descent import Descent, squares
from cointoss.compare.fitting.intervals import Known, drawn_near, halved, region_of
from cointoss.compare.fitting.misfit import Misfit, Predicted
from cointoss.compare.metrics.estimates import LEVEL
from cointoss.models.errors import ScenarioError
from cointoss.models.records import Array
from cointoss.models.stages import stage

DRAWN, CROWD, MODES, REFINED = 8192, 256, 256, 24
"""At each stage, where five values are free, how many neighbours are drawn, how many of them are fitted, and
how many points go on at most; and how many points are refined at the end."""
HOPELESS = 100.0
"""A point whose χ² is larger than the least by more than this does not go on."""
ALIKE = 15.0
"""Points whose χ² exceeds the least by no more than this count as equally good: later observations may prefer
them."""
APART = 1.0
"""The least distance between two points that go on, in χ²."""
NEAR, FEW = 50.0, 512
"""The next observations are fitted while, at `FEW` points or more, their χ² exceeds the least by at most
`NEAR`."""
GROWTH, SLOWEST = 1.6, 64
"""How the count of fitted numbers grows from stage to stage: at most by the factor `GROWTH`, at least by the
part 1/`SLOWEST`."""
SAME = 1e-4
"""Minima nearer to each other than this part of every span are one, and at the end those within three
deviations."""
CLOSE = 60
"""The most steps of the last least squares."""
EARLIER = 4
"""The number of stages before the last whose points also serve to measure intervals."""
SURELY, REACH = 5.0, 5.0
"""An observation this many standard deviations before the first touch is surely before it; and no end of an
interval is sought beyond this many deviations of a value that such observations alone determine."""
ABOVE = float(chi2.ppf(LEVEL, 1))
"""How far χ² may exceed its least for a value in the interval."""
AGAIN, GAIN = 3, 1e-3
"""How often intervals are measured again at most, and by how much χ² must have fallen for that."""
UNTESTED = 3.0
"""χ² that an observation beyond the horizon counts when minima are compared: else the values that nothing
could test would win."""
UNDETERMINED = 1e-9
"""A change of the fields, in parts of their spans, is undetermined if its effect on what is seen is less than
this part of the largest effect of such a change."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Minimum:
    """Values with the least squares around them, and what they explain."""

    values: Array
    """The values, (k,)."""
    predicted: Predicted
    covariance: Array
    """Covariance of the values, (k, k); infinite variances of what is not determined."""
    determined: int
    """How many combinations of the values what was seen determines: at most k."""

    @property
    def chi_square(self) -> float:
        """Sum of the squares of the residuals within the horizon of trust."""
        return float(np.sum(self.predicted.residuals[self.predicted.is_tested] ** 2))

    @property
    def score(self) -> float:
        """The number by which minima are compared: χ², with a price for what is beyond the horizon."""
        return self.chi_square + UNTESTED * int(np.sum(~self.predicted.is_tested))


class LeastSquaresSearch:
    """A search for the least squares of a misfit; points are in parts of the spans, 0 to 1."""

    def __init__(self, misfit: Misfit, *, starts: int, seed: int) -> None:
        """Prepare it; see `found`."""
        self._misfit, self._starts, self._rng = misfit, starts, np.random.default_rng(seed)
        self._descent = Descent(misfit)
        # What was seen first is fitted first.
        self._order = np.argsort(misfit.times, kind="stable")
        self._best: tuple[Array, float, int] | None = None

    def found(self) -> tuple[tuple[Minimum, ...], Array] | None:
        """Return minima, the best first, and the ends of the interval of each value, (k, 2); None where no
        start makes a scenario."""
        sampler = qmc.Sobol(self._descent.size, rng=self._rng)
        starts = sampler.random_base2(int(np.ceil(np.log2(self._starts))))[: self._starts]
        starts = starts[self._misfit.accepts(self._descent.values(starts))]
        if not len(starts):
            return None
        known = self._fitted(starts)
        with stage("refining the best values", detail=self._so_far):
            points = known[-1].points
            missed = self._descent.residuals(points, self._order)
            deepest, _ = self._modes(*self._descent.descended(points, missed, self._order), self._order, 0.0)
            minima = [each for each in map(self._refined, deepest[:REFINED]) if each is not None]
        if not minima:
            return None
        with stage("measuring the intervals", detail=self._so_far):
            ends = self._ends(minima, np.vstack([known[-1].points, deepest]), known[-EARLIER - 1 : -1])
        return self._apart(minima), ends

    def _fitted(self, points: Array) -> list[Known]:
        """Return points that explain what was seen until ever later times, at last all."""
        fitted, seen, around = 0, len(self._order), points[:0]
        known: list[Known] = []
        with stage("touch by touch", "numbers seen", total=seen, detail=self._so_far) as progress:
            while fitted < seen:
                points = np.vstack([points, around])
                missed = self._next(points, fitted)
                fitted = missed.shape[1]
                rows = self._order[:fitted]
                some = self._ranked(squares(missed), ALIKE)[: CROWD if known else None]
                there, missed_there = self._descent.descended(points[some], missed[some], rows)
                # Minima alone do not show how far a bent region reaches, so other points are kept, too.
                among = np.vstack([there, points[some]]), np.vstack([missed_there, missed[some]])
                points, information = self._modes(*among, rows, ALIKE)
                known.append(Known(points, information))
                around = self._neighbours(points, information)
                progress(fitted, seen)
        return known

    def _so_far(self) -> str:
        """Return the best that was found so far, in words."""
        if self._best is None:
            return ""
        (point, square, count), spans = self._best, self._misfit.spans
        values = zip(spans, self._descent.values(point), strict=True)
        told = ", ".join(f"{span.field} = {value:.5g}" for span, value in values)
        return f"chi-square {square:.4g} of {count}: {told}"

    def _ends(self, minima: list[Minimum], points: Array, earlier: list[Known], again: int = AGAIN) -> Array:
        """Return the ends of the intervals, (k, 2); minima that are found on the way are added.

        Args:
            minima: those known.
            points: others that explain what was seen, (n, k).
            earlier: points that explain less.
            again: how often the measurement may be repeated.
        """
        best = min(minima, key=lambda each: each.score)
        rows = np.flatnonzero(best.predicted.is_tested)
        points = np.vstack([points, [self._descent.point(each.values) for each in minima]])
        missed = self._descent.residuals(points, rows)
        known = [*earlier, Known(points, self._descent.information(points, missed, rows))]
        region = region_of(self._descent, rows, known, limits=self._limits(best), above=ABOVE, rng=self._rng)
        better = self._refined(region.best) if region.least < best.chi_square - GAIN else None
        if not again or better is None or better.score >= best.score - GAIN:
            return self._descent.values(region.ends.T).T
        minima.append(better)
        return self._ends(minima, np.vstack([points, region.met]), earlier, again - 1)

    def _limits(self, best: Minimum) -> Array:
        """Return how far each coordinate may be by what was seen before the first touch, (k, 2).

        That part of the misfit is smooth.
        """
        seen = self._misfit.observed
        first = seen.touch_times.min(initial=np.inf) - SURELY * np.max(seen.touch_sd, initial=0.0)
        early = np.flatnonzero(self._misfit.times < first)
        point = self._descent.point(best.values)
        if not len(early):
            return np.tile([0.0, 1.0], (len(point), 1))
        covariance, _ = covariance_of(self._descent.slopes_at(point, early), np.ones(len(point)))
        far = REACH * np.sqrt(np.diag(covariance))
        return np.clip(np.column_stack([point - far, point + far]), 0, 1)

    def _apart(self, minima: list[Minimum]) -> tuple[Minimum, ...]:
        """Return minima, the best first, of which no two are within three deviations."""
        kept: list[Minimum] = []
        for each in sorted(minima, key=lambda each: each.score):
            near = 3 * np.sqrt(np.diag(each.covariance)) + SAME * np.abs(self._descent.width)
            if not any(np.all(np.abs(each.values - other.values) <= near) for other in kept):
                kept.append(each)
        return tuple(kept)

    def _next(self, points: Array, fitted: int) -> Array:
        """Return the residuals to fit next, (p, n): those that a few points nearly explain already."""
        least, seen = fitted + 1 + fitted // SLOWEST, len(self._order)
        most = min(max(least, int(GROWTH * fitted)), seen)
        missed = self._descent.residuals(points, self._order[:most])
        grown = np.cumsum(missed[:, fitted:] ** 2, axis=1)
        near = np.sum(grown <= grown.min(axis=0) + NEAR, axis=0) >= min(FEW, len(points))
        if near.all():
            return missed
        # A touch that a toss does not make misses by the time the toss is followed, which depends on what is
        # fitted.
        count = min(max(fitted + int(np.argmin(near)), least), seen)
        return self._descent.residuals(points, self._order[:count])

    def _modes(
        self, points: Array, missed: Array, rows: NDArray[np.intp], alike: float
    ) -> tuple[Array, Array]:
        """Return points that the residuals distinguish, (n, k), and their information, (n, k, k).

        They are in the order of `_ranked`, and none of them is hopeless. A value that no residual determines
        distinguishes no points.
        """
        square = squares(missed)
        self._best = points[np.argmin(square)], float(square.min()), len(rows)
        order = self._ranked(square, alike)
        order = order[square[order] <= square.min() + HOPELESS]
        points = points[order]
        information = self._descent.information(points, missed[order], rows)
        kept: list[int] = []
        for i in range(len(points)):
            apart = points[i] - points[kept]
            if len(kept) == MODES:
                break
            both = information[kept] + information[i]
            if np.all(np.einsum("pi,pij,pj->p", apart, both, apart) > APART):
                kept.append(i)
        return points[kept], information[kept]

    def _ranked(self, square: Array, alike: float) -> NDArray[np.intp]:
        """Return the order of points by χ²; those above the least by no more than `alike` come first, in any
        order."""
        anyhow = self._rng.permutation(len(square))
        return anyhow[np.argsort(np.maximum(square[anyhow], square.min() + alike), kind="stable")]

    def _least(self, point: Array, rows: NDArray[np.intp]) -> Array:
        """Return where the squares of some residuals are least, near a point; itself where all are flat."""
        if not np.any(self._descent.slopes_at(point, rows)):
            return point
        return least_squares(
            lambda x: self._descent.residuals(x[None], rows)[0],
            np.clip(point, 1e-9, 1 - 1e-9),
            jac=lambda x: self._descent.slopes_at(x, rows),  # pyright: ignore[reportArgumentType]
            bounds=(0.0, 1.0),
            max_nfev=CLOSE,
            xtol=1e-12,
            ftol=1e-10,
            gtol=1e-12,
        ).x

    def _neighbours(self, points: Array, information: Array) -> Array:
        """Return points drawn within the errors of each of some, (n, k), alike many of each."""
        chosen = np.resize(np.arange(len(points)), max(halved(DRAWN, self._descent.size), len(points)))
        held = np.zeros((len(chosen), self._descent.size), dtype=bool)
        return drawn_near(points[chosen], information[chosen], held, self._rng)

    def _refined(self, point: Array) -> Minimum | None:
        """Return the minimum near a point of what is within its own horizon; None where it is no scenario."""
        try:
            tested = self._misfit.predicted(self._descent.values(point)).is_tested
            point = self._least(point, np.flatnonzero(tested))
            predicted = self._misfit.predicted(self._descent.values(point))
        except ScenarioError:
            return None
        covariance, determined = covariance_of(
            self._descent.slopes_at(point, np.flatnonzero(predicted.is_tested)), self._descent.width
        )
        return Minimum(
            values=self._descent.values(point),
            predicted=predicted,
            covariance=covariance,
            determined=determined,
        )


def covariance_of(slopes: Array, scales: Array) -> tuple[Array, int]:
    """Return the covariance of fitted values, (k, k), and how many combinations of them are determined.

    Variances of what is not determined are infinite.

    Args:
        slopes: of the residuals, in standard deviations, by the values over their scales, (n, k).
        scales: of the values, (k,).
    """
    k = len(scales)
    _, sizes, axes = np.linalg.svd(np.vstack([slopes, np.zeros((k, k))]), full_matrices=False)
    open_ = sizes <= UNDETERMINED * max(sizes[0], 1.0)
    known = axes[~open_] / sizes[~open_, None]
    covariance = np.outer(scales, scales) * (known.T @ known)
    lost = np.any(np.abs(axes[open_]) > UNDETERMINED**0.5, axis=0)
    covariance[lost, lost] = np.inf
    return covariance, len(known)
