"""The probability of the same side, as it is distributed over people, fitted to how often each had it."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq, minimize, minimize_scalar
from scipy.special import betaln, logsumexp
from scipy.stats import binom, chi2, halfnorm

from cointoss.compare.flips.counts import Flips
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import LEVEL
from cointoss.models.hand import same_side_probability
from cointoss.models.records import Array

PANELS, ORDER = 150, 8
"""Panels of the quadrature over people by Gauss and Legendre before any is halved, and its order in each."""
HALVINGS = 60
"""The most halvings of a panel, toward a jump of p."""
SCANNED = 30
"""Spreads that are tried where p is simulated, so that its likelihood may have several peaks."""
DROP = float(chi2.ppf(LEVEL, 1)) / 2
"""How far the logarithm of the likelihood falls from its largest value to the ends of an interval."""
_LEAST = 1e-12
_TOLERANCE = 1e-7
"""The tolerance of a search for the largest likelihood: of the parameters, which are below 1, and of the
logarithm."""


@dataclass(frozen=True)
class SameSide:
    """How likely the side that was up at the release comes up, as a function of |90° - ψ|."""

    probability: Callable[[Array], Array]
    """The probability for angles from 0 to 90°, (n,) [rad] to (n,)."""
    tosses: float = math.inf
    """Simulated tosses behind each probability; infinite for a closed form."""


CAUGHT = SameSide(lambda off: same_side_probability(np.pi / 2 - off))
"""A coin that a hand catches after many turns (Diaconis, Holmes and Montgomery 2007)."""


@dataclass(frozen=True)
class People:
    """A family of distributions of p, the probability of the same side, over people."""

    latent: Any
    """The distribution of a number that each person has, of `scipy.stats`."""
    ends: tuple[float, float]
    """The ends between which all but 1e-25 of the distribution lies."""
    probability: Callable[[Array, Array], Array]
    """p, from the parameters and that number, (n,) to (n,)."""
    start: tuple[float, ...]
    """Where the search for the parameters begins; the first is a spread, and not negative."""
    largest: float = 1.0
    """The largest spread."""
    tosses: float = math.inf
    """Simulated tosses behind each probability; infinite for a closed form."""


@dataclass(frozen=True)
class PeopleFit:
    """A distribution of p over people, fitted by maximum likelihood."""

    people: People
    parameters: Array
    log_likelihoods: Array
    """Logarithm of each person's likelihood, but for what depends on the counts alone, (n,)."""

    @property
    def log_likelihood(self) -> float:
        """The logarithm of the likelihood of all people."""
        return float(self.log_likelihoods.sum())


def wobbling(side: SameSide) -> People:
    """Return people whose |90° - ψ| is half-normal; the parameter is the root of its mean square [rad]."""
    return People(
        halfnorm(),
        (0.0, 11.0),
        lambda parameters, off: side.probability(np.minimum(parameters[0] * off, np.pi / 2)),
        start=(0.2,),
        largest=np.pi / 2,
        tosses=side.tosses,
    )


def log_binomial(same: ArrayLike, flips: ArrayLike, p: ArrayLike, tosses: float = math.inf) -> Array:
    """Return the logarithm of the likelihood of counts, but for what depends on these; arrays broadcast.

    A simulated p is known as well as its tosses let it: its posterior distribution is a beta distribution
    (Jeffreys), so the counts are beta-binomial.

    Args:
        same: how often the same side came up.
        flips: all flips.
        p: the probability of the same side.
        tosses: behind each p.
    """
    up, other = np.asarray(same), np.asarray(flips) - np.asarray(same)
    q = np.clip(np.asarray(p, dtype=float), _LEAST, 1 - _LEAST)
    if math.isinf(tosses):
        return np.asarray(up * np.log(q) + other * np.log1p(-q))
    a, b = tosses * q + 1 / 2, tosses * (1 - q) + 1 / 2
    return np.asarray(betaln(up + a, other + b) - betaln(a, b))


def log_likelihoods(flips: Flips, people: People, parameters: Array) -> Array:
    """Return the logarithm of the likelihood of each person's counts, but for what depends on these, (n,).

    Args:
        flips: the counts.
        people: whose integral over the latent number it is.
        parameters: of the family.
    """
    latent, weights = quadrature(people, parameters, int(flips.flips.max()))
    p = people.probability(parameters, latent)
    of_latent = people.latent.logpdf(latent) + np.log(weights)
    of_counts = log_binomial(flips.same[:, None], flips.flips[:, None], p, people.tosses)
    return np.asarray(logsumexp(of_counts + of_latent, axis=1))


def quadrature(people: People, parameters: Array, flips: int) -> tuple[Array, Array]:
    """Return the nodes of the quadrature over the latent number, and their weights, (m,) each.

    Panels are halved until none is wider than two standard deviations of any likelihood of a person. These
    are equal in asin √p: 1/(2 √flips).

    Args:
        people: over whom.
        parameters: of the family.
        flips: of one person at most.
    """

    def turned(latent: Array) -> Array:
        return np.arcsin(np.sqrt(np.clip(people.probability(parameters, latent), 0, 1)))

    widest = (1 / max(flips, 1) + 1 / people.tosses) ** 0.5
    edges = np.linspace(*people.ends, PANELS + 1)
    for _ in range(HALVINGS):
        middles = (edges[:-1] + edges[1:]) / 2
        at_edges, at_middles = turned(edges), turned(middles)
        passed = np.abs(at_middles - at_edges[:-1]) + np.abs(at_edges[1:] - at_middles)
        if not (wide := passed > widest).any():
            break
        edges = np.sort(np.append(edges, middles[wide]))
    x, weights = leggauss(ORDER)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + x)).ravel(), (half * weights).ravel()


def fit_people(flips: Flips, people: People) -> PeopleFit:
    """Return the distribution of a family under which the counts are most likely."""

    def likelihood(x: Array) -> float:
        return float(log_likelihoods(flips, people, x).sum())

    start = people.start
    if not math.isinf(people.tosses):
        spreads = np.linspace(0.0, people.largest, SCANNED + 1)[1:]
        start = max(((spread, *start[1:]) for spread in spreads), key=lambda x: likelihood(np.array(x)))
    found = _most_likely(
        likelihood,
        start,
        [(0.0, people.largest)] + [(0.0, 1.0)] * (len(people.start) - 1),
    )
    return PeopleFit(people, found, log_likelihoods(flips, people, found))


def _most_likely(
    log_likelihood: Callable[[Array], float], start: tuple[float, ...], bounds: list[tuple[float, float]]
) -> Array:
    return minimize(
        lambda x: -log_likelihood(x),
        x0=start,
        bounds=bounds,
        method="Nelder-Mead",
        options={"xatol": _TOLERANCE, "fatol": _TOLERANCE},
    ).x


def spread_interval(flips: Flips, found: PeopleFit) -> Array:
    """Return the interval of the first parameter by the likelihood ratio, the others at their best, (2,).

    An end is 0, or the largest spread, where the likelihood is not small there.
    """
    best, rest = found.parameters[0], tuple(found.parameters[1:])

    def above(spread: float) -> float:
        def at(others: Array) -> float:
            return log_likelihoods(flips, found.people, np.array([spread, *others])).sum()

        others = _most_likely(at, rest, [(0.0, 1.0)] * len(rest)) if rest else np.array([])
        return float(at(others) - found.log_likelihood) + DROP

    steps = 1 if math.isinf(found.people.tosses) else SCANNED
    return np.array([crossing(above, best, end, steps) for end in (0.0, found.people.largest)])


def crossing(above: Callable[[float], float], inner: float, outer: float, steps: int = 1) -> float:
    """Return where a function falls below 0 on its way outwards; the outer end where it does not.

    Args:
        above: not negative at the inner end.
        inner: the inner end.
        outer: the outer end.
        steps: in which a function that may fall several times is followed inwards, to its last fall.
    """
    places = np.linspace(outer, inner, steps + 1).tolist()
    last = next(i for i, at in enumerate(places) if at == inner or above(at) >= 0)
    root: Any = outer if last == 0 else brentq(above, places[last], places[last - 1], xtol=1e-6)
    return float(root)


def estimate_of(same: int, flips: int, side: SameSide, tried: Array) -> Estimate:
    """Return the argument of `side` that is most likely, with the interval by the likelihood ratio.

    It is NaN where the interval has all that was tried. The likelihood may have several peaks.

    Args:
        same: how often the same side came up.
        flips: all flips.
        side: how likely it is.
        tried: rising arguments at which the likelihood is tried first, (n,).
    """

    def likelihood(arguments: Array) -> Array:
        return log_binomial(same, flips, side.probability(arguments), side.tosses)

    def at(value: float) -> float:
        return float(likelihood(np.array([value]))[0])

    values = likelihood(tried)
    top = int(np.argmax(values))
    near = tried[max(top - 1, 0)], tried[min(top + 1, len(tried) - 1)]
    refined: Any = minimize_scalar(lambda value: -at(value), bounds=near, method="bounded")
    best = float(refined.x) if -refined.fun > values[top] else float(tried[top])
    least, places = at(best) - DROP, np.unique([*tried, best])
    inside = np.flatnonzero(likelihood(places) >= least)
    around = np.pad(places, 1, mode="edge")[[inside[0], inside[-1] + 2]]
    low, high = (
        crossing(lambda value: at(value) - least, float(inner), float(outer))
        for inner, outer in zip(places[inside[[0, -1]]], around, strict=True)
    )
    return Estimate(math.nan if (low, high) == (tried[0], tried[-1]) else best, low, high, flips, "flips")


def chances_of_shares(flips: Flips, p: Array) -> dict[str, float]:
    """Return the chances of as few, or as many, flips with the first side up, at the p that favours this.

    Of several people the chances are those of their sum, and of the person who is farthest out.

    Args:
        flips: the counts.
        p: the probabilities that the model has, of any number.
    """
    people = len(flips.flips)
    same, count = (np.append(each, each.sum()) for each in (flips.same, flips.flips))
    tails = {"seldom": binom.cdf(same, count, p.min())}
    if p.max() < 1:
        tails["often"] = binom.sf(same - 1, count, p.max())
    chances: dict[str, float] = {}
    for how, tail in tails.items():
        chances[f"the first side came up too {how}"] = float(tail[-1])
        if people > 1:
            least = int(np.argmin(tail[:-1]))
            who = f"the first side came up too {how} for {flips.people[least]}"
            chances[who] = min(1.0, people * float(tail[least]))
    return chances


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
    """Return χ² of the counts against one p for all, (..., n) to (...); 0 where all are the same."""
    p = (same.sum(axis=-1) / flips.sum())[..., None]
    variance = flips * p * (1 - p)
    missed = np.divide((same - flips * p) ** 2, variance, where=variance > 0, out=np.zeros(same.shape))
    return missed.sum(axis=-1)
