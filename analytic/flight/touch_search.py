"""The search for the first touch of a flight that is integrated, and what the lowest point does there."""

import numpy as np

from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.flight.gap_polynomials import DEGREE, gap_polynomials, time_surely_clear
from cointoss.analytic.flight.integrated_flight import (
    finish_step,
    first_step,
    flight_step,
    flight_work,
    within_step,
)
from cointoss.analytic.flight.state_vector import STATE_SIZE, attitude_of, position_of, spin_of, velocity_of
from cointoss.analytic.numerics.tolerances import CHATTERING, SINK, TIME_STEP, TOUCH
from cointoss.models.attitude import rotation_matrix
from cointoss.models.clearance import clear_time, grazing_time
from cointoss.models.geometry import FLAT_SINE, contact_velocity, gap, lowest_point, tilt_sine_of
from cointoss.models.kernel.arrays import copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import add, cross, dot, norm

# After so many gap evaluations in a step, and whenever their number has doubled, its polynomials are used.
_MANY = 4


@compiled
def closing_speed(body, y):
    """Return the gap of the state y [m] and the vertical velocity of the lowest point [m/s]."""
    R = rotation_matrix(attitude_of(y))
    v, w = velocity_of(y), spin_of(y)
    point, flat = lowest_point(body, R[2], w)
    v_A = contact_velocity(body, R, v, w, point)
    return gap(body, position_of(y)[2], R[2]), v[2] if flat else v_A[2]


@compiled
def gap_acceleration(body, y):
    """Return the second derivative of the gap in free flight, at a state y that is not flat [m/s²].

    With u the upward unit vector in the body frame, u' = u × ω, it is z_C - u · c - (h/2) |u_ζ| - r |u⊥|.
    """
    dy = np.empty(STATE_SIZE)
    derivative(body, y, dy)
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    rate = cross(up, w)
    acceleration = add(cross(rate, w), cross(up, spin_of(dy)))
    sine = tilt_sine_of(up)
    sine_rate = (up[0] * rate[0] + up[1] * rate[1]) / sine
    across = rate[0] * rate[0] + rate[1] * rate[1] - sine_rate * sine_rate
    sine_acceleration = (across + up[0] * acceleration[0] + up[1] * acceleration[1]) / sine
    face = body.thickness / 2 if up[2] > 0 else -body.thickness / 2
    return (
        velocity_of(dy)[2]
        - dot(acceleration, body.center)
        - face * acceleration[2]
        - body.radius * sine_acceleration
    )


@compiled
def is_chattering(body, chi, y):
    """Return whether the impacts of a coin that touches the floor chatter (Zeno): it will stay in contact.

    Where the gap accelerates downward by A in free flight, an approach at the speed v leads to impacts that
    all come within 2 v/(A (1 - χ)). In that time the coin must turn, and fall, by less than `CHATTERING`
    times the sine of its tilt: the smaller that is, the faster the lowest point runs round the rim. An
    approach too slow to be told from contact stays too. A coin that lands flat bounces until it lies.

    Args:
        body: the coin.
        chi: restitution χ.
        y: state at the touch, (13,).
    """
    up, w = rotation_matrix(attitude_of(y))[2], spin_of(y)
    speed, (_, slowest, most) = -closing_speed(body, y)[1], smallest_flight(body, y)
    if speed < slowest:
        return True
    sine = tilt_sine_of(up)
    if sine <= FLAT_SINE:
        return False
    least = 2 * speed * (norm(w) + (body.gravity / body.radius) ** 0.5) / (CHATTERING * sine * (1 - chi))
    if least >= most:
        return False
    falling = -gap_acceleration(body, y)
    return falling > 0 and least < falling


@compiled
def expected_flight(body, y):
    """Return how long a coin that leaves the floor may fly: a quarter more than by a parabola of its gap [s].

    Infinite where the gap does not turn down, or where the coin is not on the floor.
    """
    height, speed = closing_speed(body, y)
    up = rotation_matrix(attitude_of(y))[2]
    if height > TOUCH * body.radius or tilt_sine_of(up) <= FLAT_SINE:
        return np.inf
    falling = -gap_acceleration(body, y)
    return 2.5 * speed / falling if falling > 0 and speed > 0 else np.inf


@compiled
def sink_of_squares(body, y):
    """Return what a sink of `SINK` takes from q² - r² sin² of the lower rim of a coin on the floor [m²]."""
    sine = tilt_sine_of(rotation_matrix(attitude_of(y))[2])
    return 2 * body.radius * sine * SINK * body.radius


@compiled
def clear(body, y, window):
    """Return a time during which the coin in state y surely stays above the floor, at most `window` [s]."""
    R = rotation_matrix(attitude_of(y))
    return clear_time(body, position_of(y)[2], velocity_of(y), R[2], spin_of(y), window)


@compiled
def smallest_flight(body, y):
    """Return the time and the speed of a flight too low to be told from contact.

    The time is that in which a touching coin hardly sinks. A flight that starts with the speed v lasts at
    least 2 v/A, A the largest acceleration of the gap: it outlasts that time at √(8 SINK r A).

    Returns:
        Time [s], speed [m/s], and A [m/s²].
    """
    up = rotation_matrix(attitude_of(y))[2]
    sink = SINK * body.radius
    time, acceleration = grazing_time(body, velocity_of(y), up, spin_of(y), sink)
    return time, (8 * sink * acceleration) ** 0.5, acceleration


@compiled
def fly_by_steps(body, y, longest, with_graze):
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
    work, y_near, polynomials = flight_work(body), np.empty(STATE_SIZE), np.empty((2, DEGREE + 1))
    elapsed, dt, expected = 0.0, first_step(body, y), expected_flight(body, y)
    # A coin that starts on the floor has just been lifted off it: only a clear descent is a touch at once.
    touching_speed = -smallest_flight(body, y)[1]
    # The steps shrink towards a minimum of the gap, so that the last one before it starts hardly higher.
    graze, height_before, speed_before, evaluations = np.inf, np.inf, 0.0, 0
    while elapsed < longest:
        made, dt, order = flight_step(body, y, dt, min(longest - elapsed, expected), work)
        expected = np.inf
        copy_into(y_near, y)
        inside, in_step, patience = 0.0, 0, _MANY
        while inside < made:
            height, speed = closing_speed(body, y_near)
            evaluations += 1
            in_step += 1
            if speed_before < 0 <= speed:
                graze = min(graze, height_before, height)
            height_before, speed_before = height, speed
            ahead = clear(body, y_near, made - inside)
            # Also where time itself has no finer step than the coin still has to fall.
            on_floor = height <= TOUCH * body.radius or inside + ahead == inside
            if on_floor:
                if speed < touching_speed:
                    copy_into(y, y_near)
                    return elapsed + inside, True, evaluations, graze
                ahead = max(ahead, smallest_flight(body, y_near)[0], TIME_STEP * inside)
            lifts_off = on_floor and in_step == 1
            if body.air.exponent is None and not with_graze and (lifts_off or in_step == patience):
                degree, rounding = gap_polynomials(body, work, order, made, polynomials)
                sink = sink_of_squares(body, y) if lifts_off else 0.0
                patience *= 1 if lifts_off else 2
                left = made - inside
                surely = time_surely_clear(body, polynomials, degree, rounding, sink, inside, left, ahead)
                ahead = max(ahead, surely)
            touching_speed = 0.0
            inside += ahead
            if inside < made:
                within_step(body, y, inside, order, work, y_near)
        finish_step(body, made, order, work, y, y_near)
        elapsed += made
    return longest, False, evaluations, graze
