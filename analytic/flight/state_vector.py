"""The state of a coin as the integrators advance it: an array of 13 whose parts have names.

Position of C (space), velocity of C (space), Euler parameters (body to space), angular velocity (body).
"""

from cointoss.models.attitude import Quaternion, norm_of
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, norm
from cointoss.models.state import State, state

STATE_SIZE = 13


@compiled
def position_of(y: Array) -> Vector:
    """Return the position of C in the state y, space frame [m]."""
    return y[0], y[1], y[2]


@compiled
def velocity_of(y: Array) -> Vector:
    """Return the velocity of C in the state y, space frame [m/s]."""
    return y[3], y[4], y[5]


@compiled
def attitude_of(y: Array) -> Quaternion:
    """Return the Euler parameters in the state y, body to space."""
    return y[6], y[7], y[8], y[9]


@compiled
def spin_of(y: Array) -> Vector:
    """Return the angular velocity in the state y, body frame [rad/s]."""
    return y[10], y[11], y[12]


@compiled
def state_of(y: Array) -> State:
    """Return the `State` of the state vector y, its rotation matrix made once."""
    return state(position_of(y), velocity_of(y), attitude_of(y), spin_of(y))


@compiled
def set_position(y: Array, x: Vector) -> None:
    """Set the position of C in the state vector y, space frame, (3,) [m]."""
    y[0], y[1], y[2] = x


@compiled
def set_height(y: Array, z: float) -> None:
    """Set the height of C in the state vector y [m]."""
    y[2] = z


@compiled
def set_velocity(y: Array, v: Vector) -> None:
    """Set the velocity of C in the state vector y, space frame, (3,) [m/s]."""
    y[3], y[4], y[5] = v


@compiled
def set_attitude(y: Array, e: Quaternion) -> None:
    """Set the Euler parameters in the state vector y, (4,)."""
    y[6], y[7], y[8], y[9] = e


@compiled
def set_spin(y: Array, w: Vector) -> None:
    """Set the angular velocity in the state vector y, body frame, (3,) [rad/s]."""
    y[10], y[11], y[12] = w


@compiled
def motion_scales(body: Body, y: Array) -> tuple[float, float]:
    """Return the scales of velocities, √(g r) + |v| [m/s], and spins, √(g/r) + |ω| [rad/s], in state y."""
    speed = (body.gravity * body.radius) ** 0.5 + norm(velocity_of(y))
    return speed, (body.gravity / body.radius) ** 0.5 + norm(spin_of(y))


@compiled
def normalise(y: Array) -> None:
    """Bring the Euler parameters of the state y back to norm 1."""
    size = norm_of(attitude_of(y))
    for i in range(6, 10):
        y[i] /= size
