"""The air's force on a flying coin and its moment."""

from cointoss.analytic.air.face_friction import face_friction_change
from cointoss.analytic.air.law import AirMotion
from cointoss.analytic.air.pressure import pressure_change
from cointoss.analytic.air.quadrature import CHANGE_NODES, CONTACT_NODES, FORCE_NODES, Nodes
from cointoss.analytic.air.wall_friction import wall_friction_change
from cointoss.models.body import Body
from cointoss.models.kernel.arrays import Array, copy_into
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Vector, add, cross, scale, subtract

_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@compiled
def force_and_moment(body: Body, v: Vector, w: Vector) -> tuple[Vector, Vector]:
    """Return the air's force and its moment about the mass centre.

    Strzalko et al. 2008, eqs (49)-(74). For b = 0 in the closed form of `cointoss.models.drag`: at B,
    f = -diag(c) v_B and m_B = -diag(d) ω; about C, m_C = m_B - c × f with c from B to C. For 0 < b <= 1 by
    quadrature: force and moment are homogeneous of degree 1 + b in (v, ω), so they are their own change in
    the direction of (v, ω), over 1 + b.

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].

    Returns:
        f: force, body frame, (3,) [N].
        m_C: moment about C, body frame, (3,) [N m].
    """
    return force_and_moment_by(body.air.exponent, body, v, w, False)


@compiled
def force_and_moment_by(
    exponent: float | None, body: Body, v: Vector, w: Vector, in_contact: bool
) -> tuple[Vector, Vector]:
    """Return `force_and_moment` by the exponent; where it is not None, in sustained contact, to 2e-8 of it.

    Only for an argument that is None numba omits a branch.
    """
    if exponent is not None:
        return _by_quadrature(body, exponent, v, w, CONTACT_NODES if in_contact else FORCE_NODES)
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
def force_and_moment_change(
    body: Body, v: Vector, w: Vector, dv: Vector, dw: Vector
) -> tuple[Vector, Vector]:
    """Return how the air's force and moment about C change with the motion, to first order in (dv, dw).

    For b = 0 they are linear. For b > 0 the same quadrature is applied to the change of the force on dA,
    -λ (|v|^b dv + b |v|^(b-2) (v . dv) v); the border of the pressure adds nothing, its force vanishes there.

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        dv: change of v, (3,) [m/s].
        dw: change of w, (3,) [rad/s].

    Returns:
        df: change of the force, body frame, (3,) [N].
        dm_C: change of the moment about C, body frame, (3,) [N m].
    """
    return _force_and_moment_change(body.air.exponent, body, v, w, dv, dw)


@compiled
def _force_and_moment_change(
    exponent: float | None, body: Body, v: Vector, w: Vector, dv: Vector, dw: Vector
) -> tuple[Vector, Vector]:
    if exponent is None:
        return force_and_moment(body, dv, dw)
    v_B, dv_B = subtract(v, cross(w, body.center)), subtract(dv, cross(dw, body.center))
    df, dm_B = change_about_B(body, AirMotion(exponent, v_B, w, dv_B, dw), CHANGE_NODES)
    return df, subtract(dm_B, cross(body.center, df))


@compiled
def write_jacobian(body: Body, v: Vector, w: Vector, jacobian: Array) -> None:
    """Write the derivatives of the air's force and moment about C by the motion.

    Args:
        body: the coin.
        v: velocity of C, body frame, (3,) [m/s].
        w: angular velocity, body frame, (3,) [rad/s].
        jacobian: where they go, (6, 6); row i, column j: of f and then m_C by v and then ω, body frame.
    """
    none = (0.0, 0.0, 0.0)
    for j in range(3):
        for column, dv, dw in ((j, _AXES[j], none), (3 + j, none, _AXES[j])):
            df, dm = force_and_moment_change(body, v, w, dv, dw)
            copy_into(jacobian[:, column], df + dm)


@compiled
def _by_quadrature(body: Body, b: float, v: Vector, w: Vector, nodes: Nodes) -> tuple[Vector, Vector]:
    """Return force and moment for b > 0."""
    v_B, share = subtract(v, cross(w, body.center)), 1 / (1 + b)
    df, dm_B = change_about_B(body, AirMotion(b, v_B, w, v_B, w), nodes)
    return scale(share, df), scale(share, subtract(dm_B, cross(body.center, df)))


@compiled
def change_about_B(body: Body, motion: AirMotion, nodes: Nodes) -> tuple[Vector, Vector]:
    """Return the change of the air's force and of its moment about B for b > 0, with given nodes.

    Args:
        body: the coin.
        motion: of the coin, and its change.
        nodes: of the graded rules.

    Returns:
        df: change of the force, body frame, (3,) [N].
        dm_B: change of the moment about B, body frame, (3,) [N m].
    """
    df, dm = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    if body.air.normal > 0:
        df, dm = pressure_change(body, motion, nodes)
    if body.air.tangential > 0:
        df_faces, dm_faces = face_friction_change(body, motion, nodes)
        df, dm = add(df, df_faces), add(dm, dm_faces)
        if body.thickness > 0:
            df_wall, dm_wall = wall_friction_change(body, motion, nodes)
            df, dm = add(df, df_wall), add(dm, dm_wall)
    return df, dm
