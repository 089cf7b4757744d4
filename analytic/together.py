"""Many tosses of one coin, whose sustained contacts go on side by side: each the same to the bit as alone."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import IN_LANES, Event, Mode, contact_at
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.integrator import (
    END_ROW,
    NEW_ROW,
    ROWS,
    ended_step,
    is_accepted,
    length_to_try,
    next_length,
    start_contact,
    step_contact,
)
from cointoss.analytic.contact.periodic import tilt_history
from cointoss.analytic.contact.side_by_side import (
    INSIDE,
    LEFT,
    LENGTH,
    LONGEST,
    NUMBERS_ROW,
    RIM,
    SHORT,
    START_ROW,
    SUM_3,
    SUM_5,
    lanes_work,
    step_in_lanes,
)
from cointoss.analytic.events import (
    GOES_ON,
    NO_LOSS,
    Setup,
    Spent,
    TossEnd,
    after_event,
    after_step,
    flow_to_event,
)
from cointoss.analytic.flight.runge_kutta import combined_error
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.settings import ContactLimits
from cointoss.models.answers import write_end
from cointoss.models.body import Body
from cointoss.models.ending import unless_caught
from cointoss.models.impact_row import last_face
from cointoss.models.kernel.arrays import Cube, Table, copy_into
from cointoss.models.kernel.compiled import compiled, inlined
from cointoss.models.kernel.lanes import WIDTH
from cointoss.models.perpetual import KEPT, history_in
from cointoss.models.records import IMPACT_ROW
from cointoss.models.rows import floors_alike, rules_of, write_release

_IN_LANES = tuple(mode.value for mode in IN_LANES)
POOL, ALL = 16, KEPT + 4
"""How many tosses are under way at a time, and how many numbers are kept of each: see `UnderWay.kept`."""
COIN = np.dtype(
    (
        np.record,
        [
            *((name, "i8") for name in ("row", "mode", "impacts", "steps", "in_mode")),
            *((name, "f8") for name in ("time", "next_dt")),
        ],
    )
)
"""A toss under way: the number of its row, its `Mode`, what it has spent, and the steps in the mode."""


class UnderWay(NamedTuple):
    """Tosses of one coin in linear air, some of which are under way."""

    body: Body
    rows: Table
    """Of the scenarios' fields, (n, m)."""
    limits: ContactLimits
    answers: Table
    """Where the ends go, (n, 7)."""
    coins: Any
    """The tosses under way, (`POOL`,) of `COIN`; arrays of theirs follow."""
    y: Table
    """Their states, (`POOL`, 13)."""
    stages: Cube
    """Their `contact_work`, (`POOL`, 15, 13)."""
    kept: Table
    """Their histories of energy and of tilt, and `Setup.so_far`, (`POOL`, `ALL`)."""
    impacts: Any
    """Their impacts, (`POOL`, 2) of `IMPACT_ROW`."""
    work: Cube
    """See `lanes_work`."""


@compiled
def toss_together(body: Body, rows: Table, limits: ContactLimits, answers: Table) -> None:
    """Toss scenarios with one coin in linear air; see `cointoss.analytic.by_rows.toss_rows`."""
    y, stages, kept = np.empty((POOL, STATE_SIZE)), np.empty((POOL, ROWS, STATE_SIZE)), np.empty((POOL, ALL))
    coins, impacts = np.zeros(POOL, COIN), np.zeros((POOL, 2), IMPACT_ROW)
    tosses = UnderWay(body, rows, limits, answers, coins, y, stages, kept, impacts, lanes_work())
    some, begun, under_way = np.empty(POOL, np.int64), 0, POOL
    for i in range(POOL):
        tosses.coins[i].mode = Mode.ENDED.value
    while under_way > 0:
        under_way = 0
        for i in range(POOL):
            coin = tosses.coins[i]
            while coin.mode == Mode.ENDED and begun < len(rows):
                coin.row = begun
                kept[i] = np.inf
                write_release(rows[begun], y[i])
                go_to_contact(tosses, i, setup_of(tosses, i), Mode.FLIGHT.value, Spent(0.0, 0, 0), GOES_ON)
                begun += 1
            under_way += 0 if coin.mode == Mode.ENDED else 1
        for mode in _IN_LANES:
            n = find_alike(tosses, mode, some)
            for first in range(0, n, WIDTH):
                step_some(tosses, some[first : min(first + WIDTH, n)])


@compiled
def find_alike(tosses: UnderWay, mode: int, some: NDArray[np.int64]) -> int:
    """Write the numbers of coins in a mode and on one floor into `some`, (`POOL`,); return how many they are.

    Those on other floors wait until these have ended.
    """
    n, coins, rows = 0, tosses.coins, tosses.rows
    for i in range(POOL):
        if coins[i].mode == mode and (n == 0 or floors_alike(rows[coins[some[0]].row], rows[coins[i].row])):
            some[n] = i
            n += 1
    return n


@inlined
def setup_of(tosses: UnderWay, i: int) -> Setup:
    """Return the `Setup` of the toss under way number i."""
    rules, limits, kept = rules_of(tosses.rows[tosses.coins[i].row]), tosses.limits, tosses.kept[i]
    history = history_in(kept[:KEPT], NO_LOSS + limits.tolerance)
    return Setup(tosses.body, rules, friction_in_contact(rules), limits, history, False, kept[KEPT + 2 :])


@compiled
def go_to_contact(tosses: UnderWay, i: int, setup: Setup, mode: int, spent: Spent, verdict: TossEnd) -> None:
    """Bring a toss to the start of its next contact in one of the modes `IN_LANES`, or to its end.

    Args:
        tosses: under way.
        i: which of them.
        setup: of that one.
        mode: number of the `Mode` that starts.
        spent: so far.
        verdict: how the toss ends, where it does.
    """
    coin, y, impacts = tosses.coins[i], tosses.y[i], tosses.impacts[i]
    while mode != Mode.ENDED and not (mode in _IN_LANES and spent.time < setup.rules.max_time):
        passage = flow_to_event(setup, mode, y, spent)
        mode, spent, verdict = after_event(setup, mode, passage, y, impacts)
    coin.mode, coin.time, coin.impacts, coin.steps = mode, spent.time, spent.impacts, spent.steps
    if mode == Mode.ENDED:
        outcome, ending = unless_caught(setup.rules, verdict.outcome, verdict.ending)
        face, answer = last_face(impacts, spent.impacts), tosses.answers[coin.row]
        write_end(outcome, ending, spent.impacts, face, spent.time, answer)
    else:
        start_contact(contact_at(setup.body, setup.friction, mode, y), y, tosses.stages[i])
        coin.in_mode, coin.next_dt = 0, np.inf
        tosses.kept[i, KEPT], tosses.kept[i, KEPT + 1] = 0.0, 0.0


@compiled
def step_some(tosses: UnderWay, some: NDArray[np.int64]) -> None:
    """Advance some coins, up to four in one mode on one floor, by a step of contact each.

    Where a step has too large an error, its coin takes it alone.

    Args:
        tosses: under way.
        some: the numbers of these, (n,).
    """
    body, limits, work, n = tosses.body, tosses.limits, tosses.work, len(some)
    mode, friction = tosses.coins[some[0]].mode, setup_of(tosses, some[0]).friction
    for lane in range(WIDTH):
        i = some[min(lane, n - 1)]
        coin, y, stages, numbers = tosses.coins[i], tosses.y[i], tosses.stages[i], work[NUMBERS_ROW, :, lane]
        contact = contact_at(body, friction, mode, y)
        longest = min(coin.next_dt, setup_of(tosses, i).rules.max_time - coin.time)
        numbers[RIM], numbers[LONGEST] = contact.rim, longest
        numbers[LENGTH], numbers[SHORT] = length_to_try(contact, y, longest, stages)
        copy_into(work[START_ROW, :, lane], y)
        copy_into(work[0, :, lane], stages[0])
    step_in_lanes(body, friction, mode, work)
    for lane in range(n):
        i, numbers = some[lane], work[NUMBERS_ROW, :, lane]
        coin, y, stages, setup = tosses.coins[i], tosses.y[i], tosses.stages[i], setup_of(tosses, i)
        contact, length = SustainedContact(body, friction, mode, numbers[RIM]), numbers[LENGTH]
        error = combined_error(length, numbers[SUM_5], numbers[SUM_3], STATE_SIZE) / limits.tolerance
        if is_accepted(error, length, numbers[SHORT], numbers[INSIDE]):
            copy_into(stages[NEW_ROW], work[NEW_ROW, :, lane])
            copy_into(stages[END_ROW], work[END_ROW, :, lane])
            step = ended_step(
                contact,
                y,
                length,
                next_length(length, error, stages),
                numbers[LEFT],
                limits.tolerance,
                stages,
            )
        else:
            step = step_contact(contact, y, numbers[LONGEST], limits.tolerance, stages)
        coin.next_dt, coin.in_mode = step.next_dt, coin.in_mode + 1
        tilts = tilt_history(contact, tosses.kept[i, KEPT : KEPT + 2])
        spent = Spent(coin.time, coin.impacts, coin.steps)
        passage = after_step(setup, mode, tilts, coin.in_mode, step, y, spent)
        coin.time, coin.steps = passage.spent.time, passage.spent.steps
        if passage.event != Event.NONE:
            next_mode, spent, verdict = after_event(setup, mode, passage, y, tosses.impacts[i])
            go_to_contact(tosses, i, setup, next_mode, spent, verdict)
