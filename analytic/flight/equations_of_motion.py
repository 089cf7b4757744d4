"""The equations of motion of a flying coin."""

from analytic.air.force import force_and_moment
from analytic.flight.state_vector import (
    attitude_of,
    set_attitude,
    set_position,
    set_spin,
    set_velocity,
    spin_of,
    velocity_of,
)
from analytic.numerics.rotation import quaternion_rate
from models.attitude import rotation_matrix
from models.kernel.compiled import compiled
from models.kernel.vectors import apply, apply_transposed, cross, subtract


@compiled
def derivative(body, y, dy):
    """Write the time derivative of the state y into dy.

    m a_C = f and J_C ω̇ + ω × J_C ω = m_C; Strzalko et al. 2008, eqs (21)-(22).

    Args:
        body: the coin.
        y: state, (13,).
        dy: where its rate of change goes, (13,).
    """
    v, e, w = velocity_of(y), attitude_of(y), spin_of(y)
    R = rotation_matrix(e)
    f, m_C = force_and_moment(body, apply_transposed(R, v), w)
    f_space = apply(R, f)
    gyroscopic = cross(w, apply(body.inertia, w))
    acceleration = (
        f_space[0] / body.mass,
        f_space[1] / body.mass,
        f_space[2] / body.mass - body.gravity,
    )
    set_position(dy, v)
    set_velocity(dy, acceleration)
    set_attitude(dy, quaternion_rate(e, w))
    set_spin(dy, apply(body.inertia_inverse, subtract(m_C, gyroscopic)))
