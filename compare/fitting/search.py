"""The least squares of a misfit that is riddled with minima, from many starts and touch by touch.

Each impact multiplies a change of the release, so the squares of all touches have minima by the thousand, and
those of the first touches few. The least squares are found of these first. The best are kept, with neighbours
within their errors, and what was seen next is added, until all is.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.stats import qmc

from cointoss.compare.fitting.misfit import IMPOSSIBLE, Misfit, Predicted
from cointoss.models.errors import ScenarioError
from cointoss.models.records import Array
from cointoss.models.stages import counted, stage

CROWD, REFINED = 256, 24
"""Points that go on to the next stage, and their neighbours, at most; and those refined at the end."""
MOST_NEIGHBOURS = 8
"""Of each point that goes on."""
HOPELESS = 100.0
"""A point that misses by so much more in χ² than the best does not go on."""
TOGETHER = 256
"""Starts that are tossed together."""
GROWTH = 1.6
"""Numbers that are fitted at a stage, over those at the stage before."""
STEP = 1e-7
"""Of the derivatives, in parts of the span."""
LONGEST = 0.25
"""Step of the least squares, and spread of neighbours, in parts of the span."""
SAME = 1e-4
"""Minima nearer than this part of every span are one, and at the end those within three deviations."""
STEPS, CLOSE = 6, 60
"""Steps of the least squares at a stage, and most of the last ones."""
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

    @property
    def chi_square(self) -> float:
        """Sum of the squares of the residuals within the horizon of trust."""
        return float(np.sum(self.predicted.residuals[self.predicted.is_tested] ** 2))

    @property
    def score(self) -> float:
        """What minima are compared by: χ², with a price for what is beyond the horizon."""
        return self.chi_square + UNTESTED * int(np.sum(~self.predicted.is_tested))


class Search:
    """A search for the least squares of a misfit; points are in parts of the spans, 0 to 1."""

    def __init__(self, misfit: Misfit, *, starts: int, seed: int) -> None:
        """Prepare it; see `minima`."""
        self._misfit, self._starts, self._rng = misfit, starts, np.random.default_rng(seed)
        self._low = np.array([span.start for span in misfit.spans])
        self._width = np.array([span.stop - span.start for span in misfit.spans])
        # What was seen first is fitted first.
        self._order = np.argsort(misfit.times, kind="stable")
        self._size = len(misfit.spans)

    def minima(self) -> list[Minimum]:
        """Return the minima that were found, the best first; none where no start makes a scenario."""
        with stage("screening starts", "starts") as progress:
            points = self._screened(progress)
        for first in counted("fitting touch by touch", "stages", self._stages()):
            if not len(points):
                return []
            rows = self._order[:first]
            points = self._best(*self._descended(points, rows), CROWD)
            points = np.clip(np.vstack([points, self._neighbours(points, rows)]), 0, 1)
        with stage("refining the best fits"):
            best = self._best(*self._descended(points, self._order), REFINED)
            refined = [self._refined(point) for point in best]
        found: list[Minimum] = []
        for each in sorted((each for each in refined if each is not None), key=lambda each: each.score):
            near = 3 * np.sqrt(np.diag(each.covariance)) + SAME * np.abs(self._width)
            if not any(np.all(np.abs(each.values - other.values) <= near) for other in found):
                found.append(each)
        return found

    def _screened(self, progress: Callable[[int, int], None]) -> Array:
        """Return the starts that make a scenario, (p, k)."""
        sampler = qmc.Sobol(self._size, rng=self._rng)
        points = sampler.random_base2(int(np.ceil(np.log2(self._starts))))[: self._starts]
        made = []
        for first in range(0, len(points), TOGETHER):
            made.append(self._residuals(points[first : first + TOGETHER], self._order[:1])[:, 0] < IMPOSSIBLE)
            progress(min(first + TOGETHER, len(points)), len(points))
        return points[np.concatenate(made)]

    def _stages(self) -> list[int]:
        """Return how many residuals are fitted at each stage: those of one number first, then of more."""
        measured = np.cumsum(self._misfit.is_measured[self._order])
        stages, wanted = [], 1
        while wanted < measured[-1]:
            stages.append(int(np.searchsorted(measured, wanted)) + 1)
            wanted = max(wanted + 1, int(GROWTH * wanted))
        return [*stages, len(self._order)]

    def _best(self, points: Array, squares: Array, most: int) -> Array:
        """Return the points with the least squares, no two alike, none hopeless, the best first, (n, k)."""
        order = np.argsort(squares, kind="stable")
        order = order[squares[order] <= squares.min() + HOPELESS]
        _, first = np.unique(np.round(points[order] / SAME), axis=0, return_index=True)
        return points[order[np.sort(first)]][:most]

    def _descended(self, points: Array, rows: NDArray[np.intp]) -> tuple[Array, Array]:
        """Return points after steps of Levenberg and Marquardt, (p, k), and some residuals' squares, (p,).

        All points step together: many tosses at a time take little longer than one.
        """
        damping = np.full(len(points), 1e-3)
        missed = self._residuals(points, rows)
        for _ in range(STEPS):
            slopes = self._slopes(points, rows)
            curvature = np.einsum("pni,pnj->pij", slopes, slopes)
            scale = np.einsum("pii->pi", curvature) + np.finfo(float).tiny
            curvature += (damping[:, None] * scale + 1e-9 * scale.max(axis=1, keepdims=True))[
                :, :, None
            ] * np.eye(self._size)
            slope = np.einsum("pni,pn->pi", slopes, missed)
            step = np.linalg.solve(curvature, slope[:, :, None])[:, :, 0]
            tried = np.clip(points - np.clip(step, -LONGEST, LONGEST), 0, 1)
            there = self._residuals(tried, rows)
            better = np.sum(there**2, axis=1) < np.sum(missed**2, axis=1)
            points, missed = (
                np.where(better[:, None], tried, points),
                np.where(better[:, None], there, missed),
            )
            damping = np.where(better, damping / 10, damping * 10)
        return points, np.sum(missed**2, axis=1)

    def _least(self, point: Array, rows: NDArray[np.intp]) -> Array:
        """Return where the squares of some residuals are least, near a point; itself where all are flat."""
        if not np.any(self._slopes(point[None], rows)):
            return point
        return least_squares(
            lambda x: self._residuals(x[None], rows)[0],
            np.clip(point, 1e-9, 1 - 1e-9),
            jac=lambda x: self._slopes(x[None], rows)[0],  # pyright: ignore[reportArgumentType]
            bounds=(0.0, 1.0),
            max_nfev=CLOSE,
            xtol=1e-12,
            ftol=1e-10,
            gtol=1e-12,
        ).x

    def _neighbours(self, points: Array, rows: NDArray[np.intp]) -> Array:
        """Return points drawn within the errors of fits to some residuals, (n, k)."""
        _, sizes, axes = np.linalg.svd(self._slopes(points, rows))
        sizes = np.pad(sizes, ((0, 0), (0, self._size - sizes.shape[1])))
        spread, number = 1 / np.maximum(sizes, 1 / LONGEST), min(CROWD, MOST_NEIGHBOURS * len(points))
        chosen = self._rng.permutation(np.resize(np.arange(len(points)), number))
        drawn = self._rng.normal(0, 2, (number, self._size)) * spread[chosen]
        return points[chosen] + np.einsum("pi,pij->pj", drawn, axes[chosen])

    def _refined(self, point: Array) -> Minimum | None:
        """Return the minimum near a point of what is within its own horizon; None where it is no scenario."""
        try:
            tested = self._misfit.predicted(self._values(point)).is_tested
            point = self._least(point, np.flatnonzero(tested))
            predicted = self._misfit.predicted(self._values(point))
        except ScenarioError:
            return None
        covariance = covariance_of(
            self._slopes(point[None], np.flatnonzero(predicted.is_tested))[0], self._width
        )
        return Minimum(values=self._values(point), predicted=predicted, covariance=covariance)

    def _values(self, points: Array) -> Array:
        return self._low + self._width * points

    def _residuals(self, points: Array, rows: NDArray[np.intp]) -> Array:
        until = float(self._misfit.times[rows].max())
        return self._misfit.residuals(self._values(points), until)[:, rows]

    def _slopes(self, points: Array, rows: NDArray[np.intp]) -> Array:
        """Return the derivatives of some residuals by the coordinates of points, (p, n, k)."""
        steps = np.where(points + STEP <= 1, STEP, -STEP)
        there = points[:, None, :] + np.concatenate(
            [np.zeros((len(points), 1, self._size)), steps[:, None, :] * np.eye(self._size)], axis=1
        )
        missed = self._residuals(there.reshape(-1, self._size), rows).reshape(len(points), self._size + 1, -1)
        return np.moveaxis((missed[:, 1:] - missed[:, :1]) / steps[:, :, None], 1, 2)


def covariance_of(slopes: Array, scales: Array) -> Array:
    """Return the covariance of fitted values, (k, k); infinite variances of what is not determined.

    Args:
        slopes: of the residuals, in standard deviations, by the values over their scales, (n, k).
        scales: of the values, (k,).
    """
    k = len(scales)
    _, sizes, axes = np.linalg.svd(slopes)
    sizes = np.pad(sizes, (0, k - len(sizes)))
    open_ = sizes <= UNDETERMINED * max(sizes[0], 1.0)
    known = axes[~open_] / sizes[~open_, None]
    covariance = np.outer(scales, scales) * (known.T @ known)
    lost = np.any(np.abs(axes[open_]) > UNDETERMINED**0.5, axis=0)
    covariance[lost, lost] = np.inf
    return covariance
