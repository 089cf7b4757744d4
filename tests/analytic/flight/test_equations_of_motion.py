"""The motion that is integrated obeys every equation of motion that the paper prints, or its correction.

Of a random state of a coin, with the rates that `equations_of_motion` gives it: a polynomial that vanishes at
random numbers vanishes.
"""

import numpy as np
import pytest

from cointoss.analytic.air.force import force_and_moment
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import AIR, IMPERFECT, THIN, ZLOTY, draw_quaternion, scenario
from tests.helpers.printed_equations import EQUATIONS as PRINTED
from tests.helpers.tuples import quaternion, vector

SEEDS = pytest.mark.parametrize("seed", range(3))
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


@SEEDS
@pytest.mark.parametrize("J_xi_zeta", [0.0, 0.2])
def test_plane_motion_eqs_41_47(seed, J_xi_zeta):
    """Of ϑ(t) by eq. (44): the moments that eq. (22) asks for; the line before (47) prints 0 = M_ζ.

    With a product J_ξζ, which the paper lets vanish, (42) lacks J_ξζ ϑ̇².
    """
    theta, rate, acceleration = np.random.default_rng(seed).uniform(0.5, 3, 3)
    e = np.array([np.cos(theta / 2), np.sin(theta / 2)])
    across = np.array([-e[1], e[0]])
    parts = (e, rate / 2 * across, acceleration / 2 * across - rate**2 / 4 * e)
    values = np.concatenate([[*part, 0.0, 0.0] for part in parts])
    symbols = dict(zip([*E, *D, *DD], values, strict=True))
    symbols |= {"J_xi": 1.3, "J_eta": 1.1, "J_zeta": 2.1, "J_xi_eta": 0.4, "J_eta_zeta": 0.0}
    J = np.array([[1.3, -0.4, -J_xi_zeta], [-0.4, 1.1, 0], [-J_xi_zeta, 0, 2.1]])
    w = np.array([rate, 0, 0])
    M = J @ [acceleration, 0, 0] + np.cross(w, J @ w)
    printed = [PRINTED[number](**symbols, J_xi_zeta=J_xi_zeta) for number in (41, 42, 43)]
    corrected = CORRECTED[42](**symbols, J_xi_zeta=J_xi_zeta)
    assert (e[0] * parts[2][1] - e[1] * parts[2][0]) == pytest.approx(acceleration / 2)
    due = [1.3 * acceleration, -0.4 * acceleration, -0.4 * rate**2]
    assert M - due == pytest.approx([0, J_xi_zeta * rate**2, -J_xi_zeta * acceleration])
    assert [printed[0], corrected, printed[2]] == pytest.approx(due)
    assert abs(printed[1] - corrected) > 1e-3


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
