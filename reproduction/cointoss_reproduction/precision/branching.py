"""The share f(ε) of tosses that an accuracy ε leaves uncertain, to any ε, by branching.

At ε = 1e-24 m uncertain tosses are too rare to be found by chance. So intervals of release are cut into ten
parts, again and again. A part is dropped if the tosses from its two ends never diverge: the same rim points
touch, the same face is up, and at every impact they are close. Between such ends no outcome changes. Of the
other parts a number is drawn and followed further, each with a weight of one over its chance. So f has no
bias at any ε; the chances determine only its scatter (H. Kahn, T. E. Harris, 1951).

A part contains more boundaries if more energy is left when its ends diverge. Most tosses have little energy
left, and determine f at this ε; a few have much, and determine f at ε many decades smaller. So the parts to
follow are chosen in three ways: in proportion to their weight; with preference for energy; and among parts
whose ends differ in outcome, because an exactly flat landing also makes tosses diverge, often to no effect.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from itertools import compress, pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss.study import Array
from cointoss_reproduction.precision.planar_coin import PlanarCoin, PlanarRelease, Units
from cointoss_reproduction.precision.planar_numbers import energy_left, spread, toss_many

PARTS = 10
GROUPS = 20
"""The number of groups of ancestors, which are independent of each other and so give intervals."""
PREFERENCES = (0, 2, 5)
"""Powers of the energy that is left; each has an equal share of the places, and so have different ends."""
LITTLE = 1.0
"""Energy left below which a part is preferred no less [m g r]; nothing diverges below it."""
EARLY = (4, 4, 3, 3, 2, 2)
"""The factor by which the population is larger at the first levels: most of the scatter comes from
ancestors."""
NEAR = 1e-3
"""A coin this near stands or lands flat [m g r, rad]."""
NARROWEST = 1e-30
"""Two releases this far apart are taken for the sides of a boundary [SI]."""


@dataclass(frozen=True, kw_only=True)
class Branches:
    """What the branching finds by group of ancestors at each ε, the largest first."""

    shares: Array
    """f, (GROUPS, n); over `whole` it scatters less where nearly all tosses are uncertain."""
    whole: Array
    """All weight, that of the dead parts too, which is 1 on average, (GROUPS, n)."""
    parted: Array
    """Share of the tosses that diverge from the toss one ε away, (GROUPS, n)."""
    energy: Array
    """The energy left where those tosses diverge, times their share [m g r], (GROUPS, n)."""
    boundaries: NDArray[np.int64]
    """Boundaries that were drawn by weight among those of all groups, and resolved, (GROUPS, n)."""
    flat: NDArray[np.int64]
    """The boundaries among these at which a coin lands flat, not those at which it stands, (GROUPS, n)."""
    tosses: int
    undecided: int


@dataclass(frozen=True)
class Expanded:
    """An interval of release cut into parts, and what the tosses from their ends do."""

    points: list[PlanarRelease]
    """The releases at the ends of the parts, (PARTS + 1,)."""
    outcomes: NDArray[np.int8]
    """The outcomes of these releases, (PARTS + 1,)."""
    lives: NDArray[np.bool_]
    """Whether the tosses from the ends of a part have diverged, (PARTS,)."""
    energy: Array
    """The energy left where they diverge, (PARTS,) [m g r]."""

    @property
    def differs(self) -> NDArray[np.bool_]:
        """Whether the ends of a part have different outcomes, (PARTS,)."""
        return self.outcomes[1:] != self.outcomes[:-1]

    @property
    def uncertain(self) -> float:
        """Share of the inner releases one of whose neighbours has another outcome."""
        return float((self.differs[1:] | self.differs[:-1]).mean())


def branch(
    coin: PlanarCoin,
    units: Units,
    starts: Sequence[PlanarRelease],
    *,
    quantity: str,
    largest: Fraction,
    levels: int,
    population: int,
    rng: np.random.Generator,
    followed: int = 0,
    each: Callable[..., Iterable[Any]] = map,
) -> Branches:
    """Estimate f(ε) for ε = `largest` and every tenth of it.

    A toss is uncertain when a release that is ε more or ε less has another outcome.

    Args:
        coin: the coin.
        units: of it.
        starts: releases drawn at random, the ancestors.
        quantity: of a release: what varies.
        largest: ε [SI].
        levels: how many ε.
        population: intervals that go on at each level, about; more at the first levels.
        rng: draws them.
        followed: boundaries that are followed at each level.
        each: applies a function to each of several things, as `map` does, or on several cores.
    """
    parents, group = list(starts), np.arange(len(starts)) % GROUPS
    weights = GROUPS / np.full(len(parents), float(len(parents)))
    shares, whole, parted, energies, boundaries, flat = np.zeros((6, GROUPS, levels))
    tosses, undecided, dead = 0, 0, np.zeros(GROUPS)
    for level in range(levels):
        step = largest / PARTS**level
        made = list(each(partial(expand, coin, units, quantity, step), parents))
        outcomes = np.array([one.outcomes for one in made])
        tosses, undecided = tosses + outcomes.size, undecided + int(np.sum(outcomes == 0))
        shares[:, level] = _by_group(group, weights * [one.uncertain for one in made])
        whole[:, level] = _by_group(group, weights) + dead
        weights, group = np.repeat(weights / PARTS, PARTS), np.repeat(group, PARTS)
        low = [point for one in made for point in one.points[:-1]]
        lives, differs, energy = (
            np.concatenate([getattr(one, name) for one in made]) for name in ("lives", "differs", "energy")
        )
        if followed and differs.any():
            chance = weights * differs
            drawn = rng.choice(len(low), followed, p=chance / chance.sum())
            found = each(partial(what_lies_there, coin, units, quantity, step), [low[i] for i in drawn])
            stands, lands = np.array(list(found)).T
            boundaries[:, level] = _by_group(group[drawn], stands | lands)
            flat[:, level] = _by_group(group[drawn], lands)
        dead += _by_group(group[~lives], weights[~lives])
        low, group, weights, differs, energy = _of(lives, low, group, weights, differs, energy)
        parted[:, level], energies[:, level] = _by_group(group, weights), _by_group(group, weights * energy)
        if not low:
            whole[:, level + 1 :] = dead[:, None]
            break
        here = population * (EARLY[level] if level < len(EARLY) else 1)
        chance = chances(_scores(weights, energy, differs), here)
        goes_on = rng.random(len(chance)) < chance
        parents, group, weights = _of(goes_on, low, group, weights / chance)
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


def _of(chosen: NDArray[np.bool_], releases: list[PlanarRelease], *numbers: Any) -> tuple[Any, ...]:
    """Return the chosen entries of several lists."""
    return list(compress(releases, chosen)), *(each[chosen] for each in numbers)


def _by_group(group: NDArray[np.intp], numbers: Array | NDArray[np.bool_] | None = None) -> Array:
    """Return the sum of numbers, or how many there are, by group, (n,) to (GROUPS,)."""
    return np.bincount(group, numbers, GROUPS).astype(float)


def expand(coin: PlanarCoin, units: Units, quantity: str, step: Fraction, parent: PlanarRelease) -> Expanded:
    """Cut an interval into parts and toss from their ends.

    Args:
        coin: the coin.
        units: of it.
        quantity: of a release: what varies.
        step: length of a part [SI].
        parent: lower end.
    """
    points = spread(parent, quantity, step, PARTS + 1)
    ends = toss_many(coin, units, points)
    left = np.array([energy_left(one, other) for one, other in pairwise(ends)])
    return Expanded(
        points=points,
        outcomes=np.array([end.outcome for end in ends], dtype=np.int8),
        lives=(left > 0) | [one.itinerary != other.itinerary for one, other in pairwise(ends)],
        energy=np.maximum(left, LITTLE),
    )


def what_lies_there(
    coin: PlanarCoin, units: Units, quantity: str, width: Fraction, low: PlanarRelease
) -> tuple[bool, bool]:
    """Return whether a coin at a boundary in an interval stands, and whether it lands flat.

    The boundary is found by bisection. The tosses at its sides come as near to standing, or to
    landing flat, as they have been stretched apart; where they come near to neither, nothing is known.

    Args:
        coin: the coin.
        units: of it.
        quantity: of a release: what varies.
        width: of the interval [SI].
        low: its lower end; its ends have different outcomes.
    """
    (at_low,) = toss_many(coin, units, [low])
    while width > NARROWEST:
        width /= 2
        _, middle = spread(low, quantity, width, 2)
        if toss_many(coin, units, [middle])[0].outcome == at_low.outcome:
            low = middle
    sides = toss_many(coin, units, spread(low, quantity, width, 2), to_contact=True)
    lands = all(side.flattest < min(side.from_upright, NEAR) for side in sides)
    stands = all(side.from_upright < min(side.flattest, NEAR) for side in sides)
    return stands, lands


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
