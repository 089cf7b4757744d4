"""One toss by the event loop, as Python runs it, and how far it can be trusted."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.entries import closest_other, find_horizon, go_on, toss_coin
from cointoss.analytic.entries import event_tangent as find_event_tangent
from cointoss.analytic.events import Started, TossEnd, started_of
from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.analytic.horizon.certainty import Certainty
from cointoss.analytic.horizon.horizon import ErrorsMade, Horizon
from cointoss.analytic.settings import FINE, AnalyticSettings, contact_limits
from cointoss.models.body import Body, Rules
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.records import IMPACT_ROW, Array, Ending, Later, OtherOutcome, Outcome


class EventLog(NamedTuple):
    """What the event loop gives for one toss."""

    rows: NDArray[Any]
    """Impacts, (n,) of `IMPACT_ROW`."""
    started: Started
    contacts: Array
    """Start and end of every sustained contact, (n, 2) [s]."""
    outcome: Outcome
    ending: Ending
    end_time: float
    path: Started
    """The same; where the coin is followed with the modes from the end of the toss on, and the path's end;
    their steps and their grazes are not counted."""

    @property
    def verdict(self) -> TossEnd:
        """The outcome and the ending."""
        return TossEnd(self.outcome, self.ending)


def run(
    body: Body,
    rules: Rules,
    start: Array,
    settings: AnalyticSettings = FINE,
    until: float | None = None,
    so_far: Array | None = None,
) -> EventLog:
    """Toss the coin in state `start`, (13,), until the toss is decided or a budget is spent.

    Args:
        body: the coin.
        rules: floor and ending.
        start: state, (13,).
        settings: of the engine.
        until: the coin is followed up to this time, see `EndingCriteria.until`.
        so_far: becomes the number of impacts and the time [s] so far, (2,), while the toss goes on.
    """
    room, limits = np.zeros(FIRST_ROOM, IMPACT_ROW), contact_limits(settings)
    so_far = np.empty(2) if so_far is None else so_far
    n, rows, pieces, outcome, ending, end_time = toss_coin(
        body, rules, limits, start.copy(), room, True, so_far
    )
    started = started_of(pieces)
    followed = pieces if until is None else go_on(body, rules, limits, pieces, Ending(ending), until)
    return EventLog(
        rows=rows[:n].copy(),
        started=started,
        contacts=contacts_of(started.times, started.modes),
        outcome=Outcome(outcome),
        ending=Ending(ending),
        end_time=end_time,
        path=started_of(followed),
    )


def contacts_of(start_times: Array, started: NDArray[np.int8]) -> Array:
    """Return start and end of every sustained contact, (n, 2) [s], from the modes and where they start."""
    lasting = (started != Mode.FLIGHT) & (started != Mode.ENDED)
    changes = np.diff(lasting.astype(np.int8), prepend=0)
    return np.stack([start_times[changes == 1], start_times[changes == -1]], axis=1)


def later_part(toss: EventLog) -> Later:
    """Return how the coin goes on after its toss."""
    end = len(toss.started.times) - 1
    times, modes = toss.path.times[end:], toss.path.modes[end:]
    bounces = (modes[1:] == Mode.FLIGHT) & (modes[:-1] == Mode.FLIGHT)
    held = toss.ending != Ending.CAUGHT
    return Later(
        end=float(times[-1]),
        times=times[1:][bounces],
        contacts=contacts_of(times, modes) if held else np.empty((0, 2)),
    )


def horizon_of(body: Body, rules: Rules, toss: EventLog, made: ErrorsMade | None = None) -> Horizon:
    """Return how far a toss can be trusted, see `cointoss.analytic.horizon.horizon.find_horizon`.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
        made: the errors, by default those of this engine.
    """
    return find_horizon(body, rules, toss.rows, toss.started, made or ErrorsMade())


def other_outcome(
    body: Body, rules: Rules, toss: EventLog, horizon: Horizon, certainty: Certainty
) -> OtherOutcome | None:
    """Return the outcome of the neighbour that ends otherwise, and about the least change that leads to it.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
        horizon: how far it can be trusted.
        certainty: of its outcome.

    Returns:
        None where there is no such neighbour, or none with another outcome that is decided.
    """
    if certainty.outcome in (toss.outcome, Outcome.UNDECIDED, Outcome.TRANSIENT):
        return None
    outcome, change, impact = closest_other(body, rules, toss.rows, toss.started, horizon, certainty)
    return None if change == 0 else OtherOutcome(outcome=outcome, change=change, impact=impact)


def event_tangent(body: Body, rules: Rules, toss: EventLog, number: int) -> Array:
    """Return the tangent map from just after the impact before to just after impact `number`, (14, 14).

    A small change is one of the state and of the time of the event, (14,); two tosses are compared each at
    its own impact. So the saltation matrix, with f the rate of change of the state before and after the
    impact, D the derivative of the impact and dt = -(∇gap . dy)/(∇gap . f_before) the delay of the touch,

        dy_after = D (dy + f_before dt) - f_after dt,

    falls in two: the last term only brings back the tosses to one time, and dt goes into the time of the
    event. At a low hop that term would cost digits.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
        number: of the impact, from 0; the first map starts at the release.
    """
    found, n = np.empty((2 * STATE_SIZE + 2, STATE_SIZE)), STATE_SIZE
    left = rules.max_time - toss.started.times[number]
    find_event_tangent(body, rules, toss.started.states[number].copy(), left, found)
    rate, early = found[-2], np.append(found[-1], 0)
    to_the_touch = np.eye(n + 1) + np.outer(np.append(rate, 1), -early)
    return _with_time(found[n : 2 * n]) @ to_the_touch @ _with_time(found[:n].T)


def _with_time(of_state: Array) -> Array:
    """Return a map of the state, (13, 13), as one of an event that keeps its time, (14, 14)."""
    of_event = np.eye(STATE_SIZE + 1)
    of_event[:STATE_SIZE, :STATE_SIZE] = of_state
    return of_event
