"""The suite of cases: right values by closed forms, both engines, and engines with planted errors."""

import json
from dataclasses import replace

import numpy as np
import pytest

from cointoss import Ending, Engine, analytic
from cointoss_yardstick.simulators.simulator import simulator_of
from cointoss_yardstick.suite.agreeing import assert_agrees, assert_met
from cointoss_yardstick.suite.card import Card
from cointoss_yardstick.suite.case import cases
from cointoss_yardstick.suite.hints import CAUSES
from cointoss_yardstick.suite.running import Status, full, run_case, run_cases
from own_engines import Newton
from plants import PLANTS, UNNAMED, Planted, of, resting, touching
from right_values import RIGHT
from tests.helpers.command_line import cointoss, printed, python, refused

CASES = {case.name: case for case in cases()}
EACH = [
    pytest.param(
        str(engine),
        name,
        marks=[pytest.mark.long] * ((engine, name) == ("mujoco", "shares")),
        id=f"{engine}-{name}",
    )
    for engine in Engine
    for name in CASES
]


@pytest.mark.parametrize("name", RIGHT)
def test_a_right_value_is_that_of_its_closed_form(name):
    for case in (CASES[name], full(CASES[name])):
        assert case.right == pytest.approx(RIGHT[name](case), rel=1e-11, abs=1e-13)


def test_each_case_has_a_name_of_its_own_a_source_and_a_reason():
    assert len(CASES) == len(cases())
    assert all(case.source and case.reason for case in cases())


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("engine", "name"), EACH)
def test_the_engines_of_cointoss_meet_the_suite(engine, name):
    """The sequence of faces is that within the analytic engine's horizon."""
    run = run_case(simulator_of(engine), CASES[name], None)
    assert (run.status, run.why) == (Status.MET, "")
    if name == "faces" and engine == "analytic":
        assert run.error == 0
        assert analytic.toss(CASES[name].scenario).trusted_impacts == len(CASES[name].right)


DEAR = {"dzhanibekov", "critical_speed", "eulers_disk", "energy", "faces", "shares"}
FLIGHTS = {"parabola", "glide", "fall_speed", "attitude_kept", "spin_kept", "precession", "terminal_speed"}
STEPPED = ("parabola", "glide", "fall_speed", "attitude_kept", "flat_50", "tilted", "two_rims", "rest")
FAULTS = [(hint, None) for hint in PLANTS] + [
    (hint, 1e-3)
    for hint in PLANTS
    if hint.startswith(
        ("the floor", "the shape", "gravity", "the velocity comes", "the states", "the attitudes")
    )
]


def card_of(engine, *names):
    """Return the card of an engine for the cases of these names."""
    asked = simulator_of(engine)
    return Card.of(asked, run_cases([asked], [CASES[name] for name in names]))


@pytest.mark.slow_after_first
@pytest.mark.parametrize(("hint", "dt"), FAULTS)
def test_a_fault_earns_its_hint_and_no_other(hint, dt):
    """Also through a step of 1 ms, with which a late state comes one step late."""
    wrong = Planted(PLANTS[hint].before, PLANTS[hint].after, dt)
    card = card_of(wrong, *(STEPPED if dt else CASES.keys() - DEAR))
    assert card.hints == [hint.replace("0.0001", f"{dt or 1e-4:g}").replace("5e-05", f"{(dt or 1e-4) / 2:g}")]


@pytest.mark.slow_after_first
@pytest.mark.parametrize("dt", [None, 1e-3])
@pytest.mark.parametrize("fault", UNNAMED)
def test_a_fault_of_no_known_pattern_earns_no_hint(fault, dt):
    wrong = Planted(UNNAMED[fault].before, UNNAMED[fault].after, dt)
    names = {"faces", "tilted_spin", "spin_kept", *STEPPED}
    card = card_of(wrong, *(names if dt else names | CASES.keys() - DEAR))
    assert card.hints == []
    assert card.missed or (dt, fault) == (1e-3, "a tenth less thickness"), (
        "0.1 mm is less than a step's limit"
    )


def test_each_cause_has_its_plant_and_right_engines_and_a_loss_without_a_pattern_have_no_hint():
    assert all(any(hint.startswith(each.words.partition("{")[0]) for hint in PLANTS) for each in CAUSES)
    assert not card_of(Planted(), *CASES.keys() - DEAR).missed
    lossy = UNNAMED["less restitution"]
    flat = CASES["energy"].scenario.replace("release.angles", [0, 0, 0])
    run = run_case(simulator_of(lossy), replace(CASES["energy"], until=2.0, scenario=flat), None)
    assert run.found == pytest.approx([2 * np.log(0.97)], rel=1e-2)


def test_a_floor_too_high_is_missed_in_each_case_with_a_touch_and_its_height_is_told():
    low = PLANTS["the floor, or a margin around the coin, is at -0.2 mm, not at 0"]
    assert {each.case.name for each in card_of(low, "flat_50", "tilted").missed} == {"flat_50", "tilted"}
    wrong = touching(lambda _: 5e-3)
    card = card_of(wrong, *CASES.keys() - DEAR)
    assert card.hints == ["the floor, or a margin around the coin, is at +5 mm, not at 0"]
    assert {each.case.name for each in card.missed} == CASES.keys() - DEAR - FLIGHTS
    for part in ("; the lowest point touches or lies at +5 mm", f"likely: {card.hints[0]}", "20 missed"):
        assert part in card.as_lines()
    assert (card.as_json()["hints"], "<p>Likely: the floor" in card.page()) == (card.hints, True)
    with pytest.raises(AssertionError, match=r"off by .*; the lowest point touches or lies at \+5 mm"):
        assert_met(simulator_of(wrong), CASES["tilted"])


WEIGHT = 2e-3 * 9.81


@pytest.mark.parametrize(
    ("engine", "missed"),
    [
        (resting(3e-4, stiffness=WEIGHT / 3e-4), 0),
        (resting(3e-4, stiffness=1.1 * WEIGHT / 3e-4), 1),
        (resting(-2e-2, stiffness=WEIGHT / 3e-4), 1),
    ],
    ids=["as deep as its spring lets it", "deeper", "away from the floor"],
)
def test_a_coin_at_rest_may_lie_as_deep_as_the_spring_that_the_engine_names(engine, missed):
    assert len(card_of(engine, "rest").missed) == missed


@pytest.mark.slow
def test_a_card_has_errors_by_step_and_their_order():
    engine = simulator_of(Newton())
    chosen = [CASES[name] for name in ("parabola", "terminal_speed", "flat_50")]
    parabola, terminal, flat = run_cases([engine], chosen)
    assert [run.dt for run in parabola.runs] == pytest.approx([2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4, 6.25e-5])
    # Half-implicit Euler is g t dt/2 off after t.
    assert [run.error for run in parabola.runs] == pytest.approx(
        [(run.dt or 0) / 0.4 for run in parabola.runs], rel=1e-6
    )
    assert (parabola.order, parabola.lasting) == pytest.approx((1.0, 0.0), abs=1e-6)
    uneven = run_case(engine, CASES["parabola"], 7e-3)
    assert uneven.error == pytest.approx(0.4 / 57 / 0.4, rel=1e-6), "a step ends with the case"
    card = Card.of(engine, [parabola, terminal, flat])
    assert card.told == "2 of 3 cases met, 1 not realisable"
    told = json.loads(json.dumps(card.as_json()))
    assert [each["status"] for each in told["cases"]] == ["met", "not realisable", "met"]
    assert told["cases"][1]["why"] == "air.normal = 20.0: accepted: 0"
    page = card.page()
    for part in (
        "A coin falls on its parabola",
        "air.normal = 20.0: accepted: 0",
        "at 0.0625 ms",
        "half-implicit",
    ):
        assert part in page


def test_a_card_says_which_error_no_shorter_step_takes_away():
    """Beside an error that does shrink; the time of rest errs by some touches more or less."""
    engine, right = simulator_of(Newton()), (0.12, -0.08, 0.6152 + 0.001 * 0.7848)
    card = Card.of(engine, run_cases([engine], [replace(CASES["parabola"], right=right), CASES["zeno"]]))
    assert [each.lasting for each in card.results] == pytest.approx([0.001, 0.0], rel=1e-6)
    assert "  met\n  an error of 1.0e-03 does not shrink with the step" in card.as_lines()


def test_full_is_an_hour_and_10000_tosses():
    rest, shares = full(CASES["rest"]), full(CASES["shares"])
    assert (rest.until, shares.tosses) == (3600.0, 10_000)
    assert shares.tolerance["stepping"] == pytest.approx(CASES["shares"].tolerance["stepping"] / 50**0.5)
    assert full(CASES["tilted"]) == CASES["tilted"]


AWAY = replace(CASES["tilted"], until=0.1)


@pytest.mark.parametrize(
    ("quantity", "why"),
    [
        (AWAY.quantity, "no impact was seen in 0.1 s"),
        ("period_of_spin", ""),
        ("exponent_of_the_fall", "the coin did not come down from 0.2 to 0.05 rad"),
    ],
)
def test_a_case_in_which_nothing_happens_has_failed_and_says_why(quantity, why):
    run = run_case(simulator_of("analytic"), replace(AWAY, quantity=quantity), None)
    assert run.status == Status.FAILED
    assert why in run.why


def test_a_toss_that_agrees_passes():
    assert_agrees(analytic.toss("fig24a"), "fig24a")
    assert_agrees("analytic", "fig24a", tolerance=1e-6)
    assert_agrees(Newton(dt=5e-5), TWO, tolerance=2e-2)
    assert_met(simulator_of("analytic"), CASES["tilted"])


TWO = CASES["tilted"].scenario.replace("ending.max_impacts", 2)
IN_AIR = TWO.replace("air", {"normal": 8.0, "tangential": 2.0}, "ending.max_impacts", 1)
"""Air ten times as thick as a coin's; without it the flight is a parabola."""
TOSS = analytic.toss("fig24a")
TURNED = replace(TOSS, impacts=replace(TOSS.impacts, face=3 - TOSS.impacts.face))
LATE = replace(TOSS, impacts=replace(TOSS.impacts, time=1.02 * TOSS.impacts.time))
LEANING = Newton(lean=0.05)
OFF = [
    (
        assert_agrees,
        LEANING,
        TWO,
        r"Newton's steps: impact 1 at 0\.2\d+ s: impulse \(.*\) N s against the contact law: off by ",
    ),
    (assert_agrees, of("gravity", lambda _: 1e-3), TWO, "Planted: no impact was seen in"),
    (
        assert_agrees,
        of("gravity", lambda _: 9.5),
        TWO,
        r"Planted: flight before impact 1: off by 3\.2e-02, allowed 1\.0e-02",
    ),
    (
        assert_agrees,
        of("air", lambda _: {}),
        IN_AIR,
        r"Planted: flight before impact 1: off by 1\.6e-01, allowed 1\.0e-02",
    ),
    (assert_agrees, LATE, "fig24a", r"impact 1: time 0\.288\d+ s, right 0\.283\d+ s: off by 2\.0e-02"),
    (
        assert_agrees,
        TURNED,
        "fig24a",
        r"analytic: impact 1: face T, right H; with impulses off by .* the first 10",
    ),
    (
        assert_met,
        simulator_of(LEANING),
        CASES["sideways"],
        r"sideways .*: sideways_impulse 0\.049979, right 0: off by 5\.0e-02, allowed 1\.0e-02",
    ),
    (assert_met, simulator_of("analytic"), AWAY, r"tilted: no impact was seen in 0\.1 s"),
]
"""What is off, of a toss or of a case, and what is said."""


@pytest.mark.parametrize(("asserted", "given", "tossed", "words"), OFF, ids=[row[-1][:30] for row in OFF])
def test_what_is_off_is_told_by_impact_quantity_and_size(asserted, given, tossed, words):
    with pytest.raises(AssertionError, match=words):
        asserted(given, tossed)


SUITE = """
def test_suite(cointoss_engine, cointoss_case):
    from cointoss_yardstick.testing import assert_met
    if cointoss_case.name in ("tilted", "sideways", "terminal_speed"):
        assert_met(cointoss_engine, cointoss_case)
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("options", "status", "words"),
    [
        (["--cointoss-engine", "yardstick.tests.own_engines:right"], 0, f"{len(CASES)} passed"),
        (["--cointoss-engine", "yardstick.tests.own_engines:leaning"], 1, "off by 5.0e-02, allowed 1.0e-02"),
        ([], 1, "--cointoss-engine: missing; accepted: package.module:name"),
    ],
)
def test_pytest_takes_the_suite_by_a_plugin(tmp_path, options, status, words):
    (tmp_path / "test_mine.py").write_text(SUITE)
    answered = python(
        "-m",
        "pytest",
        "-q",
        "-p",
        "no:cacheprovider",
        "-p",
        "cointoss_yardstick.testing",
        *options,
        folder=tmp_path,
    )
    assert answered.returncode == status, answered.stdout
    assert words in answered.stdout


@pytest.mark.slow
def test_the_command_prints_a_card_and_ends_with_1_where_a_case_is_missed(tmp_path):
    page = tmp_path / "card.html"
    met = printed("conform", "analytic", "--case", "tilted", "--case", "faces", "--out", page)
    assert "2 of 2 cases met" in met
    assert "A coin tilted by 45°" in page.read_text(encoding="utf-8")
    missed = cointoss("conform", "yardstick.tests.own_engines:leaning", "--case", "sideways", "--json")
    assert missed.exit_code == 1
    (told,) = json.loads(missed.stdout)["cases"]
    assert (told["status"], told["right"]) == ("missed", [0.0])
    assert len(told["runs"]) == 6


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["conform", "nowhere"], "engine: nowhere, accepted: analytic, mujoco, or package.module:name"),
        (["conform", "analytic", "--case", "none"], "none; accepted: parabola, "),
        (["conform", "analytic", "--out", "card.txt"], "card.txt"),
        (["conform", "/no/python -m a:b"], "/no/python: can't be run"),
    ],
)
def test_the_command_refuses_in_one_line(words, told):
    assert told in refused(*words)


def test_an_engine_asked_for_states_goes_on_where_a_period_is_repeated():
    case = CASES["critical_speed"].scenario
    assert analytic.toss(case).ending == Ending.PERIODIC
    seen = simulator_of("analytic").observe(case, 1.0)
    assert seen.states.time[-1] == pytest.approx(1.0)
    assert np.abs(seen.states.normal[:, 2]).max() < 0.018
