"""Estimates from random samples, with their confidence intervals."""

from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.stats import chi2_contingency, norm

from cointoss.compare.metrics.estimate import Estimate
from cointoss.models.records import Array

LEVEL = 0.99
"""The level of all confidence intervals: of a hundred verdicts one would be wrong by chance alone."""
Z = float(norm.ppf((1 + LEVEL) / 2))
"""Standard deviations of a normal interval of this level."""


def share(met: ArrayLike, counted: str = "tosses") -> Estimate:
    """Return the share of a sample that meets something, with Wilson's interval.

    Args:
        met: which of the sample do, (n,) of bool.
        counted: what the sample is of.
    """
    flags = np.asarray(met, dtype=bool)
    return share_of(int(flags.sum()), flags.size, counted)


def share_of(met: int, count: int, counted: str = "tosses") -> Estimate:
    """Return the share of a sample that meets something, from its number and that of all; see `share`.

    Of no sample it is NaN, and may be anything from 0 to 1.

    Raises:
        ValueError: for more that meet it than there are, or a negative number.
    """
    if not 0 <= met <= count:
        raise ValueError(f"met: {met}, accepted: a number from 0 to the count, {count}")
    value, low, high = (float(one) for one in wilson(met, count))
    return Estimate(value, low, high, count, counted)


def wilson(met: ArrayLike, count: ArrayLike) -> tuple[Array, Array, Array]:
    """Return shares of samples, and the ends of their intervals.

    They are those of E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209. Of no sample a share is NaN, and may be
    anything from 0 to 1.

    Args:
        met: how many of each sample meet something, of any shape.
        count: how many each has.
    """
    k, n = np.broadcast_arrays(np.asarray(met, dtype=float), np.asarray(count, dtype=float))
    with np.errstate(invalid="ignore", divide="ignore"):
        share = k / n
    middle, wide = (
        (k + Z**2 / 2) / (n + Z**2),
        Z * np.sqrt(k * (n - k) / np.maximum(n, 1) + Z**2 / 4) / (n + Z**2),
    )
    return share, np.where(k == 0, 0.0, middle - wide), np.where(k == n, 1.0, middle + wide)


def chance_alike(counts: ArrayLike) -> float:
    """Return the probability that counts of two samples differ by chance as much as these, by a χ² test.

    Args:
        counts: of each kind, by sample, (2, kinds).
    """
    met = np.asarray(counts)
    test: Any = chi2_contingency(met[:, met.any(axis=0)])
    return float(test.pvalue)


def in_words(found: Estimate, spec: str, factor: float = 1.0) -> str:
    """Return an estimate and its interval, all times a factor, each by a format as in ".1%"."""
    value, low, high = (f"{factor * x:{spec}}" for x in (found.value, found.low, found.high))
    return f"{value} [{low}, {high}]"


def percent(part: Estimate) -> str:
    """Return a share in per cent, with its interval."""
    digits = 3 if part.high < 0.01 else 2 if part.high < 0.1 else 1
    value, low, high = (f"{100 * one:.{digits}f}" for one in (part.value, part.low, part.high))
    return f"{value} % [{low}, {high}]"
