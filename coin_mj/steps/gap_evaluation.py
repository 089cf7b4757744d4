"""The gap below MuJoCo's coin, how fast it closes, and how long the next step of flight may be."""

from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import state_of
from cointoss.models import geometry
from cointoss.models.body import Body
from cointoss.models.clearance import clear_time, damping_rate
from cointoss.models.geometry import GapEvaluation
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm
from cointoss.models.state import State

DAMPED = 0.5
"""A step of flight is at most this part of the time in which drag may change velocities."""


@compiled
def evaluate_gap(coin: MujocoCoin) -> GapEvaluation:
    """Return the `GapEvaluation` of the coin's shape in the present state."""
    return geometry.evaluate_gap(coin.shape, state_above_floor(coin))


@compiled
def state_above_floor(coin: MujocoCoin) -> State:
    """Return the present `State`, its height above MuJoCo's floor."""
    x, v, e, w, R = state_of(coin)
    return State((x[0], x[1], x[2] - coin.floor_height), v, e, w, R)


@compiled
def longest_step(coin: MujocoCoin) -> float:
    """Return the length of a step of free flight in which the coin turns by at most the angle set [s]."""
    state = state_of(coin)
    v, w = state.velocity, state.spin
    longest = coin.flight_angle / turning_rate(coin.body, w)
    return min(longest, DAMPED / damping_rate(coin.shape, v, w, longest))


@compiled
def clear_flight(coin: MujocoCoin, window: float) -> float:
    """Return a time in which the coin surely does not touch, at most `window` [s]."""
    x, v, _, w, R = state_above_floor(coin)
    return clear_time(coin.shape, x[2], v, R[2], w, window)


@compiled
def turning_rate(body: Body, w: Vector) -> float:
    """Return the rate at which the coin turns, or would soon turn in contact [rad/s]."""
    return max(norm(w), (body.gravity / body.radius) ** 0.5)
