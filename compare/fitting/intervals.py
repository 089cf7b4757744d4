"""The intervals of fitted values: how far each may go while χ² stays near its least.

Linear propagation holds where the misfit is a parabola. The misfit of a tumbling coin is bent, jumps where
another point of the rim comes down first, and has hundreds of minima within the errors. So an interval is
that of the profile likelihood, across all minima: from the lowest to the highest value for which, all others
free, χ² exceeds its minimum by no more than the limit of the χ² distribution at the interval's level. To find
it, one value at a time is held fixed, first far outside. The others are searched for in many places:
wherever the earlier observations alone would allow them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.fitting.descent import LONGEST, Descent, squares
from cointoss.models.records import Array

NEARER = 0.6
"""The distance of the next held value from the values known to be inside, over that of the last value
outside."""
CLOSE = 0.02
"""The accuracy of an end, as a part of its distance from the best point."""
MOST_STEPS = 60
DRAWN, TRIED = 384, 12
"""How many points are drawn for each held value, where five are free, and how many of the best are fitted."""


class Known(NamedTuple):
    """Points that explain what was seen until some time, in parts of the spans."""

    points: Array
    """The points, (n, k)."""
    information: Array
    """The inverse of the covariance of each point, (n, k, k): how well what was seen determines it."""


@dataclass(frozen=True, eq=False)
class Region:
    """Where χ² is at most a limit; coordinates are parts of the spans."""

    ends: Array
    """The lowest and the highest of each coordinate, (k, 2)."""
    best: Array
    """The point with the least χ² that was found, (k,)."""
    least: float
    """χ² at `best`."""
    met: Array
    """Points of the region that were found, (n, k)."""


def region_of(
    descent: Descent,
    rows: NDArray[np.intp],
    known: Sequence[Known],
    *,
    limits: Array,
    above: float,
    rng: np.random.Generator,
) -> Region:
    """Return the region in which χ² is at most `above` its least of some points.

    Args:
        descent: the misfit.
        rows: what is fitted.
        known: points that explain all of it, at the last, and before them those that explain less.
        limits: beyond which no coordinate is looked for, (k, 2).
        above: by how much.
        rng: of the points that are drawn.
    """
    points = known[-1].points
    square = squares(descent.residuals(points, rows))
    best, least = points[np.argmin(square)], float(square.min())
    inside = square <= least + above
    met, met_squares = Known(points[inside], known[-1].information[inside]), square[inside]
    fields, signs = np.repeat(np.arange(descent.size), 2), np.tile([-1.0, 1.0], descent.size)
    near, root = np.full(len(fields), np.nan), np.zeros(len(fields))
    beyond, root_beyond = limits.ravel().copy(), np.full(len(fields), np.nan)

    def root_of(square: Array) -> Array:
        """Return what grows evenly on the way outwards where the misfit is a parabola."""
        return np.sqrt(np.maximum(square - least, 0.0))

    found = (best, least)
    for _ in range(MOST_STEPS):
        outermost = np.argmax(signs * met.points[:, fields], axis=0)
        near, root = met.points[outermost, fields], root_of(met_squares[outermost])
        beyond = np.where(signs * near > signs * beyond, limits.ravel(), beyond)
        beyond = signs * np.maximum(signs * beyond, signs * near)
        is_tried = ~np.isnan(root_beyond)
        is_far = np.abs(beyond - near) > CLOSE * np.abs(beyond - best[fields])
        left = np.flatnonzero(np.where(is_tried, is_far, beyond != near))
        if not len(left):
            break
        target = near[left] + np.where(is_tried[left], NEARER, 1.0) * (beyond[left] - near[left])
        moved, missed = _least_at(descent, rows, [*known[:-1], met], fields[left], target, rng)
        square = squares(missed)
        if square.min() < found[1]:
            found = moved[np.argmin(square)], float(square.min())
        is_inside = square <= least + above
        beyond[left[~is_inside]] = target[~is_inside]
        root_beyond[left[~is_inside]] = root_of(square[~is_inside])
        if is_inside.any():
            met_squares = np.concatenate([met_squares, square[is_inside]])
            new = moved[is_inside], descent.information(moved[is_inside], missed[is_inside], rows)
            met = Known(*map(np.concatenate, zip(met, new, strict=True)))
    part = np.where(np.isnan(root_beyond), 0.0, (above**0.5 - root) / (root_beyond - root))
    ends = near + np.where(beyond == near, 0.0, part) * (beyond - near)
    return Region(np.sort(ends.reshape(-1, 2), axis=1), *found, met.points)


def _least_at(
    descent: Descent,
    rows: NDArray[np.intp],
    known: Sequence[Known],
    fields: NDArray[np.intp],
    values: Array,
    rng: np.random.Generator,
) -> tuple[Array, Array]:
    """Return the points with the least χ² that are found where one coordinate is held, (p, k), and the
    residuals there, (p, n).

    Args:
        descent: the misfit.
        rows: what is fitted.
        known: points from which others are drawn, of each alike many.
        fields: the coordinate that is held, (p,).
        values: at which, (p,).
        rng: of the points that are drawn.
    """
    each = -(-halved(DRAWN, descent.size) // len(known))
    drawn = np.stack(
        [
            np.vstack([_drawn_at(one, field, value, each, rng) for one in known])
            for field, value in zip(fields, values, strict=True)
        ]
    )
    p, n, k = drawn.shape
    missed = descent.residuals(drawn.reshape(-1, k), rows)
    tried = np.argsort(squares(missed).reshape(p, n), axis=1)[:, :TRIED]
    chosen = (n * np.arange(p)[:, None] + tried).ravel()
    held = np.repeat(np.eye(k, dtype=bool)[fields], tried.shape[1], axis=0)
    points, missed = descent.descended(drawn.reshape(-1, k)[chosen], missed[chosen], rows, held)
    best = np.argmin(squares(missed).reshape(tried.shape), axis=1) + tried.shape[1] * np.arange(p)
    return points[best], missed[best]


def _drawn_at(known: Known, field: int, value: float, count: int, rng: np.random.Generator) -> Array:
    """Return points drawn where one coordinate has a value, (count, k), within the errors of the points of
    which it is least far; the first of each as far along its valley."""
    k = known.points.shape[1]
    ridge = 1e-12 * np.einsum("pii->p", known.information) + np.finfo(float).tiny
    variance = np.linalg.inv(known.information + ridge[:, None, None] * np.eye(k))[:, field, field]
    away = (value - known.points[:, field]) ** 2 / variance
    nearest = np.argsort(away, kind="stable")[: max(count // 4, 1)]
    chosen = np.resize(nearest, count)
    held = np.tile(np.arange(k) == field, (count, 1))
    moved = np.where(held, value - known.points[chosen], 0.0)
    mean = known.points[chosen] + _along(known.information[chosen], moved, held)
    spread = (np.arange(count) >= len(nearest)).astype(float)
    points = drawn_near(mean, known.information[chosen], held, rng, spread)
    points[:, field] = value
    return points


def halved(count: int, size: int) -> int:
    """Return how many points are drawn for `size` free values: half of `count` for each less than five."""
    return count >> max(5 - size, 0)


def drawn_near(
    points: Array,
    information: Array,
    held: NDArray[np.bool_],
    rng: np.random.Generator,
    spread: Array | float = 1.0,
) -> Array:
    """Return a point drawn within the errors of each of some, (n, k).

    Where nothing is determined that is anywhere in the spans.

    Args:
        points: in parts of the spans, (n, k).
        information: at each, (n, k, k).
        held: coordinates that stay, (n, k).
        rng: of what is drawn.
        spread: in standard deviations, of all or of each, (n,).
    """
    free = ~held
    squares, axes = np.linalg.eigh(information * (free[:, :, None] & free[:, None, :]))
    sizes, axes = np.sqrt(np.maximum(squares, 0.0)), axes.transpose(0, 2, 1)
    spread = np.broadcast_to(spread, len(points)).astype(float)[:, None]
    drawn = spread * rng.normal(size=points.shape) / np.maximum(sizes, 1.0)
    anywhere = np.einsum("pji,pi->pj", axes, rng.random(points.shape) - points)
    steps = np.where(sizes * LONGEST > 1, drawn, anywhere)
    moved = points + np.where(held, 0.0, np.einsum("pj,pji->pi", steps, axes))
    return np.clip(1 - np.abs(1 - np.abs(moved)), 0, 1)


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
