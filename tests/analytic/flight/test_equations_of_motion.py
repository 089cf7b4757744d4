"""The motion that is integrated obeys every equation of motion that the paper prints, or its correction.

Numbers: a random state of a coin, with the rates that `equations_of_motion` gives it. Symbols: the
printed scalar equations against the vector form (22), for every state at once.
"""

from functools import cache

import numpy as np
import pytest

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, draw_quaternion, scenario
from tests.helpers.printed_equations import EQUATIONS as PRINTED
from tests.helpers.tuples import quaternion, vector

SEEDS = pytest.mark.parametrize("seed", range(10))
EXACT = 1e-10
"""Agreement asked for, relative to the size of the terms."""
WRONG = {24: 1e-2, 36: 1e-2, 37: 1e-2, 38: 1e-4, 39: 1e-2}
"""Above this part of the size of the terms a printed equation fails, by its number."""
FIRST, SECOND = "- e1*d0 + e0*d1 + e3*d2 - e2*d3", "- e1*dd0 + e0*dd1 + e3*dd2 - e2*dd3"
W_XI, W_ZETA = "e1*d0 - e0*d1 - e3*d2 + e2*d3", "e3*d0 - e2*d1 + e1*d2 - e0*d3"
CORRECTED = {
    # ω_ξ, not ω_ζ, in the first product: the two then cancel, as J_ξ = J_η asks.
    36: PRINTED[36].corrected((W_ZETA, W_XI)),
    # The factor 2 before all terms.
    37: PRINTED[37].corrected(("e1*d3)) + ", "e1*d3) + "), ("e3*dd2 - e2*dd3)", "e3*dd2 - e2*dd3))")),
    # Second derivatives in the last four terms, as in eq. (31).
    38: PRINTED[38].corrected((FIRST, SECOND)),
    # ω_ξ, not ω_ζ, in the first factors of the first and third products.
    39: PRINTED[39].corrected((W_ZETA, W_XI)),
    # Second derivatives.
    42: PRINTED[42].corrected((FIRST[2:], SECOND[2:])),
}

THIN_IMPERFECT = {**ZLOTY, "thickness": 0.0, "center_of_mass": [-1e-3, -1e-3, 0.0]}
PRODUCTS = ((0, 1, "J_xi_eta"), (0, 2, "J_xi_zeta"), (1, 2, "J_eta_zeta"))
E, D, DD = ([f"{letter}{i}" for i in range(4)] for letter in ("e", "d", "dd"))


def skew(a):
    return np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])


def lopsided(rng):
    """Give a coin whose inertia has large products: that of six random points."""
    points = rng.normal(size=(6, 3)) * ZLOTY["radius"] / 2
    points -= points.mean(axis=0)
    J = sum(p @ p * np.eye(3) - np.outer(p, p) for p in points) * ZLOTY["mass"] / 6
    return {**IMPERFECT, "inertia": J.tolist()}


class Motion:
    """A coin in flight through air: its state, the rates the engine gives it, and what acts on it."""

    def __init__(self, coin, seed, w=None):
        rng = np.random.default_rng(seed)
        coin = lopsided(rng) if coin == "lopsided" else coin
        case = scenario(coin=coin, air=AIR)
        self.m, self.r, self.h = case.coin.mass, case.coin.radius, case.coin.thickness
        self.c, self.J, self.g = np.array(case.coin.center_of_mass), case.coin.inertia_about_C, case.gravity
        self.v, self.e = rng.uniform(-3, 3, 3), np.array(draw_quaternion(rng))
        self.w = rng.uniform(-60, 60, 3) if w is None else np.array(w)
        rates = np.empty(13)
        derivative(case.body, np.array([0, 0, 1, *self.v, *self.e, *self.w]), rates)
        self.a, self.d, self.dw = rates[3:6], rates[6:10], rates[10:13]
        # ė = ½ e ∘ ω, differentiated.
        self.dd = np.add(
            quaternion_rate(quaternion(self.d), vector(self.w)),
            quaternion_rate(quaternion(self.e), vector(self.dw)),
        )
        self.R = np.array(rotation_matrix(tuple(self.e)))
        air, moment = force_and_moment(case.body, tuple(self.R.T @ self.v), tuple(self.w))
        self.f = self.R @ air - [0, 0, self.m * self.g]
        self.M = np.array(moment)
        self.torque_size = np.abs(self.J).max() * (self.w @ self.w + np.abs(self.dw).max())

    @property
    def symbols(self):
        values = {"m": self.m, "r": self.r, "h": self.h}
        values |= dict(zip([*E, *D, *DD], [*self.e, *self.d, *self.dd], strict=True))
        values |= {"J_xi": self.J[0, 0], "J_eta": self.J[1, 1], "J_zeta": self.J[2, 2]}
        # The tensor holds the products of inertia with a minus sign.
        values |= {name: -self.J[i, j] for i, j, name in PRODUCTS}
        for i, axis in enumerate(("xi", "eta", "zeta")):
            values |= {f"w_{axis}": self.w[i], f"dw_{axis}": self.dw[i]}
        return values

    def misfit(self, left, axis):
        """Give what is left of a scalar equation about an axis, relative to the size of its terms."""
        return abs(left(**self.symbols) - self.M[axis]) / self.torque_size


def bilinear(a, b):
    """Give the symmetric bilinear form Q of the rotation matrix, R = Q(e, e) on the unit sphere."""

    def square(e):
        return (e[0] ** 2 - e[1:] @ e[1:]) * np.eye(3) + 2 * np.outer(e[1:], e[1:]) + 2 * e[0] * skew(e[1:])

    return (square(a + b) - square(a) - square(b)) / 2


ALL = (ZLOTY, IMPERFECT, THIN_IMPERFECT, "lopsided")
COINS = pytest.mark.parametrize("coin", ALL)


@COINS
@SEEDS
def test_angular_velocity_is_the_rate_of_the_rotation_matrix(coin, seed):
    motion = Motion(coin, seed)
    R, R_rate = bilinear(motion.e, motion.e), 2 * bilinear(motion.e, motion.d)
    size = np.abs(motion.w).max()
    assert np.abs(R - motion.R).max() < 1e-15
    assert np.abs(R.T @ R_rate - skew(motion.w)).max() < EXACT * size
    assert np.abs(PRINTED[17](**motion.symbols) - motion.w).max() < EXACT * size
    assert np.abs(PRINTED[18](**motion.symbols) - motion.dw).max() < EXACT * size**2
    # The space frame's Ω has its dot: Ṙ Rᵀ. Without it R Rᵀ is the unit matrix.
    assert np.abs(R_rate @ R.T - skew(PRINTED[19](**motion.symbols))).max() < EXACT * size
    assert np.abs(R.T @ (R_rate @ R.T) @ R - skew(motion.w)).max() < EXACT * size
    assert np.abs(R @ R.T - np.eye(3)).max() < 1e-14


@SEEDS
def test_eq_16_holds_in_two_entries_only(seed):
    motion = Motion(ZLOTY, seed)
    error = np.abs(np.array(PRINTED[16](**motion.symbols)) - skew(motion.w)) / np.abs(motion.w).max()
    right = error < EXACT
    assert right.tolist() == [[True, True, True], [False, True, False], [False, False, True]]
    # What stands in the lower left corner is ω_z of eq. (19).
    assert PRINTED[16](**motion.symbols)[2][0] == pytest.approx(PRINTED[19](**motion.symbols)[2], rel=1e-12)


@COINS
@SEEDS
def test_vector_form_at_the_mass_centre_eqs_21_22(coin, seed):
    motion = Motion(coin, seed)
    assert np.abs(motion.m * motion.a - motion.f).max() < EXACT * motion.m * motion.g
    left = motion.J @ motion.dw + skew(motion.w) @ motion.J @ motion.w
    assert np.abs(left - motion.M).max() < EXACT * motion.torque_size


@pytest.mark.parametrize("coin", [IMPERFECT, THIN_IMPERFECT, "lopsided"])
@SEEDS
def test_vector_form_at_the_geometric_centre_eqs_23_24(coin, seed):
    motion = Motion(coin, seed)
    m, c, R, w, dw = motion.m, motion.c, motion.R, motion.w, motion.dw
    # The path of B, differentiated twice without any angular velocity.
    R_acceleration = 2 * bilinear(motion.e, motion.dd) + 2 * bilinear(motion.d, motion.d)
    a_B = motion.a - R_acceleration @ c
    Omega, Omega_rate, r_C = skew(R @ w), skew(R @ dw), R @ c
    size = m * np.linalg.norm(c) * (w @ w) + m * motion.g
    assert np.abs(m * (a_B + Omega_rate @ r_C + Omega @ Omega @ r_C) - motion.f).max() < EXACT * size

    J_B = motion.J + m * (c @ c * np.eye(3) - np.outer(c, c))
    m_B = motion.M + np.cross(c, R.T @ motion.f)
    turning = J_B @ dw + skew(w) @ J_B @ w
    size = motion.torque_size + np.linalg.norm(c) * size
    # Eq. (24) adds components in the body frame: a_B there is Rᵀ times the a_B of eq. (23).
    assert np.abs(turning + m * skew(c) @ R.T @ a_B - m_B).max() < EXACT * size
    least = WRONG[24] * m * np.linalg.norm(c) * np.linalg.norm(a_B)
    assert np.abs(turning + m * skew(c) @ a_B - m_B).max() > least


@COINS
@SEEDS
def test_constraint_on_the_euler_parameters_eq_33(coin, seed):
    motion = Motion(coin, seed)
    assert abs(PRINTED[33](**motion.symbols)) < EXACT * (motion.w @ motion.w)


@SEEDS
@pytest.mark.parametrize(
    ("coin", "number", "axis"),
    [
        *((coin, number, (number - 26) % 4) for coin in ALL for number in (26, 27, 28, 30, 31, 32)),
        *((coin, number, number - 34) for coin in (THIN, ZLOTY) for number in (34, 35, 36)),
        *((THIN_IMPERFECT, number, number - 37) for number in (37, 38, 39)),
    ],
)
def test_scalar_forms_eqs_26_39(coin, seed, number, axis):
    """Of the imperfect coin, the ideal one and the thin one: as printed, or else as corrected."""
    motion = Motion(coin, seed)
    assert motion.misfit(CORRECTED.get(number, PRINTED[number]), axis) < EXACT
    assert number not in CORRECTED or motion.misfit(PRINTED[number], axis) > WRONG[number]


NO_PRODUCTS = {name: 0 for _, _, name in PRODUCTS}


@cache
def free():
    """Return a symbol for each name of a coin, its moments and its Euler parameters."""
    import sympy

    reals = {name: sympy.Symbol(name, real=True) for name in ["m", "r", "h", *E, *D, *DD]}
    return reals | {name: sympy.Symbol(name) for name in ("J_xi", "J_eta", "J_zeta", *NO_PRODUCTS)}


def flat():
    return free() | {"J_xi_zeta": 0, "J_eta_zeta": 0}


def ideal():
    m, r, h = (free()[name] for name in "mrh")
    across = m * r**2 / 4 + m * h**2 / 12
    return free() | NO_PRODUCTS | {"J_xi": across, "J_eta": across, "J_zeta": m * r**2 / 2}


def vector_form(symbols, w, dw):
    """Give the left side of eq. (22)."""
    import sympy

    J = sympy.diag(symbols["J_xi"], symbols["J_eta"], symbols["J_zeta"])
    for i, j, name in PRODUCTS:
        J[i, j] = J[j, i] = -symbols[name]
    w, dw = sympy.Matrix(w), sympy.Matrix(dw)
    return J * dw + w.cross(J * w)


def vanishes(expression):
    import sympy

    return sympy.expand(sympy.nsimplify(expression, rational=True)) == 0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("left", "axis", "coin", "holds"),
    [
        (PRINTED[30], 0, free, True),
        (PRINTED[31], 1, free, True),
        (PRINTED[32], 2, free, True),
        (PRINTED[34], 0, ideal, True),
        (PRINTED[35], 1, ideal, True),
        (PRINTED[36], 2, ideal, False),
        (CORRECTED[36], 2, ideal, True),
        (PRINTED[37], 0, flat, False),
        (CORRECTED[37], 0, flat, True),
        (PRINTED[38], 1, flat, False),
        (CORRECTED[38], 1, flat, True),
        (PRINTED[39], 2, flat, False),
        (CORRECTED[39], 2, flat, True),
    ],
    ids=lambda value: getattr(value, "name", ""),
)
def test_in_symbols_the_forms_in_euler_parameters_are_eq_22(left, axis, coin, holds):
    symbols = coin()
    right = vector_form(symbols, PRINTED[17](**symbols), PRINTED[18](**symbols))[axis]
    assert vanishes(left(**symbols) - right) == holds


@pytest.mark.slow
@pytest.mark.parametrize("number", [26, 27, 28])
def test_in_symbols_the_forms_in_angular_velocity_are_eq_22(number):
    import sympy

    names = [f"{kind}_{axis}" for kind in ("w", "dw") for axis in ("xi", "eta", "zeta")]
    rates = {name: sympy.Symbol(name) for name in names}
    right = vector_form(free(), [rates[name] for name in names[:3]], [rates[name] for name in names[3:]])
    assert vanishes(PRINTED[number](**free(), **rates) - right[number - 26])


@pytest.mark.slow
def test_in_symbols_eq_18_is_the_derivative_of_eq_17():
    import sympy

    t = sympy.Symbol("t")
    e = [sympy.Function(name)(t) for name in E]
    d, dd = [x.diff(t) for x in e], [x.diff(t, 2) for x in e]
    symbols = dict(zip([*E, *D, *DD], [*e, *d, *dd], strict=True))
    for spin, rate in zip(PRINTED[17](**symbols), PRINTED[18](**symbols), strict=True):
        assert sympy.expand(sympy.diff(spin, t) - rate) == 0


def planar(J_xi_zeta):
    """Give the symbols of a plane motion by eq. (44), with the moments that eq. (22) then asks for."""
    import sympy

    t = sympy.Symbol("t")
    theta = sympy.Function("theta")(t)
    e = [sympy.cos(theta / 2), sympy.sin(theta / 2), sympy.Integer(0), sympy.Integer(0)]
    values = [*e, *[x.diff(t) for x in e], *[x.diff(t, 2) for x in e]]
    symbols = free() | {"J_xi_zeta": J_xi_zeta, "J_eta_zeta": 0}
    symbols |= dict(zip([*E, *D, *DD], values, strict=True))
    theta_rate, theta_acceleration = theta.diff(t), theta.diff(t, 2)
    M = vector_form(symbols, [theta_rate, 0, 0], [theta_acceleration, 0, 0])
    return symbols, M, theta_rate, theta_acceleration


@pytest.mark.slow
def test_in_symbols_plane_motion_eqs_41_47():
    import sympy

    symbols, M, theta_rate, theta_acceleration = planar(0)
    e0, e1, d0, d1, dd0, dd1 = (symbols[name] for name in ("e0", "e1", "d0", "d1", "dd0", "dd1"))
    # Eqs (45)-(46).
    assert sympy.simplify(e0 * dd1 - e1 * dd0 - theta_acceleration / 2) == 0
    assert sympy.simplify(e1 * d0 - e0 * d1 + theta_rate / 2) == 0
    assert sympy.simplify(PRINTED[41](**symbols) - M[0]) == 0
    assert sympy.simplify(PRINTED[42](**symbols) - M[1]) != 0
    assert sympy.simplify(CORRECTED[42](**symbols) - M[1]) == 0
    assert sympy.simplify(PRINTED[43](**symbols) - M[2]) == 0
    # Eq. (47); the line before it prints 0 = M_ζ.
    assert sympy.expand(M[0] - symbols["J_xi"] * theta_acceleration) == 0
    assert sympy.expand(M[1] + symbols["J_xi_eta"] * theta_acceleration) == 0
    assert sympy.expand(M[2] + symbols["J_xi_eta"] * theta_rate**2) == 0
    assert M[2] != 0


@pytest.mark.slow
def test_in_symbols_plane_motion_needs_the_product_xi_zeta_to_vanish():
    import sympy

    product = free()["J_xi_zeta"]
    symbols, M, theta_rate, _ = planar(product)
    assert sympy.simplify(M[1] - CORRECTED[42](**symbols) - product * theta_rate**2) == 0


@SEEDS
def test_plane_motion_of_the_symmetric_coin_eq_48(seed):
    motion = Motion(THIN, seed, w=[37.0, 0.0, 0.0])
    assert motion.J[0, 0] * motion.dw[0] == pytest.approx(motion.M[0], rel=1e-12)
    assert motion.M[0] != 0
    assert np.all(motion.M[1:] == 0)
    assert np.all(motion.dw[1:] == 0)


def test_a_free_coin_with_the_product_xi_eta_leaves_the_plane():
    motion = Motion(THIN_IMPERFECT, 1, w=[37.0, 0.0, 0.0])
    J_xi_eta = motion.symbols["J_xi_eta"]
    # Eq. (28) with ω = (ω_ξ, 0, 0): only a moment -J_ξη ω_ξ² would hold the axis.
    gyroscopic = -J_xi_eta * motion.w[0] ** 2
    assert motion.J[2, 2] * motion.dw[2] == pytest.approx(motion.M[2] - gyroscopic, rel=1e-12)
    assert abs(motion.dw[2]) > 1
