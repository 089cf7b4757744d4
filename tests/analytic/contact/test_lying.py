"""A coin that lies flat: the friction of its face by quadrature, and its rates of change."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode, contact_at, flow, project
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.lying import face_friction
from cointoss.analytic.entries import force_and_moment
from cointoss.analytic.numerics.rotation import quaternion_rate
from cointoss.analytic.toss import state_at_release
from cointoss.models.attitude import rotation_matrix
from tests.helpers.draws import AIR, scenario
from tests.helpers.tuples import vector


def by_quadrature(speed, rim_speed):
    """Return the friction and the moment of a face as sums over its points, r = 1.

    Their products with both speeds add up to the mean slip.
    """
    n = 600
    rho, angle = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(2 * n) + 0.5) * np.pi / n)
    x, y, share = rho * np.cos(angle), rho * np.sin(angle), rho / n / n
    slip = np.stack([speed - rim_speed * y, rim_speed * x]) / np.hypot(speed - rim_speed * y, rim_speed * x)
    return (slip[0] * share).sum(), ((x * slip[1] - y * slip[0]) * share).sum()


@pytest.mark.parametrize("ratio", [1e-4, 0.02, 0.4, 0.95, 1.05, 3.0, 25.0, 80.0])
def test_the_friction_of_a_face_is_the_sum_over_its_points(ratio):
    for rim_speed in (1.0, 0.03):
        found = face_friction(ratio * rim_speed, rim_speed)
        assert found == pytest.approx(by_quadrature(ratio, 1.0), abs=5e-6)


@pytest.mark.parametrize("border", [1e-3, 1.0, 30.0])
def test_it_is_continuous_where_its_formulas_meet(border):
    below, above = (np.array(face_friction(border * (1 + d), 1.0)) for d in (-1e-13, 1e-13))
    assert above == pytest.approx(below, rel=2e-10)


def test_a_face_that_does_not_slip_has_no_friction():
    assert face_friction(0.0, 0.0) == (0.0, 0.0)
    assert face_friction(0.3, 0.0) == (1.0, 0.0)


@pytest.mark.parametrize("tails_up", [False, True])
@pytest.mark.parametrize("air", [{}, AIR])
def test_friction_takes_the_energy_that_the_slip_of_the_face_loses(tails_up, air):
    """The power of the floor is -N (μ times the mean slip + p |Ω|); its rates are an off-centre coin's."""
    case = scenario(
        coin={"center_of_mass": [1e-3, -2e-3, 3e-4]},
        air=air,
        floor={"contact": "coulomb", "friction": 0.3, "pivoting_friction": 2e-3},
        release={
            "velocity": [0.4, -0.2, 0.1],
            "angles": [0.7, np.pi * tails_up, 0],
            "angular_velocity": [1e-3, 0, 30.0],
        },
    )
    body, y, dy = case.body, state_at_release(case.release), np.empty(13)
    contact = contact_at(body, friction_in_contact(case.rules), Mode.LYING.value, y)
    project(contact, y)
    assert y[2] == pytest.approx(1e-3 + (-3e-4 if tails_up else 3e-4), abs=1e-18)
    assert y[5] == y[10] == y[11] == 0
    assert flow(contact, y, dy) > 0
    assert dy[5] == dy[10] == dy[11] == 0
    assert np.array_equal(dy[:3], y[3:6])
    assert dy[6:10] == pytest.approx(quaternion_rate(tuple(y[6:10]), tuple(y[10:13])), rel=1e-15)
    frictionless = contact_at(body, friction_in_contact(scenario().rules), Mode.LYING.value, y)
    free, R = np.empty(13), np.array(rotation_matrix(tuple(y[6:10])))
    flow(frictionless, y, free)
    f, m = force_and_moment(body, vector(R.T @ y[3:6]), vector(y[10:13]))
    assert body.mass * free[3:5] == pytest.approx((R @ f)[:2], rel=1e-12, abs=1e-20)
    assert body.inertia[2][2] * free[12] == pytest.approx(m[2], rel=1e-12, abs=1e-20)
    power = body.mass * y[3:5] @ (dy[3:5] - free[3:5]) + body.inertia[2][2] * y[12] * (dy[12] - free[12])
    slip = y[3:6] - np.cross(R @ y[10:13], R @ body.center)
    speeds = np.hypot(*slip[:2]), body.radius * abs(y[12])
    loss = 0.3 * np.dot(by_quadrature(*speeds), speeds) + 2e-3 * abs(y[12])
    assert power == pytest.approx(-body.mass * body.gravity * loss, rel=1e-5)
