"""Where sticking starts and where it ends: at the border of the friction cone, and a little beyond it."""

import pytest

from cointoss.analytic.contact.floor_force import friction_holds
from cointoss.analytic.contact.sticking import margin
from cointoss.analytic.numerics.tolerances import BORDER
from tests.helpers.draws import scenario

MU, WEIGHT = 0.3, 2e-3 * 9.81


@pytest.mark.parametrize("past", [-0.5, 0.5, 2.0])
def test_what_has_begun_to_stick_is_held_a_little_beyond_the_cone(past):
    """So that a coin on the border does not start and stop for ever.

    Args:
        past: the border, in parts of `BORDER`.
    """
    share = MU * (1 + past * BORDER)
    F = (0.6 * share * WEIGHT, -0.8 * share * WEIGHT, WEIGHT)
    assert friction_holds(MU, F) == (past < 0)
    assert margin(scenario().body, (0.0, 0.0, 1.0), F, MU) == pytest.approx(
        MU * BORDER * (1 - past), rel=1e-6
    )
