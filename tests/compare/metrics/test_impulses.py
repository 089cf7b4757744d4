"""Impacts of two tosses are matched by number, and both engines' agree within the horizon."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.metrics.impulses import errors_of_impacts, match
from cointoss.compare.report.comparison import compare
from cointoss.models.records import IMPACT_ROW, Impacts
from tests.helpers.draws import AIR, ZLOTY, scenario

TUMBLING = {"angles": [0.0, 0.122, 0.0], "angular_velocity": [0.0, 40.15, 0.0]}


def made(times, impulses, spins):
    rows = np.zeros(len(times), IMPACT_ROW)
    rows["time"], rows["impulse"][:, 2], rows["face"] = times, impulses, 1
    rows["angular_velocity_after"][:, 1] = spins
    return Impacts.from_rows(rows)


def test_impacts_are_matched_by_number():
    one = made([1.0, 2.0, 3.0], [2.0, 0.0, 1.0], [4.0, 0.0, 1.0])
    differences = match(one, made([1.1, 2.0], [1.0, 1.0], [5.0, 0.0]))
    assert differences.time == pytest.approx([-0.1, 0.0])
    assert differences.impulse.tolist() == [0.5, np.inf]
    assert differences.angular_velocity.tolist() == [0.25, 0]


def test_the_papers_own_impacts_have_no_error():
    assert errors_of_impacts(analytic.toss(scenario(release=TUMBLING, air=AIR))).max() < 1e-12


def test_an_impact_that_the_law_knows_nothing_of_is_wrong_beyond_measure():
    """A coin that flies up touches nothing before the toss ends."""
    toss = analytic.toss(scenario(release=TUMBLING, ending={"max_impacts": 1}))
    case = toss.scenario.replace("ending.max_time", 1e-3)
    impacts = replace(toss.impacts, velocity_before=-toss.impacts.velocity_before)
    assert errors_of_impacts(replace(toss, scenario=case, impacts=impacts)).tolist() == [np.inf]


THREE = scenario(
    floor={"contact": "coulomb", "friction": 0.3},
    release={"position": [0, 0, 0.3], "angles": [0.4, 0.6, 0.1], "angular_velocity": [20.0, 35.0, -10.0]},
    ending={"max_impacts": 3},
)
"""Impacts with friction, whose impulses are not upright."""


def through_air(thickness, spin):
    return scenario(
        coin={**ZLOTY, "thickness": thickness},
        air=AIR,
        release={"angles": [0.0, 0.122, 0.0], "angular_velocity": [3.0, spin, 0.0]},
    )


@pytest.mark.parametrize(
    ("case", "count"),
    [
        (THREE, 3),
        (through_air(0.0, 25.0), 1),
        *(
            pytest.param(through_air(*of_coin), 1, marks=pytest.mark.slow)
            for of_coin in [(0.0, 31.0), (2e-3, 25.0), (2e-3, 40.15)]
        ),
    ],
)
def test_engines_agree_within_the_horizon(case, count):
    compared = compare(case)["mujoco"]
    assert 1 <= compared.common_horizon <= compared.common_prefix
    assert compared.differences.impulse[0] < 1e-3
    assert compared.differences.time[0] == pytest.approx(0, abs=1e-6)
    # Asked: 1e-2. Measured with friction: 5e-5.
    assert compared.errors[:count].max() < 1e-3
