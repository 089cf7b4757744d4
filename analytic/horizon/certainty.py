"""Whether the engine's own errors can change how a toss ends: its neighbours are tossed to the end.

From the last trusted impact on, or from the release, coins start as far beside this one as `FAR` times its
errors. Where all of them have the same touches, faces and ending, no boundary of outcomes lies between. That
is an estimate from samples, no bound; but errors that impacts have amplified have one direction left.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.events import Started, TossEnd, toss_coin
from cointoss.analytic.flight.state_vector import STATE_SIZE, motion_scales, normalise
from cointoss.analytic.horizon.horizon import Horizon
from cointoss.analytic.numerics.tolerances import CONTACT_STEP_ERROR
from cointoss.analytic.settings import ContactLimits
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body, Rules, is_to_be_caught, with_budgets
from cointoss.models.geometry import FLAT_SINE, tilt_sine_of
from cointoss.models.impact_row import FIRST_ROOM, ImpactRows
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW, Array, Ending, Outcome

FAR = 30.0
"""The distance of a toss's neighbours, in standard deviations of its errors."""
LEAST = 1e-9
"""The least distance of a neighbour against the scales of the coin: as a step of sustained contact errs."""
PAIRS = 2
"""Pairs of neighbours, on opposite sides."""
CONTACT_ERROR = CONTACT_STEP_ERROR / 100
"""Error allowed in their steps of sustained contact, relative: far below the toss's own. With its tolerance
they would repeat its errors, and agree with it where those have changed its outcome."""
FOLLOWED = 50_000
"""Steps of contact up to which neighbours are followed; more would take seconds."""
_CLOSER, _CLOSER_STEPS = 0.1, 16
"""A change that gives another outcome is reduced by this factor at most this often: down to rounding."""

# An error vector has the state from its height on, and the time, which changes nothing.
_FIRST, _ERRORS = 2, STATE_SIZE - 1
_draw = np.random.default_rng(0)
_SIGNS = _draw.choice([-1.0, 1.0], (PAIRS, _ERRORS))
_LEAST = LEAST * _draw.normal(size=(PAIRS, STATE_SIZE - _FIRST))


class NeighbourStart(NamedTuple):
    """Where the neighbours of a toss start beside it."""

    impact: int
    """The number of impacts before the start."""
    state: Array
    """The state of the toss, (13,)."""
    rules: Rules
    """The rules, with what the toss has left of its budgets."""


class Certainty(NamedTuple):
    """Whether an outcome is certain, and the first neighbour with another outcome."""

    certain: bool
    outcome: Outcome
    """The outcome of that neighbour."""
    pair: int
    """The number of that neighbour's pair."""
    side: float
    """The side of its pair on which that neighbour is: 1 or -1."""


@compiled
def start_of(rules: Rules, rows: NDArray[Any], started: Started, horizon: Horizon) -> NeighbourStart:
    """Return the `NeighbourStart` of the neighbours of a toss; for the arguments see `certainty_of`.

    Symmetry keeps a flat coin flat without any error, but the least tilt ends that: the neighbours of such a
    landing start before it.
    """
    ended = started.modes[horizon.impacts] == Mode.ENDED
    # A coin may pass a hand on any flight.
    first = 0 if is_to_be_caught(rules) else horizon.impacts - (1 if ended else 0)
    for i in range(first):
        e = rows[i].quaternion
        if tilt_sine_of(rotation_matrix((e[0], e[1], e[2], e[3]))[2]) <= FLAT_SINE:
            first = i
            break
    left = with_budgets(rules, rules.max_impacts - first, rules.max_time - started.times[first])
    return NeighbourStart(first, started.states[first], left)


@compiled
def _scales(body: Body, y: Array) -> Array:
    """Return the scales of a state's components from the height on, (11,)."""
    speed, spin = motion_scales(body, y)
    return np.array((body.radius, speed, speed, speed, 1.0, 1.0, 1.0, 1.0, spin, spin, spin))


@compiled
def neighbour(body: Body, start: NeighbourStart, horizon: Horizon, pair: int, size: float) -> Array:
    """Return the state in which a neighbour starts, (13,).

    Args:
        body: the coin.
        start: of the neighbours.
        horizon: of the toss.
        pair: number of the pair of neighbours.
        size: of the change, against that of the pair; negative for the other of it.
    """
    y, scales = start.state.copy(), _scales(body, start.state)
    for i in range(STATE_SIZE - _FIRST):
        by_errors = 0.0
        for k in range(_ERRORS):
            by_errors += _SIGNS[pair, k] * horizon.errors[k, i]
        y[_FIRST + i] += size * (FAR * by_errors + _LEAST[pair, i] * scales[i])
    normalise(y)
    return y


@compiled
def end_of(body: Body, rules: Rules, y: Array) -> tuple[NDArray[Any], Outcome, Ending]:
    """Return the impacts, the outcome and the ending of a neighbour that starts in the state y, (13,)."""
    limits, room = ContactLimits(FOLLOWED, CONTACT_ERROR), np.zeros(FIRST_ROOM, IMPACT_ROW)
    n, rows, _, outcome, ending, _ = toss_coin(body, rules, limits, y, room, True, np.empty(2))
    return rows[:n], outcome, ending


@compiled
def certainty_of(
    body: Body, rules: Rules, rows: ImpactRows, started: Started, verdict: TossEnd, horizon: Horizon
) -> Certainty:
    """Return whether all neighbours of a toss end as it does; not if it is undecided, or a transient.

    Args:
        body: the coin.
        rules: floor and ending.
        rows: the impacts of the toss, (n,) of `IMPACT_ROW`.
        started: its modes.
        verdict: how it ended.
        horizon: how far it can be trusted.
    """
    if verdict.outcome == Outcome.UNDECIDED or verdict.outcome == Outcome.TRANSIENT:
        return Certainty(False, verdict.outcome, 0, 0.0)
    start = start_of(rules, rows, started, horizon)
    for pair in range(PAIRS):
        for side in (1.0, -1.0):
            y = neighbour(body, start, horizon, pair, side)
            found, outcome, ending = end_of(body, start.rules, y)
            same = outcome == verdict.outcome and ending == verdict.ending
            same = same and len(found) == len(rows) - start.impact
            for i in range(len(found)):
                same = same and found[i].face == rows[start.impact + i].face
            if not same:
                return Certainty(False, outcome, pair, side)
    return Certainty(True, verdict.outcome, 0, 0.0)


@compiled
def closest_other(
    body: Body,
    rules: Rules,
    rows: ImpactRows,
    started: Started,
    horizon: Horizon,
    certainty: Certainty,
) -> tuple[Outcome, float, int]:
    """Return the outcome of a neighbour that ends otherwise, about the least change to it, and where that is.

    The change is relative to the scales of the coin, and made after the returned number of impacts, where the
    neighbours start. A change of 0 means that none was found.

    Args:
        body: the coin.
        rules: floor and ending.
        rows: the impacts of the toss, (n,) of `IMPACT_ROW`.
        started: its modes.
        horizon: how far it can be trusted.
        certainty: of its outcome, which is not certain.
    """
    start, size, least = start_of(rules, rows, started, horizon), certainty.side, 0.0
    scales = _scales(body, start.state)
    # Even the toss itself, repeated from here, may end otherwise: its times start from another origin.
    for _ in range(_CLOSER_STEPS):
        y, change = neighbour(body, start, horizon, certainty.pair, size), 0.0
        for i in range(STATE_SIZE - _FIRST):
            change = max(change, abs(y[_FIRST + i] - start.state[_FIRST + i]) / scales[i])
        _, outcome, _ = end_of(body, start.rules, y)
        if outcome != certainty.outcome or change == 0:
            break
        least, size = change, size * _CLOSER
    return certainty.outcome, least, start.impact
