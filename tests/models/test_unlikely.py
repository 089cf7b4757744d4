"""Numbers that were probably meant in another unit."""

import numpy as np
import pytest

from cointoss import Coin, Scenario, load, parse
from cointoss.models.errors import ScenarioError
from cointoss.models.sources import scenario_text
from cointoss.models.unlikely import UnitWarning, unlikely_units

TABLE = load("table")


def questioned(case, **other):
    """Return the fields that are questioned, with other numbers in place of a scenario's."""
    numbers = {name.replace("_", ".", 1): number for name, number in other.items()}
    return list(unlikely_units(case.gravity, case.coin, case.release, case.ending, numbers))


@pytest.mark.parametrize(
    ("numbers", "fields"),
    [
        ({"coin_radius": 11.625}, ["coin.radius"]),
        ({"coin_thickness": 2.33}, ["coin.thickness"]),
        ({"coin_mass": 7.5}, ["coin.mass"]),
        (
            {"coin_radius": 11.625, "coin_thickness": 2.33, "coin_mass": 7.5},
            ["coin.radius", "coin.thickness", "coin.mass"],
        ),
        ({"coin_radius": 12.0, "coin_thickness": 0.0}, ["coin.radius"]),
        ({"coin_mass": 2.0, "coin_thickness": 0.0}, ["coin.mass"]),
        ({"ending_caught": 300.0}, ["ending.caught"]),
        ({"hand_height": 1000.0}, ["hand.height"]),
        ({"release_position.z": 20.0}, ["release.position.z"]),
        ({"release_position.z": 9.0}, []),
        # A steel wheel, a coin of 3 cm on its edge, a foil, and what no scenario accepts.
        ({"coin_radius": 0.6, "coin_thickness": 0.05, "coin_mass": 450.0}, []),
        ({"coin_thickness": 0.03}, []),
        # 1.25 cm, and light discs: read in mm they would be heavier than any metal.
        ({"coin_radius": 1.25}, ["coin.radius"]),
        ({"coin_radius": 1.0, "coin_thickness": 0.1, "coin_mass": 5.0}, []),
        ({"coin_radius": 0.5, "coin_thickness": 0.05, "coin_mass": 0.589}, []),
        ({"coin_thickness": 1e-7}, []),
        ({"coin_radius": 0.0}, []),
        ({"coin_mass": -1.0}, []),
    ],
)
def test_lengths_in_mm_and_a_mass_in_g_are_questioned_where_no_coin_is_so_light_or_heavy(numbers, fields):
    assert questioned(TABLE, **numbers) == fields


@pytest.mark.parametrize(
    ("moments", "center", "is_questioned"),
    [
        # At most m (r² + h²/4) about a diameter and m r² about the axis: all mass at the rims.
        ((1.0, 1.0, 2e-5), (0.0, 0.0, 0.0), "diameter"),
        ((1.01 * 1.0077e-5, 1.01 * 1.0077e-5, 1e-8), (0.0, 0.0, 0.0), "diameter"),
        ((0.99 * 1.0077e-5, 0.99 * 1.0077e-5, 1e-8), (0.0, 0.0, 0.0), ""),
        ((5e-6, 6e-6, 1.01 * 1.0017e-5), (0.0, 0.0, 0.0), "axis"),
        ((5e-6, 6e-6, 0.99 * 1.0017e-5), (0.0, 0.0, 0.0), ""),
        # About the centre of mass 9 mm beside the middle m (9 mm)² is gone.
        ((5e-6, 6e-6, 0.99 * 1.0017e-5), (0.009, 0.0, 0.0), "axis"),
    ],
)
def test_an_inertia_is_questioned_that_no_body_in_the_cylinder_has(moments, center, is_questioned):
    inertia = np.diag(moments).tolist()
    coin = Coin(mass=0.01, radius=0.03165, thickness=0.0049, center_of_mass=center, inertia=inertia)
    doubted = unlikely_units(9.81, coin, TABLE.release, TABLE.ending).get("coin.inertia", "")
    assert (bool(doubted), is_questioned in doubted) == (bool(is_questioned), True)


def test_a_radius_in_cm_is_asked_for_in_cm():
    doubted = unlikely_units(9.81, TABLE.coin, TABLE.release, TABLE.ending, {"coin.radius": 1.25})
    assert doubted["coin.radius"].startswith('coin.radius = 1.25 m: is it cm? write "1.25 cm";')


def test_a_scenario_in_units_of_its_own_is_not_questioned():
    scaled = load("fig21")
    assert (scaled.gravity, scaled.coin.radius, scaled.release.position[2]) == (1.0, 1.0, 200.0)
    assert questioned(scaled, coin_radius=1e3) == []
    assert questioned(scaled.replace("gravity", 9.81)) == ["release.position.z"]


def test_whoever_makes_a_scenario_is_asked(tmp_path):
    file = tmp_path / "high.toml"
    file.write_text(scenario_text("fig24a").replace("0.40001", "300"))
    asked = r'^release\.position\.z = 300 m: is it mm\? write "300 mm"$'
    with pytest.warns(UnitWarning, match=asked):
        high = load(file)
    with pytest.warns(UnitWarning, match=asked):
        Scenario(**high.as_tables())
    assert high == parse(high.to_toml(), "high")


def test_where_the_number_makes_no_scenario_the_refusal_asks():
    with pytest.raises(ScenarioError, match=r"^coin\.radius = 12 m: is it mm\? .* kg/m³; release\.pos"):
        load("fig24a").replace("coin.radius", 12)
