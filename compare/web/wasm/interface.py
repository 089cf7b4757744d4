"""What a page asks of the engine: compiled functions of rows of numbers, in double precision."""

# Words are integers in the numbers of a scenario.
# pyright: reportArgumentType=false

import math

import numpy as np

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.sampling import floor_force, sample_contact
from cointoss.analytic.events import Verdict, started_of, toss_coin
from cointoss.analytic.flight.flying import sample
from cointoss.analytic.flight.state_vector import STATE_SIZE, position_of, spin_of, velocity_of
from cointoss.analytic.horizon.certainty import certainty_of
from cointoss.analytic.horizon.horizon import MOST_CARRIED, STEP_ERROR, TURN_ERROR, ErrorsMade, find_horizon
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.compare.web.wasm.fields import FIELDS, FIRST
from cointoss.models.attitude import normalized, quaternion_from_angles
from cointoss.models.barriers import barrier, energy
from cointoss.models.body import NO_CODE, AirLaw, Body, Rules
from cointoss.models.faults import (
    Fault,
    fault_of_center,
    fault_of_floor,
    fault_of_inertia,
    fault_of_quaternion,
    fault_of_toss,
)
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector
from cointoss.models.making import Cylinder, make_body, most_impacts, moved_inertia
from cointoss.models.records import IMPACT_ROW, Array
from cointoss.models.state import State, state

ANSWER = ("outcome", "ending", "impacts", "last_face", "end_time", "trusted_impacts", "outcome_certain")
"""Columns of what is answered of a toss; the last two are -1 where they were not asked for."""
IMPACT = ("time", "face", "energy", "impulse_x", "impulse_y", "impulse_z")
"""Columns of an impact, in SI."""
EXAMINED = ("fault", "limit", "barrier")
"""Columns of what is said of a scenario: its `Fault`, the number in its sentence, and the least energy with
which the coin turns over [J], NaN of a row that is no scenario's."""
PIECE = 2 + STATE_SIZE
"""Numbers of a piece of a path: when it starts, its `Mode`, and the state there."""
NO_TRUST, TRUST, CERTAIN = range(3)
"""What is found beside the outcome: nothing, the trusted impacts, and whether the outcome is certain, too."""
NO_SCENARIO = -2
"""In place of the outcome, where the numbers make no scenario."""
_LIMITS = contact_limits(MANY)
_COIN, _CENTER, _INERTIA = (
    FIELDS.index(name) for name in ("coin.mass", "coin.center_of_mass.xi", "coin.inertia.xi.xi")
)
_AIR, _FLOOR = FIELDS.index("air.exponent"), FIELDS.index("floor.restitution")
_POSITION, _ANGLES, _QUATERNION, _SPIN = (
    FIELDS.index(f"release.{name}")
    for name in ("position.x", "angles.psi", "quaternion.e0", "angular_velocity.xi")
)
_ENDING = FIELDS.index("ending.test")


@compiled
def three(row: Array, first: int) -> Vector:
    """Return three numbers of a row."""
    return row[first], row[first + 1], row[first + 2]


@compiled
def foreign_number(row: Array) -> int:
    """Return the place of the first number that no scenario's row has there, -1 where there is none.

    All are finite, but for the parts of a scenario that are left out, which are not a number as a whole.
    """
    for i in range(len(FIRST)):
        is_left_out = FIRST[i] >= 0 and math.isnan(row[FIRST[i]])
        if not (math.isnan(row[i]) if is_left_out else math.isfinite(row[i])):
            return i
    return -1


@compiled
def cylinder_of(row: Array) -> Cylinder:
    """Return the mass and the size of the coin of a row of `fields.FIELDS`."""
    return Cylinder(row[_COIN], row[_COIN + 1], row[_COIN + 2])


@compiled
def has_inertia(row: Array) -> bool:
    """Return whether a row gives the inertia, which else is the cylinder's."""
    return not math.isnan(row[_INERTIA])


@compiled
def inertia_of(row: Array) -> Matrix:
    """Return J_C of the coin of a row, body frame [kg m²]."""
    if has_inertia(row):
        return three(row, _INERTIA), three(row, _INERTIA + 3), three(row, _INERTIA + 6)
    return moved_inertia(cylinder_of(row), three(row, _CENTER))


@compiled
def body_of(row: Array, exponent: float | None) -> Body:
    """Return the coin of a row.

    Args:
        row: of a scenario.
        exponent: of its air; None for linear air, which is compiled apart.
    """
    air = AirLaw(exponent, row[_AIR + 1], row[_AIR + 2])
    return make_body(cylinder_of(row), three(row, _CENTER), inertia_of(row), air, row[0])


@compiled
def has_linear_air(row: Array) -> bool:
    """Return whether the air of a row is linear in the velocity, or none."""
    return row[_AIR] == 0 or (row[_AIR + 1] == 0 and row[_AIR + 2] == 0)


@compiled
def rules_of(row):
    """Return the `Rules` of a row; words are integers there."""
    floor, ending = row[_FLOOR : _FLOOR + 7], row[_ENDING : _ENDING + 4]
    law, kind = int(floor[2]), int(floor[6])
    most = most_impacts(law, kind, floor[0]) if math.isnan(ending[1]) else int(ending[1])
    return Rules(
        law,
        NO_CODE,
        floor[0],
        floor[1],
        kind,
        floor[3],
        floor[4],
        floor[5],
        int(ending[0]),
        most,
        ending[2],
        math.inf if math.isnan(ending[3]) else ending[3],
    )


@compiled
def release_of(row: Array) -> State:
    """Return the state at the release of a row; without an attitude the coin is flat, heads up."""
    q = row[_QUATERNION : _QUATERNION + 4]
    if not math.isnan(q[0]):
        e = normalized((q[0], q[1], q[2], q[3]))
    elif not math.isnan(row[_ANGLES]):
        e = quaternion_from_angles(three(row, _ANGLES))
    else:
        e = quaternion_from_angles((0.0, 0.0, 0.0))
    return state(three(row, _POSITION), three(row, _POSITION + 3), e, three(row, _SPIN))


@compiled
def write_release(row: Array, y: Array) -> None:
    """Write the state at the release of a row as a state vector, (13,)."""
    release = release_of(row)
    for i in range(3):
        y[i], y[3 + i], y[10 + i] = release.position[i], release.velocity[i], release.spin[i]
    for i in range(4):
        y[6 + i] = release.attitude[i]


@compiled
def fault_of_parts(row):
    """Return what is wrong with the coin, the floor or the attitude of a row, each for itself."""
    cylinder = cylinder_of(row)
    found = fault_of_center(cylinder, three(row, _CENTER))
    if found.fault == Fault.NONE:
        found = fault_of_inertia(cylinder, inertia_of(row), has_inertia(row))
    if found.fault == Fault.NONE:
        found = fault_of_floor(int(row[_FLOOR + 2]), int(row[_FLOOR + 6]), row[_FLOOR + 4], row[_FLOOR + 5])
    q = row[_QUATERNION : _QUATERNION + 4]
    if found.fault == Fault.NONE and not math.isnan(q[0]):
        found = fault_of_quaternion((q[0], q[1], q[2], q[3]))
    return found


@compiled
def fault_of(body, row):
    """Return what is wrong with the scenario of a row, whose coin is made."""
    found = fault_of_parts(row)
    return found if found.fault != Fault.NONE else fault_of_toss(body, rules_of(row), release_of(row))


@compiled
def examine(row: Array, answer: Array) -> None:
    """Say whether a row is a scenario.

    Args:
        row: of numbers, each within its bounds where it is finite.
        answer: where it goes, (3,), see `EXAMINED`.
    """
    place = foreign_number(row)
    if place >= 0:
        answer[0], answer[1], answer[2] = Fault.ROW.value, place, math.nan
    elif has_linear_air(row):
        _examine(body_of(row, None), row, answer)
    else:
        _examine(body_of(row, row[_AIR]), row, answer)


@compiled
def _examine(body, row, answer):
    found = fault_of(body, row)
    answer[0], answer[1] = found.fault.value, found.limit
    answer[2] = min(barrier(body, 1.0), barrier(body, -1.0))


@compiled
def toss_each(rows: Array, wanted: int, answers: Array) -> None:
    """Toss each of many scenarios.

    Args:
        rows: of their fields, (n, m).
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
        answers: where they go, (n, 7), see `ANSWER`.
    """
    impacts, y = np.zeros(2 if wanted == NO_TRUST else FIRST_ROOM, IMPACT_ROW), np.empty(STATE_SIZE)
    for i in range(len(rows)):
        for k in range(answers.shape[1]):
            answers[i, k] = -1.0
        if foreign_number(rows[i]) >= 0:
            answers[i, 0] = NO_SCENARIO
        elif has_linear_air(rows[i]):
            _answer(body_of(rows[i], None), rows[i], wanted, impacts, y, answers[i])
        else:
            _answer(body_of(rows[i], rows[i, _AIR]), rows[i], wanted, impacts, y, answers[i])


@compiled
def _answer(body, row, wanted, impacts, y, answer):
    if fault_of(body, row).fault != Fault.NONE:
        answer[0] = NO_SCENARIO
        return
    rules = rules_of(row)
    write_release(row, y)
    keep_all = wanted != NO_TRUST
    n, impacts, pieces, outcome, ending, end_time = toss_coin(body, rules, _LIMITS, y, impacts, keep_all)
    _write_end(n, impacts, Verdict(outcome, ending), end_time, answer)
    if keep_all:
        _write_trust(body, rules, impacts[:n], pieces, Verdict(outcome, ending), wanted, answer)


@compiled
def _write_end(n, impacts, verdict, end_time, answer):
    answer[0], answer[1], answer[2], answer[4] = verdict.outcome.value, verdict.ending.value, n, end_time
    answer[3] = impacts[(n - 1) % len(impacts)]["face"] if n > 0 else 0


@compiled
def _write_trust(body, rules, impacts, pieces, verdict, wanted, answer):
    started = started_of(pieces)
    made = ErrorsMade(STEP_ERROR, TURN_ERROR, MOST_CARRIED)
    horizon = find_horizon(body, rules, impacts, started, made)
    answer[5] = horizon.impacts
    if wanted == CERTAIN:
        answer[6] = certainty_of(body, rules, impacts, started, verdict, horizon).certain


@compiled
def toss_one(row: Array, answer: Array, impacts: Array, pieces: Array, sizes: Array) -> None:
    """Toss a scenario, and keep its impacts and the pieces of its path, as many as there is room for.

    Args:
        row: of its fields; of a scenario, see `examine`.
        answer: where it goes, (7,), see `ANSWER`.
        impacts: where they go, (m, 6), see `IMPACT`.
        pieces: where they go, (k, `PIECE`), the last where the toss ends.
        sizes: how many impacts and pieces there are, (2,); written to.
    """
    if has_linear_air(row):
        _toss_one(body_of(row, None), row, answer, impacts, pieces, sizes)
    else:
        _toss_one(body_of(row, row[_AIR]), row, answer, impacts, pieces, sizes)


@compiled
def _toss_one(body, row, answer, impacts, pieces, sizes):
    rules, y = rules_of(row), np.empty(STATE_SIZE)
    write_release(row, y)
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    n, rows, found, outcome, ending, end_time = toss_coin(body, rules, _LIMITS, y, room, True)
    _write_end(n, rows, Verdict(outcome, ending), end_time, answer)
    _write_trust(body, rules, rows[:n], found, Verdict(outcome, ending), CERTAIN, answer)
    sizes[0], sizes[1] = n, len(found)
    for i in range(min(n, len(impacts))):
        row = rows[i]
        impacts[i, 0], impacts[i, 1], impacts[i, 2] = row.time, row.face, row.energy
        for k in range(3):
            impacts[i, 3 + k] = row.impulse[k]
    for i in range(min(len(found), len(pieces))):
        for k in range(PIECE):
            pieces[i, k] = found[i, k]


@compiled
def sample_path(row: Array, pieces: Array, times: Array, states: Array, more: Array) -> None:
    """Write the states of a path, its energies, and the floor's force in sustained contacts.

    Args:
        row: of the scenario's fields.
        pieces: of the path, all of them, see `toss_one`.
        times: increasing, from 0 to the end, (n,) [s].
        states: where they go, (n, 13).
        more: where energies [J] and forces, space frame, zero in flight [N], go, (n, 4).
    """
    if has_linear_air(row):
        _sample_path(body_of(row, None), row, pieces, times, states, more)
    else:
        _sample_path(body_of(row, row[_AIR]), row, pieces, times, states, more)


@compiled
def _sample_path(body, row, pieces, times, states, more):
    friction, first = friction_in_contact(rules_of(row)), 0
    for number in range(len(pieces)):
        piece, last = pieces[number], len(times)
        if number + 1 < len(pieces):
            last = first
            while last < len(times) and times[last] < pieces[number + 1, 0]:
                last += 1
        if last == first:
            continue
        # Nothing starts at the end; as a flight, it is sampled as it is.
        start, mode = piece[2:].copy(), int(piece[1])
        if mode == Mode.FLIGHT.value or mode == Mode.ENDED.value:
            sample(body, start, piece[0], times[first:last], states[first:last])
        else:
            contact = contact_at(body, friction, mode, start)
            sample_contact(contact, start, piece[0], times[first:last], _LIMITS.tolerance, states[first:last])
        for i in range(first, last):
            y, force = states[i], (0.0, 0.0, 0.0)
            if mode != Mode.FLIGHT.value and mode != Mode.ENDED.value:
                force = floor_force(contact_at(body, friction, mode, y), y)
            more[i, 0] = energy(body, position_of(y)[2], velocity_of(y), spin_of(y))
            more[i, 1], more[i, 2], more[i, 3] = force
        first = last
