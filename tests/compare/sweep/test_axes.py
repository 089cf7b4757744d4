"""Axes of a map: what is read, with which units, and every way to get one wrong."""

from typing import Any

import pytest
from pydantic import BaseModel

from cointoss.compare.shares.show import texts_of
from cointoss.compare.sweep.axes import Axis, parse_axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.fields import UNITS, split
from cointoss.models.reading import load
from cointoss.models.scenario import Scenario
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


@pytest.mark.parametrize("field", UNITS)
def test_a_value_lands_in_its_field_alone_with_its_unit(field):
    case = TUMBLING.replace("ending.caught", 1.0)
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
    axis = parse_axis("release.position.z=20 cm:0.6:5", TUMBLING)
    assert axis == Axis(field="release.position.z", unit="m", start=0.2, stop=0.6, count=5)
    assert axis.values.tolist() == pytest.approx([0.2, 0.3, 0.4, 0.5, 0.6], rel=1e-15)
    assert parse_axis("floor.restitution=60 %:0.9:2", TUMBLING).values.tolist() == [0.6, 0.9]
    assert parse_axis("release.angular_velocity.eta=5:-5:3", TUMBLING).values.tolist() == [5, 0, -5]
    assert parse_axis("ending.max_impacts=1:9:5", TUMBLING).values.tolist() == [1, 3, 5, 7, 9]
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
        parse_axis(text, TUMBLING)


def test_an_axis_has_as_many_values_as_asked_for_and_none_twice():
    with pytest.raises(SweepError, match="not 3 numbers between both; accepted: ends that are farther apart"):
        parse_axis("floor.restitution=0.5:0.5000000000000001:3", load("fig24a"))
    close = parse_axis("floor.restitution=0.5:0.50000002:3", load("fig24a"))
    assert texts_of(close.values) == ["0.5", "0.50000001", "0.50000002"]
    assert texts_of(parse_axis("floor.restitution=0.8:0.2:3", load("fig24a")).values) == ["0.8", "0.5", "0.2"]
