"""The event loop of a toss: fly, touch, hit, stop."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from analytic.flight import STATE_SIZE, attitude_of, position_of, spin_of, velocity_of
from analytic.impact import impulse, spin_gained
from analytic.rim import closing_speed, crowded, fly
from models.attitude import rotation_matrix
from models.body import Body, Rules
from models.compiled import compiled
from models.ending import energy, face_up, judge
from models.geometry import contact_velocity, lowest_point
from models.records import IMPACT_ROW, Array, Ending, Outcome
from models.vectors import add, apply, scale, subtract


class Run(NamedTuple):
    """What the event loop gives for one toss."""

    rows: NDArray[Any]
    """Impacts, (n,) of `IMPACT_ROW`."""
    start_times: Array
    """Release and the times after the impacts, where the flights start, (n + 1,) [s]."""
    start_states: Array
    """States there, (n + 1, 13)."""
    outcome: Outcome
    ending: Ending
    end_time: float


def run(body: Body, rules: Rules, start: Array) -> Run:
    """Toss the coin in state `start`, (13,), until the toss is decided."""
    rows = np.zeros(rules.max_impacts, dtype=IMPACT_ROW)
    times = np.empty(rules.max_impacts + 1)
    states = np.empty((rules.max_impacts + 1, STATE_SIZE))
    n, outcome, ending, end_time = fly_and_hit(body, rules, start.copy(), rows, times, states)
    return Run(
        rows[:n].copy(),
        times[: n + 1].copy(),
        states[: n + 1].copy(),
        Outcome(outcome),
        Ending(ending),
        end_time,
    )


@compiled
def hit(body, rules, y, row):
    """Let the floor act on the coin in state y, which touches it, and record the impact.

    Args:
        body: the coin.
        rules: floor and ending.
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
    S, ending = impulse(body, rules, R, arm, tau, v_A, flat)
    v_after = add(v, scale(1 / body.mass, S))
    w_after = w if flat else add(w, spin_gained(body, R, arm, S))
    v_A_after = contact_velocity(body, R, v_after, w_after, point)
    E_before, E_after = energy(body, y[2], v, w), energy(body, y[2], v_after, w_after)
    x, e = position_of(y), attitude_of(y)
    for i in range(3):
        row.impulse[i] = S[i]
        row.point[i] = point[i]
        row.position[i] = x[i]
        row.velocity_before[i] = v[i]
        row.velocity_after[i] = v_after[i]
        row.angular_velocity_before[i] = w[i]
        row.angular_velocity_after[i] = w_after[i]
        row.contact_velocity_before[i] = v_A[i]
        row.contact_velocity_after[i] = v_A_after[i]
    for i in range(4):
        row.quaternion[i] = e[i]
    row.face = face_up(R[2][2])
    row.energy = E_after
    row.energy_change = E_after - E_before
    y[3], y[4], y[5] = v_after
    y[10], y[11], y[12] = w_after
    return ending


@compiled
def fly_and_hit(body, rules, y, rows, times, states):
    """Run the event loop.

    Args:
        body: the coin.
        rules: floor and ending.
        y: state at release, (13,); becomes the state at the end.
        rows: where the impacts are recorded, (max_impacts,) of `IMPACT_ROW`.
        times: where the start of each flight is recorded, (max_impacts + 1,) [s].
        states: where the states there are recorded, (max_impacts + 1, 13).

    Returns:
        Number of impacts, outcome, ending, and the time of the end [s].
    """
    time, n = 0.0, 0
    outcome, ending = Outcome.UNDECIDED, Ending.NONE
    while True:
        times[n] = time
        states[n] = y
        if ending != Ending.NONE:
            break
        if n == rules.max_impacts:
            ending = Ending.MAX_IMPACTS
            break
        flown, touches, _ = fly(body, y, rules.max_time - time)
        time += flown
        if not touches:
            ending = Ending.MAX_TIME
            break
        if crowded(body, rules.restitution, y):
            outcome, ending = decided(body, rules, y)
            if ending == Ending.NONE:
                ending = Ending.CHATTER
            break
        ending = hit(body, rules, y, rows[n])
        if ending != Ending.NONE:
            break
        rows[n].time = time
        n += 1
        # A step forced at a grazing point may have left the coin a little below the floor.
        y[2] -= min(closing_speed(body, y)[0], 0.0)
        outcome, ending = decided(body, rules, y)
    return n, outcome, ending, time


@compiled
def decided(body, rules, y):
    """Give the outcome and the ending that `judge` gives of the state y, (13,)."""
    up = rotation_matrix(attitude_of(y))[2]
    return judge(body, rules, y[2], velocity_of(y), up, spin_of(y))
