"""The gap below MuJoCo's coin, how fast it closes, and how long the next step may be."""

from typing import NamedTuple

from coin_mj.model.state import state_of
from models.attitude import rotation_matrix
from models.body import Body
from models.clearance import clear_time
from models.geometry import contact_velocity, gap, lowest_point
from models.kernel.compiled import compiled
from models.kernel.vectors import norm


class GapEvaluation(NamedTuple):
    """The gap between coin and floor in one state."""

    gap: float
    """Of the coin's shape, negative in contact [m]."""
    speed: float
    """Vertical velocity of the lowest point [m/s]."""
    step_bound: float
    """A step of free flight that surely ends before the coin touches [s]."""


@compiled
def evaluate_gap(coin):
    """Return the `GapEvaluation` of the present state."""
    shape, (x, v, e, w) = _shape_of(coin), state_of(coin)
    R = rotation_matrix(e)
    z = x[2] - coin.floor_height
    point, flat = lowest_point(shape, R[2], w)
    speed = v[2] if flat else contact_velocity(shape, R, v, w, point)[2]
    longest = coin.flight_angle / turning_rate(shape, w)
    return GapEvaluation(gap(shape, z, R[2]), speed, clear_time(shape, z, v, R[2], w, longest))


@compiled
def _shape_of(coin):
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
