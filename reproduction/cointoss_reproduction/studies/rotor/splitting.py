"""The share of tosses that stretch a difference by more than given levels, by splitting.

Tosses that reach a level go on from there, drawn with preference for energy; each has a weight of one over
its chance. So shares are without bias at every level (H. Kahn, T. E. Harris, 1951).
"""

import numpy as np

from cointoss import Scenario
from cointoss.study import Array
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS
from cointoss_reproduction.studies.rotor.chain import SPIN, Coin, V, Z, reach, stretch_all

MANY = 4
"""How many times the tosses there are at the first level."""
PREFERENCES = (0, 2, 5, 12, 25)
"""Powers of the energy above the barrier; each has an equal share of the tosses."""
LITTLE = 0.2
"""Energy above the barrier below which a toss is preferred no less [m g r]."""


def coin_of(scenario: Scenario) -> Coin:
    """Return the coin of a scenario, balanced and turning about ξ, in its own units."""
    coin, body = scenario.coin, scenario.body
    inertia = float(body.inertia[0][0])
    time = (coin.radius / scenario.gravity) ** 0.5
    return Coin(
        inertia=inertia / (coin.mass * coin.radius**2),
        half=coin.thickness / (2 * coin.radius),
        restitution=scenario.floor.restitution,
        rough=scenario.floor.contact != "smooth",
        slowing=time * body.drag.moment_tangential / inertia,
        drag=time * (body.drag.force_tangential + body.drag.force_normal) / (2 * coin.mass),
        own_slowing=time * body.drag.moment_normal / float(body.inertia[2][2]),
    )


def shares_beyond(scenario: Scenario, levels: Array, rng: np.random.Generator, tosses: int) -> Array:
    """Return the share of tosses that stretch a difference of height by more than each of the levels, (n,).

    Releases are flat, at rest but for the spin, with the heights and spins of the maps.

    Args:
        scenario: coin, air and floor.
        levels: logarithms of the stretch, in radians over parts of r, increasing, (n,).
        rng: draws the releases and the phases.
        tosses: at each level, about.
    """
    coin, radius = coin_of(scenario), scenario.coin.radius
    states, changes = np.zeros((2, MANY * tosses, 5))
    states[:, Z] = rng.uniform(*HEIGHTS, len(states)) / radius
    states[:, SPIN] = rng.uniform(*SPINS, len(states)) * (radius / scenario.gravity) ** 0.5
    changes[:, Z] = 1
    known, weights = np.zeros(len(states)), np.full(len(states), 1 / len(states))
    shares = np.zeros(len(levels))
    for level, target in enumerate(levels):
        goes_on = np.flatnonzero(known < target) if level else np.arange(len(states))
        moved, changed, so_far = states[goes_on], changes[goes_on], known[goes_on]
        stretch_all(coin, moved, changed, so_far, target, rng)
        states[goes_on], changes[goes_on], known[goes_on] = moved, changed, so_far
        hit = known >= target
        shares[level] = weights[hit].sum()
        if not hit.any():
            break
        chances = preference(coin, states[hit], weights[hit])
        steps = (rng.random() + np.arange(tosses)) / tosses
        drawn = np.minimum(np.searchsorted(np.cumsum(chances), steps), len(chances) - 1)
        weights = weights[hit][drawn] / (tosses * chances[drawn])
        states, changes, known = states[hit][drawn], changes[hit][drawn], known[hit][drawn]
    return shares


def preference(coin: Coin, states: Array, weights: Array) -> Array:
    """Return the chances of states to go on, which sum to 1, (n,)."""
    turning = coin.inertia * states[:, SPIN] ** 2
    left = np.maximum(states[:, Z] + (states[:, V] ** 2 + turning) / 2 - reach(coin), LITTLE)
    shared = [weights * left**power for power in PREFERENCES]
    return np.mean([each / each.sum() for each in shared], axis=0)
