"""The numbers of a comparison, of paths whose difference is a formula."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.report.compared_tosses import NEARLY, PARTED, TIMES, Against
from cointoss.compare.report.comparison import Comparison
from cointoss.compare.report.motion import ROUNDING, motion_of
from cointoss.compare.report.page import _horizons, _impact, _impact_rows
from cointoss.models.reading import load
from cointoss.models.records import Ending
from tests.helpers.draws import ZLOTY
from tests.helpers.films import MadePath, made, struck

R = ZLOTY["radius"]
RELEASE = {"position": [0, 0, 0.1], "velocity": [0.3, 0, 0]}
TILTED = (np.cos(0.1), np.sin(0.1), 0.0, 0.0)
MOVES = {"position": (0, 0, 0.1), "velocity": (0.3, 0, 0)}


def against(other, *, engine="mujoco", spin=0.0, **path):
    """Return a toss held against one that moves sideways, or as a path says; both touch once."""
    measure = made(
        MadePath(**{**MOVES, **path}),
        impacts=[(0.5, 1e-3)],
        engine="analytic",
        ending=Ending.LYING,
        release={**RELEASE, "angular_velocity": [0, spin, 0]},
    )
    toss = made(MadePath(**{**MOVES, **path, **other}), impacts=[(0.3, 8e-4)], end=0.8, ending=Ending.LYING)
    return Against(measure=measure, toss=replace(toss, engine=engine))


def test_paths_are_compared_at_the_same_times_as_far_as_both_last():
    pair = against({"velocity": (0.3, 0.002, 0)})
    assert pair.together.time[-1] == 0.8
    assert pair.together.distance == pytest.approx(0.002 * pair.together.time, abs=1e-15)
    assert pair.together.parting_time == pytest.approx(PARTED * R / 0.002, abs=0.8 / (TIMES - 1))
    assert [*pair.differences.time, *pair.differences.impulse] == pytest.approx([0.2, 0.2])


@pytest.mark.parametrize(
    ("other", "how", "error"),
    [
        pytest.param({"velocity": (0.33, 0, 0)}, {}, 0.1, id="a part of the way"),
        pytest.param(
            {"position": (0, 0.002, 0.1)}, {"velocity": (0, 0, 0)}, 0.002 / R, id="of at least a radius"
        ),
        pytest.param({"quaternion": TILTED}, {}, 0.2, id="an angle"),
        pytest.param(
            {"quaternion": TILTED}, {"spin": 100.0}, 0.002 / (NEARLY * 0.3), id="a part of its turn"
        ),
        pytest.param(
            {"velocity": (1, 0, 0), "start": 0.31}, {"velocity": (0, 0, 0)}, 0.0, id="before a touch"
        ),
    ],
)
def test_the_error_of_a_flight_is_that_of_its_way_or_of_its_turn(other, how, error):
    assert against(other, **how).flight_error == pytest.approx(error, rel=5e-3, abs=1e-12)


@pytest.mark.parametrize("trusted", [0, 2, 4])
def test_faces_must_agree_no_further_than_the_other_toss_is_trusted(trusted):
    toss = analytic.toss(load("fig24a").replace("ending.max_impacts", 4))
    pair = Against(measure=toss, toss=replace(toss, trusted_impacts=trusted))
    assert (pair.common_prefix, pair.common_horizon) == (4, trusted)


def shown(*pairs, horizons):
    """Return a comparison of one measure with others, whose horizons are given."""
    measure = pairs[0].measure
    found = Comparison(name="made", text="", tosses=(measure, *(pair.toss for pair in pairs)))
    for pair, horizon in zip(found.against, horizons, strict=True):
        vars(pair).update(common_horizon=horizon, errors=np.array([0.02]))
    return found


def test_the_page_plots_differences_in_radii_and_heights_at_touches():
    motion = motion_of(shown(against({"velocity": (0.3, 0.002, 0)}), horizons=[1]))
    (apart,) = motion["apart"]
    assert apart["distance"][0] == apart["angle"][-1] == ROUNDING
    assert apart["distance"][-1] == pytest.approx(0.002 * 0.8 / R, rel=1e-3)
    assert [toss["heights"] for toss in motion["tosses"]] == [[0.1], [0.1]]


def test_the_table_of_impacts_has_their_numbers_and_marks_what_is_beyond_each_horizon():
    found = shown(against({}), against({}, engine="off"), horizons=[1, 0])
    horizons = _horizons(found)
    assert horizons == [1, 1, 0]
    (row,) = _impact_rows(found, horizons)
    assert row["classes"] == ["", "", "beyond"]
    assert row["differences"][0] == {"time": pytest.approx(0.2), "impulse": pytest.approx(0.2), "error": 0.02}
    assert _impact(struck(), 0) == {
        "time": 0.5,
        "face": "H",
        "rim": pytest.approx(60),
        "impulse": "0, 0, 2.5000",
        "energy": 1.25,
        "energy_lost": 0.5,
    }
    assert _impact(struck(), 1) is None
