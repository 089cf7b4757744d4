"""What varies over a batch: every way to say it means the scenarios that a person would write one by one."""

import numpy as np
import pytest
import xarray as xr

from cointoss import Air, ScenarioError, load
from cointoss.compare.sweep import batch as module
from cointoss.compare.sweep.batch import batch_of
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.batch import refused
from cointoss.models.fields import UNITS
from cointoss.models.hand import Hand
from tests.helpers.draws import scenario

CASE = load("fig24a")
CHI, Z, ETA = "floor.restitution", "release.position.z", "release.angular_velocity.eta"


@pytest.mark.parametrize(
    ("vary", "sizes", "number", "given"),
    [
        ({CHI: 0.5, Z: "40 cm"}, {}, 0, {CHI: 0.5, Z: 0.4}),
        ({CHI: "0.4:0.6:3"}, {CHI: 3}, 1, {CHI: 0.5}),
        ({CHI: (0.4, 0.6, 3)}, {CHI: 3}, 2, {CHI: 0.6}),
        ({Z: ("40 cm", 0.6, 3), CHI: "40 %:0.6:2"}, {Z: 3, CHI: 2}, 3, {Z: 0.5, CHI: 0.6}),
        ({CHI: [0.4, 0.5], Z: ["40 cm", "0.5 m"]}, {"toss": 2}, 1, {CHI: 0.5, Z: 0.5}),
        ({CHI: [[0.4], [0.5]], Z: [0.4, 0.5, 0.6]}, {"dim_0": 2, "dim_1": 3}, 5, {CHI: 0.5, Z: 0.6}),
        ({CHI: xr.DataArray([0.4, 0.5], dims="f"), Z: "0.4:0.6:3"}, {"f": 2, Z: 3}, 4, {CHI: 0.5, Z: 0.5}),
        (
            {CHI: xr.DataArray([0.4, 0.5], dims="n"), Z: xr.DataArray([0.4, 0.6], dims="n")},
            {"n": 2},
            1,
            {CHI: 0.5, Z: 0.6},
        ),
        (
            {"floor.contact": ["smooth", "knurled"], CHI: 0.5},
            {"toss": 2},
            1,
            {"floor.contact": "knurled", CHI: 0.5},
        ),
        (
            {"release.position": [[0, 0, 0.4], [0.1, 0, 0.5]]},
            {"toss": 2},
            1,
            {"release.position": [0.1, 0, 0.5]},
        ),
        (
            {
                "release.position": xr.DataArray(
                    [[0, 0, 40.0], [10.0, 0, 50.0]], dims=("n", "v"), attrs={"units": "cm"}
                )
            },
            {"n": 2},
            1,
            {"release.position": [0.1, 0, 0.5]},
        ),
        (
            {"release.position": xr.DataArray([0, 0, 40.0], dims="v", attrs={"units": "cm"})},
            {},
            0,
            {"release.position": [0, 0, 0.4]},
        ),
        (
            {"release.position": [0, 0, 0.4], "air": Air(normal=0.1)},
            {},
            0,
            {"release.position": [0, 0, 0.4], "air": Air(normal=0.1)},
        ),
        (
            {
                CHI: xr.DataArray([[0.4, 0.5, 0.6], [0.7, 0.8, 0.9]], dims=("b", "a")),
                Z: xr.DataArray([0.3, 0.4], dims="b"),
            },
            {"b": 2, "a": 3},
            4,
            {CHI: 0.8, Z: 0.4},
        ),
        ({"ending.max_impacts": [3, 4]}, {"toss": 2}, 1, {"ending.max_impacts": 4}),
        ({"gravity": np.array([9.0])}, {"toss": 1}, 0, {"gravity": 9.0}),
    ],
)
def test_each_toss_is_the_scenario_that_one_would_write(vary, sizes, number, given):
    batch = batch_of(CASE, vary)
    batch.check()
    assert batch.sizes == sizes
    assert batch.scenario_at(number) == CASE.replace(*(part for pair in given.items() for part in pair))


@pytest.mark.parametrize(
    ("name", "field"),
    [
        ("restitution", CHI),
        ("height", Z),
        ("position.z", Z),
        ("thickness", "coin.thickness"),
        ("contact", "floor.contact"),
        ("angular_velocity.eta", ETA),
        ("mass", "coin.mass"),
        ("caught", "ending.caught"),
        ("height of the catch", "ending.caught"),
    ],
)
def test_a_field_may_be_named_by_what_no_other_is_called(name, field):
    value = ["smooth"] if field == "floor.contact" else [0.0015]
    assert batch_of(CASE, {name: value}).varied[0].field == field


@pytest.mark.parametrize("size", [1.0, 2.0**-600])
def test_a_spin_is_the_size_of_omega_about_the_scenarios_own_axis(size):
    case = CASE.replace("release.angular_velocity", [3.0 * size, 4.0 * size, 12.0 * size])
    batch = batch_of(case, {"spin": "13:26:2"})
    assert batch.sizes == {"release.spin": 2}
    for number, spin in enumerate([(3, 4, 12), (6, 8, 24)]):
        assert batch.scenario_at(number).release.angular_velocity == spin
    assert batch_of(case, {"spin": "26 rad/s"}).scenario.release.angular_velocity == (6, 8, 24)


def test_the_angles_and_the_quaternion_of_a_release_replace_each_other():
    tilted = scenario(release={"angles": [0.1, 0.2, 0.3]})
    e1 = tilted.release.attitude[1]
    turned = batch_of(tilted, {"release.quaternion.e1": [0.0, e1 + 1e-4]}).scenario_at(1)
    assert turned.release.angles is None
    assert turned.release.quaternion is not None
    assert batch_of(turned, {"release.angles.theta": [0.5]}).scenario_at(0).release.angles == (0, 0.5, 0)
    kept = batch_of(tilted, {"release.angles.theta": [0.5]}).scenario_at(0)
    assert kept.release.angles == (0.1, 0.5, 0.3)


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ({"release.angles.theta": [0.5], "release.quaternion.e1": [0.0]}, "accepted: angles or a quaternion"),
        (
            {"height": "0.2:0.6:1000000", "spin": "1:9:1000000", CHI: [0.5, 0.6]},
            "accepted: at most 1e",
        ),
        ({"restitution": [0.5], CHI: [0.6]}, "each field once"),
        ({"spin": [9.0], ETA: [3.0]}, "each field once"),
        ({CHI: [0.4, 0.5], Z: [0.3, 0.4, 0.5]}, "shapes that do not broadcast"),
        (
            {CHI: xr.DataArray([0.4, 0.5], dims="n"), Z: xr.DataArray([0.3], dims="n")},
            "accepted: 2, as the others",
        ),
    ],
)
def test_what_does_not_go_together_is_refused(vary, said):
    with pytest.raises(SweepError, match=said):
        batch_of(CASE, vary)


def test_the_largest_scenario_has_what_varies_farthest_from_0():
    found = batch_of(CASE, {CHI: "0.2:0.8:4", ETA: "5:-20:6"}).largest()
    assert (found.floor.restitution, found.release.angular_velocity[1]) == (0.8, -20)


def test_drawn_releases_vary_as_fields_do():
    hand = Hand.people(caught=0.4)
    drawn = hand.releases(CASE, 5, seed=3)
    batch = batch_of(CASE, {**drawn, CHI: "0.4:0.6:2"})
    assert batch.sizes == {"toss": 5, CHI: 2}
    states = hand.states(hand.scenario(CASE).body, np.random.default_rng(3), 5)
    made = batch.scenario_at(4)
    assert (made.release.position, made.ending.caught) == (tuple(states[2, :3]), 0.4)


@pytest.mark.parametrize("field", UNITS)
def test_a_row_is_refused_where_its_scenario_is(field):
    """Around each bound of each field: what rows say is what a scenario says."""
    case = scenario(release={"angles": [0.1, 0.2, 0.3]}, air={"exponent": 0.5, "normal": 0.1})
    tried = np.array([-1e10, -1e9, -1, -1e-9, 0, 1e-10, 1e-9, 0.3, 1, 2, 1e6, 2e6, 1e9, 1e10, np.nan])
    batch, numbers = batch_of(case, {field: tried}), np.arange(len(tried))
    assert refused(batch.rows(numbers), [field]).tolist() == [_is_refused(batch, toss) for toss in numbers]


def _is_refused(batch, toss):
    try:
        batch.scenario_at(toss)
    except ScenarioError:
        return True
    return False


def test_the_ends_of_an_axis_suffice_where_conditions_are_monotone(monkeypatch):
    looked = []
    monkeypatch.setattr(
        module, "refused", lambda rows, _: looked.append(len(rows)) or np.zeros(len(rows), bool)
    )
    batch_of(CASE, {Z: "0.2:0.6:1000", CHI: "0.1:0.9:1000"}).check()
    batch_of(CASE, {"release.angles.theta": "0.2:0.6:100", CHI: "0.1:0.9:1000"}).check()
    batch_of(CASE, {Z: np.linspace(0.2, 0.6, 50), "gravity": np.linspace(9, 10, 50)}).check()
    assert looked == [4, 200, 50]
