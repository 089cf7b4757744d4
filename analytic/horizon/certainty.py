"""Whether the engine's own errors can change how a toss ends: its neighbours are tossed to the end.

From the last trusted impact on, or from the release, coins start as far beside this one as `FAR` times its
errors. Where all of them have the same touches, faces and ending, no boundary of outcomes lies between. That
is an estimate from samples, no bound; but errors that impacts have amplified have one direction left.
"""

import numpy as np

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.events import EventLog, run
from cointoss.analytic.horizon.horizon import Horizon
from cointoss.analytic.settings import Settings
from cointoss.models.body import Body, Rules, is_to_be_caught
from cointoss.models.records import Array, Outcome

FAR = 30.0
"""So many standard deviations of its errors are its neighbours away."""
LEAST = 1e-9
"""And so far at least, against the scales of the coin: as a step of sustained contact errs."""
PAIRS = 2
"""Of neighbours, on opposite sides."""
FOLLOWED = Settings(contact_steps=50_000)
"""Neighbours are not followed through longer contacts, which would take seconds."""


def outcome_is_certain(body: Body, rules: Rules, toss: EventLog, horizon: Horizon) -> bool:
    """Return whether all neighbours of a toss end as it does; False where it is undecided.

    Args:
        body: the coin.
        rules: floor and ending.
        toss: from its release on.
        horizon: how far it can be trusted.
    """
    if toss.outcome == Outcome.UNDECIDED:
        return False
    ended = toss.started.modes[horizon.impacts] == Mode.ENDED
    # What passes a hand may do so on any flight.
    first = 0 if is_to_be_caught(rules) else horizon.impacts - int(ended)
    rng = np.random.default_rng(0)
    start, time = toss.start_states[first], toss.start_times[first]
    left = rules._replace(max_impacts=rules.max_impacts - first, max_time=rules.max_time - time)
    scales = _scales(body, start)
    for _ in range(PAIRS):
        by_errors = FAR * rng.choice([-1.0, 1.0], len(horizon.errors)) @ horizon.errors
        # Where the coin is changes nothing; the last error is that of the time.
        change = np.concatenate([[0.0, 0.0], by_errors[:-1] + LEAST * scales * rng.normal(size=len(scales))])
        for side in (1.0, -1.0):
            y = start + side * change
            y[6:10] /= np.linalg.norm(y[6:10])
            if not _ends_alike(run(body, left, y, FOLLOWED), toss, first):
                return False
    return True


def _scales(body: Body, y: Array) -> Array:
    """Return the scales of a state's components from the height on, (11,)."""
    speed = (body.gravity * body.radius) ** 0.5 + float(np.linalg.norm(y[3:6]))
    spin = (body.gravity / body.radius) ** 0.5 + float(np.linalg.norm(y[10:13]))
    return np.array([body.radius, *[speed] * 3, *[1.0] * 4, *[spin] * 3])


def _ends_alike(neighbour: EventLog, toss: EventLog, first: int) -> bool:
    """Return whether a neighbour has the faces of a toss from an impact on, its outcome and its ending."""
    same = (neighbour.outcome, neighbour.ending) == (toss.outcome, toss.ending)
    return same and np.array_equal(neighbour.rows["face"], toss.rows["face"][first:])
