"""The share f(ε) of tosses that an accuracy ε leaves uncertain, to any ε, by branching.

At ε = 1e-24 m too few tosses are uncertain to be met by chance. So intervals of release are cut into ten
parts, time and again. A part dies where the tosses from its ends never part: the same rim points touch, the
same face is up, and at every impact they are close. Between them no outcome changes. Of the parts that live
a number goes on, each by a draw of its own, with a weight of one over its chance. So f is without bias at
every ε whatever the chances are, which decide its scatter alone (H. Kahn, T. E. Harris, 1951).

A part holds the more boundaries the more energy is left where its ends part. Most tosses have little, and
make f at this ε; few have much, and make f at ε that are many decades smaller. So some of the places are
shared by weight alone, some with preference for energy, and some among parts whose ends differ in outcome,
for a landing that is exactly flat parts tosses, too, and often to no effect.
"""

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.precision.double_double import pair_of
from cointoss_reproduction.precision.planar_coin import PlanarCoin
from cointoss_reproduction.precision.planar_state import spread
from cointoss_reproduction.precision.planar_toss import toss_many

PARTS = 10
GROUPS = 10
"""Of ancestors; what is found of one does not depend on the others, so they show how sure a number is."""
PREFERENCES = (0, 2, 5)
"""Powers of the energy that is left; each has an equal share of the places, and so have different ends."""
LITTLE = 1.0
"""Energy left below which a part is preferred no less [m g r]; nothing diverges below it."""
EARLY = (4, 4, 3, 3, 2, 2)
"""How many times the population there is at the first levels: most of the scatter comes of ancestors."""
NEAR = 1e-3
"""A coin this near stands or lands flat [m g r, rad]."""
NARROWEST = 1e-28
"""Two releases this far apart are taken for the sides of a boundary [the state's unit]."""


@dataclass(frozen=True, kw_only=True)
class Branches:
    """What the branching finds by group of ancestors at each ε, the largest first."""

    shares: Array
    """f, (GROUPS, n); over `whole` it scatters less where nearly all tosses are uncertain."""
    whole: Array
    """All weight, that of the dead parts too, which is 1 on average, (GROUPS, n)."""
    parted: Array
    """Share of the tosses that part from one ε away, (GROUPS, n)."""
    energy: Array
    """That is left where they part, times this share [m g r], (GROUPS, n)."""
    boundaries: NDArray[np.int64]
    """Boundaries that were drawn by weight among those of all groups, and resolved, (GROUPS, n)."""
    flat: NDArray[np.int64]
    """Those of them at which a coin lands flat, not one that stands, (GROUPS, n)."""
    tosses: int
    undecided: int


@dataclass(frozen=True)
class Expanded:
    """Intervals of release cut into parts, and what the tosses from their ends do."""

    points: Array
    """Releases, (n, PARTS + 1, 5, 2)."""
    outcomes: NDArray[np.int8]
    """Theirs, (n, PARTS + 1)."""
    lives: NDArray[np.bool_]
    """Whether the tosses from the ends of a part have parted, (n, PARTS)."""
    energy: Array
    """That is left where they part, (n, PARTS) [m g r]."""

    @property
    def differs(self) -> NDArray[np.bool_]:
        """Whether the ends of a part have different outcomes, (n, PARTS)."""
        return self.outcomes[:, 1:] != self.outcomes[:, :-1]

    @property
    def uncertain(self) -> Array:
        """Share of the inner releases one of whose neighbours has another outcome, (n,)."""
        return (self.differs[:, 1:] | self.differs[:, :-1]).mean(axis=1)


def branch(
    coin: PlanarCoin,
    starts: Array,
    *,
    row: int,
    largest: Fraction,
    levels: int,
    population: int,
    rng: np.random.Generator,
    followed: int = 0,
) -> Branches:
    """Estimate f(ε) for ε = `largest` and every tenth of it.

    A toss is uncertain when a release that is ε more or ε less has another outcome.

    Args:
        coin: the coin.
        starts: releases drawn at random, the ancestors, (n, 5, 2).
        row: of the state: what varies.
        largest: ε [its unit in the state].
        levels: how many ε.
        population: intervals that go on at each level, about; more at the first levels.
        rng: draws them.
        followed: boundaries that are followed at each level.
    """
    parents, group = starts.copy(), np.arange(len(starts)) % GROUPS
    weights = GROUPS / np.full(len(parents), float(len(parents)))
    shares, whole, parted, energies, boundaries, flat = np.zeros((6, GROUPS, levels))
    tosses, undecided, dead = 0, 0, np.zeros(GROUPS)
    for level in range(levels):
        step = largest / PARTS**level
        made = expand(coin, parents, row, step)
        tosses, undecided = tosses + made.outcomes.size, undecided + int(np.sum(made.outcomes == 0))
        shares[:, level] = _by_group(group, weights * made.uncertain)
        whole[:, level] = _by_group(group, weights) + dead
        weights, group = np.repeat(weights / PARTS, PARTS), np.repeat(group, PARTS)
        low, lives, differs = (
            made.points[:, :-1].reshape(-1, *starts.shape[1:]),
            made.lives.ravel(),
            made.differs.ravel(),
        )
        if followed and differs.any():
            chance = weights * differs
            drawn = rng.choice(len(low), followed, p=chance / chance.sum())
            stands, lands = what_lies_there(coin, low[drawn], row, step)
            boundaries[:, level] = _by_group(group[drawn], stands | lands)
            flat[:, level] = _by_group(group[drawn], lands)
        dead += _by_group(group[~lives], weights[~lives])
        parents, group, weights, differs = low[lives], group[lives], weights[lives], differs[lives]
        energy = made.energy.ravel()[lives]
        parted[:, level], energies[:, level] = _by_group(group, weights), _by_group(group, weights * energy)
        if len(parents) == 0:
            whole[:, level + 1 :] = dead[:, None]
            break
        here = population * (EARLY[level] if level < len(EARLY) else 1)
        chance = chances(_scores(weights, energy, differs), here)
        goes_on = rng.random(len(chance)) < chance
        parents, group, weights = parents[goes_on], group[goes_on], weights[goes_on] / chance[goes_on]
    return Branches(
        shares=shares,
        whole=whole,
        parted=parted,
        energy=energies,
        boundaries=boundaries.astype(np.int64),
        flat=flat.astype(np.int64),
        tosses=tosses,
        undecided=undecided,
    )


def _by_group(group: NDArray[np.intp], numbers: Array | NDArray[np.bool_] | None = None) -> Array:
    """Return the sum of numbers, or how many there are, by group, (n,) to (GROUPS,)."""
    return np.bincount(group, numbers, GROUPS).astype(float)


def expand(coin: PlanarCoin, parents: Array, row: int, step: Fraction) -> Expanded:
    """Cut intervals into parts and toss from their ends.

    Args:
        coin: the coin.
        parents: lower ends, (n, 5, 2).
        row: of the state: what varies.
        step: length of a part [its unit in the state].
    """
    points = spread(parents, row, pair_of(step), PARTS + 1)
    ends = toss_many(coin, points)
    outcomes = ends.outcome.reshape(-1, PARTS + 1)
    itineraries, left = ends.itinerary.reshape(-1, PARTS + 1), ends.left.reshape(-1, PARTS + 1)
    parted = (left[:, 1:] > 0) | (itineraries[:, 1:] != itineraries[:, :-1])
    return Expanded(
        points=points.reshape(-1, PARTS + 1, *points.shape[1:]),
        outcomes=outcomes,
        lives=parted | (outcomes[:, 1:] != outcomes[:, :-1]),
        energy=np.maximum(left[:, 1:], LITTLE),
    )


def what_lies_there(
    coin: PlanarCoin, low: Array, row: int, width: Fraction
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return whether at a boundary in each interval lies a coin that stands, and one that lands flat, (n,).

    The boundary is found by bisection. The tosses at its sides come as near to standing, or to landing flat,
    as they have been stretched apart; where that is not near neither is known.

    Args:
        coin: the coin.
        low: lower ends of intervals whose ends have different outcomes, (n, 5, 2).
        row: of the state: what varies.
        width: of the intervals [its unit in the state].
    """
    low, outcome = low.copy(), toss_many(coin, low).outcome
    while width > NARROWEST:
        width /= 2
        middle = spread(low, row, pair_of(width), 2)[1::2]
        same = toss_many(coin, middle).outcome == outcome
        low[same] = middle[same]
    sides = toss_many(coin, spread(low, row, pair_of(width), 2), to_contact=True)
    nearest = np.where(np.isnan(sides.from_upright), np.inf, sides.from_upright)
    lands = (sides.flattest < np.minimum(nearest, NEAR)).reshape(-1, 2)
    stands = (nearest < np.minimum(sides.flattest, NEAR)).reshape(-1, 2)
    return stands[:, 0] & stands[:, 1], lands[:, 0] & lands[:, 1]


def _scores(weights: Array, energy: Array, differs: NDArray[np.bool_]) -> Array:
    """Return the sum of the shares in the weight, each time with another preference."""
    preferred = [*(weights * energy**power for power in PREFERENCES), weights * differs]
    return np.sum([each / each.sum() for each in preferred if each.any()], axis=0)


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
