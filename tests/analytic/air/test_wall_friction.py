"""The rules around the wall: between the points where its friction is not smooth, and for few of them."""

import numpy as np
import pytest

from cointoss.analytic.air import wall_friction
from cointoss.analytic.air.law import AirMotion
from cointoss.analytic.air.quadrature import FORCE_NODES
from tests.helpers.draws import ZLOTY, scenario
from tests.helpers.tuples import vector


@pytest.mark.parametrize("apart", [0.049, 0.051])
def test_a_break_is_hidden_by_one_nearer_to_the_real_axis_within_half_its_distance_from_there(apart):
    """Also across the angle 2 π."""
    breaks, away = np.array([0.01, 3.0, 2 * np.pi + 0.01 - apart]), np.array([1e-3, 0.0, 0.1])
    kept = wall_friction._without_hidden(breaks, away, 3)
    assert (kept, *breaks[:2], *away[:2]) == (2 if apart < 0.05 else 3, 0.01, 3.0, 1e-3, 0.0)


def test_a_coin_that_rolls_needs_rules_at_two_breaks_of_six(monkeypatch):
    """The lowest point rests, and near it complex ones; so does the end of the axis through it, nearly."""
    strips, strip = [], wall_friction._strip
    monkeypatch.setattr(wall_friction, "_strip", lambda *given: strips.append(given) or strip(*given))
    body, w = scenario(coin=ZLOTY, air={"tangential": 0.2, "exponent": 0.5}).body, (20.0, 11.0, 1.0)
    v = vector(-np.cross(w, [-ZLOTY["radius"], 0.0, -ZLOTY["thickness"] / 2]))
    wall_friction.wall_friction_change(body, AirMotion(0.5, v, w, v, w), FORCE_NODES)
    assert 0 < len(strips) <= 4 * len(FORCE_NODES.around_x)
