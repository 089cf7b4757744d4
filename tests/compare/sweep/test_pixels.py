"""Sweeps: axes are read, tiles cover the map, and each pixel is the toss of its own scenario, to the bit."""

import warnings
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from pydantic import BaseModel

from cointoss import analytic, coin_mj
from cointoss.coin_mj import Realisation, Settings
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import grid, run
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.compare.sweep.grid import Sweep, Tile, cut, gaps, tile_shape, tiles
from cointoss.compare.sweep.pixels import Pixels, check, pixel_scenario, toss_pixels
from cointoss.models.fields import UNITS, split
from cointoss.models.records import UnsupportedError
from cointoss.models.scenario import Scenario
from cointoss.models.unused import UnusedFieldWarning
from tests.helpers import basin_runs
from tests.helpers.draws import AIR, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

HERE = scenario(
    coin={"center_of_mass": [1e-4, 0, 0]},
    air=AIR,
    floor={"restitution": 0.4},
    release={"angles": [0.1, 0.2, 0.3], "angular_velocity": [1.0, 30.0, 2.0]},
    ending={"max_impacts": 12},
)
WHOLE = Tile(slice(0, 3), slice(0, 4))


def sweep_of(x: str, y: str, case: Scenario = HERE, **given: Any) -> Sweep:
    return basin_runs.sweep_of(x, y, case, **given)


def numeric_fields(model: type[BaseModel], path: str = "") -> set[str]:
    """Walk through the scenario's tables for keys with a number or a list of numbers."""
    found = set()
    for name, field in model.model_fields.items():
        annotation = field.annotation
        if isinstance(annotation, type) and issubclass(annotation, BaseModel):
            found |= numeric_fields(annotation, f"{name}.")
        elif any(kind in str(annotation) for kind in ("float", "int")):
            found.add(path + name)
    return found


def test_every_numeric_field_but_the_inertia_can_vary():
    keys = {".".join(part for part in split(field)[:2] if part) for field in UNITS}
    assert keys == numeric_fields(Scenario) - {"coin.inertia"}


@pytest.mark.parametrize("field", UNITS)
def test_a_value_lands_in_its_field_alone_with_its_unit(field):
    case = HERE.replace("ending.caught", 1.0)
    if "quaternion" in field:
        case = scenario(release={"quaternion": [0.5, 0.5, 0.5, 0.5]})
    table, key, index = split(field)

    def value(of: Scenario) -> Any:
        entry = getattr(getattr(of, table) if table else of, key)
        return entry if index is None else entry[index]

    # Near the value that is there, so that the scenario stays valid; a count stays whole.
    new = value(case) + (1 if field == "ending.max_impacts" else 1e-4)
    changed = case.replace(field, new)
    assert value(changed) == (pytest.approx(new, rel=1e-3) if "quaternion" in field else new)
    back = changed.replace(field, value(case))
    if "quaternion" not in field:  # whose other components are brought to norm 1
        assert back == case
    if UNITS[field]:
        as_text = f"{new!r} {UNITS[field]}"
        assert parse_axis(f"{field}={as_text}:9:2", case).start == pytest.approx(new, rel=1e-15)


def test_an_axis_includes_both_ends_and_takes_units():
    axis = parse_axis("release.position.z=20 cm:0.6:5", HERE)
    assert axis == Axis(field="release.position.z", unit="m", start=0.2, stop=0.6, count=5)
    assert axis.values.tolist() == pytest.approx([0.2, 0.3, 0.4, 0.5, 0.6], rel=1e-15)
    assert parse_axis("floor.restitution=60 %:0.9:2", HERE).values.tolist() == [0.6, 0.9]
    assert parse_axis("release.angular_velocity.eta=5:-5:3", HERE).values.tolist() == [5, 0, -5]
    assert parse_axis("ending.max_impacts=1:9:5", HERE).values.tolist() == [1, 3, 5, 7, 9]
    drag = scenario(air={"exponent": 0.5, "normal": 0.1})
    assert parse_axis("air.normal=1:2:2", drag).unit == "kg*m**-2.5*s**-0.5"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("floor.contact=1:2:3", r"floor\.contact: no numeric field .*floor\.restitution, .*floor\.friction"),
        ("floor.restitutoin=0:1:3", r"did you mean floor\.restitution\?"),
        ("release.position=0:1:3", r"did you mean release\.position\.[xyz]\?"),
        ("coin.inertia=0:1:3", "no numeric field"),
        ("gravity=9:9:3", "START = STOP"),
        ("gravity=9:900 cm/s**2:3", "START = STOP"),
        ("gravity=9:10:1", "N = 1; accepted: a whole number from 2 to 1000000"),
        ("gravity=9:10:1e3", "N = 1e3; accepted"),
        ("gravity=9:10:2000000", "N = 2000000; accepted"),
        ("gravity=9:10", "accepted: FIELD=START:STOP:N"),
        ("gravity", "accepted: FIELD=START:STOP:N"),
        ("gravity=fast:10:3", r"gravity = fast: accepted: a number in m/s\*\*2"),
        ("gravity=9 kg:10:3", "gravity = 9 kg: accepted"),
        ("gravity=nan:10:3", "a finite number"),
        ("ending.max_impacts=1:4:3", "whole numbers only"),
    ],
)
def test_a_wrong_axis_is_refused_with_what_is_accepted(text, said):
    with pytest.raises(SweepError, match=said):
        parse_axis(text, HERE)


@pytest.mark.parametrize("shape", [(2, 2), (300, 500), (2, 100_000), (100_000, 3), (129, 127)])
@pytest.mark.parametrize("x", ["release.position.z=1:2:{}", "gravity=9:10:{}"])
@pytest.mark.parametrize("y", ["release.velocity.z=1:2:{}", "floor.friction=1:2:{}"])
def test_tiles_cover_the_map_once_and_are_of_the_size_agreed(shape, x, y):
    sweep = sweep_of(x.format(shape[1]), y.format(shape[0]))
    tile = tile_shape(sweep)
    assert tile[0] * tile[1] <= grid.TILE_TOSSES[Engine.ANALYTIC]
    # No smaller than it must be: whole rows and columns that would fit aside, half of what is allowed.
    assert tile[0] * tile[1] >= min(shape[0] * shape[1], grid.TILE_TOSSES[Engine.ANALYTIC]) / 2
    covered = np.zeros(shape, dtype=int)
    for rows, columns in tiles(shape, tile):
        covered[rows, columns] += 1
    assert np.all(covered == 1)


def test_a_large_map_has_no_more_tiles_than_a_folder_holds():
    slow = sweep_of("release.position.z=1:2:1000", "air.exponent=1:2:1000")
    assert len(list(tiles(slow.shape, tile_shape(slow)))) <= 2 * grid.MOST_TILES
    assert np.prod(tile_shape(sweep_of("release.position.z=1:2:100", "air.exponent=1:2:100"))) <= 64


@pytest.mark.parametrize("along_x", [True, False])
@pytest.mark.parametrize("pixels", [1, 2, 3, 5, 7, 14, 1000])
def test_a_tile_is_cut_into_parts_that_cover_it_once(pixels, along_x):
    left, covered, order = [Tile(slice(2, 6), slice(1, 6))], np.zeros((7, 7), dtype=int), []
    while left:
        part, rest = cut(left[0], pixels, along_x=along_x)
        assert 1 <= covered[part].size <= pixels
        covered[part] += 1
        order.append(part)
        left = rest + left[1:]
    assert np.all(covered[2:6, 1:6] == 1)
    assert covered.sum() == 20
    if pixels == 3:
        first = (slice(2, 3), slice(1, 4)) if along_x else (slice(2, 5), slice(1, 2))
        assert order[0] == Tile(*first)


def test_the_gaps_of_a_tile_hold_what_is_not_tossed_whatever_was_tossed_first():
    tile, tossed = Tile(slice(10, 14), slice(20, 25)), np.zeros((4, 5), dtype=bool)
    assert gaps(tile, tossed) == [tile]
    tossed[0], tossed[1, :2] = True, True
    assert gaps(tile, tossed) == [
        Tile(slice(11, 12), slice(22, 25)),
        Tile(slice(12, 14), slice(20, 25)),
    ]
    tossed[:, :2] = True
    assert gaps(tile, tossed) == [Tile(slice(11, 14), slice(22, 25))]
    tossed[:] = True
    assert gaps(tile, tossed) == []
    tossed[3, 1] = tossed[3, 3] = False
    assert gaps(tile, tossed) == [Tile(slice(13, 14), slice(21, 24))]


@pytest.mark.parametrize(("cost", "most"), [(1e-5, 1 << 14), (4e-3, 250), (3.0, 8)])
def test_a_tile_is_tossed_in_parts_of_a_second(monkeypatch, cost, most):
    sweep, now, sizes = sweep_of("release.position.z=1:2:128", "release.velocity.z=1:2:128"), [0.0], []

    def toss(_, part):
        size = (part.rows.stop - part.rows.start) * (part.columns.stop - part.columns.start)
        now[0] += cost * size
        sizes.append(size)
        return Pixels(np.zeros(size, np.int8), np.zeros(size, np.int32), None)

    class Clock:
        working_time = property(lambda _: now[0])

    monkeypatch.setattr(run, "toss_pixels", toss)
    monkeypatch.setattr(run, "compiling", Clock())
    whole = Tile(slice(0, 128), slice(0, 128 if cost < 1 else 2))
    tossed = list(run.toss_here(sweep, [whole]))
    assert sum(sizes) == 128 * (whole.columns.stop)
    assert len(tossed) == len(sizes)
    assert max(sizes) <= most
    # None takes much longer than a second, once the cost is known; and a cheap map has few parts.
    assert all(size * cost <= run.SECOND * 1.01 or size == 1 for size in sizes[1:])
    assert cost > 1e-4 or len(sizes) <= 6


def test_a_tile_is_long_along_the_release_where_the_coin_varies_across():
    across = sweep_of("gravity=9:10:500", "release.position.z=1:2:20000")
    assert tile_shape(across) == (1 << 14, 1)
    along = sweep_of("release.position.z=1:2:20000", "gravity=9:10:500")
    assert tile_shape(along) == (1, 1 << 14)


@pytest.mark.parametrize(
    ("x", "y"),
    [
        ("release.angular_velocity.eta=20:60:4", "release.position.z=0.2:0.6:3"),
        ("release.angles.theta=0.1:3:4", "release.angles.psi=-1:1:3"),
        ("floor.restitution=0.2:0.6:4", "release.velocity.x=0:1:3"),
        ("release.velocity.z=0:1:4", "coin.thickness=0:3 mm:3"),
        ("coin.mass=1 g:5 g:4", "air.normal=0:0.8:3"),
    ],
)
@pytest.mark.parametrize("after", [None, 0, 2])
def test_each_pixel_is_its_own_toss_to_the_bit(x, y, after):
    assert_each_pixel_is_its_own_toss(x, y, after)


def test_each_pixel_of_a_largest_number_of_impacts_is_its_own_toss_to_the_bit():
    assert_each_pixel_is_its_own_toss("gravity=1:20:4", "ending.max_impacts=1:9:3", None)


def assert_each_pixel_is_its_own_toss(x, y, after):
    sweep = sweep_of(x, y, after=after)
    pixels = toss_pixels(sweep, WHOLE)
    assert pixels.outcome.shape == (3, 4)
    for i, at_y in enumerate(sweep.y.values):
        for j, at_x in enumerate(sweep.x.values):
            given = [
                (axis.field, int(at) if axis.field == "ending.max_impacts" else at)
                for axis, at in ((sweep.x, at_x), (sweep.y, at_y))
            ]
            toss = analytic.toss(sweep.scenario.replace(*given[0], *given[1]))
            if after is None or len(toss.impacts) <= after:
                assert pixels.outcome[i, j] == toss.outcome
                assert pixels.impacts[i, j] == len(toss.impacts)
            else:
                assert pixels.outcome[i, j] == toss.impacts.face[after]
                assert pixels.impacts[i, j] == after + 1


def test_the_impacts_of_the_last_digit_are_those_of_one_toss():
    """Long tosses multiply a difference in the last digit: their numbers of impacts would tell."""
    case = scenario(floor={"restitution": 0.9}, release={"angular_velocity": [3.0, 40.0, 5.0]})
    sweep = sweep_of("release.angles.theta=0.1:3:4", "release.angles.phi=-1:1:3", case)
    pixels = toss_pixels(sweep, WHOLE)
    for i, at_y in enumerate(sweep.y.values.tolist()):
        for j, at_x in enumerate(sweep.x.values.tolist()):
            toss = analytic.toss(pixel_scenario(sweep, at_y, at_x))
            assert (pixels.outcome[i, j], pixels.impacts[i, j]) == (toss.outcome, len(toss.impacts))
    assert pixels.impacts.max() > 1000


def test_a_part_of_a_map_is_that_part_of_the_whole():
    sweep = sweep_of("floor.restitution=0.2:0.6:4", "release.position.z=0.2:0.6:3")
    whole, part = toss_pixels(sweep, WHOLE), toss_pixels(sweep, Tile(slice(1, 3), slice(2, 4)))
    assert np.array_equal(part.outcome, whole.outcome[1:3, 2:4])
    assert np.array_equal(part.impacts, whole.impacts[1:3, 2:4])


def test_both_engines_agree_at_the_first_touch():
    case = scenario(coin={"thickness": 0.0})
    maps = [
        toss_pixels(
            sweep_of(
                "release.angular_velocity.eta=20:60:4",
                "release.position.z=0.2:0.6:3",
                case,
                engine=engine,
                after=0,
            ),
            WHOLE,
        )
        for engine in Engine
    ]
    assert np.array_equal(maps[0].outcome, maps[1].outcome)
    assert len(np.unique(maps[0].outcome)) == 2
    assert np.all(maps[1].impacts == 1)


@pytest.mark.parametrize(
    ("x", "y", "said"),
    [
        ("release.position.z=-1:1:4", "gravity=9:10:3", r"release\.position\.z = -1.*above the floor"),
        # Flat it is clear of the floor, and upright again: in between it is not.
        ("release.angles.theta=0:3.14159:21", "release.position.z=2 mm:1:3", r"\(at release\.angles\.theta"),
        ("floor.restitution=0.5:1.5:4", "release.position.z=0.2:1:3", r"floor\.restitution = 1\.5"),
        ("coin.radius=1 cm:10 m:4", "release.position.x=0:1:3", r"above the floor.*coin\.radius = \d"),
        ("release.angular_velocity.xi=0:1e8:4", "release.position.x=0:1:3", r"angular_velocity.*spin of at"),
        ("release.quaternion.e0=1:0.9:4", "release.position.x=0:1:3", "either angles or quaternion"),
        ("coin.center_of_mass.xi=-2 cm:2 cm:4", "release.position.x=0:1:3", "center_of_mass"),
        ("release.velocity.x=0:2e9:4", "release.position.x=0:1:3", r"release\.velocity"),
    ],
)
def test_a_pixel_that_is_no_scenario_is_refused_before_the_first_toss(x, y, said):
    with pytest.raises(SweepError, match=said):
        check(sweep_of(x, y))


def test_euler_parameters_off_norm_are_refused_inside_an_axis():
    case = scenario(release={"quaternion": [1.0, 0, 0, 0]})
    check(sweep_of("release.quaternion.e1=-0.01:0.01:9", "release.position.x=0:1:3", case))
    with pytest.raises(SweepError, match="norm 1 within 1e-3"):
        check(sweep_of("release.quaternion.e1=0:0.1:9", "release.position.x=0:1:3", case))


def test_what_mujoco_cannot_toss_is_refused_at_either_end_of_an_axis():
    axes = ("floor.restitution=0.5:0:4", "release.position.z=0.2:1:3")
    check(sweep_of(*axes))
    with pytest.raises(UnsupportedError, match=r"floor\.restitution = 0"):
        check(sweep_of(*axes, engine=Engine.MUJOCO))
    one_step = replace(coin_mj.MANY, contact=Realisation.ONE_STEP)
    check(sweep_of(*axes, engine=Engine.MUJOCO, settings=one_step))


def test_a_field_that_a_map_varies_is_one_that_is_used():
    rough = scenario(floor={"contact": "coulomb"})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check(sweep_of("floor.friction=0:0.5:3", "release.position.z=0.3:0.4:3", rough))
        check(sweep_of("floor.friction=-0.0:0.5:2", "floor.restitution=0.5:0:2", rough))
    z = "release.position.z=0.3:0.4:3"
    for case, x, y in ((HERE, "floor.friction=0.5:0:3", z), (rough, "gravity=9:10:2", z)):
        with pytest.warns(UnusedFieldWarning, match=r"^floor\.friction = "):
            check(sweep_of(x, y, case))


@pytest.mark.parametrize("contact", ["spring", "one_step"])
def test_a_pixel_by_mujoco_is_the_toss_with_the_settings_that_its_map_records(contact):
    axes = ("release.angular_velocity.eta=20:40:2", "release.position.z=0.2:0.3:2")
    chosen = replace(coin_mj.MANY, contact=Realisation(contact))
    sweep = sweep_of(*axes, engine=Engine.MUJOCO, settings=chosen)
    made = toss_pixels(sweep, Tile(slice(0, 2), slice(0, 2)))
    recorded: dict[str, Any] = sweep.settings.as_dict()
    assert recorded["contact"] == contact
    for row, y in enumerate(sweep.y.values):
        for column, x in enumerate(sweep.x.values):
            one = coin_mj.toss(pixel_scenario(sweep, y, x), settings=Settings(**recorded))
            assert made.outcome[row, column] == one.outcome
            assert made.impacts[row, column] == len(one.impacts) > 0


def test_axes_that_exclude_each_other_are_refused():
    with pytest.raises(SweepError, match="on both axes"):
        sweep_of("gravity=9:10:3", "gravity=8:9:3")
    with pytest.raises(SweepError, match="max_impacts"):
        sweep_of("gravity=9:10:3", "ending.max_impacts=1:3:3", after=1)
