"""The tilting of a coin that is spun on its edge: what a spin about its normal does, in closed form."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode, flow
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from tests.helpers.contacts import SMOOTH, held, put_on_floor
from tests.helpers.draws import scenario

G, R, M, H, OFFSET = 9.81, 9.525e-3, 2.5e-3, 4e-4, 1e-4
BODY = scenario(coin={"mass": M, "radius": R, "thickness": H, "center_of_mass": (0, 0, OFFSET)}).body
J, J_ZETA = BODY.inertia[0][0], BODY.inertia[2][2]
ROUGH = FloorFriction(1e4)
COINS = pytest.mark.parametrize(
    ("side", "turn"), [(side, rate * np.sqrt(2 * G / R)) for side in (-1, 1) for rate in (0.9, 1.1, 3.0)]
)
"""The rim on the floor, tails' or heads', and the angular velocity about the vertical [rad/s]."""


def tilting(mode, friction, side, lean, turn, about_normal=0.0):
    """Return the second derivative of the lean to a rim, at rest so far, where C is at rest [rad/s²]."""
    y = np.array([0, 0, R, 0, 0, 0, *quaternion_from_angles((0.3, np.pi / 2 + side * lean, 0.8)), 0, 0, 0])
    up, dy = np.array(rotation_matrix(tuple(y[6:10]))[2]), np.empty(13)
    y[10:] = turn * up + [0, 0, side * about_normal]
    if lean:
        put_on_floor(BODY, friction, mode, y)
    flow(held(BODY, friction, mode, y)._replace(rim=side), y, dy)
    return -side * (np.cross(np.cross(up, y[10:]), y[10:]) + np.cross(up, dy[10:]))[2] / np.hypot(*up[:2])


@COINS
def test_a_rim_that_rolls_on_the_spot_is_driven_out_by_turning_faster_than_root_of_2_g_over_r(side, turn):
    """(J_ξ + m (r² + a²)) d²φ/dt² = a (J_ζ Ω²/r - m g), where C is at rest and ω_ζ = -Ω a/r."""
    a = H / 2 - side * OFFSET
    found = tilting(Mode.STICKING, ROUGH, side, 0.0, turn, -turn * a / R)
    assert found == pytest.approx(a * (J_ZETA * turn**2 / R - M * G) / (J + M * (R * R + a * a)), rel=1e-9)
    assert (found > 0) == (turn**2 > 2 * G / R)


@COINS
@pytest.mark.parametrize(
    ("mode", "friction", "inertia"), [(Mode.SLIDING, SMOOTH, J), (Mode.STICKING, ROUGH, J + M * R * R)]
)
def test_a_coin_that_turns_about_the_vertical_is_driven_out_by_its_lean(side, turn, mode, friction, inertia):
    """On a smooth floor, and as much where the rim sticks at once: what C needs to go round cancels its spin.

    For small φ and a the moment is ((J_ζ - J_ξ) Ω² + m g r) φ - m g a.
    """
    moment = ((J_ZETA - J) * turn**2 + M * G * R) * 0.03 - M * G * (H / 2 - side * OFFSET)
    assert tilting(mode, friction, side, 0.03, turn) == pytest.approx(moment / inertia, rel=0.02)
