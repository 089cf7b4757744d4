"""The intervals of fitted values: how far each may go while χ² stays near its least.

Linear propagation holds where the misfit is a parabola. That of a tumbling coin is bent, has edges where
another point of the rim comes down first, and has several minima within the errors. So an interval is that of
the profile likelihood, across all minima: from the lowest to the highest value with which, all others free,
χ² is at most so much above its least as chance makes it in so many cases.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.fitting.descent import Descent
from cointoss.models.records import Array

FIRST_STEP, GROWTH = 0.5, 1.6
"""The first step outwards, in standard deviations but at most in parts of the span; next over last."""
CLOSE = 0.01
"""An end is known so well, in parts of its distance from the best point."""
MOST_STEPS = 60


@dataclass(frozen=True, eq=False)
class Region:
    """Where χ² is at most a limit; coordinates are parts of the spans."""

    ends: Array
    """The lowest and the highest of each coordinate, (k, 2)."""
    best: Array
    """The point with the least χ² that was met, (k,)."""
    least: float
    """χ² there."""


def region_of(descent: Descent, rows: NDArray[np.intp], points: Array, *, sd: Array, above: float) -> Region:
    """Return the region in which χ² is at most `above` its least of some points.

    From the outermost of the points each coordinate is moved outwards, while all others make χ² least.

    Args:
        descent: the misfit.
        rows: what is fitted.
        points: those known, of which all within the region count, (p, k).
        sd: standard deviation of each coordinate by linear propagation, (k,); infinite where not determined.
        above: by how much.
    """
    squares = descent.squares(points, rows)
    best, least = points[np.argmin(squares)], float(squares.min())
    inside = np.flatnonzero(squares <= least + above)
    fields, signs = np.repeat(np.arange(descent.size), 2), np.tile([-1.0, 1.0], descent.size)
    outermost = inside[np.argmax(signs * points[inside][:, fields], axis=0)]
    held = np.eye(descent.size, dtype=bool)[fields]

    def root_of(square: Array) -> Array:
        """Return what grows evenly on the way outwards where the misfit is a parabola."""
        return np.sqrt(np.maximum(square - least, 0.0))

    at, near, root = points[outermost], points[outermost, fields], root_of(squares[outermost])
    beyond, root_beyond = np.full(len(fields), np.nan), np.full(len(fields), np.nan)
    steps = np.minimum(FIRST_STEP * sd, FIRST_STEP)[fields]
    found = (best, least)

    def ends() -> Array:
        """Return where the region ends, by what is known."""
        part = (above**0.5 - root) / (root_beyond - root)
        return np.where(np.isnan(beyond), near, near + part * (beyond - near))

    for _ in range(MOST_STEPS):
        is_far = np.abs(beyond - near) > CLOSE * np.abs(beyond - best[fields])
        left = np.flatnonzero(np.where(np.isnan(beyond), near != (signs > 0), is_far))
        if not len(left):
            break
        outwards = np.clip(near + signs * steps, 0, 1)
        between = near + np.clip((ends() - near) / (beyond - near), 0.1, 0.9) * (beyond - near)
        target = np.where(np.isnan(beyond), outwards, between)[left]
        moved = np.where(held[left], target[:, None], at[left])
        along = np.clip(
            _along(descent.information(at[left], rows), moved - at[left], held[left]) + at[left], 0, 1
        )
        both, squared = descent.descended(
            np.vstack([moved, along]), rows, np.vstack([held[left], held[left]])
        )
        best_of = np.argmin(squared.reshape(2, -1), axis=0), np.arange(len(left))
        moved, square = both.reshape(2, len(left), -1)[best_of], squared.reshape(2, -1)[best_of]
        if square.min() < found[1]:
            found = moved[np.argmin(square)], float(square.min())
        is_inside = square <= least + above
        inner, outer = left[is_inside], left[~is_inside]
        at[inner], near[inner], root[inner] = moved[is_inside], target[is_inside], root_of(square[is_inside])
        beyond[outer], root_beyond[outer] = target[~is_inside], root_of(square[~is_inside])
        steps[inner] *= GROWTH
    return Region(np.sort(ends().reshape(-1, 2), axis=1), *found)


def _along(information: Array, moved: Array, held: NDArray[np.bool_]) -> Array:
    """Return changes with those of the held coordinates, and others that let the misfit grow least, (p, k).

    Args:
        information: at each point, (p, k, k).
        moved: changes of the held coordinates, 0 for others, (p, k).
        held: which they are, one for each point, (p, k).
    """
    pulled = np.einsum("pij,pj->pi", information, moved)
    ridge = 1e-9 * np.einsum("pii->p", information) + np.finfo(float).tiny
    free = ~held
    kept = information * (free[:, :, None] & free[:, None, :])
    kept += (held + ridge[:, None])[:, :, None] * np.eye(held.shape[1])
    others = np.linalg.solve(kept, -np.where(free, pulled, 0.0)[:, :, None])[:, :, 0]
    return np.where(held, moved, others)
