"""The resets of a toss: what they bring to the floor lies there."""

import numpy as np
import pytest

from cointoss.analytic.contact.lying import lay_flat
from cointoss.analytic.contact.resets import tilt_onto_rim
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.geometry import FLAT_SINE
from tests.helpers.draws import IMPERFECT, THIN, ZLOTY, scenario


@pytest.mark.parametrize("tilt", [5e-8, np.pi - 5e-8], ids=["heads", "tails"])
def test_of_a_coin_that_is_laid_flat_the_whole_face_is_on_the_floor(tilt):
    """Its mass centre is off the middle between the faces."""
    body = scenario(coin=IMPERFECT).body
    assert body.center[2] != 0
    y = np.array([0.1, -0.2, 0.5, 0, 0, 0, *quaternion_from_angles((0.3, tilt, 1.1)), 1.0, 2.0, 3.0])
    heads_up = np.cos(tilt) > 0
    lay_flat(body, y)
    R = np.array(rotation_matrix(tuple(y[6:10])))
    assert R[2] == pytest.approx([0, 0, 1 if heads_up else -1], abs=1e-16)
    r, lower_face = body.radius, (-0.5 if heads_up else 0.5) * body.thickness
    for angle in np.linspace(0, 2 * np.pi, 7):
        rim = np.array([r * np.cos(angle), r * np.sin(angle), lower_face])
        assert y[2] + R[2] @ (rim - body.center) == pytest.approx(0, abs=1e-17)


@pytest.mark.parametrize(
    ("coin", "lean", "rate", "expected"),
    [
        (ZLOTY, 0.0, 2.0, FLAT_SINE / 8),
        (ZLOTY, 0.0, -2.0, -FLAT_SINE / 8),
        (ZLOTY, 1e-3, -2.0, 1e-3),
        (THIN, 0.0, 2.0, 0.0),
    ],
)
def test_a_coin_that_passes_its_edge_as_it_lands_is_tilted_to_the_side_to_which_it_turns(
    coin, lean, rate, expected
):
    """So n_z is where its rate leads: not of a thin coin, nor of one that leans."""
    y = np.array([0, 0, 0.0125, 0, 0, 0, *quaternion_from_angles((0.0, np.pi / 2 - lean, 0.0)), -rate, 0, 0])
    tilt_onto_rim(scenario(coin=coin).body, y)
    assert rotation_matrix(tuple(y[6:10]))[2][2] == pytest.approx(expected, rel=1e-6, abs=3e-16)
