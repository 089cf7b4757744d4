"""What 350,757 flips say of the angle ψ between a coin's normal and its angular momentum."""

import csv
from collections.abc import Callable
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray
from scipy.optimize import brentq, minimize
from scipy.special import logsumexp
from scipy.stats import chi2, expon, halfnorm, norm

from cointoss.study import LEVEL, Array, same_side_probability

PANELS, ORDER = 150, 8
"""Of the quadrature over people by Gauss and Legendre, and its order in each panel."""
_LEAST = 1e-12
_TOLERANCE = 1e-7
"""Of a search for the largest likelihood: of parameters, which are below 1, and of its logarithm."""


@dataclass(frozen=True)
class Flips:
    """Flips caught with the side up that was up at the release, and all, by person, (n,)."""

    heads_same: NDArray[np.int64]
    heads: NDArray[np.int64]
    """That started with heads up."""
    tails_same: NDArray[np.int64]
    tails: NDArray[np.int64]

    @property
    def same(self) -> NDArray[np.int64]:
        """Started with either side."""
        return self.heads_same + self.tails_same

    @property
    def flips(self) -> NDArray[np.int64]:
        """All."""
        return self.heads + self.tails


@dataclass(frozen=True)
class People:
    """A family of distributions of p, the probability of the same side, over people."""

    latent: Any
    """The distribution of a number that each person has, of `scipy.stats`."""
    ends: tuple[float, float]
    """Between which all but 1e-25 of it lies."""
    probability: Callable[[Array, Array], Array]
    """p, from the parameters and that number, (n,) to (n,)."""
    start: tuple[float, ...]
    """Where the search for the parameters begins; the first is a spread, and positive."""


@dataclass(frozen=True)
class PeopleFit:
    """A distribution of p over people, fitted by maximum likelihood."""

    people: People
    parameters: Array
    log_likelihoods: Array
    """By person, but for what depends on the counts alone, (n,)."""

    @property
    def log_likelihood(self) -> float:
        """Of all."""
        return float(self.log_likelihoods.sum())


def _wobbling(parameters: Array, off: Array) -> Array:
    return same_side_probability(np.pi / 2 - np.minimum(parameters[0] * off, np.pi / 2))


WOBBLING = People(halfnorm(), (0.0, 11.0), _wobbling, start=(0.2,))
"""|90° - ψ| is half-normal over people; its parameter is the root of its mean square [rad]."""
NORMAL = People(norm(), (-11.0, 11.0), lambda x, latent: x[1] + x[0] * latent, start=(0.01, 0.5))
"""p is normal, whatever made it; its parameters are its standard deviation and its mean."""
EXPONENTIAL = People(expon(), (0.0, 60.0), lambda x, latent: 0.5 + x[0] * latent, start=(0.01,))
"""p - 1/2 is exponential, whatever made it; its parameter is its mean."""


def read_flips() -> Flips:
    """Read the counts of Bartoš et al. (2025) that come with the package."""
    path = resources.files(__name__.rpartition(".")[0]) / "same_side_flips.csv"
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    column = {name: np.array([int(row[name]) for row in rows]) for name in rows[0]}
    return Flips(
        heads_same=column["heads_to_heads"],
        heads=column["heads_to_heads"] + column["heads_to_tails"],
        tails_same=column["tails_to_tails"],
        tails=column["tails_to_tails"] + column["tails_to_heads"],
    )


def log_likelihoods(flips: Flips, people: People, parameters: Array) -> Array:
    """Return the logarithm of the likelihood of each person's counts, but for what depends on these, (n,).

    Panels of the quadrature are narrower than any person's likelihood, wherever among all people that lies.

    Args:
        flips: the counts.
        people: whose integral over the latent number it is.
        parameters: of the family.
    """
    latent, weights = _nodes(people.ends)
    p = np.clip(people.probability(parameters, latent), _LEAST, 1 - _LEAST)
    same, other = flips.same[:, None], (flips.flips - flips.same)[:, None]
    of_latent = people.latent.logpdf(latent) + np.log(weights)
    return np.asarray(logsumexp(same * np.log(p) + other * np.log1p(-p) + of_latent, axis=1))


def _nodes(ends: tuple[float, float]) -> tuple[Array, Array]:
    """Return the nodes of the quadrature and their weights, (m,) each."""
    x, weights = leggauss(ORDER)
    edges = np.linspace(*ends, PANELS + 1)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + x)).ravel(), (half * weights).ravel()


def fit(flips: Flips, people: People) -> PeopleFit:
    """Return the distribution of a family under which the counts are most likely."""
    found = _most_likely(
        lambda x: log_likelihoods(flips, people, x).sum(),
        people.start,
        [(1e-4, 1.0)] + [(0.0, 1.0)] * (len(people.start) - 1),
    )
    return PeopleFit(people, found, log_likelihoods(flips, people, found))


def _most_likely(
    log_likelihood: Callable[[Array], float], start: tuple[float, ...], bounds: list[tuple[float, float]]
) -> Array:
    best = minimize(
        lambda x: -log_likelihood(x),
        x0=start,
        bounds=bounds,
        method="Nelder-Mead",
        options={"xatol": _TOLERANCE, "fatol": _TOLERANCE},
    )
    return best.x


def quantiles(people: People, parameters: Array, parts: Array) -> Array:
    """Return p below which parts of the people are, (n,) to (n,); p must grow with the latent number."""
    return people.probability(parameters, people.latent.ppf(parts))


def spread_of(found: PeopleFit) -> float:
    """Return the standard deviation of p over people."""
    latent, weights = _nodes(found.people.ends)
    of_latent = weights * found.people.latent.pdf(latent)
    p = found.people.probability(found.parameters, latent)
    return float(np.sqrt(of_latent @ (p - of_latent @ p) ** 2))


def interval(flips: Flips, found: PeopleFit) -> Array:
    """Return the interval of the first parameter by the likelihood ratio, the others at their best, (2,)."""
    best, rest = found.parameters[0], tuple(found.parameters[1:])
    least = found.log_likelihood - chi2.ppf(LEVEL, 1) / 2

    def above(spread: float) -> float:
        def at(others: Array) -> float:
            return log_likelihoods(flips, found.people, np.array([spread, *others])).sum()

        others = _most_likely(at, rest, [(0.0, 1.0)] * len(rest)) if rest else np.array([])
        return float(at(others) - least)

    return np.array([brentq(above, best, end, xtol=1e-6) for end in (best / 4, best * 4)])


def without(flips: Flips, person: int) -> Flips:
    """Return the counts of all but one person."""
    return Flips(*(np.delete(counts, person) for counts in vars(flips).values()))


def chance_of_spread(flips: Flips, found: PeopleFit, rng: np.random.Generator, draws: int = 4000) -> float:
    """Return how likely people as modelled differ among each other by as much as those who flipped.

    Args:
        flips: the counts.
        found: the model.
        rng: draws people.
        draws: how many times all of them.
    """
    latent = found.people.latent.rvs((draws, len(flips.flips)), random_state=rng)
    p = np.clip(found.people.probability(found.parameters, latent), 0, 1)
    drawn = _scatter(rng.binomial(flips.flips, p), flips.flips)
    return float((drawn >= _scatter(flips.same, flips.flips)).mean())


def _scatter(same: NDArray[np.int64], flips: NDArray[np.int64]) -> Array:
    """Return χ² of the counts against one p for all, (..., n) to (...)."""
    p = (same.sum(axis=-1) / flips.sum())[..., None]
    return ((same - flips * p) ** 2 / (flips * p * (1 - p))).sum(axis=-1)
