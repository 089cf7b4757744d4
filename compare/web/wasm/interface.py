"""What a page asks of the engine: compiled functions of rows of numbers, in double precision."""

# Words are integers in the numbers of a scenario.
# pyright: reportArgumentType=false

import numpy as np

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.sampling import floor_force, sample_contact
from cointoss.analytic.events import Verdict, started_of, toss_coin
from cointoss.analytic.flight.flying import sample
from cointoss.analytic.flight.state_vector import STATE_SIZE, position_of, spin_of, velocity_of
from cointoss.analytic.horizon.certainty import certainty_of
from cointoss.analytic.horizon.horizon import MOST_CARRIED, STEP_ERROR, TURN_ERROR, ErrorsMade, find_horizon
from cointoss.analytic.settings import MANY, ContactLimits, Settings
from cointoss.models.barriers import energy
from cointoss.models.body import AirLaw, Body, Rules
from cointoss.models.drag import Drag
from cointoss.models.impact_row import FIRST_ROOM
from cointoss.models.kernel.compiled import compiled
from cointoss.models.records import IMPACT_ROW, Array, UnsupportedError
from cointoss.models.scenario import Scenario

ANSWER = ("outcome", "ending", "impacts", "last_face", "end_time", "trusted_impacts", "outcome_certain")
"""Columns of what is answered of a toss; the last two are -1 where they were not asked for."""
IMPACT = ("time", "face", "energy", "impulse_x", "impulse_y", "impulse_z")
"""Columns of an impact, in SI."""
NUMBERS, ENDLESS = 47, (43, 44)
"""Length of a row of `numbers_of`, and where it may be infinite: the longest time, the height of no hand."""
PIECE = 2 + STATE_SIZE
"""Numbers of a piece of a path: when it starts, its `Mode`, and the state there."""
PLACES = {
    "release.position.x": ("release", 0),
    "release.position.y": ("release", 1),
    "release.position.z": ("release", 2),
    "release.velocity.x": ("release", 3),
    "release.velocity.y": ("release", 4),
    "release.velocity.z": ("release", 5),
    "release.angular_velocity.xi": ("release", 10),
    "release.angular_velocity.eta": ("release", 11),
    "release.angular_velocity.zeta": ("release", 12),
    "floor.restitution": ("numbers", 35),
    "floor.friction": ("numbers", 38),
}
"""Fields of a scenario that are one number of its row, or of its release: which, and where."""
NO_TRUST, TRUST, CERTAIN = range(3)
"""What is found beside the outcome: nothing, the trusted impacts, and whether the outcome is certain, too."""


def numbers_of(scenario: Scenario, settings: Settings = MANY) -> Array:
    """Return what a toss depends on beside its release as a row of numbers, (n,).

    Raises:
        UnsupportedError: for air whose exponent is above 0.
    """
    body, rules = scenario.body, scenario.rules
    if body.air.exponent is not None:
        raise UnsupportedError(f"air.exponent = {body.air.exponent}: accepted in a page: 0")
    return np.array(
        [
            *(body.mass, body.radius, body.thickness, *body.center),
            *np.ravel(body.inertia),
            *np.ravel(body.inertia_inverse),
            *(body.inertia_smallest, body.inertia_largest, body.air.normal, body.air.tangential),
            *(*body.drag, body.sliding_share, body.gravity),
            *rules,
            *(settings.contact_steps, settings.contact_tolerance),
        ],
        dtype=float,
    )


@compiled
def body_of(numbers: Array) -> Body:
    """Return the coin of a row of `numbers_of`."""
    n = numbers
    return Body(
        n[0],
        n[1],
        n[2],
        (n[3], n[4], n[5]),
        ((n[6], n[7], n[8]), (n[9], n[10], n[11]), (n[12], n[13], n[14])),
        ((n[15], n[16], n[17]), (n[18], n[19], n[20]), (n[21], n[22], n[23])),
        n[24],
        n[25],
        AirLaw(None, n[26], n[27]),
        Drag(n[28], n[29], n[30], n[31]),
        n[32],
        n[33],
    )


@compiled
def rules_of(numbers):
    """Return the `Rules` of a row of `numbers_of`; words are integers there."""
    n = numbers
    return Rules(
        int(n[34]),
        n[35],
        n[36],
        int(n[37]),
        n[38],
        n[39],
        n[40],
        int(n[41]),
        int(n[42]),
        n[43],
        n[44],
    )


@compiled
def limits_of(numbers: Array) -> ContactLimits:
    """Return the budget and the tolerance of a row of `numbers_of`."""
    return ContactLimits(int(numbers[45]), numbers[46])


@compiled
def toss_each(numbers: Array, releases: Array, wanted: int, answers: Array) -> None:
    """Toss a coin once from each release.

    Args:
        numbers: of the scenario, see `numbers_of`.
        releases: states at time 0, (n, 13); written over.
        wanted: `NO_TRUST`, `TRUST` or `CERTAIN`.
        answers: where they go, (n, 7), see `ANSWER`.
    """
    body, rules, limits = body_of(numbers), rules_of(numbers), limits_of(numbers)
    room = np.zeros(2 if wanted == NO_TRUST else FIRST_ROOM, IMPACT_ROW)
    for i in range(len(releases)):
        n, rows, pieces, outcome, ending, end_time = toss_coin(
            body, rules, limits, releases[i], room, wanted != NO_TRUST
        )
        answer = answers[i]
        answer[0], answer[1], answer[2], answer[4] = outcome.value, ending.value, n, end_time
        answer[3] = rows[(n - 1) % len(rows)]["face"] if n > 0 else 0
        answer[5], answer[6] = -1, -1
        if wanted != NO_TRUST:
            _write_trust(body, rules, rows[:n], pieces, Verdict(outcome, ending), wanted, answer)


@compiled
def _write_trust(body, rules, rows, pieces, verdict, wanted, answer):
    started = started_of(pieces)
    horizon = find_horizon(body, rules, rows, started, ErrorsMade(STEP_ERROR, TURN_ERROR, MOST_CARRIED))
    answer[5] = horizon.impacts
    if wanted == CERTAIN:
        answer[6] = certainty_of(body, rules, rows, started, verdict, horizon).certain


@compiled
def toss_one(
    numbers: Array, release: Array, answer: Array, impacts: Array, pieces: Array, sizes: Array
) -> None:
    """Toss a coin, and keep its impacts and the pieces of its path, as many as there is room for.

    Args:
        numbers: of the scenario, see `numbers_of`.
        release: state at time 0, (13,); written over.
        answer: where it goes, (7,), see `ANSWER`.
        impacts: where they go, (m, 6), see `IMPACT`.
        pieces: where they go, (k, `PIECE`), the last where the toss ends.
        sizes: how many impacts and pieces there are, (2,); written to.
    """
    body, rules, limits = body_of(numbers), rules_of(numbers), limits_of(numbers)
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    n, rows, found, outcome, ending, end_time = toss_coin(body, rules, limits, release, room, True)
    answer[0], answer[1], answer[2], answer[4] = outcome.value, ending.value, n, end_time
    answer[3] = rows[n - 1]["face"] if n > 0 else 0
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
def sample_path(numbers: Array, pieces: Array, times: Array, states: Array, more: Array) -> None:
    """Write the states of a path, its energies, and the floor's force in sustained contacts.

    Args:
        numbers: of the scenario, see `numbers_of`.
        pieces: of the path, all of them, see `toss_one`.
        times: increasing, from 0 to the end, (n,) [s].
        states: where they go, (n, 13).
        more: where energies [J] and forces, space frame, zero in flight [N], go, (n, 4).
    """
    body, rules, limits = body_of(numbers), rules_of(numbers), limits_of(numbers)
    friction, first = friction_in_contact(rules), 0
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
            sample_contact(contact, start, piece[0], times[first:last], limits.tolerance, states[first:last])
        for i in range(first, last):
            y, force = states[i], (0.0, 0.0, 0.0)
            if mode != Mode.FLIGHT.value and mode != Mode.ENDED.value:
                force = floor_force(contact_at(body, friction, mode, y), y)
            more[i, 0] = energy(body, position_of(y)[2], velocity_of(y), spin_of(y))
            more[i, 1], more[i, 2], more[i, 3] = force
        first = last
