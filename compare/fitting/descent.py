"""Steps of least squares of a misfit from many points at once, each in parts of the spans, 0 to 1."""

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.fitting.misfit import Misfit
from cointoss.models.records import Array

STEP = 1e-7
"""Step of the derivatives, in parts of the span."""
LONGEST = 0.25
"""Step of the least squares, in parts of the span."""
TOGETHER = 1 << 22
"""About how many residuals are in memory together."""
STEPS, SETTLED = 6, 1e-3
"""The most steps, and the change of χ² below which a point has converged."""


class Descent:
    """The misfit as a function of points, (p, k), and some of what was seen, the rows."""

    def __init__(self, misfit: Misfit) -> None:
        """Keep the spans."""
        self.misfit, self.size = misfit, len(misfit.spans)
        self.low = np.array([span.start for span in misfit.spans])
        self.width = np.array([span.stop - span.start for span in misfit.spans])

    def values(self, points: Array) -> Array:
        """Return the values of the fields."""
        return self.low + self.width * points

    def point(self, values: Array) -> Array:
        """Return the point with these values, (k,)."""
        return np.clip((values - self.low) / self.width, 0, 1)

    def residuals(self, points: Array, rows: NDArray[np.intp]) -> Array:
        """Return what was seen less what the tosses show, in standard deviations, (p, n)."""
        return self.misfit.residuals(self.values(points), float(self.misfit.times[rows].max()))[:, rows]

    def slopes(
        self,
        points: Array,
        missed: Array,
        rows: NDArray[np.intp],
        held: NDArray[np.bool_] | None = None,
    ) -> Array:
        """Return the derivatives of the residuals by the coordinates of the points, (p, n, k).

        Args:
            points: where.
            missed: the residuals there, (p, n).
            rows: of what.
            held: coordinates whose derivatives are 0, (p, k); by default none.
        """
        found = np.zeros((len(points), len(rows), self.size))
        is_tossed = np.ones(points.shape, bool) if held is None else ~held
        for i, slope in self.misfit.known_slopes.items():
            found[:, :, i] = np.where(is_tossed[:, i, None], self.width[i] * slope[rows], 0.0)
            is_tossed[:, i] = False
        at, field = np.nonzero(is_tossed)
        moved = points[at]
        steps = np.where(moved[np.arange(len(at)), field] + STEP <= 1, STEP, -STEP)
        moved[np.arange(len(at)), field] += steps
        found[at, :, field] = (self.residuals(moved, rows) - missed[at]) / steps[:, None]
        return found

    def slopes_at(self, point: Array, rows: NDArray[np.intp]) -> Array:
        """Return the derivatives of the residuals at one point, (k,): (n, k)."""
        return self.slopes(point[None], self.residuals(point[None], rows), rows)[0]

    def information(self, points: Array, missed: Array, rows: NDArray[np.intp]) -> Array:
        """Return the products of the slopes, the inverse of the covariance at each point, (p, k, k)."""
        found = np.empty((len(points), self.size, self.size))
        for some in self._groups(len(points), rows):
            slopes = self.slopes(points[some], missed[some], rows)
            found[some] = np.einsum("pni,pnj->pij", slopes, slopes)
        return found

    def _groups(self, count: int, rows: NDArray[np.intp]) -> list[slice]:
        """Return groups of points, so small that the memory holds the residuals of their slopes."""
        size = max(1, TOGETHER // (len(rows) * (self.size + 1)))
        return [slice(first, min(first + size, count)) for first in range(0, count, size)]

    def descended(
        self,
        points: Array,
        missed: Array,
        rows: NDArray[np.intp],
        held: NDArray[np.bool_] | None = None,
    ) -> tuple[Array, Array]:
        """Return points after steps of Levenberg and Marquardt, (p, k), and the residuals there, (p, n).

        All points step together: many tosses at a time take little longer than one.

        Args:
            points: where they begin.
            missed: the residuals there.
            rows: what is fitted.
            held: coordinates that stay, (p, k); by default none.
        """
        held = np.zeros(points.shape, dtype=bool) if held is None else held
        there, missed_there = np.empty_like(points), np.empty_like(missed)
        for some in self._groups(len(points), rows):
            there[some], missed_there[some] = self._descended(points[some], missed[some], rows, held[some])
        return there, missed_there

    def _descended(
        self, points: Array, missed: Array, rows: NDArray[np.intp], held: NDArray[np.bool_]
    ) -> tuple[Array, Array]:
        points, missed = points.copy(), missed.copy()
        slopes = np.empty((*missed.shape, self.size))
        damping, left = np.full(len(points), 1e-3), np.arange(len(points))
        moved = left
        for _ in range(STEPS):
            slopes[moved] = self.slopes(points[moved], missed[moved], rows, held[moved])
            there = self._stepped(points[left], missed[left], slopes[left], damping[left])
            missed_there = self.residuals(there, rows)
            gain = squares(missed[left]) - squares(missed_there)
            moved, is_left = left[gain > 0], (gain < 0) | (gain > SETTLED)
            points[moved], missed[moved] = there[gain > 0], missed_there[gain > 0]
            damping[left] *= np.where(gain > 0, 0.1, 10.0)
            left, moved = left[is_left], left[is_left & (gain > 0)]
            if not len(left):
                break
        return points, missed

    def _stepped(self, points: Array, missed: Array, slopes: Array, damping: Array) -> Array:
        """Return where one step leads, (p, k)."""
        curvature = np.einsum("pni,pnj->pij", slopes, slopes)
        scale = np.einsum("pii->pi", curvature) + np.finfo(float).tiny
        curvature += (damping[:, None] * scale + 1e-9 * scale.max(axis=1, keepdims=True))[
            :, :, None
        ] * np.eye(self.size)
        slope = np.einsum("pni,pn->pi", slopes, missed)
        step = np.linalg.solve(curvature, slope[:, :, None])[:, :, 0]
        return np.clip(points - np.clip(step, -LONGEST, LONGEST), 0, 1)


def squares(missed: Array) -> Array:
    """Return χ², (p,), from residuals, (p, n)."""
    return np.sum(missed**2, axis=1)
