"""The restitution by the speed of approach, against closed forms and against Hertz's damped contact."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss.models.body import Rules
from cointoss.models.restitution import (
    chatter_restitution,
    elastic_speed,
    restitution_at_speed,
    viscous_restitution,
)
from tests.helpers.draws import scenario


def rules_with(**floor: Any) -> Rules:
    return scenario(floor={"restitution": 0.5} | floor).rules


POWER, VISCOUS = {"restitution_exponent": 0.25}, {"restitution": 1.0, "restitution_viscous": 0.3}


SLOWEST = 2.0 * 0.5**4
"""Up to this speed the power law of exponent 1/4, 0.5 at 2 m/s, has the restitution 1 [m/s]."""
LAW = {**POWER, "restitution_speed": 2.0}
BOTH = {**POWER, "restitution_threshold": 0.2, "restitution_viscous": 0.1}


@pytest.mark.parametrize(
    ("floor", "speed", "expected"),
    [
        *(({"restitution_speed": 3.0}, speed, 0.5) for speed in (-1.0, 0.0, 1e-9, 1.0, 20.0)),
        ({**POWER, "restitution": 0.0}, 0.0, 0.0),
        (LAW, 2.0, 0.5),
        (LAW, 4.0, 0.5 * 2**-0.25),
        (LAW, 1.001 * SLOWEST, 1.001**-0.25),
        *((LAW, speed, 1.0) for speed in (SLOWEST * (1 - 1e-12), SLOWEST / 9, 0.0, -1.0)),
        ({**LAW, "restitution_exponent": 1.0}, 4.0, 0.25),
        ({**LAW, "restitution_exponent": 0.1}, 4.0, 0.5 * 2**-0.1),
        # Both factors act above the threshold.
        (BOTH, 0.2, 0.0),
        (BOTH, 0.3, 0.5 * 0.3**-0.25 * viscous_restitution(0.1, 0.3)),
    ],
)
def test_the_restitution_at_a_speed_is_that_of_the_law(floor, speed, expected):
    """min(1, χ (v/v₀)^-p) V(v), and 0 up to the threshold."""
    assert restitution_at_speed(rules_with(**floor), speed) == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("p", [0.1, 0.25, 1.0])
def test_the_power_law_has_the_restitution_1_up_to_its_elastic_speed(p):
    rules = rules_with(restitution_exponent=p, restitution_speed=2.0)
    assert elastic_speed(rules) == pytest.approx(2.0 * 0.5 ** (1 / p), rel=1e-14)
    assert chatter_restitution(rules, 3.0) == 1.0


def of_hertz(A: float) -> float:
    """Return the restitution of x" = -(x^(3/2) + A √x x'), x' = 1 at the touch, until the force is zero."""

    def rate(_: float, y: np.ndarray) -> list[float]:
        deep = max(y[0], 0.0)
        return [y[1], -(deep**1.5 + A * deep**0.5 * y[1])]

    def pushes(t: float, y: np.ndarray) -> float:
        return y[0] + A * y[1] if t > 0.05 else 1.0

    pushes.terminal = True  # pyright: ignore[reportFunctionMemberAccess]
    path = solve_ivp(rate, (0, 20), [1e-14, 1], events=pushes, rtol=1e-10, atol=1e-12, method="DOP853")
    return -path.y[1, -1]


@pytest.mark.parametrize(
    ("A", "near"),
    [(1e-3, 1e-6), (0.01, 1e-6), (0.1, 1e-4), (0.3, 1e-3), (1.0, 0.013), (3.0, 0.065)],
)
def test_the_viscous_law_is_that_of_a_damped_contact_of_hertz(A, near):
    """Its loss a is 1.15345 A at stiffness 1: 0.1 % off down to e = 0.7, 1.2 % at 0.4, 6 % at 0.13."""
    assert viscous_restitution(1.15345 * A, 1.0) == pytest.approx(of_hertz(A), rel=near)


def test_the_viscous_law_has_the_series_of_its_source():
    """1 - x + (3/5) x² + O(x³), x = a v^(1/5)."""
    for x in (1e-3, 1e-2):
        for speed in (1e-3, 1.0, 5.0):
            found = viscous_restitution(x / speed**0.2, speed)
            assert abs(found - (1 - x + 0.6 * x * x)) < 0.5 * x**2.5
