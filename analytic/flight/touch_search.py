"""The search for the first touch of an integrated flight, and the motion of the lowest point there."""

from typing import NamedTuple

import numpy as np

from cointoss.analytic.flight.equations_of_motion import Flight, flight_in
from cointoss.analytic.flight.gap_polynomials import DEGREE, TimeWindow, gap_polynomials, time_surely_clear
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
    """The shortest flight that differs from contact."""

    time: float
    """The time in which a touching coin hardly sinks [s]."""
    speed: float
    """The speed with which such a flight would start [m/s]."""
    acceleration: float
    """The largest acceleration of the gap in that time [m/s²]."""


class Flown(NamedTuple):
    """A flight to its first touch, or as long as was wanted."""

    time: float
    """The duration of the flight [s]."""
    touches: bool
    evaluations: int
    """The number of gap evaluations."""
    steps: int
    """The number of steps or pieces, which make the errors of the state at the flight's end."""
    graze: float
    """No minimum of the gap on the way is below half of this height, unless it is above a tenth of the radius
    [m]; infinite where there is none, or none was looked for."""


class Lowest(NamedTuple):
    """The lowest minimum of the gap so far, and where the coin was last seen."""

    graze: float
    """The lowest minimum so far, as in `Flown`."""
    height: float
    """The gap where the coin was last seen [m]."""
    speed: float
    """The rate of the gap where the coin was last seen [m/s]."""


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
        chi: restitution χ; of a law of one's own that of an impact there.
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
    falling = -gap_acceleration(body, flight_in(body, state, False))
    return falling > 0 and least < falling


@compiled
def expected_flight(body: Body, state: State) -> float:
    """Return how long a coin that leaves the floor may fly: a quarter more than by a parabola of its gap [s].

    Infinite where the gap does not turn down, or where the coin is not on the floor.
    """
    height, speed = evaluate_gap(body, state)
    if height > TOUCH * body.radius or tilt_sine_of(state.R[2]) <= FLAT_SINE:
        return np.inf
    falling = -gap_acceleration(body, flight_in(body, state, False))
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
def seen(lowest: Lowest, height: float, speed: float) -> Lowest:
    """Return the `Lowest` with one more evaluation of the gap.

    Steps shrink towards a minimum of the gap, so that the last one before it starts hardly higher.
    """
    is_past = lowest.speed < 0 <= speed
    graze = min(lowest.graze, lowest.height, height) if is_past else lowest.graze
    return Lowest(graze, height, speed)


@compiled
def seen_between(body: Body, y: Array, within: TimeWindow, order: int, work: Array, lowest: Lowest) -> Lowest:
    """Return the `Lowest` after a part of a step in which the coin surely does not touch.

    Args:
        body: the coin.
        y: state at the start of the step, (13,).
        within: the part; the coin has been seen at its start.
        order: of the step, see `flight_step`.
        work: see `flight_work`.
        lowest: at the start of the part.
    """
    y_near, t, end = np.empty(STATE_SIZE), within.start + within.least, within.start + within.length
    while t < end:
        within_step(body, y, t, order, work, y_near)
        near = state_of(y_near)
        height, speed = evaluate_gap(body, near)
        lowest = seen(lowest, height, speed)
        ahead = clear(body, near, end - t)
        if height <= TOUCH * body.radius or t + ahead == t:
            ahead = max(ahead, smallest_flight(body, near).time, TIME_STEP * t)
        t += ahead
    return lowest


@compiled
def fly_by_steps(body: Body, y: Array, longest: float, with_graze: bool) -> Flown:
    """Fly until the coin first touches the floor.

    Every step is searched by steps of `clear_time`, which never pass a touch; each ends at a state computed
    from the start of the step, so the state found is as exact as the step.

    Args:
        body: the coin.
        y: state at the start, (13,); becomes the state at the touch, or at the end of the flight.
        longest: the longest flight wanted [s].
        with_graze: whether minima of the gap are looked for on the way.
    """
    work, y_near, coefficients = flight_work(body), np.empty(STATE_SIZE), np.empty((2, DEGREE + 1))
    start = state_of(y)
    elapsed, dt = 0.0, first_step(body, y)
    # A coin that starts on the floor has just been lifted off it: only a clear descent is a touch at once.
    touching_speed = -smallest_flight(body, start).speed
    lowest, evaluations, steps = Lowest(np.inf, np.inf, 0.0), 0, 0
    # Called at two places, a step is compiled by itself: among the search its vectors would fall apart.
    made, dt, order = flight_step(body, y, dt, min(longest, expected_flight(body, start)), work)
    while elapsed < longest:
        steps += 1
        copy_into(y_near, y)
        inside, in_step, patience = 0.0, 0, _MANY
        while inside < made:
            near = state_of(y_near)
            height, speed = evaluate_gap(body, near)
            evaluations += 1
            in_step += 1
            lowest = seen(lowest, height, speed)
            ahead = clear(body, near, made - inside)
            # Also where time itself has no finer step than the coin still has to fall.
            on_floor = height <= TOUCH * body.radius or inside + ahead == inside
            if on_floor:
                if speed < touching_speed:
                    copy_into(y, y_near)
                    return Flown(elapsed + inside, True, evaluations, steps, lowest.graze)
                ahead = max(ahead, smallest_flight(body, near).time, TIME_STEP * inside)
            lifts_off = on_floor and in_step == 1
            if body.air.exponent is None and (lifts_off or in_step == patience):
                polynomials = gap_polynomials(body, work, order, made, coefficients)
                sink = sink_of_squares(body, near.R[2]) if lifts_off else 0.0
                patience *= 1 if lifts_off else 2
                window = TimeWindow(inside, made - inside, ahead)
                surely = time_surely_clear(body, polynomials, sink, window)
                if with_graze and surely > ahead:
                    skipped = TimeWindow(inside, min(surely, made - inside), ahead)
                    lowest = seen_between(body, y, skipped, order, work, lowest)
                ahead = max(ahead, surely)
            touching_speed = 0.0
            inside += ahead
            if inside < made:
                within_step(body, y, inside, order, work, y_near)
        finish_step(body, made, order, work, y, y_near)
        elapsed += made
        if elapsed < longest:
            made, dt, order = flight_step(body, y, dt, longest - elapsed, work)
    return Flown(longest, False, evaluations, steps, lowest.graze)
