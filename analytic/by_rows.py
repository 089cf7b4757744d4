"""Tosses of scenarios as rows of numbers: many of them, or one with its impacts and its path."""

import numpy as np

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.events import Started, TossEnd, started_of, toss_coin
from cointoss.analytic.flight.state_vector import STATE_SIZE, position_of, spin_of, velocity_of
from cointoss.analytic.going_on import go_on
from cointoss.analytic.horizon.certainty import certainty_of
from cointoss.analytic.horizon.horizon import MOST_CARRIED, STEP_ERROR, TURN_ERROR, ErrorsMade, find_horizon
from cointoss.analytic.path import force_in, sample_pieces
from cointoss.analytic.settings import MANY, ContactLimits, contact_limits
from cointoss.analytic.together import toss_together
from cointoss.models.answers import ANSWER_AT, write_end
from cointoss.models.barriers import energy
from cointoss.models.body import NO_CODE, Body, OwnCode, Rules, with_budgets, with_own_law
from cointoss.models.faults import Fault
from cointoss.models.impact_row import FIRST_ROOM, ImpactRows, last_face
from cointoss.models.kernel.arrays import Row, Table, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.records import IMPACT_ROW
from cointoss.models.rows import (
    AT,
    NOT_TOSSED,
    REFUSED,
    body_of,
    examine_each,
    has_linear_air,
    rules_of,
    run_end,
    write_release,
)

IMPACT = ("time", "face", "energy", "impulse_x", "impulse_y", "impulse_z")
"""Columns of an impact, in SI."""
PIECE = 2 + STATE_SIZE
"""The length of a row for a piece of a path: start time, `Mode`, and state at the start."""
NO_TRUST, TRUST, CERTAIN = range(3)
"""Beside the outcome a toss finds: nothing; the trusted impacts; or also whether the outcome is certain."""
_LIMITS = contact_limits(MANY)


@compiled
def toss_rows(rows: Table, own: OwnCode, limits: ContactLimits, wanted: int, answers: Table) -> None:
    """Toss each of many scenarios.

    Args:
        rows: of their fields, each a scenario's, (n, m).
        own: a contact law of one's own in place of theirs, or `NO_CODE`.
        limits: of sustained contact.
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
        answers: where they go, (n, 7), see `cointoss.models.answers.ANSWER`.
    """
    first = 0
    while first < len(rows):
        end = run_end(rows, first)
        some, found = rows[first:end], answers[first:end]
        if has_linear_air(rows[first]) and wanted == NO_TRUST and own.address == NO_CODE.address:
            toss_together(body_of(rows[first], None), some, limits, found)
        else:
            _toss_one_by_one(some, own, limits, wanted, found)
        first = end


@compiled
def _toss_one_by_one(rows: Table, own: OwnCode, limits: ContactLimits, wanted: int, answers: Table) -> None:
    """Toss rows with one coin, air and gravity; for the arguments see `toss_rows`."""
    if has_linear_air(rows[0]):
        _toss_run(body_of(rows[0], None), rows, own, limits, wanted, answers)
    else:
        _toss_run(body_of(rows[0], rows[0, AT.air_exponent]), rows, own, limits, wanted, answers)


@compiled
def _toss_run(
    body: Body, rows: Table, own: OwnCode, limits: ContactLimits, wanted: int, answers: Table
) -> None:
    """Toss rows with one coin, air and gravity, which are those of `body`; for the rest see `toss_rows`."""
    keep_all, y = wanted != NO_TRUST, np.empty(STATE_SIZE)
    impacts = np.zeros(FIRST_ROOM if keep_all else 2, IMPACT_ROW)
    for i in range(len(rows)):
        rules, answer = with_own_law(rules_of(rows[i]), own), answers[i]
        _forget(answer[ANSWER_AT.ending :])
        if keep_all:
            rules = with_budgets(rules, min(rules.max_impacts, MOST_LOSSLESS), rules.max_time)
        write_release(rows[i], y)
        n, impacts, pieces, outcome, ending, end_time = toss_coin(
            body, rules, limits, y, impacts, keep_all, np.empty(2)
        )
        if keep_all:
            _write_trust(body, rules, impacts[:n], pieces, TossEnd(outcome, ending), wanted, answer)
        write_end(outcome, ending, n, last_face(impacts, n), end_time, answer)


@compiled
def _forget(answer: Row) -> None:
    """Write -1, for what is not asked for, into an answer or a part of one."""
    for k in range(len(answer)):
        answer[k] = NOT_TOSSED


@compiled
def toss_each(rows: Table, wanted: int, answers: Table) -> None:
    """Toss each of many rows, some of which may be invalid scenarios.

    Args:
        rows: of their fields, (n, m).
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
        answers: where they go, (n, 7), see `cointoss.models.answers.ANSWER`; an invalid scenario gets
            `REFUSED` in place of the outcome.
    """
    faults = np.empty(1, np.int8)
    for i in range(len(rows)):
        examine_each(rows[i : i + 1], faults)
        if faults[0] == Fault.NONE.value:
            _toss_one_by_one(rows[i : i + 1], NO_CODE, _LIMITS, wanted, answers[i : i + 1])
        else:
            _forget(answers[i])
            answers[i, ANSWER_AT.outcome] = REFUSED


@compiled
def toss_apart(rows: Table, answers: Table, limits: ContactLimits, wanted: int) -> None:
    """Toss each of many scenarios by itself, as a thread of a card does: in vacuum or in air with b = 0.

    Args:
        rows: of their fields, each a scenario's, (n, m).
        answers: where they go, (n, 7), see `cointoss.models.answers.ANSWER`.
        limits: of sustained contact.
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
    """
    for i in range(len(rows)):
        _toss_run(body_of(rows[i], None), rows[i : i + 1], NO_CODE, limits, wanted, answers[i : i + 1])


@compiled
def _write_trust(
    body: Body, rules: Rules, impacts: ImpactRows, pieces: Table, verdict: TossEnd, wanted: int, answer: Row
) -> None:
    """Write how many impacts can be trusted, and if it is wanted whether the outcome is certain.

    Args:
        body: the coin.
        rules: floor and ending.
        impacts: of the toss.
        pieces: where its modes start, as `toss_coin` returns them.
        verdict: how it ended.
        wanted: `TRUST` or `CERTAIN`.
        answer: where it goes, (7,).
    """
    started = started_of(pieces)
    made = ErrorsMade(STEP_ERROR, TURN_ERROR, MOST_CARRIED)
    horizon = find_horizon(body, rules, impacts, started, made)
    answer[ANSWER_AT.trusted_impacts] = horizon.impacts
    if wanted == CERTAIN:
        certainty = certainty_of(body, rules, impacts, started, verdict, horizon)
        answer[ANSWER_AT.outcome_certain] = certainty.certain


@compiled
def toss_one(row: Row, answer: Row, impacts: Table, pieces: Table, sizes: Row) -> None:
    """Toss a scenario, and keep its impacts and the pieces of its path, as many as there is room for.

    Args:
        row: of its fields; of a scenario, see `examine`.
        answer: where it goes, (7,), see `cointoss.models.answers.ANSWER`.
        impacts: where they go, (m, 6), see `IMPACT`.
        pieces: where they go, (k, `PIECE`), the last where the path ends: with the toss, or after it, see
            `cointoss.analytic.going_on`.
        sizes: how many impacts and pieces there are, (2,); written to.
    """
    if has_linear_air(row):
        _toss_one(body_of(row, None), row, answer, impacts, pieces, sizes)
    else:
        _toss_one(body_of(row, float(row[AT.air_exponent])), row, answer, impacts, pieces, sizes)


@compiled
def _toss_one(body: Body, row: Row, answer: Row, impacts: Table, pieces: Table, sizes: Row) -> None:
    """Toss a scenario whose coin is `body`; for the rest see `toss_one`."""
    rules, y = rules_of(row), np.empty(STATE_SIZE)
    write_release(row, y)
    room, until = np.zeros(FIRST_ROOM, IMPACT_ROW), float(row[AT.ending_until])
    n, rows, found, outcome, ending, end_time = toss_coin(body, rules, _LIMITS, y, room, True, sizes)
    write_end(outcome, ending, n, last_face(rows, n), end_time, answer)
    _write_trust(body, rules, rows[:n], found, TossEnd(outcome, ending), CERTAIN, answer)
    if until > end_time:
        found = go_on(body, rules, _LIMITS, found, ending, until)
    sizes[0], sizes[1] = n, len(found)
    for i in range(min(n, len(impacts))):
        S = rows[i].impulse
        copy_into(impacts[i], (rows[i].time, float(rows[i].face), rows[i].energy, S[0], S[1], S[2]))
    for i in range(min(len(found), len(pieces))):
        copy_into(pieces[i], found[i])


@compiled
def sample_path(row: Row, pieces: Table, times: Row, states: Table, more: Table) -> None:
    """Write the states of a path, its energies, and the floor's force in sustained contacts.

    Args:
        row: of the scenario's fields.
        pieces: of the path, all of them, see `toss_one`.
        times: increasing, from 0 to the end, (n,) [s].
        states: where they go, (n, 13).
        more: where energies [J] and forces, space frame, zero in flight and in a hand [N], go, (n, 4).
    """
    if has_linear_air(row):
        _sample_path(body_of(row, None), row, pieces, times, states, more)
    else:
        _sample_path(body_of(row, float(row[AT.air_exponent])), row, pieces, times, states, more)


@compiled
def _sample_path(body: Body, row: Row, pieces: Table, times: Row, states: Table, more: Table) -> None:
    """Write the states of a path of the coin `body`; for the rest see `sample_path`."""
    starts, modes, nothing = pieces[:, 0].copy(), pieces[:, 1].astype(np.int8), np.empty(0)
    started, number, friction = (
        Started(starts, pieces[:, 2:PIECE].copy(), modes, nothing, nothing),
        0,
        friction_in_contact(rules_of(row)),
    )
    sample_pieces(body, friction, _LIMITS.tolerance, started, times, states)
    for i in range(len(times)):
        while number + 1 < len(starts) and times[i] >= starts[number + 1]:
            number += 1
        y, before, mode = states[i], int(pieces[number - 1, 1]), int(pieces[number, 1])
        # A coin that comes to rest from flight is in a hand, and no floor holds it.
        held = Mode.FLIGHT.value if mode == Mode.RESTING and before == Mode.FLIGHT else mode
        E = energy(body, position_of(y)[2], velocity_of(y), spin_of(y))
        copy_into(more[i], (E, *force_in(body, friction, held, y)))
