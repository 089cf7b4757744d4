"""The law `coulomb` against a brute-force integration, the laws it meets in its limits, and its energy."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.models.contact_laws.coulomb import (
    NO_SLIP,
    SIZE,
    V_Z,
    Goal,
    RoughPoint,
    coulomb,
    friction_without_slip,
    straight_slip,
)
from cointoss.models.laws import RestitutionKind
from tests.helpers.impacts import draw_contact
from tests.helpers.tuples import matrix

KINEMATIC, ENERGETIC = RestitutionKind
COUNT = 100


def after(K, v, S):
    return np.array(v) + np.array(K) @ S


def brute(K, v, mu, end, *, stopped=1e-3, **integrator):
    """Integrate dv/dp = K (-mu s, 1) while the point slips, up to the root of `end`.

    Returns:
        v_A, S_x, S_y, the work of the normal impulse and p, (7,), and the slowest slip; None if the slip
        falls to its part `stopped` before.
    """
    K = np.array(K)

    def rate(_, y):
        s = y[:2] / np.hypot(*y[:2])
        return np.array([*(K @ [-mu * s[0], -mu * s[1], 1]), -mu * s[0], -mu * s[1], y[2]])

    def stops(_, y):
        return np.hypot(*y[:2]) - stopped * np.hypot(*v[:2])

    def ends(_, y):
        return end(y)

    stops.terminal = ends.terminal = True  # pyright: ignore[reportFunctionMemberAccess]
    ends.direction = 1  # pyright: ignore[reportFunctionMemberAccess]
    how = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-15, **integrator}
    solved = solve_ivp(rate, (0, 10), [*v, 0, 0, 0], events=(stops, ends), **how)
    if len(solved.t_events[0]):
        return None
    return np.array([*solved.y_events[1][0], solved.t_events[1][0]]), np.hypot(*solved.y[:2]).min()


def brute_impulse(K, v, chi, mu, kind, **how):
    """Return the impulse of the law, (3,), None if the slip stops before its end."""
    first = brute(K, v, mu, lambda y: y[2] + chi * v[2] * (kind == KINEMATIC), **how)
    if first is None or kind == KINEMATIC:
        return None if first is None else first[0][[3, 4, 6]]
    taken, slips = first[0][5], first[0][:3]
    restored = brute(K, slips, mu, lambda y: y[5] + chi**2 * taken, **how)
    return None if restored is None else (first[0] + restored[0])[[3, 4, 6]]


@pytest.mark.parametrize("kind", list(RestitutionKind))
def test_an_impact_that_slips_throughout_is_that_of_a_brute_integration(kind):
    """It gives back the part of the speed, or of the work."""
    rng, compared, turned = np.random.default_rng(1), 0, 0.0
    while compared < 40:
        K, v = draw_contact(rng)
        chi, mu = rng.uniform(0.1, 0.9), rng.uniform(0.02, 0.2)
        S = brute_impulse(K, v, chi, mu, kind)
        if S is None:
            continue
        ours = np.array(coulomb(K, v, chi, mu, kind))
        assert ours == pytest.approx(S, abs=1e-9 * float(np.linalg.norm(S)))
        slip = after(K, v, ours)[:2]
        turned = max(turned, abs(np.arctan2(np.cross([*v[:2], 0], [*slip, 0])[2], slip @ v[:2])))
        compared += 1
    assert turned > 0.5


@pytest.mark.parametrize("kind", list(RestitutionKind))
def test_friction_stays_in_its_cone_and_the_floor_never_pulls(kind):
    rng = np.random.default_rng(3)
    for _ in range(COUNT):
        K, v = draw_contact(rng)
        chi, mu = rng.uniform(0, 1), 10 ** rng.uniform(-2, 1)
        S = np.array(coulomb(K, v, chi, mu, kind))
        assert S[2] > 0
        assert np.hypot(*S[:2]) <= mu * S[2] * (1 + 1e-12)
        assert after(K, v, S)[2] >= -1e-12
        if kind == KINEMATIC:
            assert after(K, v, S)[2] == pytest.approx(-chi * v[2], abs=1e-12 * float(np.linalg.norm(v)))


STOP = 0.1 / (900 + 0.3 * 1500)
"""The impulse that stops a slip of 0.1 m/s with μ = 0.3."""
DEEPEST = -1 + (1000 - 900 * 1.2) / (1.2 * 1500 - 900)
"""The normal velocity where slip of 1 m/s stops in Painlevé's attitude: it has fallen on."""
TAKEN = (1 - DEEPEST) / 2 / (1.2 * 1500 - 900) + DEEPEST**2 / (2 * 460)
"""The work that compression takes there: sliding, then sticking at the rate K_zz - K_xz²/K_xx = 460."""
IN_A_PLANE = {
    # dv_x/dp = K_xz - μ K_xx and dv_z/dp = K_zz - μ K_xz while it slips along x, up to v_z' = 0.5 |v_z|.
    "without friction": (-300, (1.0, -0.5), 0.0, KINEMATIC, (1 - 300 * 0.75 / 1000, 0.25)),
    "slips throughout": (-300, (1.0, -0.5), 0.1, KINEMATIC, (1 - 450 * 0.75 / 1030, 0.25)),
    # Friction -K_xz/K_xx = 0.6 holds the point.
    "stops and sticks": (-900, (0.1, -1.0), 0.7, KINEMATIC, (0.0, 0.5)),
    "stops and reverses": (
        -900,
        (0.1, -1.0),
        0.3,
        KINEMATIC,
        (-450 * (0.5 + 1 - STOP * 1270) / 730, 0.5),
    ),
    "never slips": (-900, (0.0, -1.0), 0.7, KINEMATIC, (0.0, 0.5)),
    "begins to slip": (-900, (0.0, -1.0), 0.3, KINEMATIC, (-450 * 1.5 / 730, 0.5)),
    "begins to slip, energetic": (-900, (0.0, -1.0), 0.3, ENERGETIC, (-450 * 1.5 / 730, 0.5)),
    "Painleve's attitude": (900, (1.0, -1.0), 1.2, KINEMATIC, (0.0, 0.5)),
    "Painleve's attitude, energetic": (900, (1.0, -1.0), 1.2, ENERGETIC, (0.0, 0.5 * (920 * TAKEN) ** 0.5)),
}


@pytest.mark.parametrize(("K_xz", "v", "mu", "kind", "expected"), IN_A_PLANE.values(), ids=IN_A_PLANE)
def test_in_a_plane_of_symmetry_an_impact_is_its_closed_form(K_xz, v, mu, kind, expected):
    K = ((1500.0, 0.0, float(K_xz)), (0.0, 1400.0, 0.0), (float(K_xz), 0.0, 1000.0))
    start = (v[0], 0.0, v[1])
    found = after(K, start, coulomb(K, start, 0.5, mu, kind))
    # Slip below 1e-11 of the speed counts as stopped.
    assert found == pytest.approx((expected[0], 0.0, expected[1]), rel=1e-10, abs=1e-11)


def test_slip_that_starts_keeps_its_direction():
    rng = np.random.default_rng(7)
    started = 0
    for _ in range(COUNT):
        K, _ = draw_contact(rng)
        mu = rng.uniform(0.01, 1.0)
        f = np.array(friction_without_slip(K, mu))
        gained = np.array(K) @ [*f, 1.0]
        if np.hypot(*f) < mu * (1 - 1e-9):
            assert np.abs(gained[:2]).max() < 1e-11 * np.abs(K).max()
            continue
        started += 1
        assert np.hypot(*f) == pytest.approx(mu, rel=1e-12)
        # Friction opposes the slip that it allows to start.
        assert gained[:2] / np.hypot(*gained[:2]) == pytest.approx(-f / mu, abs=1e-8)
    assert started > 20


def draw_critical(rng, nearest=-6.0, farthest=-2.5):
    """A contact with a friction near that at which it just sticks: slip then keeps its speed as it goes.

    The friction's part beyond that one is 10 to a power between `nearest` and `farthest`.
    """
    K, v = draw_contact(rng)
    sticks = np.linalg.solve(np.array(K)[:2, :2], np.array(K)[:2, 2])
    beyond = rng.choice([-1, 1]) * 10 ** rng.uniform(nearest, farthest)
    return K, v, float(np.hypot(*sticks)) * (1 + beyond)


@pytest.mark.parametrize("kind", list(RestitutionKind))
@pytest.mark.parametrize("seed", range(10))
def test_slip_that_hardly_grows_or_dies_goes_straight(kind, seed):
    """Against an implicit integration, which takes its turning in long steps."""
    rng = np.random.default_rng([seed, 6])
    K, v, mu = draw_critical(rng)
    chi = rng.uniform(0.1, 0.9)
    end = brute_impulse(K, v, chi, mu, kind, stopped=0, method="Radau", rtol=1e-8, atol=1e-11)
    S = coulomb(K, v, chi, mu, kind)
    assert S == pytest.approx(end, abs=1e-6 * float(np.linalg.norm(S)))


@pytest.mark.parametrize("kind", list(RestitutionKind))
def test_slow_slip_by_critical_friction_differs_from_none_by_no_more_than_itself(kind):
    """Step by step until its direction was known, one such impact took seconds: this test would not end."""
    rng = np.random.default_rng(10)
    for _ in range(COUNT):
        K, v, mu = draw_critical(rng, -11.0, -2.5)
        chi, angle = rng.uniform(0.1, 0.9), rng.uniform(0, 2 * np.pi)
        slip = 10 ** rng.uniform(-11, -4) * abs(v[2])
        slow = slip * np.cos(angle), slip * np.sin(angle), v[2]
        S, expected = (np.array(coulomb(K, start, chi, mu, kind)) for start in (slow, (0.0, 0.0, v[2])))
        # No mass that K stands for is larger.
        mass = 1 / np.linalg.eigvalsh(np.array(K))[0]
        assert np.linalg.norm(S - expected) <= 3 * slip * mass


@pytest.mark.parametrize("aside", [1e-3, 1e-6, 1e-9])
def test_slip_that_passes_near_zero_is_followed_round_it(aside):
    """|v_t| has a kink there in the limit: a series from before would go on as if slip turned negative."""
    K, mu = ((900.0, 0.0, 600.0), (0.0, 700.0, 0.0), (600.0, 0.0, 1000.0)), 0.2
    # Slip along -x is pushed back by K_xz, through zero and on along +x.
    v = (-1.0, aside, -2.0)
    S = np.array(coulomb(K, v, 0.5, mu, KINEMATIC))
    solved = brute(K, v, mu, lambda y: y[2] - 1.0, stopped=0, method="Radau", rtol=1e-10, atol=1e-14)
    assert solved is not None
    end, slowest = solved
    assert slowest < 1.1 * aside
    assert end[0] > 0.1
    assert end[[3, 4, 6]] == pytest.approx(S, rel=1e-6, abs=1e-6 * end[6])
    assert after(K, v, S)[2] == pytest.approx(1.0, rel=1e-12)


def test_an_impact_ends_though_its_slip_would_later_turn_the_point_back():
    """v_Az rises by 0.03 and falls again before slip stops; here 0.02 is enough."""
    K = ((1.48, 1.394, 1.124), (1.394, 2.423, 2.527), (1.124, 2.527, 2.799))
    v, mu = (-0.69, 0.72, -0.01), 2.08
    S = np.array(coulomb(K, v, 1.0, mu, KINEMATIC))
    assert S == pytest.approx(brute_impulse(K, v, 1.0, mu, KINEMATIC), abs=1e-9 * float(np.linalg.norm(S)))


@pytest.mark.parametrize("angle", [0.0, 0.4, 1.2, 2.5, -0.9])
def test_slow_slip_is_turned_into_the_direction_that_it_keeps_in_every_frame(angle):
    """Along x it keeps its direction, K_ty being 0, and dies away at the rate μ K_xx - K_xz: slowly.

    Seen from axes turned about z, K_xy is not 0.
    """
    c, s = np.cos(angle), np.sin(angle)
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    mu, K_xx, K_xz, K_zz, slip, v_z = 0.4, 1500.0, 599.9, 1000.0, 1e-6, -1.0
    K = turned @ np.array([[K_xx, 0, K_xz], [0, 400.0, 0], [K_xz, 0, K_zz]]) @ turned.T
    y = np.zeros(SIZE)
    y[:3] = turned @ [slip, 1e-7 * slip, v_z]
    A = RoughPoint(matrix(K), mu, NO_SLIP, False)
    f, gained, p, stops = straight_slip(A, y, Goal(V_Z, 0.5))
    assert stops
    assert p == pytest.approx(slip / (mu * K_xx - K_xz), rel=1e-9)
    assert f == pytest.approx(-mu * turned[:2, 0], abs=1e-12)
    assert gained == pytest.approx(turned @ [K_xz - mu * K_xx, 0, K_zz - mu * K_xz], rel=1e-9, abs=1e-9)
