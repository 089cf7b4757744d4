"""The gap below MuJoCo's coin, how fast it closes, and how long the next step of flight may be."""

from typing import NamedTuple

from cointoss.coin_mj.model.state import state_of
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import Body
from cointoss.models.clearance import clear_time, damping_rate
from cointoss.models.geometry import contact_velocity, gap, lowest_point
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import norm

DAMPED = 0.5
"""A step of flight is at most this part of the time in which drag may change velocities."""


class GapEvaluation(NamedTuple):
    """The gap between coin and floor in one state."""

    gap: float
    """Of the coin's shape, negative in contact [m]."""
    speed: float
    """Vertical velocity of the lowest point [m/s]."""


@compiled
def evaluate_gap(coin):
    """Return the `GapEvaluation` of the present state."""
    shape, (x, v, e, w) = shape_of(coin), state_of(coin)
    R = rotation_matrix(e)
    point, flat = lowest_point(shape, R[2], w)
    speed = v[2] if flat else contact_velocity(shape, R, v, w, point)[2]
    return GapEvaluation(gap(shape, x[2] - coin.floor_height, R[2]), speed)


@compiled
def longest_step(coin):
    """Return the length of a step of free flight in which the coin turns by at most the angle set [s]."""
    _, v, _, w = state_of(coin)
    longest = coin.flight_angle / turning_rate(coin.body, w)
    return min(longest, DAMPED / damping_rate(coin.body, v, w, longest))


@compiled
def clear_flight(coin, window):
    """Return a time in which the coin surely does not touch, at most `window` [s]."""
    x, v, e, w = state_of(coin)
    z, up = x[2] - coin.floor_height, rotation_matrix(e)[2]
    return clear_time(shape_of(coin), z, v, up, w, window)


@compiled
def shape_of(coin):
    """Return the body with the thickness of its shape."""
    body = coin.body
    return Body(
        body.mass,
        body.radius,
        coin.shape_thickness,
        body.center,
        body.inertia,
        body.inertia_inverse,
        body.inertia_smallest,
        body.inertia_largest,
        body.air,
        body.drag,
        body.sliding_share,
        body.gravity,
    )


@compiled
def turning_rate(body, w):
    """Return the rate at which the coin turns, or would soon turn in contact [rad/s]."""
    return max(norm(w), (body.gravity / body.radius) ** 0.5)
