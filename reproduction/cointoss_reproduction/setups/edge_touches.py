"""Coins at their first touch, let go at rest, and on their edge: what the edge's share follows from."""

import numpy as np

from cointoss import Outcome, analytic
from cointoss.study import (
    Array,
    gap,
    highest_on_floor,
    quaternion_from_angles,
    rotation_matrix,
    rows_from_states,
    run,
)
from cointoss_reproduction.frame.parts import Part
from cointoss_reproduction.setups.edge_classes import DIAMETRAL, EdgeClass, corner
from cointoss_reproduction.setups.ends import Ends, counted

DROP = 1e-4
"""Height of the lowest point of a coin that is let go at rest [m]."""
ANYHOW = "to any attitude"
TURNED = (DIAMETRAL, ANYHOW)
"""How a coin may be turned."""


def attitudes(turned: str, rng: np.random.Generator, count: int) -> Array:
    """Draw Euler parameters of coins that are turned in one of these ways, (count, 4)."""
    if turned == ANYHOW:
        drawn = rng.normal(size=(count, 4))
        return drawn / np.linalg.norm(drawn, axis=1, keepdims=True)
    return np.array([quaternion_from_angles((0.0, tilt, 0.0)) for tilt in rng.uniform(0, 2 * np.pi, count)])


def tossed(kind: EdgeClass, turned: str, rng: np.random.Generator, count: int) -> Array:
    """Draw states, (n, 13), flat to turn about a diameter, or in any attitude with as much spin."""
    drawn = kind.starts(count)
    if turned != DIAMETRAL:
        drawn[:, 6:10] = attitudes(turned, rng, count)
    return drawn


def first_touches(kind: EdgeClass, starts: Array) -> Part:
    """Toss coins of a class up to their first impact.

    Args:
        kind: the class.
        starts: the states at release, (count, 13).

    Returns:
        Whether C is then on the edge's side of the rim, and the energy left over that of the pass, (count,).
    """
    scenario = kind.scenario.replace("ending.max_impacts", 1)
    body = scenario.body
    on_edge, energy = np.empty(len(starts), dtype=bool), np.empty(len(starts))
    for i, state in enumerate(starts):
        row = run(body, scenario.rules, state).rows[0]
        n_z = rotation_matrix(tuple(row["quaternion"]))[2][2]
        on_edge[i] = abs(n_z) < np.sin(corner(kind.aspect))
        energy[i] = row["energy"] / (body.mass * body.gravity * highest_on_floor(body))
    return {"on_edge": on_edge, "energy": energy}


def let_go(kind: EdgeClass, turned: str, rng: np.random.Generator, count: int) -> Part:
    """Let coins of a class go at rest just above the floor; return which end on their edge, (count,)."""
    scenario, quaternions = kind.scenario, attitudes(turned, rng, count)
    height = np.array([DROP - gap(scenario.body, 0.0, rotation_matrix(tuple(e))[2]) for e in quaternions])
    starts = np.zeros((count, 13))
    starts[:, 2], starts[:, 6:10] = height, quaternions
    return {"on_edge": analytic.toss_rows(rows_from_states(scenario, starts)).outcome == Outcome.EDGE}


def way_to_rest(kind: EdgeClass, count: int) -> Part:
    """Toss coins of a class, and return of those that end on their edge how they came to rest there.

    Returns:
        The time from their last impact to the end [s], and the way of C in it, as the crow flies [m].
    """
    scenario, times, ways = kind.scenario, [], []
    for state in kind.starts(count):
        log = run(scenario.body, scenario.rules, state)
        if log.outcome == Outcome.EDGE:
            last = log.rows[-1]
            times.append(log.end_time - last["time"])
            ways.append(np.linalg.norm(log.start_states[-1][:2] - last["position"][:2]))
    return {"times": np.array(times), "ways": np.array(ways)}


def endings_of(kind: EdgeClass, count: int) -> Ends:
    """Toss coins of a class, and return how many end how, by outcome and ending."""
    return counted(analytic.toss_rows(rows_from_states(kind.scenario, kind.starts(count))))
