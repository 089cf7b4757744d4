"""Whether a floor's resistance holds a coin on its edge: states just within and just beyond each bound."""

import numpy as np
import pytest

from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.body import whole_gravity
from cointoss.models.rest import is_held, is_slowing, lever_of, slow_spin
from cointoss.models.state import state
from tests.helpers.draws import ZLOTY, scenario

R, H = ZLOTY["radius"], ZLOTY["thickness"]
ROUGH = {"contact": "coulomb", "friction": 0.3}
BALANCED = float(np.arctan2(H / 2, R))
"""The lean from upright at which C is over the rim's lowest point."""
SLOW = 1e-3 * (9.81 / R) ** 0.5
"""Spins from which on a coin counts as turning [rad/s]."""


@pytest.mark.parametrize(
    ("slope", "lean", "v", "w"),
    [
        (0.0, 0.2, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (0.0, BALANCED, (0.0, 0.0, 1e-5), (0.0, 0.0, 0.0)),
        (0.0, BALANCED, (1e-5, 1e-5, 0.0), (0.0, 0.0, 0.0)),
        (0.0, 0.2, (0.0, 0.0, 0.0), (1e-3, 2e-3, 3e-3)),
        (0.1, BALANCED, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
        (0.1, BALANCED + 1e-3, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    ],
    ids=["level", "rises", "slides", "turns", "slope", "slope, off balance"],
)
def test_a_coin_is_held_from_the_least_rolling_friction_on_that_bears_its_weight_and_its_motion(
    slope, lean, v, w
):
    """δ bears the lever, also that of a slope, and motion of up to m g (δ - lever)²/(4 l), l the longest way.

    A slope may turn the coin on its point once about: its lever then gives 2 m g_x a.
    """
    body, tan = scenario(floor={**ROUGH, "slope": slope}).body, np.tan(slope)
    e = quaternion_from_angles((0.0, np.pi / 2 - lean, 0.0))
    height, lever = R * np.cos(lean) + H / 2 * np.sin(lean), abs(R * np.sin(lean) - H / 2 * np.cos(lean))
    leaning = state((0.0, 0.0, height), v, e, w)
    longest = 2 * (np.hypot(lever, height) + R) * (1 + tan)
    motion = (np.dot(v, v) + np.dot(w, np.array(body.inertia) @ w) / body.mass) / 2
    moved = 2 * body.downhill * lever + motion
    least = lever + tan * height + np.sqrt(4 * longest * moved / body.gravity)
    arm = (0.0, lever, -height)
    assert whole_gravity(body) == pytest.approx(9.81, rel=1e-15)
    assert is_held(body, least * (1 + 1e-9), 0.9, leaning, arm, False)
    assert not is_held(body, least * (1 - 1e-9), 0.9, leaning, arm, False)


@pytest.mark.parametrize(
    ("sliding", "v", "w", "slope", "holds"),
    [
        (0.3, (0.99 * SLOW * R, 0.0, 0.0), 0.0, 0.0, True),
        (0.3, (0.0, 1.01 * SLOW * R, 0.0), 0.0, 0.0, False),
        (0.0, (0.0, 1.0, 0.0), 0.0, 0.0, True),
        (0.3, (0.0, 0.0, 0.0), 0.99 * SLOW, 0.0, True),
        (0.3, (0.0, 0.0, 0.0), 1.01 * SLOW, 0.0, False),
        (1.001 * np.tan(0.1), (0.0, 0.0, 0.0), 0.0, 0.1, True),
        (0.999 * np.tan(0.1), (0.0, 0.0, 0.0), 0.0, 0.1, False),
    ],
)
def test_what_moves_faster_or_slides_down_is_not_held(sliding, v, w, slope, holds):
    """On a smooth floor it may slide on; on a slope friction must bear it, tan(slope) <= μ."""
    body = scenario(floor={**ROUGH, "slope": slope}).body
    upright = state((0.0, 0.0, R), v, quaternion_from_angles((0.0, np.pi / 2, 0.0)), (0.0, 0.0, w))
    assert is_held(body, 5e-3, sliding, upright, (0.0, 0.0, -R), True) == holds


@pytest.mark.parametrize(("part", "holds"), [(0.99, True), (1.01, False)])
def test_a_coin_on_a_line_is_held_only_where_its_weight_meets_the_floor_between_the_rims(part, holds):
    """Its normal points downhill: it topples from tan(slope) = (h/2)/r on, whatever resists rolling."""
    body = scenario(floor={**ROUGH, "slope": float(np.arctan(part * H / 2 / R))}).body
    e = quaternion_from_angles((np.pi / 2, np.pi / 2, 0.0))
    upright = state((0.0, 0.0, R), (0.0, 0.0, 0.0), e, (0.0, 0.0, 0.0))
    arm = (upright.R[0][2] * H / 2, 0.0, -R)
    assert is_held(body, 1e-3, 0.9, upright, arm, True) == holds


def test_the_lever_of_a_coin_that_stands_on_a_line_is_its_distance_from_it():
    standing = rotation_matrix(quaternion_from_angles((0.0, np.pi / 2, 0.0)))
    assert lever_of(standing, (3e-3, 4e-3, -1e-2), True) == pytest.approx(3e-3)
    assert lever_of(standing, (3e-3, 4e-3, -1e-2), False) == pytest.approx(5e-3)


@pytest.mark.parametrize(
    ("rolling", "pivoting", "roll", "slows"),
    [(0.0, 1e-4, 9.0, False), (1e-4, 1e-4, 0.0, True), (1e-4, 0.0, 1.01, True), (1e-4, 0.0, 0.99, False)],
)
def test_a_coin_that_stands_comes_to_rest_where_something_resists_what_it_does(
    rolling, pivoting, roll, slows
):
    body = scenario().body
    w = (0.6 * roll * SLOW, 0.8 * roll * SLOW, 5.0)
    assert slow_spin(body) == pytest.approx(SLOW, rel=1e-15)
    assert is_slowing(body, rolling, pivoting, w) == slows
