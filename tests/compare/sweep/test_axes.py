"""Axes of a map: what is read, with which units, and every way to get one wrong."""

import numpy as np
import pytest
from pydantic import BaseModel

from cointoss.compare.shares.show import texts_of
from cointoss.compare.sweep.axes import Axis, Span, axis_given, parse_axis
from cointoss.compare.sweep.errors import SweepError
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


@pytest.mark.parametrize(("start", "stop"), [(10.0, 20.0), (20.0, 10.0)])
@pytest.mark.parametrize(
    ("value", "is_end"),
    [
        (10.0, True),
        (20.0, True),
        (10 + 9e-6, True),
        (20 - 9e-6, True),
        (10 + 2e-5, False),
        (20 - 2e-5, False),
    ],
)
def test_a_value_is_at_an_end_within_a_millionth_of_the_span(start, stop, value, is_end):
    assert Span(field="gravity", unit="", start=start, stop=stop).ends_at(value) is is_end


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((0.2, 0.6, 1), "N = 1; accepted: a whole number from 2"),
        ((0.2, 0.6, 1_000_001), "accepted: a whole number from 2 to 1000000"),
        ((0.2, np.nextafter(0.2, 1), 4), "not 4 numbers between both"),
        ((0.2, 0.2, 4), "START = STOP"),
        ([0.2, 0.4, 0.6001], "values that are not evenly spaced"),
        ([[0.2, 0.4]], "or two or more evenly spaced values"),
    ],
)
def test_what_is_no_axis_is_refused(given, said):
    with pytest.raises(SweepError, match=said):
        axis_given("floor.restitution", given, load("fig24a"))


def test_an_axis_of_impacts_has_whole_numbers_only():
    with pytest.raises(SweepError, match="that give whole numbers only"):
        parse_axis("ending.max_impacts=1:9:4", TUMBLING)
