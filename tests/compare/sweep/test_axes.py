"""Axes of a map: what is read, with which units, and every way to get one wrong."""

import pytest
from pydantic import BaseModel

from cointoss.compare.shares.show import texts_of
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.models.fields import UNITS, split
from cointoss.models.reading import load
from cointoss.models.scenario import Scenario
from cointoss.models.unlikely import UnitWarning
from tests.helpers.basin_runs import TUMBLING
from tests.helpers.draws import scenario


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


@pytest.mark.filterwarnings(f"ignore::{UnitWarning.__module__}.UnitWarning")
@pytest.mark.parametrize(("field", "unit"), [pair for pair in UNITS.items() if pair[1]])
def test_a_value_may_be_given_in_the_unit_of_its_field(field, unit):
    assert parse_axis(f"{field}=0.3 {unit}:9:2", TUMBLING).start == pytest.approx(0.3, rel=1e-15)


def test_an_axis_includes_both_ends_and_takes_units():
    axis = parse_axis("release.position.z=20 cm:0.6:5", TUMBLING)
    assert axis == Axis(field="release.position.z", unit="m", start=0.2, stop=0.6, count=5)
    assert axis.values.tolist() == pytest.approx([0.2, 0.3, 0.4, 0.5, 0.6], rel=1e-15)
    assert parse_axis("floor.restitution=60 %:0.9:2", TUMBLING).values.tolist() == [0.6, 0.9]
    assert parse_axis("release.angular_velocity.eta=5:-5:3", TUMBLING).values.tolist() == [5, 0, -5]
    assert parse_axis("ending.max_impacts=1:9:5", TUMBLING).values.tolist() == [1, 3, 5, 7, 9]
    drag = scenario(air={"exponent": 0.5, "normal": 0.1})
    assert parse_axis("air.normal=1:2:2", drag).unit == "kg*m**-2.5*s**-0.5"


def test_an_axis_has_as_many_values_as_asked_for_and_none_twice():
    close = parse_axis("floor.restitution=0.5:0.50000002:3", load("fig24a"))
    assert texts_of(close.values) == ["0.5", "0.50000001", "0.50000002"]
    assert texts_of(parse_axis("floor.restitution=0.8:0.2:3", load("fig24a")).values) == ["0.8", "0.5", "0.2"]
