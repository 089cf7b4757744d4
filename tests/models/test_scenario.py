"""Scenarios: what is read, in which units, from which files, and written again."""

import math
import os
import re
import tomllib
from pathlib import Path

import numpy as np
import pytest

from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.models.errors import ScenarioError
from cointoss.models.laws import ContactLaw, EndingTest
from cointoss.models.making import MOST_IMPACTS, MOST_LOSSLESS
from cointoss.models.parts import Coin, Release
from cointoss.models.reading import load, parse
from cointoss.models.records import IMPACT_ROW
from cointoss.models.scenario import KEPT_BYTES, MOST_KEPT, Scenario, keeping_all
from cointoss.models.sources import MOST_BYTES, named_scenarios, scenario_text
from tests.helpers.draws import scenario

GOOD = Path(__file__).with_name("good.toml").read_text(encoding="utf-8")


def test_numbers_are_si_and_strings_carry_units():
    read = parse(GOOD, "good.toml")
    numbers = [read.coin.mass, read.coin.radius, *read.release.position, *(read.release.angles or ())]
    assert [*numbers, *read.release.angular_velocity] == pytest.approx(
        [2e-3, 1.25e-2, 0, 1e-3, 0.4, 0, math.radians(7), 0, 1, 40.15, 0], rel=1e-15
    )
    assert (read.floor.contact, read.ending.test) == (ContactLaw.SMOOTH, EndingTest.RIGOROUS)


def test_what_is_left_out_has_its_documented_default():
    read = parse(GOOD.replace("[air]\nnormal = 0.8", ""), "good.toml")
    assert (read.air.normal, read.air.tangential, read.air.exponent) == (0, 0, 0)
    assert (read.floor.friction, read.floor.rolling_friction, read.floor.restitution_threshold) == (0, 0, 0)
    assert read.release.velocity == read.coin.center_of_mass == (0, 0, 0)
    assert (read.floor.pivoting_friction, read.ending.max_time) == (0, 1_000_000)


POWER = {"contact": "smooth", "restitution": 0.5, "restitution_exponent": 0.25}


@pytest.mark.parametrize(
    ("floor", "lossless"),
    [
        ({"contact": "smooth", "restitution": 0.99}, False),
        ({"contact": "smooth", "restitution": 1.0}, True),
        ({"contact": "coulomb", "restitution": 0.7}, False),
        ({"contact": "coulomb", "restitution": 0.71}, True),
        ({"contact": "coulomb", "restitution": 0.95, "restitution_kind": "energetic"}, False),
        ({"contact": "perfectly_rough", "restitution": 0.5}, False),
        ({"contact": "knurled", "restitution": 0.2}, True),
        ({"contact": "smooth", "restitution": 0.5, "restitution_viscous": 0.1}, False),
        (POWER, True),
        # The power law gives back all up to 0.5⁴ m/s.
        ({**POWER, "restitution_threshold": 1.01 * 0.5**4}, False),
        ({**POWER, "restitution_threshold": 0.99 * 0.5**4}, True),
    ],
)
def test_a_toss_has_patience_where_impacts_take_energy(floor, lossless):
    assert scenario(floor=floor).rules.max_impacts == (MOST_LOSSLESS if lossless else MOST_IMPACTS)
    assert scenario(floor=floor, ending={"max_impacts": 7}).rules.max_impacts == 7


def test_a_toss_that_keeps_its_impacts_keeps_no_more_than_fit():
    assert IMPACT_ROW.itemsize + 8 * (STATE_SIZE + 4) == KEPT_BYTES
    case = scenario(ending={"max_impacts": MOST_KEPT})
    assert keeping_all(case.rules, case) == case.rules
    patient = scenario(floor={"restitution": 0.99})
    assert keeping_all(patient.rules, patient) == patient.rules._replace(max_impacts=MOST_KEPT)
    more = scenario(ending={"max_impacts": MOST_KEPT + 1})
    with pytest.raises(ScenarioError, match=r"= 1000001: .* at most 1000000 where.*0\.416 GB here"):
        keeping_all(more.rules, more)


def test_the_unit_of_lambda_follows_the_exponent():
    text = GOOD.replace("normal = 0.8", 'exponent = 0.5\nnormal = "800 g*m**-2.5*s**-0.5"')
    assert parse(text, "good.toml").air.normal == pytest.approx(0.8, rel=1e-15)


def test_a_scenario_can_be_neither_changed_nor_half_read():
    """What is refused names the field that was meant."""
    read = parse(GOOD, "good.toml")
    way = ": is frozen; accepted: a scenario with another value, as of scenario.replace"
    for part, name, said, field, given in (
        (read.floor, "friction", "Floor.friction", "floor.friction", 1),
        (read.ending, "max_time", "EndingCriteria.max_time", "ending.max_time", 1),
        (read, "gravity", "Scenario.gravity", "gravity", 1),
        (read, "body", "Scenario.body", "gravity", "..."),
        (read.coin, "colour", "Coin.colour", "coin.mass", "..."),
    ):
        with pytest.raises(AttributeError, match=re.escape(f'{said} = 1{way}("{field}", {given})')):
            setattr(part, name, 1)
        with pytest.raises(AttributeError, match=re.escape(f'del {said}{way}("{field}", ...)')):
            delattr(part, name)
    assert not read.coin.inertia_about_C.flags.writeable


def test_a_quaternion_is_brought_to_norm_one():
    read = scenario(release={"quaternion": [0.7071, 0.7071, 0, 0]})
    assert np.linalg.norm(read.release.attitude) == pytest.approx(1, abs=2e-16)


def test_the_named_scenarios_are_there_and_fig_24_is_the_papers():
    """Which coin, floor and g it does not say: the ideal coin, 2 mm thick, on a smooth floor."""
    case = load("fig24a")
    assert (case.coin.center_of_mass, case.coin.thickness) == ((0, 0, 0), 2e-3)
    assert (case.floor.contact, case.gravity) == (ContactLaw.SMOOTH, 9.81)
    assert {f"contact_{law}" for law in ContactLaw} < set(named_scenarios())
    heights = [load(f"fig24{letter}").release.position[2] for letter in "abcdef"]
    assert heights == pytest.approx([0.40001, 0.40002, 0.40003, 0.40004, 0.40005, 0.40006], rel=1e-15)


@pytest.mark.parametrize(
    ("name", "content", "says"),
    [
        ("no_such.toml", None, r"^no_such\.toml: no such file.*fig24a"),
        ("coin.toml", b"\xff\xfe\x00", r"^coin\.toml: .*accepted: a text file in UTF-8"),
        ("coin.toml", f"{GOOD}#{MOST_BYTES * '#'}".encode(), "^coin.toml: more than 65536 bytes; acc"),
        ("/dev/zero", None, "^/dev/zero: more than 65536 bytes; accepted: at most 65536 bytes of text$"),
        (".", None, r"can't be read.*accepted: a TOML file"),
        ("", None, r"\(no name\): .*accepted: a TOML file"),
        (300 * "a", None, r"name too long.*accepted: a TOML file"),
    ],
    ids=["none", "binary", "long", "endless", "folder", "unnamed", "long name"],
)
@pytest.mark.usefixtures("here")
def test_what_is_no_file_of_a_scenario_is_answered_in_a_line(name, content, says):
    if content:
        Path(name).write_bytes(content)
    with pytest.raises(ScenarioError, match=says):
        load(name)


def test_a_pipe_is_a_scenario():
    read, write = os.pipe()
    os.write(write, GOOD.encode())
    os.close(write)
    assert load(f"/dev/fd/{read}") == parse(GOOD, "good.toml")
    os.close(read)


def test_a_byte_order_mark_is_read_over(tmp_path):
    (tmp_path / "coin.toml").write_text(GOOD, encoding="utf-8-sig")
    assert load(str(tmp_path / "coin.toml")) == parse(GOOD, "good.toml")


def test_a_shipped_scenario_is_shadowed_by_a_file_of_its_name_but_by_no_folder(here):
    shipped = scenario_text("fig3_flat")
    (here / "fig3_flat").mkdir()
    assert scenario_text("fig3_flat") == shipped
    (here / "fig21").write_text("mine")
    assert scenario_text("fig21") == "mine"


def test_a_file_may_say_its_format():
    assert parse(f"format = 1\n{GOOD}", "mine.toml") == parse(GOOD, "mine.toml")
    assert "format" not in parse(GOOD, "mine.toml").as_tables()


TABLES = tomllib.loads(scenario_text("fig24a"))


def test_a_scenario_is_made_in_python():
    assert Scenario(**TABLES) == load("fig24a")
    assert Scenario.model_validate(load("zloty").as_tables()) == load("zloty")


@pytest.mark.parametrize(
    ("kind", "good", "wrong", "says"),
    [
        (
            Scenario,
            TABLES,
            {"floor": TABLES["floor"] | {"restitution": 2}},
            r"^floor\.restitution = 2: accepted: a number >= 0 and <= 1$",
        ),
        (Coin, TABLES["coin"], {"radius": "-1 cm"}, r'^radius = "-1 cm": accepted: a number >= 1e-09'),
        (Release, TABLES["release"], {"angels": (0, 0, 0)}, "did you mean angles"),
    ],
)
def test_a_scenario_made_in_python_is_refused_as_its_file_is(kind, good, wrong, says):
    with pytest.raises(ScenarioError, match=says):
        kind(**good | wrong)


@pytest.mark.parametrize("name", named_scenarios())
def test_a_scenario_is_written_as_a_file_that_is_read_as_the_same(name):
    assert parse(load(name).to_toml(), name) == load(name)


def test_every_digit_of_a_scenario_is_written():
    awkward = load("fig24a").replace(
        "gravity",
        10,
        "coin.inertia",
        np.diag([1e-7 / 3, 1e-7 / 3, 2e-7 / 3]),
        "release.quaternion",
        [0.1, 0.2, 0.3, -(0.86**0.5)],
        "release.position.z",
        np.float64(1e5),
        "ending.max_impacts",
        7,
        "ending.caught",
        0.3,
    )
    written = awkward.to_toml()
    assert parse(written, "written") == awkward
    assert written.startswith("gravity = 10.0\n\n[coin]\nmass = 0.002\n")
    assert 'contact = "smooth"\n' in written
    assert "\nmax_impacts = 7\n" in written
