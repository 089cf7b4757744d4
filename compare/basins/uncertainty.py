"""The uncertainty exponent α of a map's boundaries."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import t

from cointoss.compare.basins.maps import OutcomeCodes, measured, outcome_map
from cointoss.models.records import Array, Outcome

BANDS = 8
"""Number of bands that the map is cut into; the largest ε is at most the map's length over this number."""
DIRECTIONS = 8
"""Number of directions in which the map is cut into bands."""
_CELLS = 6 * BANDS
"""Bands are made of cells; this is the largest number of cells along each side."""

Counts = NDArray[np.int64]


@dataclass(frozen=True, kw_only=True, eq=False)
class UncertaintyExponent:
    """How the fraction of uncertain pixels falls with ε."""

    alpha: float
    """Slope of ln f against ln ε, by least squares; 1 for a smooth boundary, less for a fractal one."""
    low: float
    """Lower end of the confidence interval of the slope at these ε."""
    high: float
    """Upper end. The interval is unbounded where one band holds every uncertain pixel of some ε."""
    epsilons: NDArray[np.int64]
    """ε, (n,) [pixels]."""
    fractions: Array
    """f(ε), (n,)."""
    local: Array
    """Slopes between neighbouring ε, (n - 1,); equal where f is a power of ε."""


def uncertainty_exponent(
    outcomes: ArrayLike, *, along: Literal["x", "y"], epsilons: Sequence[int], confidence: float = 0.95
) -> UncertaintyExponent | None:
    """Measure α in f(ε) ~ ε^α (section 5.2).

    C. Grebogi, S. W. McDonald, E. Ott, J. A. Yorke, Phys. Lett. A 99, 415 (1983); S. W. McDonald, C. Grebogi,
    E. Ott, J. A. Yorke, Physica D 17, 125 (1985). A pixel is uncertain when either of the two at the distance
    ε along the axis has another outcome. Pixels for which one of the three is undecided or outside are left
    out.

    ε must be small against the stripes: beyond, f levels off, and a smooth boundary too has a slope below 1.
    `local` then rises towards 1 with falling ε; for a fractal boundary it stays. Stripes narrower than a
    pixel give a slope near 0 whatever the boundary is: only a finer map distinguishes these.

    The interval is a jackknife's: the map is cut into `BANDS` parallel bands, the slope is taken without each
    in turn, and Student's t gives the half width. What spans the map in some direction makes only the bands
    along it independent; therefore `DIRECTIONS` directions of bands are tried, and the widest interval is
    given. It says how far the slope would change in a like map with other boundaries, not the bias of too
    large an ε. It holds the slope at least as often as asked where no structure is longer than a band, and
    less often where curved stripes span the map: tests/compare/test_uncertainty.py measures how often.

    Args:
        outcomes: the map, (y, x).
        along: the axis; boundaries parallel to it are not seen.
        epsilons: increasing, each at least 1, the largest at most a `BANDS`-th of the map's length [pixels].
        confidence: probability with which the interval is to hold the slope.

    Returns:
        None where no pixel is uncertain at some ε.

    Raises:
        ValueError: for such ε or such a confidence as is not accepted.
    """
    codes = measured(outcome_map(outcomes))
    lines = codes if along == "x" else codes.T
    distances = _checked(epsilons, lines.shape[1])
    if not 0 < confidence < 1:
        raise ValueError(f"confidence: {confidence}, accepted: between 0 and 1")
    counted = [_count(lines, distance) for distance in distances]
    uncertain, known = (np.array(counts) for counts in zip(*counted, strict=True))
    if not uncertain.any(axis=(1, 2)).all():
        return None
    f = uncertain.sum(axis=(1, 2)) / known.sum(axis=(1, 2))
    alpha = float(_slope(distances, f))
    error = max(_jackknife_error(distances, uncertain, known, band) for band in _bands(known.shape[1:]))
    reach = float(t.ppf((1 + confidence) / 2, BANDS - 1)) * error
    return UncertaintyExponent(
        alpha=alpha,
        low=alpha - reach,
        high=alpha + reach,
        epsilons=distances,
        fractions=f,
        local=np.diff(np.log(f)) / np.diff(np.log(distances)),
    )


def _checked(epsilons: Sequence[int], length: int) -> NDArray[np.int64]:
    distances = np.asarray(epsilons)
    most = length // BANDS
    if (
        distances.ndim != 1
        or len(distances) < 2
        or not np.issubdtype(distances.dtype, np.integer)
        or distances[0] < 1
        or np.any(np.diff(distances) <= 0)
        or distances[-1] > most
    ):
        raise ValueError(
            f"epsilons: {list(epsilons)}, accepted: two or more increasing whole numbers from 1 to {most}, "
            f"1/{BANDS} of the map's length"
        )
    return distances.astype(np.int64)


def _count(lines: OutcomeCodes, distance: int) -> tuple[Counts, Counts]:
    """Count the uncertain pixels and those known to be so or not, in each cell."""
    centre, before, after = lines[:, distance:-distance], lines[:, : -2 * distance], lines[:, 2 * distance :]
    inside = np.s_[:, distance:-distance]
    known, uncertain = np.zeros(lines.shape, dtype=bool), np.zeros(lines.shape, dtype=bool)
    known[inside] = np.all([part != Outcome.UNDECIDED for part in (centre, before, after)], axis=0)
    uncertain[inside] = known[inside] & ((centre != before) | (centre != after))
    return _in_cells(uncertain), _in_cells(known)


def _in_cells(flags: NDArray[np.bool_]) -> Counts:
    for axis, n in enumerate(flags.shape):
        starts = np.linspace(0, n, min(n, _CELLS), endpoint=False).astype(int)
        flags = np.add.reduceat(flags, starts, axis=axis, dtype=np.int64)
    return flags.astype(np.int64)


def _bands(shape: tuple[int, ...]) -> Iterator[NDArray[np.int64]]:
    """Return the number of the band in which each cell lies, for one direction after the other."""
    row, column = np.indices(shape)
    for angle in np.arange(DIRECTIONS) * np.pi / DIRECTIONS:
        across = np.cos(angle) * column / shape[1] + np.sin(angle) * row / shape[0]
        # Rounded, that cells on one line across are distinguished only by their order.
        order = np.argsort(np.round(across, 9), axis=None, kind="stable")
        band = np.empty(row.size, dtype=np.int64)
        band[order] = np.arange(row.size) * BANDS // row.size
        yield band.reshape(shape)


def _jackknife_error(
    distances: NDArray[np.int64], uncertain: Counts, known: Counts, band: NDArray[np.int64]
) -> float:
    """Return the standard error of the slope from the slopes without each band in turn."""
    inside = [band == number for number in range(BANDS)]
    u, k = (
        counts.sum(axis=(1, 2)) - np.array([counts[:, part].sum(axis=1) for part in inside])
        for counts in (uncertain, known)
    )
    if not u.all():
        return np.inf
    return float(np.sqrt((BANDS - 1) * np.var(_slope(distances, u / k))))


def _slope(distances: NDArray[np.int64], f: Array) -> Array:
    """Return the least-squares slope of ln f, (..., n), against the log of the distances, (n,)."""
    x = np.log(distances)
    x -= x.mean()
    return np.log(f) @ x / (x @ x)
