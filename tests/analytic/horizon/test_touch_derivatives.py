"""Derivatives of a touch and its impact: closed forms, identities that every law keeps, and their order."""

from typing import Any

import numpy as np
import pytest

from cointoss.analytic.flight.state_vector import attitude_of
from cointoss.analytic.horizon.touch_derivatives import touch_derivatives, touch_differences
from cointoss.models.attitude import rotation_matrix
from cointoss.models.laws import ContactLaw, RestitutionKind
from cointoss.models.scenario import Scenario
from tests.helpers.draws import PAPER_OFFSET, ZLOTY, draw_quaternion, scenario
from tests.helpers.impacts import struck

LAWS = [
    *({"contact": str(law), "friction": 0.2} for law in ContactLaw),
    *(
        {"contact": "coulomb", "friction": friction, "restitution_kind": str(kind)}
        for friction in (0.05, 0.3, 3.0)
        for kind in RestitutionKind
    ),
]


def on_floor(floor: dict[str, Any], **coin: Any) -> Scenario:
    return scenario(coin={**ZLOTY, **coin}, floor={"restitution": 0.7, **floor})


def draw_touch(rng: np.random.Generator) -> np.ndarray:
    """Draw a state in which the lowest point moves down: faster than the spin can lift it."""
    velocity = [*rng.uniform(-1, 1, 2), -rng.uniform(1, 2)]
    return np.array([0, 0, 0.01, *velocity, *draw_quaternion(rng), *rng.uniform(-30, 30, 3)])


def tilted(angle: float, spin: float, velocity: list[float]) -> np.ndarray:
    """Give a coin tilted about x by an angle, spinning about x."""
    return np.array([0, 0, 0.01, *velocity, np.cos(angle / 2), np.sin(angle / 2), 0, 0, spin, 0, 0])


@pytest.mark.parametrize("tilt", [1e-6, 1e-3, 0.3, 1.2, np.pi / 2 - 1e-5])
def test_a_planar_smooth_impact_has_the_derivatives_of_its_closed_form(tilt):
    """S_z = -(1 + χ) v_Az/(1/m + x²/J), v_Az = v_z + w x, with x = h/2 sin θ - r cos θ from C to A."""
    case = on_floor({})
    body, w, v_z = case.body, 7.0, -1.5
    touch = touch_derivatives(body, case.rules, tilted(tilt, w, [0.3, 0.2, v_z]))
    x = body.thickness / 2 * np.sin(tilt) - body.radius * np.cos(tilt)
    x_change = body.thickness / 2 * np.cos(tilt) + body.radius * np.sin(tilt)
    J = body.inertia[0][0]
    K, v_A = 1 / body.mass + x * x / J, v_z + w * x
    by_angle = -1.7 * (w * x_change / K - v_A * 2 * x * x_change / J / K**2)
    turn = np.array([*[0] * 6, -np.sin(tilt / 2) / 2, np.cos(tilt / 2) / 2, 0, 0, 0, 0, 0])
    size = 1.7 * body.mass
    assert touch.impulse[2, 5] == pytest.approx(-1.7 / K, abs=1e-7 * size)
    assert touch.impulse[2, 10] == pytest.approx(-1.7 * x / K, abs=1e-7 * size)
    assert touch.impulse[2] @ turn == pytest.approx(by_angle, abs=1e-7 * size)
    assert touch.gap @ turn == pytest.approx(x, abs=1e-7 * body.radius)
    spin_by_angle = (by_angle * x - 1.7 * v_A / K * x_change) / J
    assert touch.after[10] @ turn == pytest.approx(spin_by_angle, abs=1e-6 * size / J * body.radius)


@pytest.mark.parametrize("slip", [1e-7, 1e-4, 0.1])
def test_developed_friction_turns_with_slow_slip(slip):
    """S_xy = -μ S_z u: a velocity across the slip turns its direction u by 1/|slip|."""
    case = on_floor({"contact": "sliding_friction", "friction": 0.3})
    y = tilted(0.4, 0.0, [slip, 0.0, -1.0])
    touch, S = touch_derivatives(case.body, case.rules, y), struck(case, y)[0]["impulse"]
    assert touch.impulse[1, 4] == pytest.approx(-0.3 * S[2] / slip, rel=1e-3)


@pytest.mark.parametrize("floor", LAWS)
def test_differences_are_of_the_second_order_and_the_step_chosen_is_short_enough(floor):
    case = on_floor(floor, center_of_mass=PAPER_OFFSET)
    y = draw_touch(np.random.default_rng(5))
    body, rules = case.body, case.rules
    rows = rotation_matrix(attitude_of(y))
    assert min(abs(rows[2][2]), np.hypot(*rows[2][:2])) > 0.1

    def differences(part: float) -> np.ndarray:
        return touch_differences(body, rules, rules.restitution, y, part)

    touch = touch_derivatives(body, rules, y)
    chosen = np.vstack([touch.gap, touch.up, touch.contact_velocity, touch.impulse, touch.after])
    errors = [np.linalg.norm(differences(part) - chosen) for part in (4e-3, 2e-3, 1e-3)]
    assert np.log2(np.divide(errors[:-1], errors[1:])) == pytest.approx([2, 2], abs=0.1)


@pytest.mark.parametrize("floor", LAWS[::3])
def test_the_velocity_after_an_impact_changes_as_its_impulse_over_the_mass(floor):
    """The velocity of C by S/m; the Euler parameters e as they did, of which norm 1 is kept: by 1 - e eᵀ."""
    case = on_floor(floor, center_of_mass=PAPER_OFFSET)
    y = draw_touch(np.random.default_rng(8))
    touch, e = touch_derivatives(case.body, case.rules, y), y[6:10]
    assert touch.after[3:6] - np.eye(13)[3:6] == pytest.approx(touch.impulse / case.body.mass, rel=1e-12)
    assert np.abs(touch.impulse[:, 3:6]).max() > 0.1 * case.body.mass
    assert touch.after[6:10, 6:10] == pytest.approx(np.eye(4) - np.outer(e, e), abs=1e-12)
