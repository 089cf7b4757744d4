"""The tangent map from event to event, of a coin that falls flat."""

import numpy as np
import pytest

from cointoss.analytic.runs import event_tangent, run
from cointoss.analytic.toss import state_at_release
from tests.helpers.draws import THIN, scenario

Z, V_Z, TIME = 2, 5, 13


def test_what_falls_from_higher_comes_later_and_faster_and_what_is_thrown_up_comes_later():
    """From rest at the height z: t = √(2 z/g) + v_0/g, and v² = 2 g z; all touch at one height."""
    z, chi, g = 0.4, 0.7, 9.81
    case = scenario(
        coin=THIN, floor={"restitution": chi}, release={"position": [0, 0, z]}, ending={"max_impacts": 1}
    )
    toss = run(case.body, case.rules, state_at_release(case.release))
    map_of = event_tangent(case.body, case.rules, toss, 0)
    v = (2 * g * z) ** 0.5
    assert map_of[[Z, V_Z, TIME], Z] == pytest.approx([0, chi * g / v, 1 / v], abs=1e-9)
    assert map_of[[Z, V_Z, TIME], V_Z] == pytest.approx([0, 0, 1 / g], abs=1e-9)
    assert map_of[TIME, TIME] == 1
    assert np.all(map_of[:TIME, TIME] == 0)
