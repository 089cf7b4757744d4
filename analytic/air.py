"""The air's force on a flying coin and its moment."""

from models.compiled import compiled
from models.vectors import cross, subtract


@compiled
def force_and_moment(body, v, w):
    """Give the air's force and its moment about the mass centre, for b = 0.

    Strzalko et al. 2008, eqs (49)-(74), in the closed form of `models.drag`: at B, f = -diag(c) v_B and
    m_B = -diag(d) ω; about C, m_C = m_B - c × f with c from B to C.

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        f: force, body frame, (3,) [N].
        m_C: moment about C, body frame, (3,) [N m].
    """
    drag = body.drag
    v_B = subtract(v, cross(w, body.center))
    f = (
        -drag.force_tangential * v_B[0],
        -drag.force_tangential * v_B[1],
        -drag.force_normal * v_B[2],
    )
    m_B = (
        -drag.moment_tangential * w[0],
        -drag.moment_tangential * w[1],
        -drag.moment_normal * w[2],
    )
    return f, subtract(m_B, cross(body.center, f))


@compiled
def force_and_moment_change(body, v, w, dv, dw):  # noqa: ARG001
    """Give the change of `force_and_moment` with a small change of the motion; for b = 0 both are linear.

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        dv: its change, of C, body frame, (3,) [m/s].
        dw: its change, body frame, (3,) [rad/s].

    Returns:
        df: of the force, body frame, (3,) [N].
        dm_C: of the moment about C, body frame, (3,) [N m].
    """
    return force_and_moment(body, dv, dw)
