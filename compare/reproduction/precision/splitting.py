"""The share f(ε) of tosses that an accuracy ε leaves uncertain, to any ε, by multilevel splitting.

At ε = 1e-24 m too few tosses are uncertain to be met by chance. So intervals of release are cut into ten,
time and again, and those go on that may hold a boundary. What is left out is left out by a draw, and counted
by weight, so that the share at every level is unbiased (M. Villén-Altamirano, J. Villén-Altamirano, 1991).
Of parts whose ends have one outcome and one itinerary few go on: a pair of boundaries may hide in them.

How many boundaries lie in an interval depends on the energy that is left where tosses from its ends diverge:
most are in the few intervals where that is large. Those go on with preference, or a run would miss them.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.reproduction.precision.double_double import Pair, add, pair_of, scale
from cointoss.compare.reproduction.precision.planar_coin import PlanarCoin
from cointoss.compare.reproduction.precision.planar_state import part, put
from cointoss.compare.reproduction.precision.planar_toss import toss_many
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import Array

PARTS = 10
DIFFERENT, WANDERING, ALIKE = 0, 1, 2
PLACES = (0.6, 0.25, 0.15)
"""How the population is shared among parts whose ends differ in outcome, in itinerary only, in neither."""
PREFERENCE = 3
"""Of parts whose ends differ those go on in proportion to this power of the energy that is left."""
LITTLE = 0.1
"""Energy left below which a part is preferred no less [m g r]; nothing diverges below 1."""


@dataclass(frozen=True, kw_only=True)
class Replica:
    """One run of the splitting."""

    shares: Array
    """f at each ε, the largest first, (n,)."""
    hidden: Array
    """The part of it that comes of intervals whose ends were alike, (n,)."""
    tosses: int
    undecided: int

    @property
    def largest_hidden(self) -> float:
        """The largest part of any f that came of intervals whose ends were alike."""
        seen = self.shares > 0
        return float(np.max(self.hidden[seen] / self.shares[seen], initial=0.0))


def replica(
    coin: PlanarCoin,
    starts: Array,
    *,
    row: int,
    largest: Fraction,
    levels: int,
    population: int,
    rng: np.random.Generator,
) -> Replica:
    """Estimate f(ε) for ε = `largest` and every tenth of it.

    A toss is uncertain when a release that is ε more or ε less has another outcome.

    Args:
        coin: the coin.
        starts: releases drawn at random, (n, 5, 2).
        row: of the state: what varies.
        largest: ε [its unit in the state].
        levels: how many ε.
        population: intervals that go on at each level, about.
        rng: draws them.
    """
    parents = starts.copy()
    weights, alike = np.full(len(parents), 1 / len(parents)), np.zeros(len(parents), dtype=bool)
    shares, hidden, tosses, undecided = np.zeros(levels), np.zeros(levels), 0, 0
    for level in range(levels):
        if len(parents) == 0:
            break
        points = spread(parents, row, pair_of(largest / PARTS**level), PARTS + 1)
        ends = toss_many(coin, points)
        outcome, itinerary = (codes.reshape(-1, PARTS + 1) for codes in (ends.outcome, ends.itinerary))
        left = ends.left.reshape(-1, PARTS + 1)[:, 1:]
        tosses, undecided = tosses + outcome.size, undecided + int(np.sum(outcome == 0))
        differs = outcome[:, 1:] != outcome[:, :-1]
        uncertain = (differs[:, 1:] | differs[:, :-1]).mean(axis=1)
        shares[level] = weights @ uncertain
        hidden[level] = weights[alike] @ uncertain[alike]
        wanders = itinerary[:, 1:] != itinerary[:, :-1]
        kind = np.where(differs, DIFFERENT, np.where(wanders, WANDERING, ALIKE)).ravel()
        weights = np.repeat(weights / PARTS, PARTS)
        chance = chances(_scores(weights, kind, left.ravel()), population)
        goes_on = rng.random(len(chance)) < chance
        parents = points.reshape(-1, PARTS + 1, *points.shape[1:])[:, :-1].reshape(-1, *points.shape[1:])
        parents, weights = parents[goes_on], weights[goes_on] / chance[goes_on]
        alike = (kind == ALIKE)[goes_on]
    return Replica(shares=shares, hidden=hidden, tosses=tosses, undecided=undecided)


def _scores(weights: Array, kind: NDArray[np.intp], energy: Array) -> Array:
    """Return weights times what is preferred, scaled so that each kind has its share of `PLACES`."""
    preferred = weights * np.where(kind == ALIKE, 1.0, np.maximum(energy, LITTLE) ** PREFERENCE)
    whole = np.bincount(kind, preferred, len(PLACES))
    return preferred * (np.array(PLACES) / np.where(whole > 0, whole, 1))[kind]


def chances(scores: Array, population: int) -> Array:
    """Return min(1, score/τ) with τ such that the chances sum to the population; all 1 where they are few."""
    if len(scores) <= population:
        return np.ones(len(scores))
    ordered = np.sort(scores)[::-1]
    rest = np.cumsum(ordered[::-1])[::-1]
    kept = np.arange(population)
    # With the first k kept for sure the others share what is left.
    tau = rest[:population] / (population - kept)
    k = int(np.flatnonzero(ordered[:population] <= tau)[0])
    return np.minimum(1.0, scores / tau[k])


def spread(starts: Array, row: int, step: tuple[float, float], points: int) -> NDArray[np.float64]:
    """Return releases in steps from each of `starts`, (n points, 5, 2)."""
    spread_out = np.repeat(starts, points, axis=0)
    _spread(spread_out, row, step, points)
    return spread_out


@compiled
def _spread(states: Array, row: int, step: Pair, points: int) -> None:
    for i in range(len(states)):
        put(states[i], row, add(part(states[i], row), scale(step, float(i % points))))
