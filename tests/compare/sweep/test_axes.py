"""Axes of a map: what is read, with which units, and every way to get one wrong."""

import numpy as np
import pytest

from cointoss.compare.shares.show import texts_of
from cointoss.compare.sweep.axes import Span, axis_given, parse_axis
from cointoss.compare.sweep.errors import SweepError
from cointoss.models.fields import FIELDS, UNITS, WORDED
from cointoss.models.reading import load
from cointoss.models.unlikely import UnitWarning
from tests.helpers.basin_runs import TUMBLING
from tests.helpers.draws import scenario


def test_every_number_of_a_scenario_but_the_inertia_can_vary():
    numbers = {field for field in FIELDS if not field.startswith("coin.inertia.")} - WORDED.keys()
    assert UNITS.keys() == numbers


@pytest.mark.filterwarnings(f"ignore::{UnitWarning.__module__}.UnitWarning")
@pytest.mark.parametrize(("field", "unit"), [pair for pair in UNITS.items() if pair[1]])
def test_a_value_may_be_given_in_the_unit_of_its_field(field, unit):
    assert parse_axis(f"{field}=0.3 {unit}:9:2", TUMBLING).start == pytest.approx(0.3, rel=1e-15)


@pytest.mark.parametrize(
    ("case", "axis", "unit", "values"),
    [
        (TUMBLING, "release.position.z=20 cm:0.6:5", "m", ["0.2", "0.3", "0.4", "0.5", "0.6"]),
        (TUMBLING, "floor.restitution=60 %:0.9:2", "", ["0.6", "0.9"]),
        (TUMBLING, "floor.restitution=0.8:0.2:3", "", ["0.8", "0.5", "0.2"]),
        (TUMBLING, "floor.restitution=0.5:0.50000002:3", "", ["0.5", "0.50000001", "0.50000002"]),
        (TUMBLING, "release.angular_velocity.eta=5:-5:3", "rad/s", ["5", "0", "-5"]),
        (TUMBLING, "ending.max_impacts=1:9:5", "", ["1", "3", "5", "7", "9"]),
        (scenario(air={"exponent": 0.5}), "air.normal=1:2:2", "kg*m**-2.5*s**-0.5", ["1", "2"]),
    ],
)
def test_an_axis_has_as_many_values_as_asked_for_with_both_ends(case, axis, unit, values):
    found = parse_axis(axis, case)
    assert (found.field, found.unit) == (axis.partition("=")[0], unit)
    assert texts_of(found.values) == values


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
    ("field", "given", "said"),
    [
        ("floor.restitution", (0.2, 0.6, 1), "N = 1; accepted: a whole number from 2"),
        ("floor.restitution", (0.2, 0.6, 1_000_001), "accepted: a whole number from 2 to 1000000"),
        ("floor.restitution", (0.2, np.nextafter(0.2, 1), 4), "not 4 numbers between both"),
        ("floor.restitution", (0.2, 0.2, 4), "START = STOP"),
        ("floor.restitution", [0.2, 0.4, 0.6001], "values that are not evenly spaced"),
        ("floor.restitution", [[0.2, 0.4]], "or two or more evenly spaced values"),
        ("ending.max_impacts", (1, 9, 4), "that give whole numbers only"),
    ],
)
def test_what_is_no_axis_is_refused(field, given, said):
    with pytest.raises(SweepError, match=said):
        axis_given(field, given, load("fig24a"))
