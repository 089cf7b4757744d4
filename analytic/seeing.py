"""What each of many tosses shows: its first touches, and its states at times."""

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.sampling import sample_contact
from cointoss.analytic.events import started_of, toss_coin
from cointoss.analytic.flight.flying import sample
from cointoss.analytic.flight.state_vector import state_of
from cointoss.analytic.settings import ContactLimits
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules, with_budgets, with_floor
from cointoss.models.faults import Fault, fault_of_release
from cointoss.models.kernel.arrays import Array, Cube, Row, Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW

LongCounts = Annotated[NDArray[np.int64], 1]


class Sightings(NamedTuple):
    """What tosses show, a row for each toss."""

    touch_times: Table
    """Times of the first touches, (n, most) [s]; the toss's end stands for those that it does not make."""
    up: Table
    """The vertical part of the normal ζ at each touch, (n, most); 0 where there is none."""
    states: Cube
    """The states at the times asked for, in the order of a state vector, (n, m, 13)."""
    impacts: LongCounts
    """The number of impacts, (n,); -1 for a release that no scenario has."""


class SightingRequest(NamedTuple):
    """What is asked of each toss."""

    restitution: Row
    """χ, (n,)."""
    friction: Row
    """μ, (n,)."""
    max_time: Row
    """The time at which the toss ends at the latest, (n,) [s]."""
    times: Table
    """Times of the states asked for, rising, (n, m) [s]; before and after the toss its ends count."""


@compiled
def see_each(
    body: Body, rules: Rules, limits: ContactLimits, starts: Table, asked: SightingRequest, found: Sightings
) -> None:
    """Toss the coin from each state, (n, 13), and write what is asked into what is found.

    Args:
        body: the coin.
        rules: of the floor and the ending, but for what is asked.
        limits: of sustained contact.
        starts: at release; written to.
        asked: of each toss.
        found: where it goes.
    """
    most, is_filmed = found.touch_times.shape[1], found.states.shape[1] > 0
    room = np.zeros(most + 1, IMPACT_ROW)  # the last is work space
    for i in range(len(starts)):
        if fault_of_release(body, state_of(starts[i])).fault != Fault.NONE:
            found.impacts[i] = -1
            continue
        floor = with_floor(rules, asked.restitution[i], asked.friction[i])
        floor = with_budgets(floor, floor.max_impacts if is_filmed else most, asked.max_time[i])
        n, rows, pieces, _, _, end_time = toss_coin(body, floor, limits, starts[i], room, is_filmed)
        found.impacts[i] = n
        for k in range(most):
            found.touch_times[i, k] = end_time
            if k < n:
                e = rows[k]["quaternion"]
                found.touch_times[i, k] = rows[k]["time"]
                found.up[i, k] = rotation_matrix((e[0], e[1], e[2], e[3]))[2][2]
        if is_filmed:
            _film(body, floor, limits, pieces, asked.times[i], found.states[i])


@compiled
def _film(
    body: Body, rules: Rules, limits: ContactLimits, pieces: Array, times: Array, states: Array
) -> None:
    """Write the states of a toss at `times` into `states`, (m, 13), from the table that `toss_coin` gives."""
    started, friction, first = started_of(pieces), friction_in_contact(rules), 0
    last = len(started.times) - 1
    for k in range(last + 1):
        after = first
        while after < len(times) and (k == last or times[after] < started.times[k + 1]):
            after += 1
        if after > first:
            mode, y, start_time = 0 + int(started.modes[k]), started.states[k], started.times[k]
            asked = np.minimum(np.maximum(times[first:after], start_time), started.times[last])
            if mode == Mode.FLIGHT or mode == Mode.ENDED:
                sample(body, y, start_time, asked, states[first:after])
            else:
                contact = contact_at(body, friction, mode, y)
                sample_contact(contact, y, start_time, asked, limits.tolerance, states[first:after])
        first = after
