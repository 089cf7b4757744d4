"""`cointoss toss`: what it answers, in which form, and where it stops."""

import csv
import json
import math
from dataclasses import replace
from importlib.metadata import version

import pytest

from cointoss import analytic
from cointoss.compare.commands.settings import described
from cointoss.compare.output.answer import as_json
from cointoss.compare.sweep.basin import basin
from cointoss.compare.sweep.toss_many import toss_many
from cointoss.models.distribution import DISTRIBUTION
from cointoss.models.errors import ScenarioError
from cointoss.models.reading import load, parse, scenario_text
from cointoss.models.records import Ending, OtherOutcome, Outcome
from cointoss.models.scenario import MOST_KEPT, Scenario
from tests.helpers.command_line import cointoss, refused
from tests.helpers.draws import THIN, scenario


@pytest.mark.parametrize("engine", ["analytic", "mujoco"])
def test_more_impacts_than_memory_has_room_for_are_refused_before_the_toss(engine, tmp_path):
    (tmp_path / "long.toml").write_text(scenario_text("fig24a") + "\n[ending]\nmax_impacts = 30000000\n")
    said = refused("toss", tmp_path / "long.toml", "--engine", engine)
    assert "accepted: at most 1000000 where all are kept, as of one toss (12.5 GB here)" in said
    assert f"<= {MOST_KEPT}" in refused("toss", "fig24a", "--max-impacts", MOST_KEPT + 1)


def test_many_tosses_keep_no_impacts_and_may_have_more():
    case = scenario(ending={"max_impacts": 30_000_000, "max_time": 0.5})
    two = {"height": [0.4, 0.5]}
    assert toss_many(case, two).ending.values.tolist() == 2 * [str(Ending.MAX_TIME)]
    for trust in ("impacts", "certain"):
        with pytest.raises(ScenarioError, match=r"max_impacts = 30000000: .*12\.5 GB here"):
            toss_many(case, two, trust=trust)
    with pytest.raises(ScenarioError, match="max_impacts"):
        basin(case, x="gravity=9:10:2", y="coin.mass=1 g:2 g:2", trust=True)


def test_json_has_the_agreed_form():
    answered = cointoss("toss", "fig24a", "--json", "--max-impacts", 3)
    assert answered.exit_code == 0
    toss = json.loads(answered.stdout)
    of_toss = (
        "engine sequence outcome ending end_time outcome_certain other_outcome trusted_impacts trust_end "
        "trust_reason impacts contacts"
    )
    assert list(toss) == [*of_toss.split(), "scenario", "settings", "versions"]
    limited = load("fig24a").replace("ending.max_impacts", 3)
    assert Scenario.model_validate(toss["scenario"]) == limited
    assert toss["scenario"]["floor"]["restitution_kind"] == "kinematic"
    assert toss["end_time"] == toss["impacts"][-1]["time"]
    assert toss["settings"] == analytic.FINE.as_dict()
    assert toss["versions"]["cointoss"] == version(DISTRIBUTION)
    assert (toss["engine"], toss["sequence"], toss["ending"]) == ("analytic", "HHH", "max_impacts")
    assert len(toss["impacts"]) == 3
    assert (toss["trusted_impacts"], toss["trust_end"], toss["trust_reason"]) == (3, "none", "")
    # tests/test_reference reads every other field.
    assert (toss["impacts"][0]["face"], toss["impacts"][0]["flags"]) == ("H", [])


def dropped(folder, *, restitution, height, tilt):
    """Write a scenario of a thin coin that is dropped onto a smooth floor, and return its file."""
    source = folder / "dropped.toml"
    release = {"position": [0, 0, height], "angles": [0, tilt, 0]}
    source.write_text(scenario(coin=THIN, floor={"restitution": restitution}, release=release).to_toml())
    return source


def test_a_tie_is_told_with_what_decides_it(tmp_path):
    source = dropped(tmp_path, restitution=0.5, height=0.2, tilt=math.pi / 2)
    found = json.loads(cointoss("toss", source, "--json").stdout)
    other = found["other_outcome"]
    assert (found["outcome"], found["outcome_certain"]) == ("heads", False)
    assert (other["outcome"], other["after_impact"]) == ("tails", 0)
    assert 0 < other["change"] < 1e-13
    told = f"outcome   heads or tails: a change of {other['change']:.0e} at the release decides\n"
    assert told in cointoss("toss", source).stdout
    by_mujoco = json.loads(cointoss("toss", source, "--engine", "mujoco", "--json").stdout)
    assert by_mujoco["outcome_certain"] is by_mujoco["other_outcome"] is None


def test_another_outcome_is_told_with_the_impact_after_which_a_change_leads_to_it():
    other = OtherOutcome(outcome=Outcome.EDGE, change=2e-9, impact=12)
    told = as_json(replace(analytic.toss("fig24a"), other_outcome=other))["other_outcome"]
    assert told == {"outcome": "edge", "change": 2e-9, "after_impact": 12}


def test_the_answer_says_which_impact_ends_the_trust_and_why(tmp_path):
    source, three = dropped(tmp_path, restitution=0.8, height=0.2038736, tilt=1e-6), ("--max-impacts", 3)
    reason = "at impact 1 a second point lands within MuJoCo's contact"
    text = cointoss("toss", source, *three, "--engine", "mujoco").stdout
    assert f"\nsequence  |HHH\ntrusted   0 of 3 impacts: {reason}\n" in text
    toss = json.loads(cointoss("toss", source, *three, "--engine", "mujoco", "--json").stdout)
    assert (toss["trusted_impacts"], toss["trust_end"], toss["trust_reason"]) == (0, "second_point", reason)
    assert "\ntrusted   3 impacts\n" in cointoss("toss", source, *three).stdout
    cut = cointoss("toss", "fig24a", "--max-impacts", 12).stdout
    assert "\ntrusted   10 of 12 impacts: the engine's own errors could change impact 11\n" in cut


def test_a_field_may_have_another_value_by_a_part_of_its_name():
    named = (
        "--set",
        "height=40 cm",
        "--set",
        "restitution=0.5",
        "--set",
        "spin = 30",
        "--set",
        "max_impacts=2",
    )
    toss = json.loads(cointoss("toss", "fig24a", "--json", *named, "--set", "restitution=.6").stdout)
    other = ("release.position.z", 0.4, "release.spin", 30, "floor.restitution", 0.6, "ending.max_impacts", 2)
    expected = load("fig24a").replace(*other)
    assert Scenario.model_validate(toss["scenario"]) == expected
    assert [one["face"] for one in toss["impacts"]] == list(analytic.toss(expected).sequence)


@pytest.mark.parametrize(
    ("typed", "field", "value"),
    [
        ("contact=knurled", "floor.contact", "knurled"),
        ('contact = "knurled"', "floor.contact", "knurled"),
        ("angles=[0, 0.3, 0]", "release.angles", [0, 0.3, 0]),
        ('position=[0, 0, "50 cm"]', "release.position", [0, 0, 0.5]),
        ("air={normal = 0.001, exponent = 0}", "air", {"normal": 0.001, "exponent": 0}),
        ("mass=2 g", "coin.mass", 0.002),
    ],
)
def test_a_value_is_one_of_a_scenario_file(typed, field, value):
    found, text = described("fig24a", [typed])
    assert found == load("fig24a").replace(field, value) == parse(text, "changed")


@pytest.mark.parametrize(
    ("engine", "budget"),
    [("analytic", "--contact-steps"), ("mujoco", "--contact-steps"), ("mujoco", "--flight-steps")],
)
def test_a_budget_of_steps_ends_a_toss_and_says_so(tmp_path, engine, budget):
    release = {"position": [0, 0, 0.013], "angles": [0, 1.5, 0], "angular_velocity": [0, 0, 60]}
    floor = {"contact": "coulomb", "friction": 0.9, "restitution": 0.1}
    (tmp_path / "rolls.toml").write_text(scenario(coin=THIN, floor=floor, release=release).to_toml())
    answered = cointoss("toss", tmp_path / "rolls.toml", "--engine", engine, budget, 7)
    assert answered.exit_code == 0
    assert "outcome   undecided" in answered.stdout
    assert f"The toss stopped at {budget}; raise it to go on." in answered.stdout


def test_the_trajectory_is_written_as_csv(tmp_path):
    target = tmp_path / "path.csv"
    assert cointoss("toss", "fig24a", "--max-impacts", 1, "--trajectory", target).exit_code == 0
    rows = list(csv.reader(target.read_text().splitlines()))
    assert rows[0][:4] == ["t [s]", "x [m]", "y [m]", "z [m]"]
    assert rows[0][-3:] == ["A_x [m]", "A_y [m]", "A_z [m]"]
    assert all(abs(float(number)) < 1e-15 for number in rows[-1][-1:])  # at the touch A is on the floor
    assert [float(number) for number in rows[1][:4]] == [0, 0, 0, 0.40001]
    assert float(rows[-1][0]) == pytest.approx(0.283275791, abs=1e-8)
    assert [path.name for path in tmp_path.iterdir()] == ["path.csv"]


@pytest.mark.parametrize("contact", ["spring", "one_step"])
def test_mujocos_contact_is_the_one_that_is_asked_for(contact):
    asked = ("toss", "fig24a", "--engine", "mujoco", "--max-impacts", 1, "--contact", contact, "--json")
    assert json.loads(cointoss(*asked).stdout)["settings"]["contact"] == contact


def test_a_path_of_too_many_rows_is_refused(tmp_path):
    source = tmp_path / "long.toml"
    text = scenario_text("fig24a").replace("0.40001", "1e8")
    source.write_text(text + "\n[ending]\nmax_time = 2000\n")
    said = refused("toss", source, "--trajectory", tmp_path / "path.csv")
    assert said.startswith(f"cointoss: {source}: ending.max_time = 2000: accepted")
    assert not (tmp_path / "path.csv").exists()
