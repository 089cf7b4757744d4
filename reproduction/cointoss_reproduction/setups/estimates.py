"""Estimates of means, quantiles and quotients from random samples, with their confidence intervals."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.stats import norm, quantile_test, t

from cointoss.study import LEVEL, Array, Estimate, share_of

FEWEST = 20
"""The fewest values of a sample whose median is compared by a bootstrap."""
PARTS = 20
"""The number of parts of a sample that `jackknife` leaves out in turn."""


def mean_share(shares: ArrayLike, counted: str = "tosses") -> Estimate:
    """Return the mean of shares, with Student's interval, or Wilson's where all are the same.

    Wilson's is no narrower: shares scatter at most as much as yes-or-no answers with the same mean.

    Args:
        shares: of a sample, (n,).
        counted: what the sample is of.
    """
    values = np.asarray(shares, dtype=float)
    if values.size and np.ptp(values) > 0:
        return mean(values, counted)
    total = float(values.sum())
    fewer, more = (share_of(int(met), values.size, counted) for met in (np.floor(total), np.ceil(total)))
    return Estimate(float(values[0]) if values.size else np.nan, fewer.low, more.high, values.size, counted)


def mean(values: ArrayLike, counted: str = "tosses") -> Estimate:
    """Return the mean of what a sample was drawn from, with Student's interval.

    Args:
        values: of the sample, (n,).
        counted: what the sample is of.
    """
    drawn = np.asarray(values, dtype=float)
    error = drawn.std(ddof=1) / len(drawn) ** 0.5
    return _about(float(drawn.mean()), t.ppf((1 + LEVEL) / 2, len(drawn) - 1) * error, len(drawn), counted)


def difference(first: ArrayLike, second: ArrayLike, counted: str = "tosses") -> Estimate:
    """Return the mean of one sample less that of another, drawn apart from it, with Welch's interval.

    Args:
        first: values of the one, (n,).
        second: values of the other, (m,).
        counted: what the samples are of.
    """
    samples = [np.asarray(values, dtype=float) for values in (first, second)]
    spread = [drawn.var(ddof=1) / len(drawn) for drawn in samples]
    error = sum(spread) ** 0.5
    count = min(map(len, samples))
    value = float(samples[0].mean() - samples[1].mean())
    return _about(value, norm.ppf((1 + LEVEL) / 2) * error, count, counted)


def jackknife(
    statistic: Callable[[NDArray[np.bool_]], float], count: int, counted: str = "tosses", parts: int = PARTS
) -> Estimate:
    """Return a statistic of a sample, with the interval of a jackknife over parts of it.

    Args:
        statistic: of the members that a mask over the sample keeps, (n,) of bool.
        count: n, size of the sample; its order must be random.
        counted: what the sample is of.
        parts: of the sample, each left out in turn.
    """
    part = np.arange(count) % parts
    without: Array = np.array([statistic(part != left_out) for left_out in range(parts)])
    error = ((parts - 1) * without.var()) ** 0.5
    value = statistic(np.ones(count, dtype=bool))
    return _about(value, t.ppf((1 + LEVEL) / 2, parts - 1) * error, count, counted)


def quantile(values: ArrayLike, part: float, counted: str = "tosses") -> Estimate:
    """Return the number below which a part of all values lies, with the interval of order statistics.

    The interval needs no assumption on their distribution; it is open, to infinity, where the sample is too
    small for an end.

    Args:
        values: of the sample, (n,); some may be infinite.
        part: of all values, in (0, 1).
        counted: what the sample is of.
    """
    ordered = np.sort(np.asarray(values, dtype=float))
    ends = quantile_test(ordered, p=part).confidence_interval(LEVEL)
    low, high = np.where(np.isnan(ends), (-np.inf, np.inf), ends)
    value = ordered[min(int(np.ceil(part * len(ordered))), len(ordered)) - 1]
    return Estimate(float(value), float(low), float(high), len(ordered), counted)


def ratio_of_medians(
    first: Array, second: Array, rng: np.random.Generator, counted: str = "tosses"
) -> Estimate:
    """Return the median of one sample over that of another, with the interval of a bootstrap of both.

    Of fewer than `FEWEST` values a bootstrap knows too little: the interval is all that a ratio can be.
    """
    count = min(len(first), len(second))
    if count < FEWEST:
        value = float(np.median(first) / np.median(second)) if count else np.nan
        return Estimate(value, 0.0, np.inf, count, counted)
    drawn = [np.median(rng.choice(one, (1000, len(one))), axis=1) for one in (first, second)]
    low, high = np.quantile(drawn[0] / drawn[1], [(1 - LEVEL) / 2, (1 + LEVEL) / 2])
    value = float(np.median(first) / np.median(second))
    return Estimate(value, float(low), float(high), count, counted)


def quotient(first: Estimate, second: Estimate) -> Estimate:
    """Return one positive quantity over another, estimated apart from it, with an interval of its logarithm.

    The errors of both logarithms add as squares. Any quotient is possible where one of the values is 0, or
    one of the samples is empty.
    """
    if not (first.value > 0 and second.value > 0):
        return Estimate(np.nan, 0.0, np.inf, first.count, first.counted)
    value = first.value / second.value
    errors = [np.log(np.array([one.low, one.high]) / one.value) for one in (first, second)]
    below, above = np.hypot(errors[0][0], errors[1][1]), np.hypot(errors[0][1], errors[1][0])
    count = min(first.count, second.count)
    return Estimate(value, float(value * np.exp(-below)), float(value * np.exp(above)), count, first.counted)


def scatter_of_shares(shares: Array, counts: ArrayLike) -> float:
    """Return the root of the mean square of p - 1/2 over groups, less what counting adds.

    Args:
        shares: of each group's tosses, (n,).
        counts: tosses of each group, (n,) or the same for all.
    """
    by_chance = shares * (1 - shares) / (np.asarray(counts) - 1)
    return float(np.sqrt(max(np.mean((shares - 1 / 2) ** 2 - by_chance), 0)))


def _about(value: float, half: float, count: int, counted: str) -> Estimate:
    return Estimate(value, value - float(half), value + float(half), count, counted)
