"""The gap, the lowest point and the clear time, against brute search over the rim and over time."""

import numpy as np
import pytest

from cointoss.models.attitude import rotation_matrix
from cointoss.models.clearance import clear_time, drag_bound
from cointoss.models.ending import idle_energy
from cointoss.models.geometry import contact_velocity, gap, lowest_point
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_quaternion, scenario
from tests.helpers.tuples import matrix, quaternion

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


@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flat_coin_touches_under_its_mass_center(up):
    point, flat = lowest_point(IMPERFECT, (0.0, 0.0, up), (0.0, 0.0, 5.0))
    assert flat
    assert point == (*IMPERFECT.center[:2], -up * IMPERFECT.thickness / 2)


@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_flat_coin_that_turns_touches_with_the_point_that_moves_down_fastest(up):
    w = (3.0, -4.0, 7.0)
    point, flat = lowest_point(IMPERFECT, (0.0, 0.0, up), w)
    assert not flat
    R = np.diag([1.0, up, up])
    fall = np.array([(R @ np.cross(w, edge))[2] for edge in rim(IMPERFECT) if edge[2] == -up * 1e-3])
    ours = contact_velocity(IMPERFECT, matrix(R), (0.0, 0.0, 0.0), w, point)[2]
    center = (R @ np.cross(w, -np.array(IMPERFECT.center)))[2]
    assert ours - center == pytest.approx(fall.min(), rel=1e-7)
    assert fall.min() == pytest.approx(-5 * IMPERFECT.radius, rel=1e-7)


@pytest.mark.parametrize("w", [(1.0, 0.0, 5.0), (-1.0, 0.0, 5.0)])
def test_a_coin_on_its_edge_that_turns_touches_with_the_rim_that_moves_down(w):
    up = (0.0, 1.0, 0.0)
    point, flat = lowest_point(IMPERFECT, up, w)
    assert not flat
    assert abs(point[2]) == IMPERFECT.thickness / 2
    other = (point[0], point[1], -point[2])
    R = ((1.0, 0.0, 0.0), (0.0, 0.0, -1.0), up)
    falls = [contact_velocity(IMPERFECT, R, (0.0, 0.0, 0.0), w, edge)[2] for edge in (point, other)]
    assert falls[0] == pytest.approx(falls[1] - IMPERFECT.thickness, rel=1e-12)


def test_a_flat_coin_that_spins_fast_is_clear_for_much_of_its_fall():
    """However fast it spins: a flat face is a double root of F, so half of its fall is known to be clear."""
    body = scenario(air=AIR).body
    gap_left, fall = 1e-9, 1.0
    clear = clear_time(body, 1e-3 + gap_left, (0.0, 0.0, -fall), (0.0, 0.0, 1.0), (0.0, 0.0, 300.0), 1e-8)
    assert 0.45 * gap_left / fall < clear < gap_left / fall


def test_linear_air_is_the_same_whether_its_exponent_is_none_or_0():
    """The engines differ in that: see `AirLaw`."""
    case = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}, air=AIR)
    with_zero = case.body._replace(air=case.body.air._replace(exponent=0.0))
    v, w = (0.3, -0.2, 1.0), (5.0, 30.0, -8.0)
    assert drag_bound(with_zero, v, w, 0.1) == drag_bound(case.body, v, w, 0.1)
    assert idle_energy(with_zero, case.rules, v, w) == idle_energy(case.body, case.rules, v, w) > 0
