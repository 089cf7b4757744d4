"""Restitution of the damped spring: against its own differential equation, and back."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp

from cointoss.coin_mj.model.settings import (
    FINE,
    HARDEST,
    LARGE,
    LEAST_LOSS,
    LEAST_SPRING,
    LOSS,
    MANY,
    MujocoSettings,
    Realisation,
    rebound_of,
    resolved,
)
from cointoss.coin_mj.steps.impact import time_to_release
from cointoss.models.spring import damping_ratio_of, restitution_of
from cointoss_bounce import contact, spring


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3, 0.99, 1.0, 1.01, 2.0, 5.0])
def test_the_spring_lets_go_when_its_force_vanishes(zeta):
    """u'' = -u - 2 zeta u' from u = 0, u' = -1, until the force is zero: the speed is the restitution."""

    def force(_, y):
        return -y[0] - 2 * zeta * y[1]

    vanishes: Any = force
    vanishes.terminal, vanishes.direction = True, -1
    path = solve_ivp(
        lambda t, y: [y[1], force(t, y)],
        (0, 50),
        [0, -1],
        events=vanishes,
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
    )
    assert path.status == 1
    assert time_to_release(1.0, 2 * zeta, 0.0, -1.0) == pytest.approx(path.t[-1], rel=1e-9)
    middle = path.t.size // 2
    x, speed = path.y[:, middle]
    assert time_to_release(1.0, 2 * zeta, x, speed) == pytest.approx(path.t[-1] - path.t[middle], rel=1e-8)
    assert restitution_of(zeta) == pytest.approx(path.y[1, -1], rel=1e-9)


def test_both_branches_meet_at_critical_damping():
    assert restitution_of(1.0) == math.exp(-2)
    assert restitution_of(1 - 1e-9) == pytest.approx(math.exp(-2), rel=1e-8)
    assert restitution_of(1 + 1e-9) == pytest.approx(math.exp(-2), rel=1e-8)


@given(st.floats(0.01, 1.0))
def test_damping_ratio_inverts_the_restitution(restitution):
    assert restitution_of(damping_ratio_of(restitution)) == pytest.approx(restitution, rel=1e-12)


@pytest.mark.parametrize("restitution", [0.0, -0.1, 1.1, float("nan")])
def test_a_restitution_out_of_reach_is_refused(restitution):
    with pytest.raises(ValueError, match="accepted: 0 < restitution <= 1"):
        rebound_of(restitution, MANY)


def test_the_spring_has_the_stiffness_asked_for():
    spring = rebound_of(0.5, MujocoSettings(stiffness=1e10, steps=20))
    assert spring.stiffness == 1e10
    assert spring.damping / (2 * np.sqrt(1e10)) == pytest.approx(damping_ratio_of(0.5), rel=1e-15)
    assert spring.duration == pytest.approx(np.pi * 1e-5, rel=1e-15)
    assert spring.step == pytest.approx(spring.duration / 20, rel=1e-15)


@pytest.mark.parametrize("restitution", [0.0, 0.3, 1.0])
def test_one_step_turns_a_speed_into_the_rebound(restitution):
    one = rebound_of(restitution, MujocoSettings(contact=Realisation.ONE_STEP, step=1e-6))
    assert (one.stiffness, one.step, one.duration) == (0, 1e-6, 1e-6)
    assert 1 - one.damping * one.step == pytest.approx(-restitution, abs=1e-15)


def test_softer_contacts_last_longer():
    for realisation, longer in ((Realisation.SPRING, 10**0.5), (Realisation.ONE_STEP, 10)):
        settings = MujocoSettings(contact=realisation)
        hard, soft = rebound_of(0.5, settings), rebound_of(0.5, settings.softened(10))
        assert soft.duration / hard.duration == pytest.approx(longer, rel=1e-12)


def test_a_stretched_spring_that_returns_slowly_never_lets_go():
    assert time_to_release(1.0, 4.0, 0.1, -0.1) == math.inf


@pytest.mark.parametrize(("damping", "x", "speed"), [(0.0, 0.1, 1.0), (2.0, -0.5, 2.0), (4.0, -1.0, 0.5)])
def test_a_spring_that_would_pull_has_let_go(damping, x, speed):
    assert time_to_release(1.0, damping, x, speed) == 0


@pytest.mark.parametrize("restitution", [0.97, 0.99, 0.995, 1.0])
def test_the_less_energy_an_impact_takes_the_less_its_steps_may_change(restitution):
    """A share of what χ = 0.96 takes. Three steps change a hundredth of that, n steps (3/n)⁵ of it."""
    share = max(1 - restitution**2, LEAST_LOSS) / LOSS
    steps = resolved(MANY, restitution, 20.0).steps
    assert (3 / steps) ** 5 <= share**2 < (3 / (steps - 1)) ** 5


@pytest.mark.parametrize(
    ("asked", "restitution", "rate", "stiffness"),
    [
        (MANY, 0.5, LARGE / 2, MANY.stiffness),
        (MANY, 0.5, 3 * LARGE, 9 * MANY.stiffness),
        (MANY, 0.98, LARGE, MANY.stiffness * (LOSS / (1 - 0.98**2)) ** 2),
        (MANY, 1.0, LARGE, HARDEST),
        (MANY, 1.0, 2 * LARGE, 4 * HARDEST),
        (FINE.softened(1e-3), 1.0, LARGE, 1e3 * FINE.stiffness),
    ],
)
def test_a_small_coin_and_a_small_loss_ask_for_a_stiffer_spring(asked, restitution, rate, stiffness):
    """As g/r, and as 1/loss² up to the hardest; a spring asked for that is harder stays."""
    assert resolved(asked, restitution, rate).stiffness == pytest.approx(stiffness, rel=1e-12)


def test_a_restitution_below_that_of_any_spring_is_one_step_as_long_as_the_springs():
    one = resolved(MANY, LEAST_SPRING / 2, 2 * LARGE)
    step = rebound_of(LEAST_SPRING, resolved(MANY, LEAST_SPRING, 2 * LARGE)).step
    assert (one.contact, one.step) == (Realisation.ONE_STEP, pytest.approx(step, rel=1e-12))


@pytest.mark.parametrize("zeta", [0.0, 0.05, 0.3, 0.99, 1.0, 1.01, 5.0])
def test_who_installs_cointoss_bounce_alone_has_the_same_contacts(zeta):
    e, settings = restitution_of(zeta), MujocoSettings(stiffness=(np.pi / (40 * 1e-3)) ** 2)
    lasts = time_to_release(1.0, 2 * zeta, 0.0, -1.0)
    assert (spring.restitution_of(zeta), spring.contact_duration(zeta)) == pytest.approx((e, lasts), rel=1e-9)
    own = rebound_of(e, settings)
    assert contact.spring_solref(e, 1e-3, 40) == pytest.approx((-own.stiffness, -own.damping), rel=1e-13)
    one = rebound_of(e, MujocoSettings(contact=Realisation.ONE_STEP, step=1e-3))
    assert contact.one_step_solref(e, 1e-3) == (-one.stiffness, -one.damping)
