"""Impacts on their own: each is the impact of a toss, with its own restitution and friction."""

import numpy as np
import pytest

from cointoss.analytic.contact.resets import hit
from cointoss.analytic.striking import strike_each
from cointoss.models.laws import ContactLaw
from cointoss.models.records import IMPACT_ROW
from cointoss_reproduction.studies.contact_laws import single_impacts
from cointoss_reproduction.studies.contact_laws.single_impacts import strike
from tests.helpers.draws import scenario
from tests.helpers.impacts import draw_impact


@pytest.mark.parametrize("law", [ContactLaw.SMOOTH, ContactLaw.SLIDING_FRICTION, ContactLaw.COULOMB])
def test_each_impact_is_that_of_a_toss(law, monkeypatch):
    # Both as written: Coulomb's law takes logarithms, musl's in the library and here the system's.
    monkeypatch.setattr(single_impacts, "strike_each", strike_each)
    case, first = draw_impact(np.random.default_rng(int(law)), law)
    states = np.array([first, first, first])
    chi, mu = np.array([0.2, 0.9, 0.9]), np.array([0.3, 0.3, 0.1])
    impacts, solved = strike(case.body, case.rules, states, restitution=chi, friction=mu)
    assert solved.all()
    assert np.array_equal(states[1], first)
    for i in range(3):
        rules = case.rules._replace(restitution=chi[i], friction=mu[i])
        row = np.zeros(1, IMPACT_ROW)
        hit(case.body, rules, chi[i], first.copy(), row[0])
        assert np.array_equal(impacts.impulse[i], row["impulse"][0])
        assert impacts.energy_change[i] == row["energy_change"][0]


def test_an_impact_without_a_solution_is_marked_and_changes_nothing():
    case = scenario(coin={"thickness": 0.0}, floor={"contact": "sliding_friction"})
    # Tilted by atan sqrt(5), the first attitude to lose its solution, at mu = sqrt(5)/2.
    half = np.arctan(5**0.5) / 2
    states = np.array(
        [[0, 0, 0, 0, slip, -1, np.cos(half), np.sin(half), 0, 0, 0, 0, 0] for slip in (-1.0, 1.0)]
    )
    for mu, count in ((5**0.5 / 2 - 1e-6, 2), (5**0.5 / 2 + 1e-6, 1)):
        impacts, solved = strike(case.body, case.rules, states, restitution=0.5, friction=mu)
        assert solved.sum() == count
        assert np.all(impacts.energy_change[~solved] == 0)
        assert np.all(impacts.impulse[~solved] == 0)
