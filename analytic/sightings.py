"""What many tosses show: their first touches, and their states at times, from a release and a floor each."""

import numpy as np
from numpy.typing import ArrayLike

from cointoss.analytic.entries import see_each
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.seeing import SightingRequest, Sightings
from cointoss.analytic.settings import FINE, AnalyticSettings, contact_limits
from cointoss.models.body import Body, Rules
from cointoss.models.interruptible import interruptible
from cointoss.models.records import Array


def sightings(
    body: Body,
    rules: Rules,
    states: Array,
    asked: SightingRequest,
    *,
    most: int,
    settings: AnalyticSettings = FINE,
) -> Sightings:
    """Return what tosses show, each as `toss` makes it.

    Args:
        body: the coin.
        rules: of the floor and the ending, but for what is `asked`.
        states: at release, (n, 13): position and velocity of C, Euler parameters, and ω.
        asked: of each toss.
        most: how many touches are told; where no times are asked for, a toss ends after as many.
        settings: of the engine.
    """
    (n, m), limits = asked.times.shape, contact_limits(settings)
    found = Sightings(
        np.zeros((n, most)), np.zeros((n, most)), np.zeros((n, m, STATE_SIZE)), np.zeros(n, dtype=np.int64)
    )
    start = np.array(states, dtype=float)
    interruptible(lambda: see_each(body, rules, limits, start, asked, found))
    return found


def asked_of(
    n: int, *, restitution: ArrayLike, friction: ArrayLike, max_time: ArrayLike, times: Array
) -> SightingRequest:
    """Return what is asked of n tosses, of all alike where a number is given."""
    chi, mu, longest = (
        np.ascontiguousarray(np.broadcast_to(x, n), float) for x in (restitution, friction, max_time)
    )
    return SightingRequest(chi, mu, longest, np.ascontiguousarray(times, float))
