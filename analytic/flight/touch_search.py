"""The search for the first touch of a flight that is integrated, and what the lowest point does there."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.flight.equations_of_motion import Flight, flight_in
from cointoss.analytic.flight.gap_polynomials import DEGREE, Window, gap_polynomials, time_surely_clear
from cointoss.analytic.flight.integrated_flight import (
    finish_step,
    first_step,
    flight_step,
    flight_work,
    within_step,
)
from cointoss.analytic.flight.state_vector import STATE_SIZE, state_of
from cointoss.analytic.numerics.tolerances import CHATTERING, SINK, TIME_STEP, TOUCH
from cointoss.models.body import Body
from cointoss.models.clearance import clear_time, grazing_time
from cointoss.models.geometry import FLAT_SINE, evaluate_gap, lower_rim, tilt_sine_of
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, cross, dot, norm
from cointoss.models.state import State

# After so many gap evaluations in a step, and whenever their number has doubled, its polynomials are used.
_MANY = 4


class LeastFlight(NamedTuple):
    """A flight too low to be told from contact."""

    time: float
    """In which a touching coin hardly sinks [s]."""
    speed: float
    """With which it would start [m/s]."""
    acceleration: float
    """Largest of the gap in that time [m/s²]."""


@compiled
def gap_acceleration(body: Body, flight: Flight) -> float:
    """Return the second derivative of the gap in free flight, at a state that is not flat [m/s²].

    With u the upward unit vector in the body frame, u' = u × ω, it is z_C - u · c - (h/2) |u_ζ| - r |u⊥|.
    """
    up, w = flight.state.R[2], flight.state.spin
    rate = cross(up, w)
    acceleration = add(cross(rate, w), cross(up, flight.spin_rate))
    sine = tilt_sine_of(up)
    sine_rate = (up[0] * rate[0] + up[1] * rate[1]) / sine
    across = rate[0] * rate[0] + rate[1] * rate[1] - sine_rate * sine_rate
    sine_acceleration = (across + up[0] * acceleration[0] + up[1] * acceleration[1]) / sine
    face = -lower_rim(up[2]) * (body.thickness / 2)
    return (
        dot(up, flight.force) / body.mass
        - body.gravity
        - dot(acceleration, body.center)
        - face * acceleration[2]
        - body.radius * sine_acceleration
    )


@compiled
def is_chattering(body: Body, chi: float, state: State) -> bool:
    """Return whether the impacts of a coin that touches the floor chatter (Zeno): it will stay in contact.

    Where the gap accelerates downward by A in free flight, an approach at the speed v leads to impacts that
    all come within 2 v/(A (1 - χ)). In that time the coin must turn, and fall, by less than `CHATTERING`
    times the sine of its tilt: the smaller that is, the faster the lowest point runs round the rim. An
    approach too slow to be told from contact stays too. A coin that lands flat bounces until it lies.

    Args:
        body: the coin.
        chi: restitution χ.
        state: at the touch.
    """
    speed, least_flight = -evaluate_gap(body, state).speed, smallest_flight(body, state)
    if speed < least_flight.speed:
        return True
    sine = tilt_sine_of(state.R[2])
    if sine <= FLAT_SINE:
        return False
    turning = norm(state.spin) + (body.gravity / body.radius) ** 0.5
    least = 2 * speed * turning / (CHATTERING * sine * (1 - chi))
    if least >= least_flight.acceleration:
        return False
    falling = -gap_acceleration(body, flight_in(body, state))
    return falling > 0 and least < falling


@compiled
def expected_flight(body: Body, state: State) -> float:
    """Return how long a coin that leaves the floor may fly: a quarter more than by a parabola of its gap [s].

    Infinite where the gap does not turn down, or where the coin is not on the floor.
    """
    height, speed = evaluate_gap(body, state)
    if height > TOUCH * body.radius or tilt_sine_of(state.R[2]) <= FLAT_SINE:
        return np.inf
    falling = -gap_acceleration(body, flight_in(body, state))
    return 2.5 * speed / falling if falling > 0 and speed > 0 else np.inf


@compiled
def sink_of_squares(body: Body, up: Vector) -> float:
    """Return what a sink of `SINK` takes from q² - r² sin² of the lower rim of a coin on the floor [m²]."""
    return 2 * body.radius * tilt_sine_of(up) * SINK * body.radius


@compiled
def clear(body: Body, state: State, window: float) -> float:
    """Return a time during which the coin surely stays above the floor, at most `window` [s]."""
    return clear_time(body, state.position[2], state.velocity, state.R[2], state.spin, window)


@compiled
def smallest_flight(body: Body, state: State) -> LeastFlight:
    """Return the `LeastFlight` from a state.

    A flight that starts with the speed v lasts at least 2 v/A, A the largest acceleration of the gap: it
    outlasts the time in which a touching coin hardly sinks at √(8 SINK r A).
    """
    sink = SINK * body.radius
    time, acceleration = grazing_time(body, state.velocity, state.R[2], state.spin, sink)
    return LeastFlight(time, (8 * sink * acceleration) ** 0.5, acceleration)


@compiled
def fly_by_steps(body: Body, y: Array, longest: float, with_graze: bool) -> tuple[float, bool, int, float]:
    """Fly until the coin first touches the floor.

    Every step is searched by steps of `clear_time`, which never pass a touch; each ends at a state computed
    from the start of the step, so the state found is as exact as the step.

    Args:
        body: the coin.
        y: state at the start, (13,); becomes the state at the touch, or at the end of the flight.
        longest: the longest flight wanted [s].
        with_graze: whether minima of the gap are looked for on the way.

    Returns:
        The time of flight [s], whether the coin touches, the number of gap evaluations, and a graze: a
        height such that no minimum of the gap on the way is below half of it, infinite where it has none [m].
    """
    work, y_near, coefficients = flight_work(body), np.empty(STATE_SIZE), np.empty((2, DEGREE + 1))
    start = state_of(y)
    elapsed, dt, expected = 0.0, first_step(body, y), expected_flight(body, start)
    # A coin that starts on the floor has just been lifted off it: only a clear descent is a touch at once.
    touching_speed = -smallest_flight(body, start).speed
    # The steps shrink towards a minimum of the gap, so that the last one before it starts hardly higher.
    graze, height_before, speed_before, evaluations = np.inf, np.inf, 0.0, 0
    while elapsed < longest:
        made, dt, order = flight_step(body, y, dt, min(longest - elapsed, expected), work)
        expected = np.inf
        copy_into(y_near, y)
        inside, in_step, patience = 0.0, 0, _MANY
        while inside < made:
            near = state_of(y_near)
            height, speed = evaluate_gap(body, near)
            evaluations += 1
            in_step += 1
            if speed_before < 0 <= speed:
                graze = min(graze, height_before, height)
            height_before, speed_before = height, speed
            ahead = clear(body, near, made - inside)
            # Also where time itself has no finer step than the coin still has to fall.
            on_floor = height <= TOUCH * body.radius or inside + ahead == inside
            if on_floor:
                if speed < touching_speed:
                    copy_into(y, y_near)
                    return elapsed + inside, True, evaluations, graze
                ahead = max(ahead, smallest_flight(body, near).time, TIME_STEP * inside)
            lifts_off = on_floor and in_step == 1
            if body.air.exponent is None and not with_graze and (lifts_off or in_step == patience):
                polynomials = gap_polynomials(body, work, order, made, coefficients)
                sink = sink_of_squares(body, near.R[2]) if lifts_off else 0.0
                patience *= 1 if lifts_off else 2
                window = Window(inside, made - inside, ahead)
                ahead = max(ahead, time_surely_clear(body, polynomials, sink, window))
            touching_speed = 0.0
            inside += ahead
            if inside < made:
                within_step(body, y, inside, order, work, y_near)
        finish_step(body, made, order, work, y, y_near)
        elapsed += made
    return longest, False, evaluations, graze
