"""Many tosses by the paper's mechanics, on all cores."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
from numba import config

from analytic.events import fly_and_hit
from models.compiled import compiled
from models.outcomes import Outcomes
from models.records import IMPACT_ROW
from models.releases import Releases, check_releases
from models.scenario import Scenario

TILE, SLOW_TILE = 512, 8
"""Tosses that a thread makes at a time, in air with b > 0 the second; Ctrl-C waits for them."""


def toss_many(scenario: Scenario, releases: Releases) -> Outcomes:
    """Toss the coin once from each release, by the event loop of `toss`: each toss is the same to the bit.

    Args:
        scenario: what to toss; its own release is not used.
        releases: the states at time 0.

    Returns:
        How each toss ended, in the order of `releases`. The paths are not kept.

    Raises:
        ValueError: for a release that a scenario with this coin and air would refuse.
    """
    check_releases(scenario, releases)
    body, rules, n = scenario.body, scenario.rules, len(releases)
    states = np.hstack([releases.position, releases.velocity, releases.quaternion, releases.angular_velocity])
    outcome, ending, face = (np.empty(n, dtype=np.int8) for _ in range(3))
    impacts, end_time = np.empty(n, dtype=np.int32), np.empty(n)
    columns = (states, outcome, ending, face, impacts, end_time)

    tile = TILE if body.air.exponent is None else SLOW_TILE

    def toss_tile(first: int) -> None:
        _toss_each(body, rules, *(column[first : first + tile] for column in columns))

    # The cores that this process may use, or what the environment sets in their place.
    with ThreadPoolExecutor(config.__dict__["NUMBA_NUM_THREADS"]) as pool:
        # An exception, so also Ctrl-C, cancels the tiles not yet begun.
        for _ in pool.map(toss_tile, range(0, n, tile)):
            pass
    return Outcomes(outcome=outcome, ending=ending, impacts=impacts, last_face=face, end_time=end_time)


@compiled
def _toss_each(body, rules, states, outcomes, endings, faces, impacts, end_times):
    # Two rows, so that a touch without solution leaves the last impact's.
    rows = np.zeros(2, IMPACT_ROW)
    for i in range(len(states)):
        n, _, outcome, ending, end_time = fly_and_hit(body, rules, states[i], rows, False)
        outcomes[i], endings[i], impacts[i], end_times[i] = outcome.value, ending.value, n, end_time
        faces[i] = rows[(n - 1) % 2]["face"] if n > 0 else 0
