"""The share of tosses that stretch a difference by more than given levels, by splitting.

Tosses that reach a level go on from there, drawn with preference for energy; each has a weight of one over
its chance. So shares are without bias at every level (H. Kahn, T. E. Harris, 1951).
"""

import numpy as np

from cointoss import Scenario
from cointoss.study import Array, rotation_matrix
from cointoss_reproduction.studies.rotor.chain import (
    COUNTED,
    MOMENTUM,
    NORMAL,
    POSITION,
    TINY,
    VELOCITY,
    Coin,
    States,
    bounce_all,
    reach,
    unknown,
)

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


def started(scenario: Scenario, states: Array) -> States:
    """Return releases as states of the chain, (n, 4, 3), whose change is one of height.

    A horizontal speed at release, which a smooth floor does not change, is left out.

    Args:
        scenario: coin, air and floor.
        states: at release, (n, 13), in SI.
    """
    coin, radius = scenario.coin, scenario.coin.radius
    time, found = (radius / scenario.gravity) ** 0.5, np.zeros((len(states), 4, 3), dtype=complex)
    # Spin about ζ turns ζ by its own moment of inertia.
    momentum = np.diag(scenario.body.inertia) / (coin.mass * radius**2) * states[:, 10:] * time
    rotation = np.array(rotation_matrix(states[:, 6:10].T))
    found[:, POSITION, 2] = states[:, 2] / radius + TINY * 1j
    found[:, VELOCITY, 2] = states[:, 5] * time / radius
    found[:, NORMAL] = rotation[:, 2].T
    found[:, MOMENTUM] = np.einsum("ijn,nj->ni", rotation, momentum)
    return found


def turned_back(coin: Coin, states: States) -> Array:
    """Return the least sine of the tilt that L_z and L_ζ allow a coin that turns with m g r, (n,).

    There U(s) = m g r; it is 0 where they allow the coin to fall flat.

    Args:
        coin: the coin.
        states: its states, (n, 4, 3).
    """
    up = states[:, MOMENTUM, 2].real
    own = np.sum(states[:, MOMENTUM].real * states[:, NORMAL].real, axis=1)
    whole = own**2 + 2 * coin.inertia
    half = np.sqrt(2 * coin.inertia * np.maximum(whole - up**2, 0.0))
    return np.sqrt(np.maximum(1 - ((np.abs(up * own) + half) / whole) ** 2, 0.0))


def planar(coin: Coin, z: float, v: float, angle: float, spin: float) -> States:
    """Return a coin in one plane as a state of the chain, (4, 3).

    Args:
        coin: the coin.
        z: height of its centre [r].
        v: its vertical speed.
        angle: that its normal has turned by, about x, from the vertical.
        spin: about x.
    """
    state = np.zeros((4, 3), dtype=complex)
    state[[POSITION, VELOCITY], 2] = z, v
    state[NORMAL] = 0, -np.sin(angle), np.cos(angle)
    state[MOMENTUM, 0] = coin.inertia * spin
    return state


def shares_beyond(
    scenario: Scenario, starts: Array, levels: Array, rng: np.random.Generator, tosses: int
) -> Array:
    """Return the share of tosses that stretch a difference of height by more than each of the levels, (n,).

    Args:
        scenario: coin, air and floor.
        starts: states at release, (n, 13), in SI.
        levels: logarithms of the stretch, in radians over parts of r, increasing, (n,).
        rng: draws the phases.
        tosses: at each level, about.
    """
    coin, states = coin_of(scenario), started(scenario, starts)
    known, weights = unknown(len(states)), np.full(len(states), 1 / len(states))
    shares = np.zeros(len(levels))
    for level, target in enumerate(levels):
        bounce_all(coin, states, known, target, rng)
        hit = known[:, COUNTED] >= target
        shares[level] = weights[hit].sum()
        if not hit.any():
            break
        chances = preference(coin, states[hit], weights[hit])
        steps = (rng.random() + np.arange(tosses)) / tosses
        drawn = np.minimum(np.searchsorted(np.cumsum(chances), steps), len(chances) - 1)
        weights = weights[hit][drawn] / (tosses * chances[drawn])
        states, known = states[hit][drawn], known[hit][drawn]
    return shares


def preference(coin: Coin, states: States, weights: Array) -> Array:
    """Return the chances of states to go on, which sum to 1, (n,)."""
    moving = np.sum(states[:, VELOCITY].real ** 2 + states[:, MOMENTUM].real ** 2 / coin.inertia, axis=1)
    left = np.maximum(states[:, POSITION, 2].real + moving / 2 - reach(coin), LITTLE)
    shared = [weights * left**power for power in PREFERENCES]
    return np.mean([each / each.sum() for each in shared], axis=0)
