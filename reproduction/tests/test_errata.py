"""Slips of the paper outside its equations of motion and impact, each shown by the motion itself."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.flight.equations_of_motion import derivative
from cointoss.models.barriers import barrier
from cointoss.models.geometry import gap
from cointoss_reproduction.setups.kellers_map import caught, thrown
from cointoss_reproduction.studies.free_flight_lyapunov.study import growth_of_tangent, tangent
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, scenario

G = 9.81


def normal_at_the_catch(turns, v_0):
    """Toss an ideal coin from flat and return its normal's height when it is back at the height of release.

    `turns` is Keller's ω_0 v_0/(π g), which for ϑ_0 = 0 is also the number of full turns.
    """
    case = scenario(coin={**ZLOTY, "center_of_mass": [0.0, 0.0, 0.0]})
    up = np.array([v_0 / G])
    return caught(case, thrown(case, turns / up, up))[0]


@pytest.mark.parametrize("v_0", [0.8, 2.4])
def test_kellers_hyperbolas_lie_at_odd_quarters(v_0):
    for k in range(9):
        boundary = (2 * k + 1) / 4
        before, after = (normal_at_the_catch(boundary + off, v_0) for off in (-1e-3, 1e-3))
        assert before * after < 0, "the face changes"
        assert abs(normal_at_the_catch(boundary, v_0)) < 1e-10, "the coin is upright"


def test_kellers_printed_intervals_name_the_wrong_face():
    turns = np.linspace(0.01, 3.99, 60)
    same_side = np.array([normal_at_the_catch(n, 2.4) > 0 for n in turns])
    printed = np.floor(turns) % 2 == 0
    # From -1/4 to 1/4 about a whole number of turns.
    corrected = np.floor(2 * turns + 0.5) % 2 == 0
    assert np.array_equal(same_side, corrected)
    assert 0.4 < np.mean(same_side == printed) < 0.6, "no better than chance"
    assert normal_at_the_catch(1, 2.4) == pytest.approx(1, abs=1e-10), "flat as it started"


def heights_of_the_normal(gamma, lean):
    """Give the normal's heights over a second of flight of the ideal coin without air.

    The normal makes the angle `gamma` with the angular momentum L, and at release leans by `lean` from the
    vertical; L lies between the two, or beyond the vertical where `lean` is less than `gamma`.
    """
    J = scenario().coin.inertia_about_C
    across = 40.0
    along = J[0, 0] * across / (np.tan(gamma) * J[2, 2])
    case = scenario(
        release={
            "position": [0, 0, 50.0],
            "angles": [0.0, lean, 0.0],
            "angular_velocity": [0.0, across, along],
        },
        ending={"max_time": 1.0},
    )
    return analytic.toss(case).sample(np.linspace(0, 1, 2000)).normal[:, 2]


@pytest.mark.parametrize(
    ("gamma", "lean", "changes"), [(35, 0, False), (44, 0, False), (46, 0, True), (35, 95, True)]
)
def test_a_coin_keeps_its_face_below_45_degrees_where_it_is_released_flat(gamma, lean, changes):
    """The normal goes round L from where it is to twice the angle."""
    heights = heights_of_the_normal(np.radians(gamma), np.radians(lean))
    ends = sorted(np.cos(np.radians([lean, lean - 2 * gamma])))
    assert [heights.min(), heights.max()] == pytest.approx(ends, abs=1e-4)
    assert (heights.min() < 0 < heights.max()) == changes


@pytest.mark.parametrize(
    ("thickness", "center"),
    [(0.0, [0.0] * 3), (2e-3, [0.0] * 3), (1.25e-2, [0.0] * 3), (2e-3, PAPER_OFFSET)],
)
def test_energy_below_m_g_r_is_enough_for_balanced_coins(thickness, center):
    body = scenario(coin={**ZLOTY, "thickness": thickness, "center_of_mass": center}).body
    r, off = body.radius, np.hypot(*center[:2])
    # A coin changes its face where its normal is level; C is then no lower than in a coin on its edge.
    on_edge = [-gap(body, 0.0, (np.cos(a), np.sin(a), 0.0)) for a in np.linspace(-np.pi, np.pi, 65)]
    assert min(on_edge) == pytest.approx(r - off, rel=1e-12)
    lowest = [barrier(body, up) / (body.mass * G * r) for up in (1.0, -1.0)]
    assert lowest == pytest.approx(
        np.hypot(r - off, thickness / 2 + np.array([1, -1]) * center[2]) / r, rel=1e-15
    )
    assert max(lowest) < 0.95 if off else min(lowest) >= 1 - 1e-15


def rates(case, quaternion, w):
    """Give the acceleration of C and the angular acceleration at one velocity."""
    out = np.empty(13)
    derivative(case.body, np.array([0, 0, 1, 0.5, -0.2, -2.0, *quaternion, *w]), out)
    return out[3:6], out[10:13]


def test_forces_that_depend_on_the_attitude_alone_couple_eqs_21_and_22():
    case = scenario(air=AIR)
    flat, leaning = [1.0, 0, 0, 0], [np.cos(0.4), np.sin(0.4), 0, 0]
    slow, fast = [1.0, 2.0, 3.0], [30.0, 20.0, 10.0]
    # The ideal coin in linear air: no force from ω, no moment from the motion of C ...
    assert np.array_equal(rates(case, flat, slow)[0], rates(case, flat, fast)[0])
    assert np.array_equal(rates(case, flat, slow)[1], rates(case, leaning, slow)[1])
    # ... and yet the path needs the attitude.
    assert np.abs(rates(case, flat, slow)[0] - rates(case, leaning, slow)[0]).max() > 0.1


@pytest.mark.slow
def test_about_its_middle_axis_the_imperfect_coin_has_a_lyapunov_exponent_above_zero():
    found = tangent()
    assert found["middle"] == pytest.approx(found["rate"], rel=1e-9)
    assert found["rate"] > 6


@pytest.mark.parametrize("duration", [0.5, 5.0])
def test_in_air_a_lyapunov_exponent_stays_below_zero(duration):
    case = scenario(air=AIR, release={"position": [0, 0, 500.0], "angular_velocity": [0.0, 0.0, 40.0]})
    exponent = growth_of_tangent(case, np.array([0, 0, 1.0]), duration)
    assert exponent == pytest.approx(-case.body.drag.moment_normal / case.body.inertia[2][2], rel=1e-9)
    assert exponent < -0.1
