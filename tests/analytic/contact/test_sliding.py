"""When sliding presses the coin into the floor, however large the force (Painlevé)."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import SustainedContact
from cointoss.analytic.contact.floor_force import sliding_force
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import RimContact
from cointoss.analytic.contact.sliding import jams
from tests.helpers.draws import scenario
from tests.helpers.tuples import matrix, vector

AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
K = ((9.0, 1.0, 3.0), (1.0, 9.0, 4.0), (3.0, 4.0, 2.0))
"""K_zz / (K_zt · s) is 2/5 for slip in the direction (0.6, 0.8)."""
FALL = (0.0, 0.0, -9.81)


@pytest.mark.parametrize("turn", [0.0, 2.1])
@pytest.mark.parametrize(
    ("slip", "mu", "is_jammed"), [(2.0, 0.39, False), (2.0, 0.41, True), (-2.0, 0.41, False)]
)
def test_sliding_jams_where_friction_gives_the_point_more_than_the_normal_force_takes(
    slip, mu, is_jammed, turn
):
    """K_zz - μ K_zt · s <= 0; the force that would hold the point then pulls. Turned about z alike."""
    c, s = np.cos(turn), np.sin(turn)
    Q = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    rows, v_A = matrix(Q @ K @ Q.T), vector(Q @ [0.6 * slip, 0.8 * slip, 0.0])
    A = RimContact(AXES, (0.0, 0.0, -0.01), AXES, rows, FALL, v_A)
    assert jams(SustainedContact(scenario().body, FloorFriction(mu), Mode.SLIDING.value, 1.0), A) == is_jammed
    pressing = sliding_force(rows, FALL, mu, (v_A[0] / abs(slip), v_A[1] / abs(slip)))[2]
    assert (pressing < 0) == is_jammed
