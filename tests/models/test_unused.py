"""What is said of a scenario's fields that nothing uses."""

import pytest

from cointoss.models.reading import load, parse
from cointoss.models.scenario import Scenario
from cointoss.models.unused import UnusedFieldWarning, unused_fields
from tests.helpers.draws import scenario

COIN = "[coin]\nmass = 0.002\nradius = 0.0125\nthickness = 0.002\n[release]\nposition = [0, 0, 0.4]\n"

SAID = [
    ({}, {}, []),
    ({"friction": 0.3}, {}, ['floor.friction = 0.3: not used with contact = "smooth"; "sliding_']),
    ({"contact": "knurled", "friction": 0.3}, {}, ['floor.friction = 0.3: not used with contact = "knurl']),
    ({"contact": "coulomb", "friction": 0.3}, {}, []),
    ({"contact": "sliding_friction", "friction": 0.3}, {}, []),
    ({"contact": "coulomb"}, {}, ['floor.friction = 0: contact = "coulomb" is then without friction; give ']),
    ({"contact": "sliding_friction"}, {}, ['floor.friction = 0: contact = "sliding_friction" is then ']),
    ({"restitution_threshold": 0.01}, {}, []),
    (
        {"restitution_threshold": 0.01, "restitution": 0},
        {},
        ["floor.restitution_threshold = 0.01: not used with restitution = 0; a restitution > 0 uses it"],
    ),
    ({"restitution_speed": 2}, {}, ["floor.restitution_speed = 2: not used with restitution_exponent = 0"]),
    ({"restitution_speed": 2, "restitution_exponent": 0.25}, {}, []),
    ({}, {"exponent": 1}, ["air.exponent = 1: not used without air; normal > 0 or"]),
    ({}, {"exponent": 1, "normal": 0.8}, []),
    ({}, {"exponent": 1, "tangential": 0.2}, []),
    ({"friction": 0.3}, {"exponent": 0.5}, ["floor.friction = 0.3: ", "air.exponent = 0.5: "]),
]


@pytest.mark.parametrize(("floor", "air", "said"), SAID)
def test_a_field_that_nothing_uses_is_named_with_its_value_and_what_uses_it(floor, air, said):
    case = scenario(floor={"restitution": 0.8, "contact": "smooth"} | floor, air=air)
    lines = unused_fields(case.floor, case.air)
    assert [line[: len(start)] for line, start in zip(lines, said, strict=True)] == said


def test_it_is_said_where_a_scenario_is_loaded_or_made_and_neither_where_it_is_read_nor_where_it_changes(
    tmp_path,
):
    text = COIN + '[floor]\nrestitution = 0.8\ncontact = "smooth"\nfriction = 0.3\n'
    source = tmp_path / "coin.toml"
    source.write_text(text)
    with pytest.warns(UnusedFieldWarning, match=r"^floor\.friction = 0\.3: not used"):
        loaded = load(source)
    with pytest.warns(UnusedFieldWarning, match=r"^floor\.friction = 0\.3: not used") as warned:
        assert Scenario(**loaded.as_tables()) == loaded
    assert [warning.filename for warning in warned] == [__file__]
    # Warnings are errors.
    assert parse(text, "coin.toml") == loaded
    loaded.replace("floor.friction", 0.2)
