"""Where coins come to rest: tosses of rows that are followed after their outcome is decided."""

import numpy as np

from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.events import Started, started_of, toss_coin
from cointoss.analytic.flight.state_vector import STATE_SIZE, spin_of, velocity_of
from cointoss.analytic.going_on import go_on
from cointoss.analytic.path import sample_piece
from cointoss.analytic.settings import ContactLimits
from cointoss.models.body import Body, OwnCode, with_budgets, with_own_law
from cointoss.models.free_joint import joint_of_states
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.arrays import Row, Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm
from cointoss.models.making import AT_REST, MOST_LOSSLESS
from cointoss.models.records import IMPACT_ROW
from cointoss.models.resting import is_still, path_length, unrest, write_rest
from cointoss.models.resting_place import RestReason
from cointoss.models.rows import AT, body_of, has_linear_air, rules_of, write_release

TURN = 0.25
"""The path of a contact or a flight is measured between states about this angle apart [rad]."""


@compiled
def rest_each(rows: Table, own: OwnCode, limits: ContactLimits, rests: Table) -> None:
    """Write where the coin of each of many scenarios comes to rest.

    Args:
        rows: of their fields, each a scenario's, (n, m).
        own: a contact law of one's own in place of theirs, or `NO_CODE`.
        limits: of sustained contact.
        rests: where they go, (n, 7), see `cointoss.models.resting_place.REST`.
    """
    for i in range(len(rows)):
        if has_linear_air(rows[i]):
            _rest_one(body_of(rows[i], None), rows[i], own, limits, rests[i])
        else:
            _rest_one(body_of(rows[i], float(rows[i, AT.air_exponent])), rows[i], own, limits, rests[i])


@compiled
def _rest_one(body: Body, row: Row, own: OwnCode, limits: ContactLimits, rest: Row) -> None:
    """Write where the coin `body` of a scenario comes to rest; for the rest see `rest_each`."""
    rules, y, room = with_own_law(rules_of(row), own), np.empty(STATE_SIZE), np.zeros(FIRST_ROOM, IMPACT_ROW)
    rules = with_budgets(rules, min(rules.max_impacts, MOST_LOSSLESS), rules.max_time)
    write_release(row, y)
    _, _, pieces, _, ending, end_time = toss_coin(body, rules, limits, y, room, True, np.empty(2))
    reason = unrest(body, rules, ending, end_time, velocity_of(y))
    until = AT_REST if reason == RestReason.AT_REST else 0.0
    started = started_of(go_on(body, rules, limits, pieces, ending, until))
    end, friction = joint_of_states(body, started.states[-1:])[0], friction_in_contact(rules)
    path = length_of(body, friction, limits.tolerance, started) if is_still(end) else 0.0
    write_rest(reason, started.times[-1], end, path, rest)


@compiled
def length_of(body: Body, friction: FloorFriction, tolerance: float, started: Started) -> float:
    """Return the length of the path of B over the floor from the first touch on, seen from above [m].

    Args:
        body: the coin.
        friction: of the floor, in contact.
        tolerance: error allowed in a step of contact, relative.
        started: where modes start, the first of which is the flight to the first touch, and the path's end.
    """
    total, rate = 0.0, (body.gravity / body.radius) ** 0.5
    for k in range(1, len(started.times) - 1):
        y, start, end = started.states[k], started.times[k], started.times[k + 1]
        n = 2 + int((end - start) * (rate + norm(spin_of(y))) / TURN)
        times, states = np.linspace(start, end, n), np.empty((n, STATE_SIZE))
        mode = 0 + int(started.modes[k])  # of eight bits, an integer keeps them in compiled code
        sample_piece(body, friction, tolerance, mode, y, start, times, states)
        total += path_length(times, joint_of_states(body, states))
    return total
