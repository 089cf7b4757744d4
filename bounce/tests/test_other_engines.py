"""Settings in the words of other engines: the contacts they describe are those that were measured."""

import ast
import re
from dataclasses import replace

import numpy as np
import pytest

from cointoss_bounce import physx_bounce, solref
from cointoss_bounce.drops import drops_of


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


def test_the_threshold_of_physx_is_what_gravity_adds_in_two_steps():
    assert physx_bounce(0.8, 2e-3, gravity=1.62).threshold == pytest.approx(2 * 1.62 * 2e-3)
    assert "bounce_threshold_velocity=0.03924)" in physx_bounce(0.8, 2e-3).settings
