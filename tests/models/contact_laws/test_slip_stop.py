"""The series of slip that stops: a closed form, its own equations, and an integration to the stop."""

import math

import numpy as np
import pytest

from cointoss.models.contact_laws.slip_stop import (
    BEFORE,
    Q,
    expand_stop,
    impulse_until,
    kept_direction,
    room_for_stop,
)
from tests.helpers.impacts import draw_contact


def draw_stopping(rng):
    """A contact whose slip dies away, with its μ, v_t, `SlipStop` and series."""
    while True:
        (K, v), mu = draw_contact(rng), rng.uniform(0.1, 1.5)
        series = room_for_stop()
        stop = expand_stop(K, mu, v[:2], True, series)
        if stop.end > 0:
            return K, mu, np.array(v[:2]), stop, series


def slope_from(s, slip):
    """tan(u/2), u the angle of the slip from the direction s."""
    u = math.atan2(s[0] * slip[1] - s[1] * slip[0], s[0] * slip[0] + s[1] * slip[1])
    return math.tan(u / 2)


@pytest.mark.parametrize("m", [-0.3, 1e-9, 0.2])
@pytest.mark.parametrize("a", [1.001, 1.5, 4.0])
def test_where_all_directions_are_as_mobile_the_impulse_is_a_closed_form(a, m):
    """K_tt = K_0, K_tz = k along x, a = μ K_0/k > 1: q goes as m^(a - 1) (1 + m²), dp/dm as -q/(k m)."""
    k, mu, q = 300.0, 0.4, 0.7
    K_0 = a * k / mu
    K = ((K_0, 0.0, k), (0.0, K_0, 0.0), (k, 0.0, 2000.0))
    slip = (q * (1 - m**2) / (1 + m**2), q * 2 * m / (1 + m**2))
    series = room_for_stop()
    stop = expand_stop(K, mu, slip, True, series)
    assert stop.end > 0
    assert stop.direction == pytest.approx((1.0, 0.0), abs=1e-15)
    assert stop.exponent == pytest.approx(a - 1, rel=1e-11)
    S, path = impulse_until(stop, series, 0.0)
    p = q / (k * (1 + m**2)) * (1 / (a - 1) + m**2 / (a + 1))
    X = q**2 / (k * (1 + m**2) ** 2) * (1 / (2 * a - 2) + m**2 / a + m**4 / (2 * a + 2))
    stopping = (-(slip[0] + k * p) / K_0, -slip[1] / K_0, p)
    # 1/(a - 1) magnifies rounding.
    assert S == pytest.approx(stopping, rel=3e-15 / (a - 1) + 3e-15, abs=1e-15 * p)
    assert path == pytest.approx(X, rel=3e-15 / (a - 1) + 3e-15)


def test_on_its_way_to_the_stop_slip_has_the_speed_and_direction_of_the_series():
    """What S gives to v_t is what q and the slope say, at the stop nothing."""
    rng = np.random.default_rng(1)
    turned = 0.0
    for _ in range(100):
        K, _, slip, stop, series = draw_stopping(rng)
        speed, s = np.hypot(*slip), stop.direction
        m = slope_from(s, slip)
        turned = max(turned, abs(m))
        for x in (1.0, 0.9, 0.5, 0.1):
            S, _ = impulse_until(stop, series, x)
            now = slip + (np.array(K) @ S)[:2]
            # q and the numbers that it is the difference of.
            scale = speed + np.abs(np.array(K)[:2]) @ np.abs(S)
            q = x**stop.exponent * np.polyval(series[BEFORE : stop.end, Q][::-1], x)
            assert np.hypot(*now) == pytest.approx(q, abs=1e-14 * scale.max())
            assert slope_from(s, now) * q == pytest.approx(m * x * q, abs=1e-14 * scale.max())
        S, _ = impulse_until(stop, series, 0.0)
        assert slip + (np.array(K) @ S)[:2] == pytest.approx([0, 0], abs=1e-14 * scale.max())
    assert turned > 0.2


def test_a_direction_that_is_kept_has_no_turning_and_draws_slip_to_it():
    rng = np.random.default_rng(3)
    found = 0
    for _ in range(200):
        (K, v), mu = draw_contact(rng), rng.uniform(0.1, 1.5)
        s, is_kept = kept_direction(K, mu, tuple(np.array(v[:2]) / math.hypot(*v[:2])))
        if not is_kept:
            continue
        found += 1

        def turning(angle, s=s, K=K, mu=mu):
            c, sine = math.cos(angle), math.sin(angle)
            along = np.array([c * s[0] - sine * s[1], c * s[1] + sine * s[0]])
            gained = np.array(K) @ [*(-mu * along), 1]
            return along[0] * gained[1] - along[1] * gained[0]

        assert abs(turning(0.0)) < 1e-13 * np.abs(K).max()
        assert turning(-1e-3) > 0 > turning(1e-3)
    assert found > 30


def test_slip_that_grows_or_has_another_kept_direction_near_is_left_alone():
    """Along x slip grows; with μ large against K_tz all directions but two are nearly kept."""
    series = room_for_stop()
    grows = ((1000.0, 0.0, 600.0), (0.0, 1000.0, 0.0), (600.0, 0.0, 1000.0))
    assert expand_stop(grows, 0.3, (1.0, 0.1), False, series).end == 0
    wide = ((2000.0, 0.0, 1e-3), (0.0, 2000.0, 0.0), (1e-3, 0.0, 1000.0))
    assert expand_stop(wide, 0.5, (0.2, 1.0), False, series).end == 0


def test_a_slow_decay_is_followed_in_one_series():
    """Where friction hardly exceeds what drives the slip, S_z is q/(μ K_0 - k), ever larger."""
    for excess in (1e-3, 1e-6, 1e-9):
        K_0, k, mu = 1000.0, 300.0, 0.3 * (1 + excess)
        K = ((K_0, 0.0, k), (0.0, K_0, 0.0), (k, 0.0, 1000.0))
        series = room_for_stop()
        stop = expand_stop(K, mu, (1.0, 0.0), False, series)
        assert stop.end > 0
        S, _ = impulse_until(stop, series, 0.0)
        assert S[2] == pytest.approx(1 / (mu * K_0 - k), rel=1e-12)
