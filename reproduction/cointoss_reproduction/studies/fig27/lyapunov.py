"""The largest Lyapunov exponent of the impact map: from its tangent map, and from a time series."""

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

from cointoss import Scenario
from cointoss.study import Array, event_tangent, run, state_at_release


def growth_by_tangent(scenario: Scenario) -> Array:
    """Return the logarithm of the growth of a small change from impact to impact, (n,).

    The change is carried by the tangent map of the toss from just after one impact to just after the next
    (Benettin's method), and starts in all components alike. The first impacts, in which it turns into the
    direction that grows most, count too.

    Args:
        scenario: of the toss; the coin's radius and √(g r), √(g/r) are its scales.
    """
    body, rules = scenario.body, scenario.rules
    toss = run(body, rules, state_at_release(scenario.release))
    r, rate = body.radius, (body.gravity / body.radius) ** 0.5
    scales = np.array([*[r] * 3, *[rate * r] * 3, *[1.0] * 4, *[rate] * 3, 1 / rate])
    change, growth = np.ones(14) / 14**0.5, []
    # Where the floor is left, x and y change nothing.
    for number in range(len(toss.rows)):
        change = event_tangent(body, rules, toss, number) @ (scales * change) / scales
        size = float(np.linalg.norm(change))
        growth.append(np.log(size))
        change /= size
    return np.array(growth)


def divergence(angles: Array, dimension: int, longest: int) -> Array:
    """Return the mean logarithm of the distance of neighbours after 0, 1, ... impacts, (longest + 1,).

    Rosenstein, Collins and De Luca (Physica D 65, 1993): states are `dimension` successive angles, each with
    its nearest neighbour that is not near it in time. Its slope is the largest exponent.

    Args:
        angles: of the rim points that touch, (n,) [rad].
        dimension: of the delay vectors.
        longest: impacts for which neighbours are followed.
    """
    # On a circle: an angle is its cosine and sine.
    points = np.column_stack([np.cos(angles), np.sin(angles)])
    count = len(points) - dimension + 1 - longest
    states = np.hstack([points[i : i + count] for i in range(dimension)])
    neighbours = _neighbours(states, apart=dimension)
    own = np.arange(count)
    curve = []
    for later in range(longest + 1):
        distance = np.linalg.norm(points[own + later] - points[neighbours + later], axis=1)
        curve.append(np.log(distance[distance > 0]).mean())
    return np.array(curve)


def _neighbours(states: Array, apart: int) -> NDArray[np.intp]:
    """Return the nearest state to each that is more than `apart` steps away from it in time, (n,)."""
    found = np.empty(len(states), dtype=np.intp)
    _, near = KDTree(states).query(states, k=2 * apart + 2)
    for i, candidates in enumerate(np.asarray(near).tolist()):
        found[i] = next(j for j in candidates if abs(j - i) > apart)
    return found
