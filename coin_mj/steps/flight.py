"""A free flight of MuJoCo's coin, from step to step, until it touches the floor."""

from enum import IntEnum

import numpy as np

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import Motion, motion_of, state_of
from cointoss.coin_mj.steps.free_step import free_rate, free_step_from, nudge, rates_of_step
from cointoss.coin_mj.steps.gap_evaluation import (
    clear_flight,
    evaluate_gap,
    longest_step,
    state_above_floor,
    turning_rate,
)
from cointoss.coin_mj.steps.knots import RecordedPath, StepKind, add_knot
from cointoss.coin_mj.steps.touch_search import arc_of, first_touch
from cointoss.models.body import Rules, is_to_be_caught
from cointoss.models.catch import approach_hand
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled


class FlightExit(IntEnum):
    """How a flight ends."""

    TOUCHES = 0
    CAUGHT = 1
    """C has come down to the height of the catch."""
    BUDGET = 2
    """The budget of time or of steps is spent."""


TOUCH_STEP = 1e-4
"""A touch is located to within this part of a contact step."""
ROUNDS = 8
"""Steps of one flight step that are made to locate it, each nearer than the last."""
NUDGE = 1e-6
"""Turn in which the rate of change of the coin's state is constant to within this part of itself [rad]."""


@compiled
def fly(
    coin: MujocoCoin, rules: Rules, time: float, steps_left: int, path: RecordedPath
) -> tuple[float, FlightExit, int, RecordedPath]:
    """Fly until the coin touches the floor or is caught.

    Args:
        coin: MuJoCo's.
        rules: floor and ending.
        time: now [s].
        steps_left: the most steps wanted.
        path: of the toss so far.

    Returns:
        The time [s], the `FlightExit`, the steps left, and the path.
    """
    # No step of flight detects contacts: of a coin that is flat within rounding MuJoCo's plane-cylinder
    # routine may take the radius for the height.
    shortest = TOUCH_STEP * coin.rebound.step
    rates, end_rate = rates_of_step(), np.empty(13)
    free_rate(coin, rates[0], False)
    is_above = state_above_floor(coin).position[2] > rules.caught
    while time < rules.max_time and steps_left > 0:
        steps_left -= 1
        start, dt = motion_of(coin), min(longest_step(coin), rules.max_time - time)
        if is_to_be_caught(rules):
            approach = approach_hand(coin.body, rules.caught, is_above, state_above_floor(coin), dt)
            is_above, dt = approach.is_above, approach.step
            if approach.is_caught:
                return time, FlightExit.CAUGHT, steps_left, path
        clear = clear_flight(coin, dt) >= dt
        path = add_knot(coin, time, StepKind.FLIGHT, path)
        free_step_from(coin, start, rates, dt)
        free_rate(coin, end_rate, True)
        if not clear:
            touch = first_touch(coin, arc_of(start, rates[0], motion_of(coin), end_rate, dt), shortest)
            if touch < dt:
                dt, touches = _land(coin, start, rates, touch, dt, shortest)
                if touches:
                    return time + dt, FlightExit.TOUCHES, steps_left, path
                free_rate(coin, end_rate, True)
        copy_into(rates[0], end_rate)
        time += dt
    return time, FlightExit.BUDGET, steps_left, path


@compiled
def _land(
    coin: MujocoCoin, start: Motion, rates: Array, touch: float, longest: float, shortest: float
) -> tuple[float, bool]:
    """Step from a state to where the coin has just touched, or until it is clear that it does not.

    Args:
        coin: MuJoCo's.
        start: the state, (13,).
        rates: its rate in the first row, see `rates_of_step`.
        touch: about when the coin touches [s].
        longest: the longest step [s].
        shortest: the coin has touched for at most this time then [s].

    Returns:
        The length of the step [s], and whether the coin touches after it, moving down.
    """
    dt, made, late = touch, np.inf, np.inf
    for _ in range(ROUNDS):
        if abs(dt - made) * turning_rate(coin.body, state_of(coin).spin) < NUDGE:
            nudge(coin, dt - made)
        else:
            free_step_from(coin, start, rates, dt)
        made = dt
        below = evaluate_gap(coin)
        if below.speed >= 0:
            if late < np.inf:
                # It was below the floor all along: it touches where it moves down again.
                break
            # It was near the floor, but passed above it.
            if dt < shortest:
                dt = shortest
                free_step_from(coin, start, rates, dt)
            return dt, False
        if below.gap > 0:
            # Newton's step towards the touch, from before; it passes none.
            clear = clear_flight(coin, longest - dt)
            if dt + clear >= longest:
                free_step_from(coin, start, rates, longest)
                return longest, False
            dt = min(dt + clear + shortest / 2, longest)
        else:
            late, since = dt, below.gap / below.speed
            if since <= shortest or dt == 0:
                return dt, True
            dt = max(dt - since + shortest / 2, 0.0)
    if late < np.inf:
        dt = late
    # Without a touch it flies on, and its next step lands.
    free_step_from(coin, start, rates, dt)
    return dt, late < np.inf
