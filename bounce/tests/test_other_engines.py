"""Settings in the words of other engines: the contacts they describe are those that were measured."""

import ast
import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from cointoss_bounce import engine_bounce, solref
from cointoss_bounce.drops import drops_of
from cointoss_bounce.spring import rebound_of


def tuples(text):
    """Return each list of numbers in brackets that a text has."""
    return [ast.literal_eval(found) for found in re.findall(r"\([-\d.e, ]+,[-\d.e, ]+\)", text)]


@pytest.mark.parametrize(("e", "steps"), [(0.3, 20), (0.8, 40), (0.999, 40)])
def test_time_constant_and_damping_ratio_of_genesis_are_the_spring_that_was_measured(e, steps):
    found = solref(e, 2e-3, backend="genesis", steps=steps)
    ((constant, ratio, *solimp),) = tuples(found.settings)
    assert " ".join(f"{number:g}" for number in solimp) == found.solimp
    assert constant > 2 * 2e-3  # Genesis takes no shorter one
    given = replace(found.contact, solref=(constant, ratio))
    assert drops_of(given).restitutions == pytest.approx(drops_of(found.contact).restitutions, rel=1e-6)
    assert np.abs(drops_of(given).restitutions - e).max() == pytest.approx(found.error, rel=1e-6)
    assert "integrator.implicitfast" in found.settings
    assert found.contact.integrator == "implicitfast"


@pytest.mark.parametrize("spring", [False, True])
def test_newton_is_given_solref_and_solimp_as_they_are(spring):
    found = solref(0.8, 2e-3, backend="newton", spring=spring)
    assert tuples(found.settings) == [found.solref, tuple(map(float, found.solimp.split()))]
    assert '"mujoco:solref_mode": 1' in found.settings
    assert f'integrator="{"rk4" if spring else "implicitfast"}"' in found.settings


@pytest.mark.parametrize("backend", ["gazebo", "isaaclab", "pybullet"])
def test_the_threshold_is_what_gravity_adds_in_two_steps(backend):
    assert f"{2 * 1.62 * 2e-3:.6g}" in engine_bounce(0.8, 2e-3, backend=backend, gravity=1.62).settings


@pytest.mark.parametrize("e", [0.05, 0.5, 0.8, 0.999])
def test_a_ball_on_the_contact_of_drake_rebounds_as_asked_and_lies_as_deep_as_told(e):
    """It is stepped by SciPy: f = k x (1 + d v), without weight, and half of what both bodies have."""
    found = engine_bounce(e, 2e-3, backend="drake", mass=0.5)
    k, d, m = found.stiffness / 2, found.dissipation, 0.5

    def rates(_, state):
        return state[1], -k * max(state[0] * (1 + d * state[1]), 0.0) / m

    for speed in (2.0, 0.5):
        left = solve_ivp(rates, (0, 0.1), (0, speed), max_step=1e-4, rtol=1e-9, atol=1e-14).y[1, -1]
        assert -left / speed == pytest.approx(rebound_of(d * speed), rel=1e-5)
    assert f"{1e3 * m * 9.81 / k:.3g} mm deep" in found.notes["rest"]
    assert (rebound_of(2 * d), np.pi * np.sqrt(m / k)) == pytest.approx((e, 4 * 2e-3), rel=1e-9)
