"""The gap, the lowest point and the clear time, against brute search over the rim and over time."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.models.attitude import rotation_matrix
from cointoss.models.clearance import acceleration_bounds, clear_time, damping_rate, drag_bound, grazing_time
from cointoss.models.ending import idle_energy
from cointoss.models.geometry import contact_velocity, gap, lowest_point
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_coin, draw_quaternion, draw_release, scenario
from tests.helpers.states import gaps
from tests.helpers.tuples import matrix, quaternion, vector

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


@pytest.mark.parametrize("exponent", [None, 0.0, 0.5, 1.0])
def test_no_coin_touches_within_its_clear_time(exponent):
    touched = 0
    for seed in range(25):
        rng = np.random.default_rng(seed)
        release = draw_release(rng, spin=400)
        release["velocity"] = rng.uniform(-3, 3, 3).tolist()
        air = {} if exponent is None else {"air": {**AIR, "exponent": exponent}}
        ending = {"max_impacts": 1, "max_time": 0.03}
        case = scenario(coin=draw_coin(rng), release=release, ending=ending, **air)
        # Lower the coin to a random gap, often a tiny one.
        body, R = case.body, rotation_matrix(case.release.attitude)
        z = release["position"][2] - gap(body, release["position"][2], R[2]) + 10 ** rng.uniform(-8, -1)
        case = case.replace("release.position.z", z)
        clear = clear_time(body, z, case.release.velocity, R[2], case.release.angular_velocity, 0.02)
        assert clear > 0
        toss = run(body, case.rules, state_at_release(case.release))
        touches, end = toss.rows["time"], toss.start_states[-1]
        # 1e-9 for the rounding of the touch's own time.
        assert (touches >= clear * (1 - 1e-9)).all()
        assert len(touches) > 0 or gap(body, end[2], rotation_matrix(tuple(end[6:10]))[2]) > 0
        touched += len(touches)
    assert touched >= 10


@pytest.mark.parametrize(
    ("seed", "exponent"),
    [(seed, 0.0) for seed in range(30)] + [(seed, b) for seed in range(6) for b in (0.5, 1.0)],
)
def test_accelerations_stay_within_their_bounds(seed, exponent):
    rng = np.random.default_rng(seed)
    air = {"normal": 20.0, "tangential": 5.0, "exponent": exponent}
    case = scenario(coin=draw_coin(rng), air=air, release=draw_release(rng, spin=200))
    release = {**draw_release(rng, spin=200), "position": [0, 0, 50.0]}
    case = case.replace("release", release, "ending.max_time", 0.06)
    body, window = case.body, 0.05
    if exponent > 0:
        # The longest window for which `clear_time` asks.
        rate = damping_rate(body, case.release.velocity, case.release.angular_velocity, window)
        window = min(window, 0.5 / rate)
        assert window > 1e-3
    up = rotation_matrix(case.release.attitude)[2]
    bounds = acceleration_bounds(body, case.release.velocity, up, case.release.angular_velocity, window)
    dt = 1e-5
    states = analytic.toss(case).sample(np.arange(0, window, dt))
    n_z = states.normal[:, 2]
    second = np.diff(n_z, 2) / dt**2
    # Rounding of n_z, 1e-16, is 2e-6/s^2 in its second difference; the bound is at least thousands.
    assert np.abs(second).max() <= bounds.of_height_of_normal + 1e-4
    assert np.abs(second).max() > 0.01 * bounds.of_height_of_normal
    assert np.linalg.norm(np.diff(states.normal, 2, axis=0), axis=1).max() / dt**2 <= bounds.of_normal + 1e-4
    R = np.array([rotation_matrix(tuple(e)) for e in states.quaternion])
    for side in (1, -1):
        axis_point = np.array([0, 0, side * body.thickness / 2]) - body.center
        height = states.position[:, 2] + R[:, 2] @ axis_point
        assert (-np.diff(height, 2) / dt**2).max() <= bounds.of_height + 1e-4


@pytest.mark.parametrize("offset", [[0, 0, 0], PAPER_OFFSET])
@pytest.mark.parametrize("tilt", [0.0, 1e-6, 1e-3])
def test_accelerations_of_a_nearly_flat_spinning_coin_stay_within_their_bounds(offset, tilt):
    w, window, dt = (0.1, -0.2, 200.0), 2e-3, 1e-6
    case = scenario(
        coin={**ZLOTY, "center_of_mass": offset},
        air=AIR,
        release={"position": [0, 0, 5.0], "angles": [0.3, tilt, 0], "angular_velocity": w},
        ending={"max_time": 0.01},
    )
    up = rotation_matrix(case.release.attitude)[2]
    bounds = acceleration_bounds(case.body, case.release.velocity, up, w, window)
    n = analytic.toss(case).sample(np.arange(0, window, dt)).normal
    # Rounding of n, 1e-16, is 4e-4/s^2 in its second difference.
    assert np.abs(np.diff(n[:, 2], 2)).max() / dt**2 <= bounds.of_height_of_normal + 1e-3
    assert np.linalg.norm(np.diff(n, 2, axis=0), axis=1).max() / dt**2 <= bounds.of_normal + 1e-3
    if offset == [0, 0, 0]:
        assert bounds.of_height_of_normal < 0.01 * 200**2


def test_a_flat_coin_that_spins_fast_is_clear_for_much_of_its_fall():
    """However fast it spins: a flat face is a double root of F, so half of its fall is known to be clear."""
    body = scenario(air=AIR).body
    gap_left, fall = 1e-9, 1.0
    clear = clear_time(body, 1e-3 + gap_left, (0.0, 0.0, -fall), (0.0, 0.0, 1.0), (0.0, 0.0, 300.0), 1e-8)
    assert 0.45 * gap_left / fall < clear < gap_left / fall


@pytest.mark.parametrize("tilt", [1e-9, 1e-6, 1e-3, 0.3, np.pi / 2 - 1e-3, np.pi / 2 - 1e-9])
@pytest.mark.parametrize("seed", range(5))
def test_a_grazing_coin_hardly_sinks_in_its_grazing_time(tilt, seed):
    """The coin touches and its lowest point is at rest; its gap is sampled from a flight 1 m higher up."""
    rng = np.random.default_rng(seed)
    body = scenario().body
    w, sink = rng.uniform(-50, 50, 3), 1e-6 * body.radius
    psi = rng.uniform(0, 2 * np.pi)
    case = scenario(release={"angles": [psi, tilt, rng.uniform(0, 6)]})
    R = np.array(rotation_matrix(case.release.attitude))
    point, _ = lowest_point(body, vector(R[2]), vector(w))
    speed = -contact_velocity(body, matrix(R), (0.0, 0.0, 0.0), vector(w), point)[2]
    time, _ = grazing_time(body, (0.0, 0.0, speed), tuple(R[2]), tuple(w), sink)
    assert time > 0
    start = -gap(body, 0.0, tuple(R[2]))
    case = scenario(
        release={
            "position": [0, 0, start + 1],
            "velocity": [0, 0, speed],
            "quaternion": list(case.release.attitude),
            "angular_velocity": w.tolist(),
        },
        ending={"max_time": max(2 * time, 1e-12)},
    )
    states = analytic.toss(case).sample(np.linspace(0, time, 200))
    # Rounding of heights near 1 m.
    assert max(1.0 - gaps(body, states)) <= 3 * sink + 1e-14


def test_linear_air_is_the_same_whether_its_exponent_is_none_or_0():
    """The engines differ in that: see `AirLaw`."""
    case = scenario(coin={**ZLOTY, "center_of_mass": PAPER_OFFSET}, air=AIR)
    with_zero = case.body._replace(air=case.body.air._replace(exponent=0.0))
    v, w = (0.3, -0.2, 1.0), (5.0, 30.0, -8.0)
    assert drag_bound(with_zero, v, w, 0.1) == drag_bound(case.body, v, w, 0.1)
    assert idle_energy(with_zero, case.rules, v, w) == idle_energy(case.body, case.rules, v, w) > 0
