"""The measures on two tosses, on made records with known answers first."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.metrics.impulses import errors_of_impacts, match
from cointoss.compare.metrics.sequences import agreement_horizon, common_prefix
from cointoss.compare.metrics.trajectories import attitude_angle, distance, parting_time, tilt
from cointoss.compare.report.comparison import compare
from cointoss.models.records import IMPACT_ROW, Impacts, States
from tests.helpers.draws import AIR, ZLOTY, scenario

TUMBLING = {"angles": [0.0, 0.122, 0.0], "angular_velocity": [0.0, 40.15, 0.0]}


def states(quaternions, positions=None):
    n = len(quaternions)
    return States(
        time=np.arange(n, dtype=float),
        position=np.zeros((n, 3)) if positions is None else np.array(positions, dtype=float),
        velocity=np.zeros((n, 3)),
        quaternion=np.array(quaternions, dtype=float),
        angular_velocity=np.zeros((n, 3)),
    )


def test_attitude_angle_is_that_of_the_rotation_between():
    angles = np.array([0.0, 1e-9, 0.3, 2.0, np.pi])
    turned = states([[np.cos(a / 2), 0, np.sin(a / 2), 0] for a in angles])
    still = states([[1, 0, 0, 0]] * 5)
    assert attitude_angle(still, turned) == pytest.approx(angles, rel=1e-12)
    assert attitude_angle(still, states(-turned.quaternion)) == pytest.approx(angles, rel=1e-12)


def test_distance_and_tilt():
    a = states([[1, 0, 0, 0]] * 2, [[0, 0, 0], [1, 1, 1]])
    b = states([[np.cos(0.2), np.sin(0.2), 0, 0]] * 2, [[3, 4, 0], [1, 1, 1]])
    assert distance(a, b).tolist() == [5, 0]
    assert tilt(b) == pytest.approx([0.4, 0.4], rel=1e-14)


def test_parting_time_is_the_first_beyond():
    times = np.array([0.0, 1.0, 2.0, 3.0])
    assert parting_time(times, np.array([0, 0.5, 0.1, 2]), 0.4) == 1.0
    assert parting_time(times, np.zeros(4), 0.4) is None


def test_sequences_share_their_leading_symbols():
    assert common_prefix("HHTH", "HHTT") == 3
    assert common_prefix("HH", "HHTT") == 2
    assert common_prefix("T", "H") == common_prefix("", "H") == 0


def made(times, impulses):
    rows = np.zeros(len(times), IMPACT_ROW)
    rows["time"], rows["impulse"][:, 2], rows["face"] = times, impulses, 1
    return Impacts.from_rows(rows)


def test_impacts_are_matched_by_number():
    differences = match(made([1.0, 2.0, 3.0], [2.0, 0.0, 1.0]), made([1.1, 2.0], [1.0, 1.0]))
    assert differences.time == pytest.approx([-0.1, 0.0])
    assert differences.impulse.tolist() == [0.5, np.inf]
    assert differences.angular_velocity.tolist() == [0, 0]


def test_the_papers_own_impacts_have_no_error():
    assert errors_of_impacts(analytic.toss(scenario(release=TUMBLING, air=AIR))).max() < 1e-12


def test_the_horizon_shrinks_with_the_error():
    tossed = analytic.toss(scenario(release=TUMBLING, air=AIR))
    n = len(tossed.impacts)
    horizons = [agreement_horizon(tossed, np.full(n, error)) for error in (1e-15, 1e-6, 1e-3, 0.3)]
    assert horizons[0] == n
    assert horizons == sorted(horizons, reverse=True)
    assert horizons[-1] < n / 2


@pytest.mark.parametrize("thickness", [0.0, 2e-3])
@pytest.mark.parametrize("spin", [25.0, 31.0, 40.15])
def test_engines_agree_within_the_horizon(thickness, spin):
    case = scenario(
        coin={**ZLOTY, "thickness": thickness},
        air=AIR,
        release={"angles": [0.0, 0.122, 0.0], "angular_velocity": [3.0, spin, 0.0]},
    )
    compared = compare(case)
    assert 1 <= compared.horizon <= compared.common_prefix
    assert compared.differences.impulse[0] < 1e-3
    assert compared.differences.time[0] == pytest.approx(0, abs=1e-6)
    assert compared.errors[0] < 1e-3


def test_coulombs_floor_is_compared():
    case = scenario(
        floor={"contact": "coulomb", "friction": 0.3},
        release={"position": [0, 0, 0.3], "angles": [0.4, 0.6, 0.1], "angular_velocity": [20.0, 35.0, -10.0]},
        ending={"max_impacts": 3},
    )
    compared = compare(case)
    assert len(compared.errors) == 3
    assert np.all(np.hypot(*compared.both[1].impacts.impulse[:, :2].T) > 5e-5)
    # Asked: 1e-2. Measured here: 5e-5.
    assert compared.errors.max() < 1e-3
