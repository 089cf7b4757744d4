"""The damping of a touch, set by its speed of approach."""

from dataclasses import replace

import pytest

from cointoss.coin_mj import FINE, Realisation
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import rebound_of
from cointoss.coin_mj.steps.rebound import coin_touching, rebound_with
from tests.helpers.draws import scenario


@pytest.mark.parametrize("contact", Realisation)
@pytest.mark.parametrize("slip_damping", [None, 7.0])
def test_a_rebound_with_another_restitution_is_that_of_the_same_settings(contact, slip_damping):
    settings = replace(FINE, contact=contact, slip_damping=slip_damping)
    of_floor, expected = (rebound_of(chi, settings) for chi in (0.8, 0.3))
    found = rebound_with(of_floor, contact == Realisation.ONE_STEP, 0.3)
    assert found == pytest.approx(expected, rel=1e-9)


def test_a_coin_touches_with_the_restitution_at_its_speed():
    case = scenario(floor={"restitution": 0.5, "restitution_exponent": 0.25})
    coin = machine_of(case, FINE).coin
    found = coin_touching(coin, case.rules, 16.0)
    assert found.rebound.damping == pytest.approx(rebound_of(0.25, FINE).damping, rel=1e-9)
    assert found._replace(rebound=coin.rebound) == coin
    constant = case.replace("floor.restitution_exponent", 0.0).rules
    assert coin_touching(coin, constant, 16.0) is coin
