"""What varies over a batch: every way to say it means the scenarios that a person would write one by one."""

import math

import numpy as np
import pytest
import xarray as xr

from cointoss import Air, ScenarioError, SweepError, load
from cointoss.compare.sweep import batch as module
from cointoss.compare.sweep.batch import MOST_ROWS, batch_of
from cointoss.models.batch import refused, rows_of, scenario_of_row
from cointoss.models.fields import FIELDS, UNITS
from cointoss.models.hand import Hand
from cointoss.models.reading import named_scenarios
from cointoss.models.rows import row_of
from tests.helpers.draws import scenario

CASE = load("fig24a")
CHI, Z, ETA = "floor.restitution", "release.position.z", "release.angular_velocity.eta"


def scenarios(batch):
    return [batch.scenario_at(number) for number in range(len(batch))]


@pytest.mark.parametrize("name", named_scenarios())
def test_a_row_is_its_scenario_and_back(name):
    case = load(name)
    back = scenario_of_row(row_of(case))
    assert back == case
    assert np.array_equal(row_of(back), row_of(case), equal_nan=True)


@pytest.mark.parametrize(
    ("vary", "dims"),
    [
        ({CHI: 0.5, Z: "40 cm"}, ()),
        ({CHI: "0.4:0.6:3"}, (CHI,)),
        ({CHI: (0.4, 0.6, 3)}, (CHI,)),
        ({Z: ("40 cm", 0.6, 3), CHI: "40 %:0.6:2"}, (Z, CHI)),
        ({CHI: [0.4, 0.5], Z: ["40 cm", "0.5 m"]}, ("toss",)),
        ({CHI: [[0.4], [0.5]], Z: [0.4, 0.5, 0.6]}, ("dim_0", "dim_1")),
        ({CHI: xr.DataArray([0.4, 0.5], dims="floor"), Z: "0.4:0.6:3"}, ("floor", Z)),
        ({CHI: xr.DataArray([0.4, 0.5], dims="n"), Z: xr.DataArray([0.4, 0.6], dims="n")}, ("n",)),
        ({"floor.contact": ["smooth", "coulomb"], CHI: 0.5}, ("toss",)),
        ({"release.position": [[0, 0, 0.4], [0.1, 0, 0.5]]}, ("toss",)),
        ({"release.position": [0, 0, 0.4], "air": Air(normal=0.1)}, ()),
        ({"ending.max_impacts": [3, 4]}, ("toss",)),
        ({"gravity": np.array([9.0])}, ("toss",)),
    ],
)
def test_each_toss_is_the_scenario_that_one_would_write(vary, dims):
    batch = batch_of(CASE, vary)
    assert tuple(batch.sizes) == dims
    batch.check()
    arrays = {}
    for field, value in vary.items():
        if isinstance(value, tuple) or (isinstance(value, str) and ":" in value):
            start, stop, count = value if isinstance(value, tuple) else value.split(":")
            low, high = (batch_of(CASE, {field: end}).scenario for end in _ends(start, stop))
            table, key = field.split(".")[0], field.split(".")[1:]
            first, last = (_get(one, table, key) for one in (low, high))
            arrays[field] = (field, np.linspace(first, last, int(count)))
        elif hasattr(value, "dims"):
            arrays[field] = value
        elif not isinstance(value, Air) and np.ndim(value):
            continue  # looked at below
    grid = xr.Dataset(coords={name: one for name, one in arrays.items() if not hasattr(one, "dims")})
    for number, made in enumerate(scenarios(batch)):
        at = dict(zip(batch.sizes, np.unravel_index(number, batch.shape), strict=True)) if batch.sizes else {}
        for one in batch.varied:
            value = one.values[tuple(at[dim] for dim in one.dims)]
            assert row_of(made)[FIELDS.index(one.field)] == value
        for field in grid.coords:
            assert row_of(made)[FIELDS.index(str(field))] == grid[field].values[at[str(field)]]
        untouched = [f for f in FIELDS if not any(f.startswith(name.split(".")[0]) for name in vary)]
        for field in untouched:
            place = FIELDS.index(field)
            assert row_of(made)[place] == row_of(CASE)[place] or math.isnan(row_of(made)[place])


def _ends(start, stop):
    return tuple(float(end) if isinstance(end, str) and end[-1].isdigit() else end for end in (start, stop))


def _get(case, table, key):
    entry = getattr(getattr(case, table), key[0])
    return entry if len(key) == 1 else entry["xyz".index(key[1])]


def test_arrays_broadcast_as_in_numpy():
    chi, z = np.array([0.4, 0.5, 0.6]), np.array([[0.4], [0.6]])
    batch = batch_of(CASE, {CHI: chi, Z: z})
    assert batch.sizes == {"dim_0": 2, "dim_1": 3}
    rows = batch.rows(np.arange(6))
    assert np.array_equal(rows[:, FIELDS.index(CHI)], np.broadcast_to(chi, (2, 3)).ravel())
    assert np.array_equal(rows[:, FIELDS.index(Z)], np.broadcast_to(z, (2, 3)).ravel())


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
    value = ["smooth"] if field == "floor.contact" else [1.5]
    assert batch_of(CASE, {name: value}).varied[0].field == field


def test_a_spin_is_the_size_of_omega_about_the_scenarios_own_axis():
    case = CASE.replace("release.angular_velocity", [3.0, 4.0, 12.0])
    batch = batch_of(case, {"spin": "13:26:2"})
    assert batch.sizes == {"release.spin": 2}
    assert [one.release.angular_velocity for one in scenarios(batch)] == [(3, 4, 12), (6, 8, 24)]
    assert batch_of(case, {"spin": "26 rad/s"}).scenario.release.angular_velocity == (6, 8, 24)
    still = scenario(release={"angular_velocity": [0, 0, 0]})
    for spin in ("1:2:2", 3.0):
        with pytest.raises(
            ScenarioError, match=r"the coin has no axis; accepted: release\.angular_velocity\.xi"
        ):
            batch_of(still, {"spin": spin}).rows(np.array([0]))


def test_the_angles_and_the_quaternion_of_a_release_replace_each_other():
    tilted = scenario(release={"angles": [0.1, 0.2, 0.3]})
    e1 = tilted.release.attitude[1]
    turned = batch_of(tilted, {"release.quaternion.e1": [0.0, e1 + 1e-4]}).scenario_at(1)
    assert turned.release.angles is None
    assert turned.release.quaternion is not None
    assert batch_of(turned, {"release.angles.theta": [0.5]}).scenario_at(0).release.angles == (0, 0.5, 0)
    kept = batch_of(tilted, {"release.angles.theta": [0.5]}).scenario_at(0)
    assert kept.release.angles == (0.1, 0.5, 0.3)


def test_drawn_releases_vary_as_fields_do():
    hand = Hand.people(caught=0.4)
    drawn = hand.releases(CASE, 5, seed=3)
    batch = batch_of(CASE, {**drawn, CHI: "0.4:0.6:2"})
    assert batch.sizes == {"toss": 5, CHI: 2}
    states = hand.states(hand.scenario(CASE).body, np.random.default_rng(3), 5)
    made = batch.scenario_at(4)
    assert (made.release.position, made.ending.caught) == (tuple(states[2, :3]), 0.4)
    for n in (0, True, 1.5):
        with pytest.raises(ValueError, match=r"^n: .*, accepted: a whole number from 1"):
            hand.releases(CASE, n)  # pyright: ignore[reportArgumentType]


BAD = [
    (
        {CHI: [0.5, 1.2]},
        r"floor\.restitution = 1\.2: accepted: a number >= 0 and <= 1 \(at toss 1, floor\.res",
    ),
    ({CHI: [0.5, math.nan]}, r"floor\.restitution = nan: accepted: a finite number \(at toss 1"),
    ({CHI: [0.5, math.inf]}, r"floor\.restitution = inf"),
    ({CHI: []}, r"floor\.restitution: empty, accepted: one value or more"),
    ({CHI: [0.1, 0.2], Z: [0.1, 0.2, 0.3]}, r"\(2,\), .* \(3,\): shapes that do not broadcast"),
    ({CHI: xr.DataArray([0.1], dims="a"), Z: xr.DataArray([1, 2], dims="a")}, "2 along a, accepted: 1"),
    (
        {Z: 1, "height": 2},
        r"release\.position\.z: given beside release\.position\.z, accepted: each field once",
    ),
    ({"release.position": [0, 0, 1], "height": 2}, "each field once"),
    ({"spin": 2, ETA: [1.0]}, "each field once"),
    ({"release.angles.phi": [0.1], "release.quaternion.e0": [1.0]}, "accepted: angles or a quaternion"),
    ({"restitutoin": 1}, r"restitutoin: no field .*did you mean floor\.restitution\?"),
    ({"hieght": 1}, r"did you mean release\.position\.z\?"),
    ({"z": [1.0]}, r"z: no field .*release\.position\.z, release\.velocity\.z"),
    ({3: 1}, "3: accepted: the name of a field"),
    ({CHI: "fast"}, r"floor\.restitution = \"fast\": accepted: a number"),
    ({Z: ["1 kg"]}, r"release\.position\.z = 1 kg: accepted: a number in m"),
    ({CHI: [[0.1], [0.2, 0.3]]}, "an array that broadcasts"),
    ({CHI: [True, False]}, "an array that broadcasts"),
    ({CHI: object()}, r"floor\.restitution"),
    ({CHI: (0.4, 0.6, 1)}, "N = 1; accepted: a whole number from 2"),
    ({CHI: (0.4, 0.6, 2.5)}, "N = 2.5; accepted: a whole number"),
    ({CHI: (0.4, 0.4, 3)}, "START = STOP"),
    ({"floor.contact": ["rough"]}, "rough"),
    ({"release.position": [[0, 0], [1, 1]]}, r"shape \(2, 2\), accepted: \(n, 3\)"),
    ({Z: "1:2:1000000", "gravity": "1:2:1000000", CHI: "0:1:3"}, "3e\\+12 tosses, accepted: at most 1e\\+12"),
    ({"ending.max_impacts": [1.5]}, r"ending\.max_impacts = 1\.5"),
    ({"ending.max_impacts": [1, 2.5, 5]}, r"ending\.max_impacts = 2\.5"),
    ({"coin.mass": [-1.0]}, r"coin\.mass = -1\.0"),
]


@pytest.mark.parametrize(("vary", "said"), BAD, ids=[str(number) for number in range(len(BAD))])
def test_what_is_no_batch_is_refused_in_one_line(vary, said):
    with pytest.raises(ValueError, match=said) as raised:
        batch_of(CASE, vary).check()
    assert "\n" not in str(raised.value)
    assert MOST_ROWS == 1e12


def test_what_varies_is_a_dict():
    with pytest.raises(SweepError, match=r"vary: .*, accepted: a dict such as"):
        batch_of(CASE, ["floor.restitution"])  # pyright: ignore[reportArgumentType]


@pytest.mark.parametrize("field", UNITS)
def test_a_row_is_refused_where_its_scenario_is(field):
    """Around each bound of each field: what rows say is what a scenario says."""
    case = scenario(release={"angles": [0.1, 0.2, 0.3]}, air={"exponent": 0.5, "normal": 0.1})
    tried = np.array([-1e10, -1e9, -1.0, -1e-9, 0.0, 1e-10, 1e-9, 0.3, 1.0, 2.0, 1e6, 2e6, 1e9, 1e10])
    rows = rows_of(case, len(tried), {field: tried})
    assert refused(rows, [field]).tolist() == [_is_refused(row) for row in rows]


def _is_refused(row):
    try:
        scenario_of_row(row)
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
