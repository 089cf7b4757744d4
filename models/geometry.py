"""Where a coin is above the floor: its tilt, its gap, its lower rim and its lowest point."""

import math
from typing import NamedTuple

from cointoss.models.body import Body
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, add, cross, dot
from cointoss.models.state import State

# Below this sine of the tilt a face counts as flat: its whole rim is at one height within rounding.
FLAT_SINE = 1e-14
FACE_SINE = 1e-7
"""Below this sine of the tilt the lowest point runs round the rim too fast to follow: a face lands."""


class GapEvaluation(NamedTuple):
    """The gap between coin and floor in one state."""

    gap: float
    """Negative in the floor [m]."""
    speed: float
    """Vertical velocity of the lowest point [m/s]."""


@compiled
def tilt_sine_of(up: Vector) -> float:
    """Return the sine of the angle between the coin's normal and the vertical.

    Args:
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
    """
    return math.sqrt(up[0] * up[0] + up[1] * up[1])


@compiled
def lower_rim(n_z: float) -> float:
    """Return which rim is the lower one, as the sign of its ζ: -1, tails', with heads up, else 1, heads'.

    Args:
        n_z: upward component of the coin's normal; of a coin on its edge its rate, for the rim that lands.
    """
    return -1.0 if n_z > 0 else 1.0


@compiled
def height_of_center(body: Body, z: float, up: Vector) -> float:
    """Return the height of the geometric centre B [m].

    Args:
        body: the coin.
        z: height of the mass centre C [m].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
    """
    return z - dot(up, body.center)


@compiled
def gap(body: Body, z: float, up: Vector) -> float:
    """Return the height of the coin's lowest point above the floor [m], negative below it.

    On it rest `clearance.clear_time` and the barriers.

    Args:
        body: the coin.
        z: height of the mass centre C [m].
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
    """
    tilt_sine = tilt_sine_of(up)
    return height_of_center(body, z, up) - body.thickness / 2 * abs(up[2]) - body.radius * tilt_sine


@compiled
def lowest_point(body: Body, up: Vector, w: Vector) -> tuple[Vector, bool]:
    """Return the point of the coin that is lowest, or about to be.

    It is on the rim, unless a face lies flat or the coin stands on its edge. The whole rim of a flat face is
    lowest: if the coin turns, the point that moves down fastest is given; if it does not, the point of the
    face under C. The same holds for the line on which a thick coin stands.

    Args:
        body: the coin.
        up: the upward unit vector in the body frame, Rᵀ z, (3,).
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        point: from B, body frame, (3,) [m].
        flat: whether the point is that under C, for a coin that lands flat without turning.
    """
    r, half = body.radius, body.thickness / 2
    rim = lower_rim(up[2])
    tilt_sine = tilt_sine_of(up)
    if tilt_sine > FLAT_SINE:
        along = rim * half
        if abs(up[2]) < FLAT_SINE:
            normal_rate = up[0] * w[1] - up[1] * w[0]
            along = body.center[2] if normal_rate == 0 else half if normal_rate < 0 else -half
        return (-r * up[0] / tilt_sine, -r * up[1] / tilt_sine, along), False
    turning = (w[0] * w[0] + w[1] * w[1]) ** 0.5
    if turning > 0:
        return (-rim * r * w[1] / turning, rim * r * w[0] / turning, rim * half), False
    return (body.center[0], body.center[1], rim * half), True


@compiled
def contact_velocity(body: Body, R: Matrix, v: Vector, w: Vector, point: Vector) -> Vector:
    """Return the velocity of the coin's point `point` in space: v_C + R (ω × (A - C)).

    Args:
        body: the coin.
        R: rotation matrix, body to space.
        v: velocity of C, space frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        point: A from B, body frame, (3,) [m].
    """
    arm = (point[0] - body.center[0], point[1] - body.center[1], point[2] - body.center[2])
    turn = cross(w, arm)
    return add(v, (dot(R[0], turn), dot(R[1], turn), dot(R[2], turn)))


@compiled
def evaluate_gap(body: Body, state: State) -> GapEvaluation:
    """Return the `GapEvaluation` of a state."""
    R, v, w = state.R, state.velocity, state.spin
    point, flat = lowest_point(body, R[2], w)
    v_A = contact_velocity(body, R, v, w, point)
    return GapEvaluation(gap(body, state.position[2], R[2]), v[2] if flat else v_A[2])
