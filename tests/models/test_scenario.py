"""Scenarios: what is read, in which units, and every way to get one wrong."""

import math
import os
import tomllib
from pathlib import Path

import numpy as np
import pytest

from cointoss.analytic.flight.state_vector import STATE_SIZE
from cointoss.models.errors import ScenarioError
from cointoss.models.laws import ContactLaw, EndingTest
from cointoss.models.making import MOST_IMPACTS, MOST_LOSSLESS
from cointoss.models.parts import Coin, Release
from cointoss.models.reading import MOST_BYTES, load, named_scenarios, parse, scenario_text
from cointoss.models.records import IMPACT_ROW
from cointoss.models.scenario import KEPT_BYTES, MOST_KEPT, Scenario, keeping_all
from tests.helpers.draws import scenario

GOOD = """
gravity = 9.81
[coin]
mass = "2 g"
radius = "1.25 cm"
thickness = 0.002
[air]
normal = 0.8
[floor]
restitution = 0.8
contact = "smooth"
[release]
position = [0, "1 mm", 0.4]
angles = [0, "7 deg", 0]
angular_velocity = ["1 rad/s", 40.15, 0]
[ending]
max_impacts = 20
"""


def test_numbers_are_si_and_strings_carry_units():
    read = parse(GOOD, "good.toml")
    assert read.coin.mass == pytest.approx(2e-3, rel=1e-15)
    assert read.coin.radius == pytest.approx(1.25e-2, rel=1e-15)
    assert read.release.position == (0, 1e-3, 0.4)
    assert read.release.angles == (0, pytest.approx(math.radians(7), rel=1e-15), 0)
    assert read.release.angular_velocity == (1, 40.15, 0)
    assert read.floor.contact is ContactLaw.SMOOTH
    assert read.ending.test is EndingTest.RIGOROUS


def test_what_is_left_out_has_its_documented_default():
    read = parse(GOOD.replace("[air]\nnormal = 0.8", ""), "good.toml")
    assert (read.air.normal, read.air.tangential, read.air.exponent) == (0, 0, 0)
    assert (read.floor.friction, read.floor.rolling_friction, read.floor.pivoting_friction) == (0, 0, 0)
    assert read.floor.restitution_threshold == 0
    assert read.release.velocity == (0, 0, 0)
    assert read.coin.center_of_mass == (0, 0, 0)
    assert read.ending.max_time == 1_000_000


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
    read = parse(GOOD, "good.toml")
    with pytest.raises(ValueError, match="frozen"):
        read.coin.mass = 1.0  # pyright: ignore[reportAttributeAccessIssue]
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


WRONG = """
mass = "2 g"
    mass = true -> coin.mass … True … number
    mass = [2] -> coin.mass … [2] … number
    mass = 2008-08-14 -> coin.mass … 2008-08-14 … number
    mass = -1 -> coin.mass … -1 … >= 1e-09 and <= 1e+09 in kg
    mass = 0 -> coin.mass … 0 … >= 1e-09
    mass = nan -> coin.mass … nan … finite
    mass = inf -> coin.mass … inf … finite
    mass = "2 m" -> coin.mass … "2 m" … kg
    mass = "2" -> coin.mass … "2" … kg
    mass = "heavy" -> coin.mass … "heavy" … "2 g"
    nothing -> coin.mass: missing … in kg, or a string with a unit like … "2 g"
radius = "1.25 cm"
    radius = -1 -> coin.radius … -1 … >= 1e-09
    radius = 1e200 -> coin.radius … 1e+200 … <= 1e+09
    radius = "cm" -> coin.radius … "cm" … "2 cm"
thickness = 0.002
    thickness = -0.1 -> coin.thickness … -0.1 … >= 0
    + inertia = 3 -> coin.inertia = 3 … 3 lists of 3 moments of inertia, such as [[8e-8, 0, 0], [0,
    + inertia = [1, 2, 3] -> coin.inertia[0] = 1 … a list of 3 moments of inertia, such as [8e-8, 0, 0]
    + inertia = [[1, 0], [0, 1]] -> coin.inertia = [[ … 3 lists of 3
    + center_of_mass = [0.02, 0, 0] -> coin.center_of_mass … 0.02 … inside
    + center_of_mass = [0, 0, 0.002] -> coin.center_of_mass … zeta
    + center_of_mass = [0.008, 0, 0] -> coin.center_of_mass … 0.008 … positive definite … coin.inertia
    + center_of_mass = [0, 0, 0.0006] -> coin.center_of_mass … 0.0006 … principal moment … coin.inertia
    + inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 3]] -> coin.inertia … [[1, 0, 0] … sum of the other two
    + inertia = [[1, 0, 0], [0.1, 1, 0], [0, 0, 1]] -> coin.inertia … symmetric
    + inertia = [[-1, 0, 0], [0, 1, 0], [0, 0, 1]] -> coin.inertia … positive definite
    + inertia = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] -> coin.inertia … 1e-6 to 1e6 m r^2
restitution = 0.8
    restitution = 1.5 -> floor.restitution … 1.5 … >= 0 … <= 1
    restitution = -0.1 -> floor.restitution … -0.1 … >= 0
    + friction = -1 -> floor.friction … -1 … >= 0
    + restitution_threshold = "-1 mm/s" -> floor.restitution_threshold … "-1 mm/s" … >= 0
    + restitution_threshold = "1 mm" -> floor.restitution_threshold … "1 mm" … a number in m/s
    + rolling_friction = "-1 mm" -> floor.rolling_friction … "-1 mm" … >= 0
    + pivoting_friction = inf -> floor.pivoting_friction … inf … a finite number
    + rolling_friction = "1 s" -> floor.rolling_friction … "1 s" … a number in m
    + rolling_friction = "9 mm"; pivoting_friction = "9 mm" -> rolling_friction = 0.009 … 2 sqrt(J/m) = 0.012
    + restitution_threshold = [1] -> floor.restitution_threshold = [1] … "2 m/s"
    nothing -> floor.restitution: missing … a number >= 0 and <= 1, or a string
contact = "smooth"
    contact = "knurled"; pivoting_friction = "0.1 mm" -> 0.0001 … 0 with contact = "knurled"
    + restitution_kind = "energetic" -> floor.restitution_kind … "energetic" … "kinematic" … "coulomb"
    nothing -> floor.contact: missing … accepted: one of "sharp_edge", … "coulomb"
"smooth"
    "smoth" -> floor.contact … "smoth" … "smooth" … "coulomb"
    3 -> floor.contact … 3 … "smooth"
normal = 0.8
    exponent = 2 -> air.exponent … 2 … <= 1
    normal = -0.8 -> air.normal … -0.8 … >= 0
    normal = 1e8 -> air … sqrt(g/r)
gravity = 9.81
    gravity = 0 -> gravity … 0 … >= 1e-09
    gravity = true -> gravity = True … a number in m/s**2, or
    gravity = = 9.81 -> not TOML … line 2
[0, "1 mm", 0.4]
    [0, 0.4] -> release.position = [0, 0.4] … a list of 3 lengths, such as [0, 0, 0.4]
    [0, 0, 0, 0.4] -> release.position … [0, 0, 0, 0.4] … 3
    0.4 -> release.position = 0.4 … a list of 3 lengths, such as [0, 0, 0.4]
    [0, 0, [1]] -> release.position[2] = [1] … in m, or a string with
    [0, 0, 0.001] -> release.position.z … 0.001 … above the floor
[0, "7 deg", 0]
    "7 deg" -> release.angles … a list of 3 angles, such as [0, "7 deg", 0]
angles = [0, "7 deg", 0]
    quaternion = [1, 0, 0] -> release.quaternion = [1, 0, 0] … a list of 4 numbers of norm 1, such
    + quaternion = [1, 0, 0, 0] -> release.quaternion … not both
    quaternion = [1, 1, 0, 0] -> release.quaternion … [1, 1, 0, 0] … norm 1
    quaternion = [1e308, 1e308, 0, 0] -> release.quaternion … norm 1
["1 rad/s", 40.15, 0]
    40.15 -> angular_velocity = 40.15 … a list of 3 spins, such as [0,
position = [0, "1 mm", 0.4]
    nothing -> release.position: missing … a list of 3 lengths, such as [0, 0, 0.4]
[air]
    [[air]] -> air = [{ … a table [air] with exponent,
40.15, 0]
    1e9, 0] -> release.angular_velocity … rad/s … sqrt(g/r)
0.4]
    1e12] -> release.position[2] … <= 1e+09
angles =
    angels = -> release.angels … unknown key … did you mean angles?
[floor]
    [flor] -> flor … unknown key … did you mean floor?
    [air.x] -> air.x … unknown key … exponent
max_impacts = 20
    max_impacts = 2.5 -> ending.max_impacts … 2.5 … a whole number >= 1 and <= 30000000
    max_impacts = 0 -> ending.max_impacts … 0 … >= 1
    max_time = 0 -> ending.max_time … 0 … >= 1e-09
    max_time = 5e-324 -> ending.max_time … 5e-324 … >= 1e-09
    test = "eq20" -> ending.test … "eq20" … "paper_smooth"
    caught = "1 cm" -> ending.caught = 0.01 … so that the coin is caught in flight
    caught = "-1 m" -> ending.caught
    caught = "0 m" -> ending.caught
    caught = "1 s" -> ending.caught = "1 s" … a number in m
"1.25 cm"
    "1 cm + 1 mm" -> coin.radius … "1 cm + 1 mm" … a unit
    "2 * 3 cm" -> coin.radius … "2 * 3 cm" … a unit
    "1 m 2 cm" -> coin.radius … "1 m 2 cm" … a unit
"7 deg"
    "7" -> release.angles[1] … "7" … in rad … "7 deg"
    "7 %" -> release.angles[1] … "7 %" … "7 deg"
    1e7 -> release.angles[1] … 10000000.0 … <= 1e+06
40.15
    "40 Hz" -> release.angular_velocity[1] … "40 Hz" … rad/s … deg/s … rpm
    1e300 -> release.angular_velocity … 1e+300 … sqrt(g/r)
"2 g"
    "1 g**9**9**9" -> coin.mass … "1 g**9**9**9" … like "2 g"
    "1e999999999 g" -> coin.mass … "1e999999999 g" … a number in kg
"""
"""What of `GOOD` is replaced, at the margin; below it, by what (+: a line more), and what is answered."""
LONG = {
    "x = " + 1900 * "[": ("max_impacts = 20", "nested too deeply … accepted"),
    ".".join(900 * "a") + " = 1": ("max_impacts = 20", "ending.a … unknown key"),
    ".".join(50_000 * "a") + " = 1": (
        "max_impacts = 20",
        "line 17 has 100003 characters … accepted: at most 2000",
    ),
    ".".join(20_000 * ['"\u2028"']) + " = 1": (
        "max_impacts = 20",
        "line 17 has 80003 characters … accepted: at most 2000",
    ),
    "x = " + 1900 * "9": ("max_impacts = 20", "ending.x … unknown key"),
    "x = 0x" + 1900 * "f": ("max_impacts = 20", "ending.x … unknown key"),
    '"1' + 1900 * "0" + ' g"': ('"2 g"', "coin.mass … 1000 … ..."),
    "": (GOOD, "coin … missing … mass, radius, thickness"),
}


def wrong_cases():
    """Return each case: what of `GOOD` is replaced, by what, and the words of the answer."""
    old, cases = "", [(old, new, words) for new, (old, words) in LONG.items()]
    for line in WRONG.strip().splitlines():
        new, _, words = line.strip().partition(" -> ")
        if words:
            new = f"{old}\n{new[2:]}" if new.startswith("+ ") else new.replace("nothing", "")
            cases.append((old, new.replace("; ", "\n"), words))
        else:
            old = line
    return cases


@pytest.mark.parametrize(("old", "new", "words"), wrong_cases(), ids=lambda text: text[:40])
def test_a_wrong_scenario_is_refused_by_file_field_value_and_what_is_accepted(old, new, words):
    assert old in GOOD, "the case must change something"
    with pytest.raises(ScenarioError) as caught:
        parse(GOOD.replace(old, new), "wrong.toml")
    message = str(caught.value)
    assert message.startswith("wrong.toml: ")
    assert "\n" not in message
    assert all(word in message for word in words.split(" … ")), message


def test_a_missing_file_is_answered_with_the_names_that_exist():
    with pytest.raises(ScenarioError, match=r"no_such\.toml: no such file.*fig24a"):
        load("no_such.toml")


def test_a_folder_or_a_binary_file_is_no_scenario(tmp_path):
    (tmp_path / "coin.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(ScenarioError, match="accepted: a text file in UTF-8"):
        load(str(tmp_path / "coin.toml"))
    with pytest.raises(ScenarioError, match=r"can't be read.*accepted: a TOML file"):
        load(str(tmp_path))
    with pytest.raises(ScenarioError, match=r"\(no name\): .*accepted: a TOML file"):
        load("")
    with pytest.raises(ScenarioError, match=r"name too long.*accepted: a TOML file"):
        load(300 * "a")


def test_a_file_without_an_end_is_read_to_its_bound_alone(tmp_path):
    for path in (Path("/dev/zero"), tmp_path / "coin.toml"):
        if path.parent == tmp_path:
            path.write_text(GOOD + "#" * MOST_BYTES)
        with pytest.raises(ScenarioError) as raised:
            load(path)
        assert str(raised.value) == f"{path}: more than 65536 bytes; accepted: at most 65536 bytes of text"


def test_a_pipe_is_a_scenario_and_one_that_nobody_writes_to_is_refused(tmp_path):
    os.mkfifo(tmp_path / "coin.toml")
    with pytest.raises(
        ScenarioError, match=r"coin.toml: can't be read \(a pipe that nobody writes to\); acc"
    ):
        load(tmp_path / "coin.toml")
    read, write = os.pipe()
    os.write(write, GOOD.encode())
    os.close(write)
    assert load(f"/dev/fd/{read}") == parse(GOOD, "good.toml")
    os.close(read)


def test_a_byte_order_mark_is_read_over(tmp_path):
    (tmp_path / "coin.toml").write_text(GOOD, encoding="utf-8-sig")
    assert load(str(tmp_path / "coin.toml")) == parse(GOOD, "good.toml")


def test_a_shipped_scenario_is_shadowed_by_a_file_of_its_name_but_by_no_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shipped = scenario_text("fig3_flat")
    (tmp_path / "fig3_flat").mkdir()
    assert scenario_text("fig3_flat") == shipped
    (tmp_path / "fig21").write_text("mine")
    assert scenario_text("fig21") == "mine"


def test_of_many_wrong_fields_the_first_are_named():
    keys = "".join(f"key{i} = {i}\n" for i in range(500))
    with pytest.raises(ScenarioError) as raised:
        parse(keys + GOOD, "wrong.toml")
    message = str(raised.value)
    assert message.startswith("wrong.toml: key0 = 0: unknown key; ")
    assert message.endswith(" (also wrong: key1, key2, key3, key4, key5, key6, key7, key8, and 491 more)")


def test_a_file_may_say_its_format():
    assert parse(f"format = 1\n{GOOD}", "mine.toml") == parse(GOOD, "mine.toml")
    assert "format" not in parse(GOOD, "mine.toml").as_tables()


@pytest.mark.parametrize("number", ["2", "0", "1.0", "true", '"1"', "[1]"])
def test_a_file_of_another_format_is_refused_by_its_number_alone(number):
    """What it says is not looked at: its fields may mean something else."""
    with pytest.raises(ScenarioError) as raised:
        parse(f"format = {number}\nmade_of = 'gold'\n{GOOD}", "new.toml")
    told = "1, or no such field; a newer cointoss may read others"
    assert str(raised.value) == f"new.toml: format = {number.title()}: accepted: {told}"


def test_a_scenario_made_in_python_is_refused_as_its_file_is():
    tables = tomllib.loads(scenario_text("fig24a"))
    assert Scenario(**tables) == load("fig24a")
    assert Scenario.model_validate(load("zloty").as_tables()) == load("zloty")
    tables["floor"]["restitution"] = 2
    with pytest.raises(ScenarioError, match=r"^floor\.restitution = 2: accepted: a number >= 0 and <= 1$"):
        Scenario(**tables)
    with pytest.raises(ScenarioError, match=r'^radius = "-1 cm": accepted: a number >= 1e-09'):
        Coin(**tables["coin"] | {"radius": "-1 cm"})
    with pytest.raises(ScenarioError, match="did you mean angles"):
        Release(**tables["release"] | {"angels": (0, 0, 0)})


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
