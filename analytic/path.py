"""The states of a toss between its events, and the floor's force there."""

from cointoss.analytic.contact.automaton import Mode, contact_at
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.sampling import floor_force, sample_contact
from cointoss.analytic.events import Started
from cointoss.analytic.flight.flying import sample
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Codes, Row, Table, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector
from cointoss.models.records import Array


@compiled
def sample_piece(
    body: Body,
    friction: FloorFriction,
    tolerance: float,
    mode: int,
    start: Row,
    start_time: float,
    times: Row,
    states: Table,
) -> None:
    """Write the states of a flight or of a contact in one mode.

    Args:
        body: the coin.
        friction: of the floor, in contact.
        tolerance: error allowed in a step of contact, relative.
        mode: its `Mode`; what starts at the end of a toss is sampled as a flight.
        start: state where it starts, (13,).
        start_time: its time [s].
        times: increasing, none before `start_time`, (n,) [s].
        states: where they go, (n, 13).
    """
    if mode == Mode.FLIGHT or mode == Mode.ENDED:
        sample(body, start, start_time, times, states)
    elif mode == Mode.RESTING:
        for i in range(len(times)):
            copy_into(states[i], start)
    else:
        contact = contact_at(body, friction, mode, start)
        sample_contact(contact, start, start_time, times, tolerance, states)


@compiled
def sample_pieces(
    body: Body, friction: FloorFriction, tolerance: float, started: Started, times: Row, states: Table
) -> None:
    """Write the states of a path at `times`.

    Args:
        body: the coin.
        friction: of the floor, in contact.
        tolerance: error allowed in a step of contact, relative.
        started: where its modes start, and where it ends.
        times: increasing, from the path's start to its end, (n,) [s].
        states: where they go, (n, 13).
    """
    first, last = 0, len(started.times) - 1
    for k in range(last + 1):
        after = first
        while after < len(times) and (k == last or times[after] < started.times[k + 1]):
            after += 1
        if after > first:
            # Of eight bits, an integer keeps them in compiled code.
            mode, start, some = 0 + int(started.modes[k]), started.states[k], states[first:after]
            sample_piece(body, friction, tolerance, mode, start, started.times[k], times[first:after], some)
        first = after


@compiled
def floor_forces(body: Body, friction: FloorFriction, modes: Codes, states: Table, forces: Table) -> None:
    """Write the floor's force in states of sustained contact, space frame, (n, 3) [N].

    Args:
        body: the coin.
        friction: of the floor, in contact.
        modes: `Mode` of each state, (n,).
        states: (n, 13).
        forces: where they go.
    """
    for i in range(len(states)):
        mode = 0 + int(modes[i])  # of eight bits, an integer keeps them in compiled code
        copy_into(forces[i], force_in(body, friction, mode, states[i]))


@compiled
def force_in(body: Body, friction: FloorFriction, mode: int, y: Array) -> Vector:
    """Return the floor's force on a coin in the state y, (13,), and in this `Mode`, space frame, (3,) [N]."""
    if mode == Mode.FLIGHT or mode == Mode.ENDED:
        return 0.0, 0.0, 0.0
    if mode == Mode.RESTING:
        return 0.0 - body.mass * body.downhill, 0.0, body.mass * body.gravity
    return floor_force(contact_at(body, friction, mode, y), y)
