"""Coins at their first touch, let go at rest, and on their edge: what the edge's share follows from."""

import numpy as np
from numpy.typing import NDArray

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
from cointoss_reproduction.setups.edge_classes import DIAMETRAL, EdgeClass
from cointoss_reproduction.setups.releases import directions, released
from cointoss_reproduction.studies.edge.laws import (
    ANGLE,
    SOLID_ANGLE,
    corner,
    edge_by_angle,
    edge_by_solid_angle,
)

DROP = 1e-4
"""Height of the lowest point of a coin that is let go at rest [m]."""
LAWS = {
    DIAMETRAL: (ANGLE, edge_by_angle, "(2/π) atan(h/D)"),
    "to any attitude": (SOLID_ANGLE, edge_by_solid_angle, "(h/D)/√(1 + (h/D)²)"),
}
"""For each way of turning: the h/D at which its law gives a third, the law, and its formula."""


def attitudes(turned: str, rng: np.random.Generator, count: int) -> Array:
    """Draw Euler parameters of coins turned in one of these ways, (count, 4)."""
    if turned == DIAMETRAL:
        tilts = rng.uniform(0, 2 * np.pi, count)
        return np.array([quaternion_from_angles((0.0, tilt, 0.0)) for tilt in tilts])
    return directions(rng, count)


def first_touches(
    kind: EdgeClass, turned: str, rng: np.random.Generator, count: int
) -> tuple[NDArray[np.bool_], Array]:
    """Toss coins of a class up to their first impact, flat or in any attitude, with as much spin.

    Returns:
        Whether C is then on the edge's side of the rim, and the energy left over that of the pass, (count,).
    """
    scenario, starts = kind.scenario.replace("ending.max_impacts", 1), kind.starts(count)
    if turned != DIAMETRAL:
        starts[:, 6:10] = attitudes(turned, rng, count)
    body = scenario.body
    touches = [run(body, scenario.rules, state).rows[0] for state in starts]
    tilt = np.array([abs(rotation_matrix(tuple(row["quaternion"]))[2][2]) for row in touches])
    energies = np.array([row["energy"] for row in touches])
    return tilt < np.sin(corner(kind.aspect)), energies / (body.mass * body.gravity * highest_on_floor(body))


def let_go(kind: EdgeClass, turned: str, rng: np.random.Generator, count: int) -> NDArray[np.bool_]:
    """Let coins of a class go at rest just above the floor; return which end on their edge, (count,)."""
    scenario, e = kind.scenario, attitudes(turned, rng, count)
    heights = np.array([DROP - gap(scenario.body, 0.0, rotation_matrix(tuple(one))[2]) for one in e])
    rows = rows_from_states(scenario, released(heights, attitude=e))
    return analytic.toss_rows(rows).outcome == Outcome.EDGE


def way_to_rest(kind: EdgeClass, count: int) -> Array:
    """Toss coins of a class, and return of those that end on their edge how they came to rest there.

    Returns:
        The time from their last impact to the end [s], and the straight distance of C in it [m], (2, n).
    """
    logs = [run(kind.scenario.body, kind.scenario.rules, state) for state in kind.starts(count)]
    ends = [(log, log.rows[-1]) for log in logs if log.outcome == Outcome.EDGE]
    times = [log.end_time - last["time"] for log, last in ends]
    ways = [np.linalg.norm(log.started.states[-1][:2] - last["position"][:2]) for log, last in ends]
    return np.array([times, ways], dtype=float)
