"""The first touches of each of many tosses, and its states at given times."""

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.events import started_of, toss_coin
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.path import sample_pieces
from cointoss.analytic.settings import ContactLimits
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Cube, Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW
from cointoss.models.rows import (
    AT,
    body_of,
    has_linear_air,
    rules_of,
    run_end,
    write_release,
)

LongCounts = Annotated[NDArray[np.int64], 1]


class Sightings(NamedTuple):
    """What tosses show, a row for each toss."""

    touch_times: Table
    """Times of the first touches, (n, most) [s]; the toss's end in place of touches that do not occur."""
    up: Table
    """The vertical part of the normal ζ at each touch, (n, most); 0 where there is none."""
    states: Cube
    """The states at the times asked for, in the order of a state vector, (n, m, 13)."""
    impacts: LongCounts
    """The number of touches of each toss, (n,)."""


@compiled
def see_each(rows: Table, limits: ContactLimits, times: Table, found: Sightings) -> None:
    """Toss each of many scenarios, and write what it shows into what is found.

    Args:
        rows: of their fields, each a scenario's, (n, m).
        limits: of sustained contact.
        times: when states are asked for, rising, (n, m) [s]; before and after the toss its ends count.
        found: where it goes. Where no times are asked for, the scenarios end with its touches at the latest.
    """
    first = 0
    while first < len(rows):
        end = run_end(rows, first)
        if has_linear_air(rows[first]):
            _see_run(body_of(rows[first], None), rows, limits, times, found, first, end)
        else:
            _see_run(
                body_of(rows[first], rows[first, AT.air_exponent]), rows, limits, times, found, first, end
            )
        first = end


@compiled
def _see_run(
    body: Body, rows: Table, limits: ContactLimits, times: Table, found: Sightings, first: int, end: int
) -> None:
    """Toss the rows from `first` to before `end`, whose coin is `body`; for the rest see `see_each`."""
    most, is_filmed = found.touch_times.shape[1], found.states.shape[1] > 0
    room, start = np.zeros(most + 1, IMPACT_ROW), np.empty(STATE_SIZE)  # the last is work space
    for i in range(first, end):
        rules = rules_of(rows[i])
        write_release(rows[i], start)
        n, impacts, pieces, _, _, end_time = toss_coin(
            body, rules, limits, start, room, is_filmed, np.empty(2)
        )
        found.impacts[i] = n
        for k in range(most):
            found.touch_times[i, k] = end_time
            if k < n:
                e = impacts[k]["quaternion"]
                found.touch_times[i, k] = impacts[k]["time"]
                found.up[i, k] = rotation_matrix((e[0], e[1], e[2], e[3]))[2][2]
        if is_filmed:
            asked, friction = np.minimum(np.maximum(times[i], 0.0), end_time), friction_in_contact(rules)
            sample_pieces(body, friction, limits.tolerance, started_of(pieces), asked, found.states[i])
