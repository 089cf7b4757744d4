"""The gap, the lowest point and the clear time, against brute search over the rim and over time."""

import numpy as np
import pytest

from cointoss.models.attitude import rotation_matrix
from cointoss.models.clearance import clear_time, drag_bound
from cointoss.models.ending import idle_energy
from cointoss.models.geometry import gap, lowest_point
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_quaternion, scenario
from tests.helpers.tuples import quaternion

pytestmark = pytest.mark.usefixtures("without_horizon")

IMPERFECT = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}).body
ANGLES = np.linspace(0, 2 * np.pi, 20_001)


def rim(body):
    ring = body.radius * np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
    sides = [np.column_stack([ring, np.full(len(ring), side * body.thickness / 2)]) for side in (1, -1)]
    return np.concatenate(sides)


@pytest.mark.parametrize("seed", range(20))
def test_gap_and_lowest_point_are_those_of_the_whole_rim(seed):
    R = np.array(rotation_matrix(quaternion(draw_quaternion(np.random.default_rng(seed)))))
    z = 0.1
    heights = z + (rim(IMPERFECT) - IMPERFECT.center) @ R[2]
    point, flat = lowest_point(IMPERFECT, tuple(R[2]), (1.0, 2.0, 3.0))
    assert not flat
    # 20 001 points of the rim stand at most r (pi/20000)^2/2 = 1.5e-10 m above its lowest point.
    assert 0 <= heights.min() - gap(IMPERFECT, z, tuple(R[2])) < 2e-10
    assert z + (np.array(point) - IMPERFECT.center) @ R[2] == pytest.approx(
        gap(IMPERFECT, z, tuple(R[2])), abs=1e-16
    )


FLAT, UPSIDE_DOWN, ON_EDGE = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 1.0, 0.0)
R, HALF = IMPERFECT.radius, IMPERFECT.thickness / 2


@pytest.mark.parametrize(
    ("up", "w", "expected", "is_flat"),
    [
        # What does not turn touches under its mass centre.
        (FLAT, (0.0, 0.0, 5.0), (*IMPERFECT.center[:2], -HALF), True),
        (UPSIDE_DOWN, (0.0, 0.0, 5.0), (*IMPERFECT.center[:2], HALF), True),
        # Upwards a point p of the rim moves at up · (ω × p), about ξ and η ±(ω_ξ p_η - ω_η p_ξ).
        (FLAT, (3.0, -4.0, 7.0), (-0.8 * R, -0.6 * R, -HALF), False),
        (UPSIDE_DOWN, (3.0, -4.0, 7.0), (0.8 * R, 0.6 * R, HALF), False),
        # On its edge ω_ζ p_ξ - ω_ξ p_ζ.
        (ON_EDGE, (1.0, 0.0, 5.0), (0.0, -R, HALF), False),
        (ON_EDGE, (-1.0, 0.0, 5.0), (0.0, -R, -HALF), False),
    ],
)
def test_of_what_is_level_the_point_that_moves_down_fastest_touches(up, w, expected, is_flat):
    point, flat = lowest_point(IMPERFECT, up, w)
    assert point == pytest.approx(expected, rel=1e-15)
    assert flat == is_flat


@pytest.mark.parametrize(("thickness", "window", "least"), [(2e-3, 1e-8, 0.45), (0.15, 1.0, 0.0)])
def test_a_flat_coin_that_spins_fast_is_clear_for_much_of_its_fall(thickness, window, least):
    """However fast it spins: a flat face is a double root of F, so half of its fall is known to be clear.

    Not much is known of a pencil over a second, but no more than is true.
    """
    body = scenario(coin={**ZLOTY, "thickness": thickness}, air=AIR).body
    gap_left, fall, z = 1e-9, 1.0, thickness / 2 + 1e-9
    clear = clear_time(body, z, (0.0, 0.0, -fall), (0.0, 0.0, 1.0), (0.0, 0.0, 300.0), window)
    assert least * gap_left / fall < clear < gap_left / fall


def test_linear_air_is_the_same_whether_its_exponent_is_none_or_0():
    """The engines differ in that: see `AirLaw`."""
    case = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}, air=AIR)
    with_zero = case.body._replace(air=case.body.air._replace(exponent=0.0))
    v, w = (0.3, -0.2, 1.0), (5.0, 30.0, -8.0)
    assert drag_bound(with_zero, v, w, 0.1) == drag_bound(case.body, v, w, 0.1)
    assert idle_energy(with_zero, case.rules, v, w) == idle_energy(case.body, case.rules, v, w) > 0
