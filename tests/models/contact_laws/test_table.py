"""What compiled code asks of a contact law is what its record says."""

from importlib import import_module

import numpy as np
import pytest

from cointoss.models.contact_laws import table
from cointoss.models.contact_laws.law import Impact
from cointoss.models.contact_laws.table import LAWS, impulse_by, laws_that
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.laws import ContactLaw, RestitutionKind
from tests.helpers.impacts import draw_contact

ASKED = {
    table.uses_friction: lambda law: law.uses_friction,
    table.jumps_without_slip: lambda law: law.jumps_without_slip,
    table.is_smooth: lambda law: law.is_smooth,
    table.spares_spin: lambda law: law.spares_spin,
    table.is_rough: lambda law: law.is_rough,
    table.is_followed: lambda law: law.is_followed,
    table.never_adds: lambda law: law.never_adds_energy,
    table.hardly_adds_energy: lambda law: law.hardly_adds_energy,
    table.may_be_energetic: lambda law: law.may_be_energetic,
}


@pytest.mark.parametrize("law", ContactLaw)
def test_each_law_has_the_record_of_the_module_of_its_name(law):
    assert LAWS[law] is import_module(f"cointoss.models.contact_laws.{law}").LAW


@pytest.mark.parametrize("asked", ASKED)
def test_a_law_is_asked_by_its_number_as_its_record_says(asked):
    has = ASKED[asked]
    assert 0 < len(laws_that(has)) < len(LAWS)
    compiled = by_numba(asked)
    for law, record in LAWS.items():
        assert asked(law) == compiled(law.value) == has(record)


@pytest.mark.parametrize("law", ContactLaw)
def test_the_impulse_by_a_number_is_that_of_the_record(law):
    K, v = draw_contact(np.random.default_rng(3))
    A = Impact(K, v, (0.6, 0.8, 0.0), 0.5, 0.3, RestitutionKind.KINEMATIC)
    S, is_possible = LAWS[law].impulse(A)
    assert is_possible
    assert impulse_by(law, A) == (S, True)
    assert S not in [record.impulse(A)[0] for other, record in LAWS.items() if other != law]
