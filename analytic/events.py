"""The event loop of a toss: fly, touch, hit, stay in contact, stop."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.contact.contact import Verdict, friction_in_contact, keeps_contact, next_motion, stay
from analytic.contact.edge import held_on_edge, on_edge, stands
from analytic.contact.floor_force import Motion, side_of
from analytic.contact.upright import put_upright, rim_forces, start_creep
from analytic.flight.equations_of_motion import STATE_SIZE, attitude_of, position_of, spin_of, velocity_of
from analytic.flight.flying import fly
from analytic.flight.touch_search import closing_speed, crowded
from analytic.impact.laws import impulse, spin_gained
from models.attitude import rotation_matrix
from models.body import Body, Rules
from models.ending import judge
from models.geometry import contact_velocity, lowest_point
from models.impact_row import FIRST_ROOM, with_room, write_impact
from models.kernel.compiled import compiled
from models.kernel.vectors import add, apply, scale, subtract
from models.perpetual import dies_away, first_contact, no_looks
from models.records import IMPACT_ROW, Array, Ending, Outcome

# The most steps and changes of a toss in contact.
CONTACT_STEPS = 50_000_000
# A change that takes less than this part of √(r/g) costs so many of them.
_NO_TIME, _STALLED = 1e-12, 1000
# An upright coin is tried for whether it stands once in so many of them.
_UPRIGHT_LOOK = 64
# A loss in the time √(r/g) that is none, against the energy: rounding takes up to a tenth of it.
NO_LOSS = 1e-12


class Run(NamedTuple):
    """What the event loop gives for one toss."""

    rows: NDArray[Any]
    """Impacts, (n,) of `IMPACT_ROW`."""
    start_times: Array
    """Where flights and contacts start, and where the toss ends, (k,) [s]."""
    start_states: Array
    """States there, (k, 13)."""
    motions: NDArray[np.int8]
    """What starts there: `Motion`, (k,)."""
    contacts: Array
    """Start and end of every contact that lasts, (n, 2) [s]."""
    outcome: Outcome
    ending: Ending
    end_time: float


def run(body: Body, rules: Rules, start: Array) -> Run:
    """Toss the coin in state `start`, (13,), until the toss is decided."""
    room = np.zeros(FIRST_ROOM, IMPACT_ROW)
    n, rows, pieces, outcome, ending, end_time = fly_and_hit(body, rules, start.copy(), room, True)
    start_times, motions = pieces[:, 0].copy(), pieces[:, 1].astype(np.int8)
    return Run(
        rows=rows[:n].copy(),
        start_times=start_times,
        start_states=pieces[:, 2:].copy(),
        motions=motions,
        contacts=contacts_of(start_times, motions),
        outcome=Outcome(outcome),
        ending=Ending(ending),
        end_time=end_time,
    )


def contacts_of(start_times: Array, motions: NDArray[np.int8]) -> Array:
    """Give start and end of every contact that lasts, (n, 2) [s]; see `Run` for the arguments."""
    changes = np.diff((motions != Motion.FLIGHT).astype(np.int8), prepend=0)
    return np.stack([start_times[changes == 1], start_times[changes == -1]], axis=1)


@compiled
def hit(body, rules, chi, y, row):
    """Let the floor act on the coin in state y, which touches it, and record the impact.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of this impact.
        y: state at the touch, (13,); becomes the state after the impact.
        row: where the impact is recorded, one `IMPACT_ROW`.

    Returns:
        `Ending.NO_SOLUTION` where the contact law has none, else `Ending.NONE`.
    """
    v, w, R = velocity_of(y), spin_of(y), rotation_matrix(attitude_of(y))
    point, flat = lowest_point(body, R[2], w)
    arm = apply(R, subtract(point, body.center))
    edge = (point[0] ** 2 + point[1] ** 2) ** 0.5
    tau = apply(R, (-point[1] / edge, point[0] / edge, 0.0)) if edge > 0 else (1.0, 0.0, 0.0)
    v_A = contact_velocity(body, R, v, w, point)
    S, ending = impulse(body, rules, chi, R, arm, tau, v_A, flat)
    v_after = add(v, scale(1 / body.mass, S))
    w_after = w if flat else add(w, spin_gained(body, R, arm, S))
    v_A_after = contact_velocity(body, R, v_after, w_after, point)
    touch, release = (position_of(y), v, attitude_of(y), w, v_A), (y[2], v_after, w_after, v_A_after)
    write_impact(body, S, point, R[2][2], touch, release, row)
    y[3], y[4], y[5] = v_after
    y[10], y[11], y[12] = w_after
    return ending


@compiled
def fly_and_hit(body, rules, y, rows, keep_all):
    """Run the event loop.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at release, (13,); becomes the state at the end.
        rows: where the impacts are recorded, (m,) of `IMPACT_ROW`. A touch for which the contact law has no
            solution uses up the row of the impact that it is not.
        keep_all: whether all impacts are recorded, in as many rows as they need, and flights and contacts;
            else impact number n is recorded in row n modulo m.

    Returns:
        Number of impacts; the rows; flights and contacts, each with its start, `Motion` and state, and the
        end, (k, 15), or none; outcome; ending; and the time of the end [s].
    """
    pieces, spare = np.empty((FIRST_ROOM if keep_all else 0, 2 + STATE_SIZE)), np.zeros(1, IMPACT_ROW)
    time, n, k, steps_left = 0.0, 0, 0, CONTACT_STEPS
    motion, looks = Motion.FLIGHT, no_looks()
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    mu = friction_in_contact(rules)
    while True:
        if keep_all:
            if k == len(pieces):
                pieces = doubled(pieces)
            # Nothing starts at the end; as a flight, it is sampled as it is.
            pieces[k, 0], pieces[k, 1] = time, motion.value if ending == Ending.NONE else Motion.FLIGHT.value
            pieces[k, 2:] = y
            k += 1
        if ending != Ending.NONE:
            break
        if motion != Motion.FLIGHT:
            time, steps_left, motion, outcome, ending = keep_contact(
                body, rules, mu, motion, y, time, steps_left, looks
            )
        elif n == rules.max_impacts:
            ending = Ending.MAX_IMPACTS
        else:
            flown, touches, _ = fly(body, y, rules.max_time - time)
            time += flown
            if not touches:
                ending = Ending.MAX_TIME
            elif crowded(body, rules.restitution, y):
                outcome, ending = decided(body, rules, y)
                if ending == Ending.NONE and not keeps_contact(rules.law):
                    ending = Ending.CHATTER
                if ending == Ending.NONE:
                    ending = hit(body, rules, 0.0, y, spare[0])
                    motion = next_motion(body, mu, motion, y)
                    first_contact(body, looks, time)
                    steps_left -= 1
                    if ending == Ending.NONE and steps_left <= 0:
                        ending = Ending.CHATTER
            else:
                if keep_all:
                    rows = with_room(rows, n)
                row = rows[n % len(rows)]
                ending = hit(body, rules, rules.restitution, y, row)
                if ending == Ending.NONE:
                    row.time = time
                    n += 1
                    # A step forced at a grazing point may have left the coin a little below the floor.
                    y[2] -= min(closing_speed(body, y)[0], 0.0)
                    outcome, ending = decided(body, rules, y)
                    if ending == Ending.NONE and _goes_on(body, rules, y, time, looks):
                        outcome, ending = Outcome.PERPETUAL, Ending.PERPETUAL
    return n, rows, pieces[:k], outcome, ending, time


@compiled
def doubled(table):
    """Give the table with twice its rows."""
    larger = np.empty((2 * len(table), table.shape[1]))
    larger[: len(table)] = table
    return larger


@compiled
def keep_contact(body, rules, mu, motion, y, time, steps_left, looks):
    """Follow a contact until the coin slides, creeps, sticks or lifts off, or the toss is decided.

    Args:
        body: the coin.
        rules: floor and ending.
        mu: coefficient of friction μ, 0 on a smooth floor.
        motion: `Motion` in contact.
        y: state, (13,); advanced.
        time: now [s].
        steps_left: the most steps wanted.
        looks: see `models.perpetual.dies_away`.

    Returns:
        The time [s], the steps left, the next `Motion`, the outcome and the ending.
    """
    undecided, dt = Outcome.UNDECIDED, np.inf
    while time < rules.max_time:
        made, dt, verdict = stay(body, mu, motion, y, min(dt, rules.max_time - time))
        time += made
        stalled = verdict == Verdict.CHANGES and made < _NO_TIME * (body.radius / body.gravity) ** 0.5
        steps_left -= _STALLED if stalled else 1
        outcome, ending = decided(body, rules, y)
        upright = motion == Motion.UPRIGHT
        one_rim = Motion.SLIDING if upright else motion
        looked_at = steps_left % _UPRIGHT_LOOK == 0 if upright else on_edge(body, y)
        if ending == Ending.NONE and looked_at and held_on_edge(body, mu, one_rim, y):
            if stands(body, mu, one_rim, y):
                outcome, ending = Outcome.EDGE, Ending.STANDING
            elif not upright:
                both = y.copy()
                put_upright(body, both)
                if motion == Motion.STICKING:
                    start_creep(body, mu, side_of(y), both)
                if min(rim_forces(body, mu, both)) > 0:
                    y[:] = both
                    return time, steps_left, Motion.UPRIGHT, undecided, Ending.NONE
        if ending == Ending.NONE and _goes_on(body, rules, y, time, looks):
            outcome, ending = Outcome.PERPETUAL, Ending.PERPETUAL
        if ending != Ending.NONE:
            return time, steps_left, motion, outcome, ending
        if steps_left <= 0:
            return time, steps_left, motion, undecided, Ending.CHATTER
        if verdict == Verdict.LANDS:
            return time, steps_left, Motion.FLIGHT, undecided, Ending.NONE
        if verdict == Verdict.CHANGES:
            return time, steps_left, next_motion(body, mu, motion, y), undecided, Ending.NONE
    return time, steps_left, motion, undecided, Ending.MAX_TIME


@compiled
def decided(body, rules, y):
    """Give the outcome and the ending that `judge` gives of the state y, (13,)."""
    up = rotation_matrix(attitude_of(y))[2]
    return judge(body, rules, y[2], velocity_of(y), up, spin_of(y))


@compiled
def _goes_on(body, rules, y, time, looks):
    """Tell whether a coin in state y, (13,), turns over for ever."""
    up = rotation_matrix(attitude_of(y))[2]
    return dies_away(body, rules, y[2], velocity_of(y), up, spin_of(y), NO_LOSS, time, looks)
