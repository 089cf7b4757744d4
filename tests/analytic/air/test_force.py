"""The air's force for 0 <= b <= 1: against adaptive quadrature, closed forms, finer rules, its own change."""

import math
from typing import Any

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cointoss.analytic.air.face_friction import disc_dissipation
from cointoss.analytic.air.force import change_about_B, force_and_moment_change
from cointoss.analytic.air.force import force_and_moment as force_and_moment_of
from cointoss.analytic.air.law import AirMotion
from cointoss.analytic.air.quadrature import CHANGE_NODES, CONTACT_NODES, FORCE_NODES, nodes_of
from cointoss.analytic.entries import force_and_moment
from cointoss.models.kernel.compiled import by_numba
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario
from tests.helpers.referee import air_by_cubature
from tests.helpers.tuples import vector

changed = by_numba(change_about_B)
force_and_moment_change = by_numba(force_and_moment_change)
R, H = ZLOTY["radius"], ZLOTY["thickness"]
LN, LT = AIR["normal"], AIR["tangential"]
FINER = nodes_of(96, 96, 60.0)


def coin(b, h=H, ln=LN, lt=LT, c=(0.0, 0.0, 0.0)):
    return scenario(
        coin={"thickness": h, "center_of_mass": list(c)},
        air={"normal": ln, "tangential": lt, "exponent": b},
    ).body


def pull(body, v, w):
    """Force and moment over r, (6,)."""
    f, m = force_and_moment(body, vector(v), vector(w))
    return np.array([*f, *(x / R for x in m)])


def change(body, v, w, dv, dw):
    f, m = force_and_moment_change(body, vector(v), vector(w), vector(dv), vector(dw))
    return np.array([*f, *(x / R for x in m)])


def force_scale(b, v, w, change_of_motion=None):
    """The order of the force: λ (|v| + r |ω|)^(1+b) π r²; of its change along (dv, dw) where given."""
    speed, d_speed = (
        np.linalg.norm(p) + R * np.linalg.norm(q) for p, q in ((v, w), change_of_motion or (v, w))
    )
    return (LN + LT) * speed**b * d_speed * np.pi * R**2


def rough_motion(rng):
    """Draw a motion, often one for which a point or a line of the surface is at rest, or nearly."""
    v = rng.normal(size=3) * 10.0 ** rng.integers(-4, 2, 3)
    w = rng.normal(size=3) * 40 * 10.0 ** rng.integers(-3, 2, 3)
    near = 1 + rng.choice([0, 1e-14, 1e-10, 1e-6, -1e-6, 1e-3, -1e-3])
    theta, z = rng.uniform(0, 2 * np.pi), rng.uniform(-H / 2, H / 2) * near
    apart = rng.choice([0, 1e-12, 1e-6]) * rng.normal(size=3)
    motions = (
        ((v[0], v[1], R * math.hypot(w[0], w[1]) * near), w),  # pressure's line at rest is at the rim
        ((R * w[2] * near, 0, v[2]), w),  # the instantaneous centre is at the rim
        (v, (0, 0, w[2])),
        ((0, 0, 0), w),
        (v, (0, 0, 0)),
        (v * (np.arange(3) != rng.integers(3)), w),
        ((v[0], v[1], 0), w * [1e-9, 1e-9, 1]),
        (
            -np.cross(w, [R * np.cos(theta), R * np.sin(theta), z]) + apart,
            w,
        ),  # a point of the wall rests
        (v, w),
    )
    return tuple(map(np.array, motions[rng.integers(9)]))


DEGENERATE = {
    "broadside": ((0, 0, 1), (0, 0, 0)),
    "edgewise": ((1, 0, 0), (0, 0, 0)),
    "tumbling in place": ((0, 0, 0), (0, 40, 0)),
    "spinning in place": ((0, 0, 0), (0, 0, 40)),
    "rolling on the rim": ((40 * R, 0, 0), (0, 0, 40)),
    "rim's point at rest": ((0, 0, 40 * R), (0, 40, 0)),
    "face's centre at rest": ((40 * H / 2, 0, 0), (0, -40, 3)),
}


@pytest.mark.parametrize("b", [0.0, 0.3, 0.5, 1.0])
@pytest.mark.parametrize("h", [0.0, *(pytest.param(h, marks=pytest.mark.slow) for h in (H, 0.6 * R))])
def test_force_and_moment_are_the_papers_integrals(b, h):
    rng = np.random.default_rng([int(10 * b), int(1e4 * h)])
    motions = [(rng.normal(size=3), rng.normal(size=3) * 60) for _ in range(2)]
    for v, w in [*motions, *(tuple(map(np.array, m)) for m in DEGENERATE.values())]:
        size = force_scale(b, v, w)
        # The adaptive rule estimates its own error; at b = 0 the kinks of one-sided pressure cost it most.
        tolerance = (1e-6 if b == 0 else 1e-7) * size
        brute = air_by_cubature(R, h, LN, LT, b, np.array(v), np.array(w), tolerance) / [1, 1, 1, R, R, R]
        assert np.abs(pull(coin(b, h), v, w) - brute).max() < tolerance
        assert np.abs(brute).max() > 0.01 * size, "the scale should be that of the force"


@pytest.mark.slow_after_first
@pytest.mark.parametrize("b", [0.3, 1e-3, 0.1, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("h", [H, 0.6 * R, 10 * R])
def test_quadrature_has_converged_for_every_motion(b, h):
    """Against three times as many nodes; motions with points and lines at rest are drawn on purpose."""
    rng = np.random.default_rng([int(1000 * b), int(1e4 * h)])
    body, worst, worst_change, in_contact, coarse = coin(b, h), 0.0, 0.0, 0.0, 0.0
    for _ in range(60):
        v, w = rough_motion(rng)
        size = force_scale(b, v, w) * (1 + h / R)

        def about_B(dv, dw, nodes, v=v, w=w):
            f, m = changed(body, AirMotion(b, vector(v), vector(w), vector(dv), vector(dw)), nodes)
            return np.array([*f, *(x / R / (1 + h / R) for x in m)])

        exact = about_B(v, w, FINER)
        worst = max(worst, np.abs(about_B(v, w, FORCE_NODES) - exact).max() / size)
        in_contact = max(in_contact, np.abs(about_B(v, w, CONTACT_NODES) - exact).max() / size)
        coarse = max(coarse, np.abs(about_B(v, w, nodes_of(12, 6, 10.0)) - exact).max() / size)
        dv, dw = rng.normal(size=3), rng.normal(size=3) / R
        size = force_scale(b, v, w, (dv, dw)) * (1 + h / R)
        difference = about_B(dv, dw, CHANGE_NODES) - about_B(dv, dw, FINER)
        worst_change = max(worst_change, np.abs(difference).max() / size)
    assert worst < 1e-11
    assert worst_change < 1e-10
    # A force that is nearly the weight moves a coin by a part of it in a step, which may err by 1e-9.
    assert 1e-12 < in_contact < 2e-8
    assert coarse > 1e-9, "fewer nodes should show an error"


def around(b):
    """∫ |cos|^(b+2) over half a turn."""
    return math.sqrt(np.pi) * math.gamma((b + 3) / 2) / math.gamma(b / 2 + 2)


WALL, FACES, V, W = 2 * np.pi * R * H, 2 * np.pi * R**2, 0.7, 30.0
CLOSED = {
    "none in vacuum": (0.5, {"ln": 0.0, "lt": 0.0}, (1, 2, 3, 4, 5, 6), [0] * 6),
    # |W u| W u u over the chords 2 √(r² - u²).
    "a turning disc": (
        1.0,
        {"h": 0.0, "lt": 0.0},
        (0, 0, 0, 0, W, 0),
        [*[0] * 4, -LN * 8 / 15 * W**2 * R**4, 0],
    ),
    # So fast that no part is at rest: the square expands.
    "a disc that turns and moves": (
        *(1.0, {"h": 0.0, "lt": 0.0}, (0, 0, 2 * W * R, 0, W, 0)),
        np.array([0, 0, -LN * R**4 * W**2 * 17 / 4, 0, -LN * R**4 * W**2, 0]) * np.pi,
    ),
}
for b in (0.0, 0.2, 0.5, 1.0):
    broadside = -(V ** (1 + b)) * (LN * np.pi * R**2 + LT * WALL)
    edgewise = -(V ** (1 + b)) * (LT * FACES + (LN + 2 * LT) * R * H * around(b))
    spun = -LT * (W * R) ** (1 + b) * (2 * FACES / (b + 4) + WALL)
    CLOSED |= {
        f"broadside, b = {b}": (b, {}, (0, 0, V, 0, 0, 0), [0, 0, broadside, 0, 0, 0]),
        f"edgewise, b = {b}": (b, {}, (V, 0, 0, 0, 0, 0), [edgewise, 0, 0, 0, 0, 0]),
        f"spinning, b = {b}": (b, {}, (0, 0, 0, 0, 0, W), [0, 0, 0, 0, 0, spun]),
    }


@pytest.mark.parametrize(("b", "parts", "motion", "expected"), CLOSED.values(), ids=CLOSED)
def test_motions_in_one_direction_have_closed_forms(b, parts, motion, expected):
    found = pull(coin(b, **parts), motion[:3], motion[3:])
    assert found == pytest.approx(expected, rel=1e-13, abs=1e-18)


def test_a_drag_coefficient_is_that_of_the_broadside_disk():
    body, v = scenario(air={"drag_coefficient": 1.1, "density": "1.3 kg/m^3"}).body, 0.7
    expected = -1.3 * 1.1 / 2 * np.pi * R**2 * v**2
    assert pull(body, (0, 0, v), (0, 0, 0)) == pytest.approx([0, 0, expected, 0, 0, 0], rel=1e-13, abs=1e-18)


def test_the_limit_of_linear_air_is_the_closed_form():
    """The distance falls in proportion to b, also through motions with points at rest."""
    rng = np.random.default_rng(4)
    for v, w in [rough_motion(rng) for _ in range(40)]:
        linear, size = pull(coin(0.0), v, w), force_scale(0.0, v, w)
        apart = [np.abs(pull(coin(b), v, w) - linear).max() / size for b in (1e-3, 1e-6, 1e-9)]
        # |v|^b - 1 is near b ln |v|, and no speed here has a logarithm above 20 but near a point at rest.
        assert all(gap < 20 * b + 1e-12 for gap, b in zip(apart, (1e-3, 1e-6, 1e-9), strict=True))


@pytest.mark.slow_after_first
@pytest.mark.parametrize("b", [0.3, 0.0, 0.5, 1.0])
@pytest.mark.parametrize("h", [0.0, H])
def test_the_change_is_the_slope_of_the_force(b, h):
    rng = np.random.default_rng(5)
    for _ in range(10):
        v, w = rng.normal(size=3), rng.normal(size=3) * 60
        dv, dw = rng.normal(size=3), rng.normal(size=3) * 60
        body = coin(b, h, c=(-1e-3, 2e-3, h / 5))

        def slope(step, v=v, w=w, dv=dv, dw=dw, body=body):
            ahead, behind = (pull(body, v + s * dv, w + s * dw) for s in (step, -step))
            return (ahead - behind) / (2 * step)

        central = (4 * slope(5e-4) - slope(1e-3)) / 3
        size = force_scale(b, v, w, (dv, dw))
        # The difference formula is of order 4 only where no point at rest comes near; rounding adds 1e-11.
        assert np.abs(change(body, v, w, dv, dw) - central).max() < 2e-6 * size
        assert np.abs(central).max() > 0.01 * size


@given(st.integers(0, 10_000), st.sampled_from([0.0, 0.1, 0.5, 1.0]))
def test_the_force_is_homogeneous_and_odd(seed, b):
    v, w = rough_motion(np.random.default_rng(seed))
    body, size = coin(b, c=(1e-3, 2e-3, 1e-4)), force_scale(b, v, w)
    here = pull(body, v, w)
    assert np.abs(pull(body, -v, -w) + here).max() < 1e-12 * size
    assert np.abs(pull(body, 3 * v, 3 * w) - 3 ** (1 + b) * here).max() < 1e-11 * size
    # Euler's theorem; the change is integrated with other nodes.
    assert np.abs(change(body, v, w, v, w) - (1 + b) * here).max() < 1e-11 * size


@pytest.mark.parametrize(("b", "is_needed"), [(0.0, False), pytest.param(0.5, True, marks=pytest.mark.slow)])
def test_linear_air_is_compiled_without_the_quadrature(b, is_needed):
    """Beside it the few lines of linear air are slower: their calls are no longer inlined."""
    written: Any = force_and_moment_of
    compiled: Any = numba.njit(written.py_func)
    compiled(coin(b), (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
    assert ("quadrature" in "".join(compiled.inspect_llvm().values())) == is_needed


@pytest.mark.parametrize("b", [0.3, 1.0])
@pytest.mark.parametrize("U", [1.1, 1.45, 1.55, 4.0])
def test_the_friction_of_a_face_is_the_sum_over_its_points(b, U):
    """|V|^b + b |V|^(b-2) V V of V = (U - ω y, ω x) for r = ω = 1: no point is at rest."""
    rho, weights = np.polynomial.legendre.leggauss(300)
    angle = np.arange(600)[:, None] * np.pi / 300
    rho, shares = (rho + 1) / 2, (rho + 1) / 4 * weights * np.pi / 300
    moves = np.array([[1 + 0 * rho * angle, 0 * rho * angle], [-rho * np.sin(angle), rho * np.cos(angle)]])
    V = U * moves[0] + moves[1]
    square = V[0] ** 2 + V[1] ** 2
    along = np.einsum("jkpq,kpq->jpq", np.array([moves[0], moves[0][::-1], moves[1]]), V) / square**0.5

    def total(part):
        return float((square ** (b / 2) * part * shares).sum())

    spun = moves[1][0] + b * along[0] * along[2], rho**2 + b * along[2] ** 2
    expected = total(1 + b * along[0] ** 2), total(1 + b * along[1] ** 2), total(spun[0]), total(spun[1])
    assert disc_dissipation(b, 1.0, U, 1.0, CHANGE_NODES) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("b", [0.0, 0.5])
def test_the_force_on_an_unbalanced_coin_is_that_about_its_middle(b):
    """v_B = v - ω × c, and m_C = m_B - c × f."""
    rng, c = np.random.default_rng(12), np.array(IMPERFECT["center_of_mass"])
    v, w = rng.normal(size=3), rng.normal(size=3) * 60
    about_B, about_C = pull(coin(b), v - np.cross(w, c), w), pull(coin(b, c=c), v, w)
    moved = about_B - [0, 0, 0, *np.cross(c, about_B[:3]) / R]
    assert about_C == pytest.approx(moved, rel=1e-13, abs=1e-13 * force_scale(b, v, w))
