"""The least squares of a misfit that is riddled with minima, from many starts and touch by touch.

Each impact multiplies a change of the release, so the squares of all touches have minima by the thousand, and
those of the first touches few. The least squares are found of these first. The best are kept, with neighbours
within their errors, and what was seen next is added, until all is.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import chi2, qmc

from cointoss.compare.fitting.descent import LONGEST, Descent
from cointoss.compare.fitting.intervals import Region, region_of
from cointoss.compare.fitting.misfit import IMPOSSIBLE, Misfit, Predicted
from cointoss.models.errors import ScenarioError
from cointoss.models.records import Array
from cointoss.models.stages import stage

CROWD, MODES, REFINED = 512, 256, 24
"""Points of a stage, with their neighbours; those that go on, at most; and those refined at the end."""
HOPELESS = 100.0
"""A point that misses by so much more in χ² than the best does not go on."""
APART = 1.0
"""χ² between two points that go on, at least."""
NEAR, FEW = 50.0, 16
"""What is fitted next misses by so much more in χ² than the best of the points, at most, at a few of them."""
SPREAD = 2.0
"""Of neighbours, in standard deviations."""
TOGETHER = 256
"""Starts that are tossed together."""
GROWTH, SLOWEST = 1.6, 16
"""Numbers that are fitted at a stage, over those at the stage before, at most; and at least a part more."""
SAME = 1e-4
"""Minima nearer than this part of every span are one, and at the end those within three deviations."""
CLOSE = 60
"""Steps of the last least squares, at most."""
LEVEL = 0.99
"""Of the intervals."""
ABOVE = float(chi2.ppf(LEVEL, 1))
"""χ² above its least, up to which a value is in its interval."""
AGAIN, GAIN = 3, 1e-3
"""Intervals are measured again so often, at most, where that meets a misfit that is less by so much."""
UNTESTED = 3.0
"""χ² that an observation beyond the horizon counts when minima are compared: else the values that nothing
could test would win."""
UNDETERMINED = 1e-9
"""A change of the fields, in parts of their spans, that changes what is seen by less than this part of the
largest such change is none that could be seen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Minimum:
    """Values with the least squares around them, and what they explain."""

    values: Array
    """(k,)."""
    predicted: Predicted
    covariance: Array
    """(k, k); infinite variances of what is not determined."""
    determined: int
    """How many combinations of the values what was seen determines: at most k."""

    @property
    def chi_square(self) -> float:
        """Sum of the squares of the residuals within the horizon of trust."""
        return float(np.sum(self.predicted.residuals[self.predicted.is_tested] ** 2))

    @property
    def score(self) -> float:
        """What minima are compared by: χ², with a price for what is beyond the horizon."""
        return self.chi_square + UNTESTED * int(np.sum(~self.predicted.is_tested))


class Found(NamedTuple):
    """What a search found."""

    minima: tuple[Minimum, ...]
    """The best first."""
    ends: Array
    """Of the interval of each value, (k, 2)."""


class Search:
    """A search for the least squares of a misfit; points are in parts of the spans, 0 to 1."""

    def __init__(self, misfit: Misfit, *, starts: int, seed: int) -> None:
        """Prepare it; see `found`."""
        self._misfit, self._starts, self._rng = misfit, starts, np.random.default_rng(seed)
        self._descent = Descent(misfit)
        # What was seen first is fitted first.
        self._order = np.argsort(misfit.times, kind="stable")

    def found(self) -> Found | None:
        """Return what was found; None where no start makes a scenario."""
        with stage("screening starts", "starts") as progress:
            starts = self._screened(progress)
        if not len(starts):
            return None
        modes, around = self._fitted(starts)
        with stage("refining the best fits"):
            minima = [each for each in map(self._refined, modes[:REFINED]) if each is not None]
        if not minima:
            return None
        with stage("measuring the intervals"):
            ends = self._ends(minima, np.vstack([modes, around]))
        return Found(self._apart(minima), ends)

    def _fitted(self, points: Array) -> tuple[Array, Array]:
        """Return points that explain all that was seen, the best first, and their neighbours, (n, k) each."""
        fitted, seen, around = 0, len(self._order), points[:0]
        with stage("fitting touch by touch", "numbers", total=seen) as progress:
            while fitted < seen:
                points = np.vstack([points, around])
                fitted = self._next(points, fitted)
                rows = self._order[:fitted]
                points, information = self._modes(*self._descent.descended(points, rows), rows)
                around = self._neighbours(points, information)
                progress(fitted, seen)
        return points, around

    def _ends(self, minima: list[Minimum], points: Array, again: int = AGAIN) -> Array:
        """Return the ends of the intervals, (k, 2); minima that are met on the way are added."""
        best = min(minima, key=lambda each: each.score)
        known = np.vstack([points, [self._descent.point(each.values) for each in minima]])
        region = self._region(best, known)
        better = self._refined(region.best) if region.least < best.chi_square - GAIN else None
        if not again or better is None or better.score >= best.score - GAIN:
            return self._descent.values(region.ends.T).T
        minima.append(better)
        return self._ends(minima, points, again - 1)

    def _region(self, best: Minimum, points: Array) -> Region:
        """Return the region of the intervals."""
        rows = np.flatnonzero(best.predicted.is_tested)
        sd = np.sqrt(np.diag(best.covariance)) / np.abs(self._descent.width)
        return region_of(self._descent, rows, points, sd=sd, above=ABOVE)

    def _apart(self, minima: list[Minimum]) -> tuple[Minimum, ...]:
        """Return minima, the best first, of which no two are within three deviations."""
        kept: list[Minimum] = []
        for each in sorted(minima, key=lambda each: each.score):
            near = 3 * np.sqrt(np.diag(each.covariance)) + SAME * np.abs(self._descent.width)
            if not any(np.all(np.abs(each.values - other.values) <= near) for other in kept):
                kept.append(each)
        return tuple(kept)

    def _screened(self, progress: Callable[[int, int], None]) -> Array:
        """Return the starts that make a scenario, (p, k)."""
        sampler = qmc.Sobol(self._descent.size, rng=self._rng)
        points = sampler.random_base2(int(np.ceil(np.log2(self._starts))))[: self._starts]
        made = []
        for first in range(0, len(points), TOGETHER):
            made.append(
                self._descent.residuals(points[first : first + TOGETHER], self._order[:1])[:, 0] < IMPOSSIBLE
            )
            progress(min(first + TOGETHER, len(points)), len(points))
        return points[np.concatenate(made)]

    def _next(self, points: Array, fitted: int) -> int:
        """Return how many residuals to fit next: as many as a few points are not far from explaining."""
        least, seen = fitted + 1 + fitted // SLOWEST, len(self._order)
        most = min(max(least, int(GROWTH * fitted)), seen)
        missed = np.cumsum(self._descent.residuals(points, self._order[:most])[:, fitted:] ** 2, axis=1)
        near = np.sum(missed <= missed.min(axis=0) + NEAR, axis=0) >= min(FEW, len(points))
        return most if near.all() else min(max(fitted + int(np.argmin(near)), least), seen)

    def _modes(self, points: Array, squares: Array, rows: NDArray[np.intp]) -> tuple[Array, Array]:
        """Return points of which the residuals tell any two apart, the best first, (n, k), and their
        information, (n, k, k).

        None of them is hopeless. What no residual determines tells nothing apart.
        """
        order = np.argsort(squares, kind="stable")
        points = points[order[squares[order] <= squares.min() + HOPELESS]]
        information = self._descent.information(points, rows)
        kept: list[int] = []
        for i in range(len(points)):
            apart = points[i] - points[kept]
            if len(kept) == MODES:
                break
            both = information[kept] + information[i]
            if np.all(np.einsum("pi,pij,pj->p", apart, both, apart) > APART):
                kept.append(i)
        return points[kept], information[kept]

    def _least(self, point: Array, rows: NDArray[np.intp]) -> Array:
        """Return where the squares of some residuals are least, near a point; itself where all are flat."""
        if not np.any(self._descent.slopes(point[None], rows)):
            return point
        return least_squares(
            lambda x: self._descent.residuals(x[None], rows)[0],
            np.clip(point, 1e-9, 1 - 1e-9),
            jac=lambda x: self._descent.slopes(x[None], rows)[0],  # pyright: ignore[reportArgumentType]
            bounds=(0.0, 1.0),
            max_nfev=CLOSE,
            xtol=1e-12,
            ftol=1e-10,
            gtol=1e-12,
        ).x

    def _neighbours(self, points: Array, information: Array) -> Array:
        """Return points drawn within the errors of each of some, (n, k), alike many of each.

        Where nothing is determined that is anywhere in the spans.
        """
        squares, axes = np.linalg.eigh(information)
        sizes, axes = np.sqrt(np.maximum(squares, 0.0)), axes.transpose(0, 2, 1)
        chosen = np.resize(np.arange(len(points)), max(CROWD - len(points), len(points)))
        drawn = self._rng.normal(0, SPREAD, (len(chosen), self._descent.size)) / np.maximum(
            sizes[chosen], 1.0
        )
        anywhere = np.einsum("pji,pi->pj", axes[chosen], self._rng.random(drawn.shape) - points[chosen])
        steps = np.where(sizes[chosen] * LONGEST > 1, drawn, anywhere)
        moved = points[chosen] + np.einsum("pj,pji->pi", steps, axes[chosen])
        return np.clip(1 - np.abs(1 - np.abs(moved)), 0, 1)

    def _refined(self, point: Array) -> Minimum | None:
        """Return the minimum near a point of what is within its own horizon; None where it is no scenario."""
        try:
            tested = self._misfit.predicted(self._descent.values(point)).is_tested
            point = self._least(point, np.flatnonzero(tested))
            predicted = self._misfit.predicted(self._descent.values(point))
        except ScenarioError:
            return None
        covariance, determined = covariance_of(
            self._descent.slopes(point[None], np.flatnonzero(predicted.is_tested))[0], self._descent.width
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
