"""The impact of one point of the coin on the floor, by the contact law: Strzalko et al. 2008, section 4.3."""

from typing import NamedTuple

from cointoss.analytic.impact.breach import Breach, breach_of
from cointoss.models.body import Body, Rules, is_ideal
from cointoss.models.contact_laws.law import NO_IMPULSE, Impact
from cointoss.models.contact_laws.table import impulse_by, spares_spin
from cointoss.models.kernel.address import call_at
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import Matrix, Vector, add, apply, apply_transposed, cross, scale
from cointoss.models.records import Ending


class ImpactPoint(NamedTuple):
    """The point A of the coin that touches the floor, as an impact finds it."""

    R: Matrix
    """Rotation matrix, body to space."""
    arm: Vector
    """The arm from C to A, space frame [m]."""
    tau: Vector
    """Unit vector along the coin's edge at A, space frame; zero where the coin lands flat without turning."""
    velocity: Vector
    """v_A before the impact, space frame [m/s]."""
    is_flat: bool
    """Whether the coin lands flat without turning: the impulse then goes through C."""


@compiled
def delassus(body: Body, R: Matrix, arm: Vector) -> Matrix:
    """Return the Delassus matrix K of A, its inverse effective mass: an impulse S gives v_A' = v_A + K S.

    K = I/m - [a] R J_C⁻¹ Rᵀ [a], [a] the matrix of a × : eqs (87)-(90), solved for v_A'.

    Args:
        body: the coin.
        R: rotation matrix, body to space.
        arm: a, from C to A, space frame, (3,) [m].

    Returns:
        K: space frame, symmetric and positive definite, a tuple of rows [1/kg].
    """
    # The columns; K is symmetric, so they are its rows too.
    return (
        velocity_gained(body, R, arm, (1.0, 0.0, 0.0), arm),
        velocity_gained(body, R, arm, (0.0, 1.0, 0.0), arm),
        velocity_gained(body, R, arm, (0.0, 0.0, 1.0), arm),
    )


@compiled
def spin_gained(body: Body, R: Matrix, arm: Vector, S: Vector) -> Vector:
    """Return the change of ω by an impulse S at A: J_C⁻¹ Rᵀ (a × S), body frame, eqs (88)-(90)."""
    return apply(body.inertia_inverse, apply_transposed(R, cross(arm, S)))


@compiled
def spin_after(body: Body, rules: Rules, w: Vector, A: ImpactPoint, S: Vector) -> Vector:
    """Return ω after an impulse S at A, body frame, (3,) [rad/s].

    The moment about the axis ζ of an ideal coin is r S_τ. Where there is none, a coin without spin about ζ
    gets none by rounding either, and its next flight too is in closed form.

    Args:
        body: the coin.
        rules: floor and ending.
        w: ω before, body frame, (3,) [rad/s].
        A: that touches.
        S: space frame, (3,) [N s].
    """
    if A.is_flat:
        return w
    w_xi, w_eta, w_zeta = add(w, spin_gained(body, A.R, A.arm, S))
    if w[2] == 0 and is_ideal(body):
        is_spared = rules.own.address == 0 and spares_spin(rules.law)
        along = 0.0 if is_spared else S[0] * A.tau[0] + S[1] * A.tau[1]
        w_zeta = body.inertia_inverse[2][2] * body.radius * along
    return w_xi, w_eta, w_zeta


@compiled
def velocity_gained(body: Body, R: Matrix, arm: Vector, S: Vector, at: Vector) -> Vector:
    """Return the velocity that an impulse S at A gives to the coin's point `at` from C, space frame, (3,)."""
    return add(scale(1 / body.mass, S), cross(apply(R, spin_gained(body, R, arm, S)), at))


@compiled
def impulse(body: Body, rules: Rules, chi: float, A: ImpactPoint) -> tuple[Vector, Ending]:
    """Return the floor's impulse on the coin by the contact law: one's own, or the scenario's.

    That of a flat landing is vertical by each of the scenario's.

    Args:
        body: the coin.
        rules: floor and ending.
        chi: restitution of this impact.
        A: that touches.

    Returns:
        S: impulse, space frame, (3,) [N s].
        ending: `Ending.NO_SOLUTION` where the law has none, or gives what no floor can, else `Ending.NONE`.
    """
    tau, v_A = A.tau, A.velocity
    is_own = rules.own.address != 0
    if A.is_flat and not is_own:
        return (0.0, 0.0, -(1 + chi) * body.mass * v_A[2]), Ending.NONE
    K = delassus(body, A.R, (0.0, 0.0, 0.0) if A.is_flat else A.arm)
    if is_own:
        S = call_at(rules.own.address, K, v_A, tau, chi, rules.friction)
        if breach_of(rules.own, K, v_A, S) != Breach.NONE:
            return NO_IMPULSE, Ending.NO_SOLUTION
        return S, Ending.NONE
    asked = Impact(K, v_A, tau, chi, rules.friction, rules.restitution_kind)
    S, is_possible = impulse_by(rules.law, asked)
    return S, Ending.NONE if is_possible else Ending.NO_SOLUTION
