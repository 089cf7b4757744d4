"""`Scenario.replace`: it makes what a file with the same values would, or refuses it likewise."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cointoss.models.errors import ScenarioError
from cointoss.models.fields import UNITS
from cointoss.models.parts import Air, Coin, Release
from cointoss.models.scenario import Scenario
from tests.helpers.draws import AIR, ZLOTY, draw_quaternion, scenario

HERE = scenario(
    coin={"center_of_mass": [1e-4, 2e-4, 3e-4]},
    air=AIR,
    floor={"restitution": 0.4, "friction": 0.1},
    release={"velocity": [1.0, 2.0, 3.0], "angles": [0.1, 0.2, 0.3], "angular_velocity": [1.0, 30.0, 2.0]},
    ending={"max_impacts": 12},
)


def test_several_fields_are_replaced_and_no_other():
    changed = HERE.replace("floor.restitution", 0.5, "release.position.z", "20 cm", "ending.max_impacts", 3)
    assert (changed.floor.restitution, changed.release.position, changed.ending.max_impacts) == (
        0.5,
        (0, 0, 0.2),
        3,
    )
    assert changed.replace("floor", HERE.floor, "release", HERE.release, "ending", HERE.ending) == HERE


def test_a_part_is_given_as_a_table_or_as_itself():
    coin = {**ZLOTY, "thickness": "1 mm"}
    assert HERE.replace("coin", coin) == HERE.replace("coin", Coin(mass=2e-3, radius=1.25e-2, thickness=1e-3))
    assert HERE.replace("air", {}) == HERE.replace("air", Air())
    assert HERE.replace("air", {"normal": 1}).air == Air(normal=1)


def test_a_drag_coefficient_takes_the_place_of_pressure_and_exponent():
    by_drag = HERE.replace("air.drag_coefficient", "110 %").air
    assert by_drag == Air(exponent=1, normal=1.2 * 1.1 / 2, tangential=HERE.air.tangential)
    thin = HERE.replace("air.drag_coefficient", 1.1, "air.density", "1 g/l").air
    assert (thin.exponent, thin.normal) == (1, pytest.approx(0.55))


def test_a_component_is_replaced_in_what_was_given_before_it():
    release = Release(position=(0.0, 0.0, 1.0))
    assert HERE.replace("release", release, "release.position.x", 2).release.position == (2, 0, 1)
    changed = HERE.replace("release.velocity", np.array([4.0, 5.0, 6.0]), "release.velocity.y", "7 m/s")
    assert changed.release.velocity == (4, 7, 6)
    bare = HERE.replace("release", {"position": [0, 0, 1]}, "release.angular_velocity.eta", 3)
    assert bare.release.angular_velocity == (0, 3, 0)


@given(st.integers(0, 2**32 - 1))
def test_a_quaternion_takes_the_place_of_the_angles_and_keeps_its_digits(seed):
    e = draw_quaternion(np.random.default_rng(seed))
    turned = HERE.replace("release.quaternion", e)
    assert turned.release.angles is None
    assert turned.release == Release.model_validate(
        {**HERE.release.model_dump(), "angles": None, "quaternion": e}
    )
    # It is of norm 1 within rounding by now, and stays as it is.
    assert turned.replace("floor.restitution", 0.5).release.quaternion == turned.release.quaternion
    assert turned.replace("release.angles", HERE.release.angles) == HERE


@given(st.sampled_from(sorted(UNITS)), st.floats(-2, 2))
def test_what_is_made_is_what_the_same_values_in_a_file_would_be(field, value):
    data: dict[str, Any] = {}
    *tables, key = field.split(".")
    for name, part in HERE.model_dump(exclude_none=True).items():
        data[name] = dict(part) if isinstance(part, dict) else part
    if len(tables) == 2:
        table, whole = tables
        names = ["xi", "eta", "zeta", "x", "y", "z", "psi", "theta", "phi", "e0", "e1", "e2", "e3"]
        entries = list(data[table].get(whole, (1.0, 0.0, 0.0, 0.0)))
        entries[names.index(key) % 3 if whole != "quaternion" else int(key[1])] = value
        data[table][whole] = entries
    else:
        (data[tables[0]] if tables else data)[key] = value
    try:
        expected = Scenario.model_validate(data)
    except ValueError:
        with pytest.raises(ScenarioError, match="accepted: "):
            HERE.replace(field, value)
    else:
        assert HERE.replace(field, value) == expected


def test_a_field_without_its_value_is_refused():
    with pytest.raises(TypeError, match=r"floor\.friction without a value"):
        HERE.replace("floor.restitution", 0.5, "floor.friction")


def test_nothing_copies_a_part_with_values_that_no_one_checks():
    for part, update in ((HERE.floor, {"contact": "coulomb"}), (HERE, {"gravity": -1.0})):
        with pytest.raises(TypeError, match=r"accepted: .*Scenario\.replace"):
            part.model_copy(update=update)
    assert HERE.model_copy() == HERE == HERE.model_copy(deep=True)
