"""The impact of one point of the coin on the floor: one function for each contact law.

Strzalko et al. 2008, section 4.3 and Fig. 17. The velocity of the contact point A has the parts v_Aτ along
the coin's edge, v_Aν across it, both in the floor, and v_Az. Every law keeps Newton's v_Az' = -χ v_Az,
eq. (85).
"""

from typing import NamedTuple

from cointoss.analytic.impact.breach import Breach, breach_of
from cointoss.analytic.impact.coulomb import coulomb
from cointoss.models.body import Body, Rules
from cointoss.models.kernel.address import call_at
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.vectors import (
    Matrix,
    Vector,
    add,
    apply,
    apply_transposed,
    cross,
    dot,
    scale,
    solve,
    subtract,
)
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Ending

NO_IMPULSE = (0.0, 0.0, 0.0)


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
def velocity_gained(body: Body, R: Matrix, arm: Vector, S: Vector, at: Vector) -> Vector:
    """Return the velocity that an impulse S at A gives to the coin's point `at` from C, space frame, (3,)."""
    return add(scale(1 / body.mass, S), cross(apply(R, spin_gained(body, R, arm, S)), at))


@compiled
def sharp_edge(K: Matrix, v_A: Vector, tau: Vector, chi: float) -> Vector:
    """(a) Return the impulse that stops the slip across the edge: v_Aν' = 0, v_Aτ' = v_Aτ."""
    along = dot(v_A, tau)
    return solve(K, subtract((along * tau[0], along * tau[1], -chi * v_A[2]), v_A))


@compiled
def knurled(K: Matrix, v_A: Vector, tau: Vector, chi: float) -> Vector:
    """(b) Return the impulse that stops the slip along the edge: v_Aτ' = 0, v_Aν' = v_Aν."""
    nu = (-tau[1], tau[0], 0.0)
    across = dot(v_A, nu)
    return solve(K, subtract((across * nu[0], across * nu[1], -chi * v_A[2]), v_A))


@compiled
def perfectly_rough(K: Matrix, v_A: Vector, chi: float) -> Vector:
    """(c) Return the impulse that stops all slip: v_Aτ' = v_Aν' = 0, eqs (91)-(92)."""
    return solve(K, subtract((0.0, 0.0, -chi * v_A[2]), v_A))


@compiled
def slip_preserving(K: Matrix, v_A: Vector, chi: float) -> Vector:
    """(d) Return the impulse that keeps all slip: v_Aτ' = v_Aτ, v_Aν' = v_Aν."""
    return solve(K, (0.0, 0.0, -(1 + chi) * v_A[2]))


@compiled
def smooth(K: Matrix, v_A: Vector, chi: float) -> Vector:
    """(e) Return the impulse of a floor without friction, S = S_z ẑ; for the ideal coin eqs (93)-(97)."""
    return 0.0, 0.0, -(1 + chi) * v_A[2] / K[2][2]


@compiled
def sliding_friction(K: Matrix, v_A: Vector, chi: float, mu: float) -> tuple[Vector, bool]:
    """(f) Return the impulse of developed friction: S_τν = -μ S_z v_Aτν/|v_Aτν|.

    The direction is that of the slip at touch-down, for the whole impact; without slip there is none and
    the floor acts as a smooth one.

    Returns:
        S: impulse, space frame, (3,) [N s].
        possible: False where no S_z > 0 fulfils Newton's law (Painlevé's case).
    """
    slip = (v_A[0] * v_A[0] + v_A[1] * v_A[1]) ** 0.5
    if slip == 0:
        return smooth(K, v_A, chi), True
    direction = (-mu * v_A[0] / slip, -mu * v_A[1] / slip, 1.0)
    gained = dot(K[2], direction)
    if gained <= 0:
        return NO_IMPULSE, False
    return scale(-(1 + chi) * v_A[2] / gained, direction), True


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
    law, tau, v_A = rules.law, A.tau, A.velocity
    is_own = rules.own.address != 0
    if A.is_flat and not is_own:
        return (0.0, 0.0, -(1 + chi) * body.mass * v_A[2]), Ending.NONE
    K = delassus(body, A.R, (0.0, 0.0, 0.0) if A.is_flat else A.arm)
    if is_own:
        S = call_at(rules.own.address, K, v_A, tau, chi, rules.friction)
        if breach_of(rules.own, K, v_A, S) != Breach.NONE:
            return NO_IMPULSE, Ending.NO_SOLUTION
        return S, Ending.NONE
    if law == ContactLaw.SHARP_EDGE:
        return sharp_edge(K, v_A, tau, chi), Ending.NONE
    if law == ContactLaw.KNURLED:
        return knurled(K, v_A, tau, chi), Ending.NONE
    if law == ContactLaw.PERFECTLY_ROUGH:
        return perfectly_rough(K, v_A, chi), Ending.NONE
    if law == ContactLaw.SLIP_PRESERVING:
        return slip_preserving(K, v_A, chi), Ending.NONE
    if law == ContactLaw.SLIDING_FRICTION:
        S, possible = sliding_friction(K, v_A, chi, rules.friction)
        return S, Ending.NONE if possible else Ending.NO_SOLUTION
    if law == ContactLaw.COULOMB:
        return coulomb(K, v_A, chi, rules.friction, rules.restitution_kind), Ending.NONE
    return smooth(K, v_A, chi), Ending.NONE
