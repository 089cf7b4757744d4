"""An engine is asked for states alone; what they show, and what is refused of them."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from adapters.mjcf import joint_of, model_of, states_of
from adapters.mujoco.engine import as_documented, tuned
from adapters.shared import friction_of
from cointoss import Ending, Outcome, UnsupportedError, UnusableEngineError, analytic, load
from cointoss.study import attitude_angle, rotation_matrix
from cointoss_yardstick.simulators.observed import ObservedToss, Samples
from cointoss_yardstick.simulators.simulator import simulator_of
from cointoss_yardstick.suite.case import cases
from cointoss_yardstick.suite.running import run_case
from own_engines import Hanging, Newton
from tests.helpers.command_line import python
from tests.helpers.draws import IMPERFECT, scenario
from tests.helpers.processes import HANGS

TUMBLING = {
    "position": [0.0, 0.0, 0.3],
    "velocity": [0.1, -0.2, 0.3],
    "angles": [0.4, 0.6, 0.1],
    "angular_velocity": [20.0, 35.0, -10.0],
}
WHOLE = ("position", "quaternion", "velocity", "angular_velocity")


class Answers:
    """An engine that answers by a function."""

    def __init__(self, simulate):
        self.simulate = simulate


def changed(**how):
    """Return an engine that answers as the analytic one, but for some columns, each changed by a function."""

    def simulate(case, times):
        states = analytic.toss(case).sample(times)
        columns = {name: getattr(states, name).copy() for name in WHOLE}
        return columns | {name: change(columns.get(name), case, times) for name, change in how.items()}

    return Answers(simulate)


@pytest.fixture
def tumbling():
    return scenario(coin=IMPERFECT, release=TUMBLING, ending={"test": "lying"})


@pytest.mark.parametrize(("law", "friction"), [("smooth", 0.0), ("coulomb", 0.3), ("perfectly_rough", 1e5)])
def test_an_adapter_takes_a_scenario_of_cointoss_where_that_is_installed_too(law, friction):
    assert friction_of(scenario(floor={"contact": law, "friction": 0.3}), rough=1e5) == friction


def test_an_adapter_hands_mujoco_the_coin_and_takes_its_states_back():
    """Its joint has B, its body the moments about C, and what it is released with comes back."""
    case = scenario(coin={"center_of_mass": [-1e-3, -4e-4, -2e-4]}, release=TUMBLING)
    states = analytic.toss(case).sample([0.0])
    joint, model = joint_of(case), model_of(case, as_documented.settings, 1e-3)
    assert np.hstack(joint) == pytest.approx(np.hstack(states.to_mujoco(case))[0], abs=1e-15)
    back = states_of(case, np.hstack(joint)[None])
    assert [back[name][0] for name in WHOLE] == [pytest.approx(getattr(states, name)[0]) for name in WHOLE]
    axes = Rotation.from_quat(model.body_iquat[1], scalar_first=True).as_matrix()
    J = axes @ np.diag(model.body_inertia[1]) @ axes.T
    assert J == pytest.approx(np.array(case.coin.moments), abs=1e-16)


@pytest.mark.parametrize("name", ["terminal_speed", "flat_50", "tilted_spin"])
def test_an_adapter_of_mujoco_meets_cases(name):
    case = next(case for case in cases() if case.name == name)
    assert run_case(simulator_of(tuned), case, tuned.dt).error < case.tolerance["stepping"]


def test_in_flight_in_air_nothing_is_gained():
    """Beyond weight and the drag at B of an unbalanced coin, to the trapezoidal rule's error."""
    case = scenario(coin=IMPERFECT, release=TUMBLING, air={"normal": 8.0, "tangential": 2.0})
    gains = simulator_of("analytic").observe(case, 0.1).gains
    assert np.abs(gains).max() < 1e-7


@pytest.mark.parametrize("name", ["fig24a", "table"])
def test_states_alone_show_the_impacts_of_the_toss(name):
    """At a spacing of 0.1 ms; what turns in it before a sample is put back by Euler's equations."""
    case = load(name).replace("ending", {"test": "rigorous"})
    known = analytic.toss(case)
    told = simulator_of("analytic").observe(case, known.end_time + 0.01)
    seen = ObservedToss(scenario=case, states=told.states).toss("seen", {})
    first = known.impacts.time < (known.contacts[0, 0] if len(known.contacts) else np.inf)
    n = min(int(first.sum()), 10)
    assert n >= 4
    assert seen.sequence[:n] == known.sequence[:n]
    assert seen.impacts.time[:n] == pytest.approx(known.impacts.time[:n], abs=1e-9)
    size = np.linalg.norm(known.impacts.impulse[:n], axis=1)
    off = np.linalg.norm(seen.impacts.impulse[:n] - known.impacts.impulse[:n], axis=1) / size
    assert 0 < off.max() < 1e-3
    spin = np.linalg.norm(known.impacts.angular_velocity_after[:n], axis=1).max()
    assert seen.impacts.angular_velocity_after[:n] == pytest.approx(
        known.impacts.angular_velocity_after[:n], abs=1e-3 * spin
    )
    assert (seen.outcome, seen.ending) == (known.outcome, Ending.SETTLED)
    assert seen.end_time == pytest.approx(known.end_time, abs=2e-3)


def test_impulses_of_a_coarse_answer_err_as_its_spacing_allows(tumbling):
    known = analytic.toss(tumbling)
    for every in (2e-4, 1e-3):
        told = simulator_of("analytic").observe(tumbling, 0.5, every=every)
        seen = ObservedToss(scenario=tumbling, states=told.states)
        size = np.linalg.norm(known.impacts.impulse[:2], axis=1)
        off = np.linalg.norm(seen.impacts.impulse[:2] - known.impacts.impulse[:2], axis=1) / size
        assert seen.spans[:2] == pytest.approx(every)
        assert off.max() < 300 * every


def test_an_engine_may_give_its_impacts(tumbling):
    known = analytic.toss(tumbling)
    seen = simulator_of("analytic").observe(tumbling, 0.6).toss("seen", {})
    n = len(seen.impacts)
    assert n > 2
    assert np.array_equal(seen.impacts.impulse, known.impacts.impulse[:n])
    assert seen.impacts.point[0] == pytest.approx(known.impacts.point[0], abs=1e-6)
    assert seen.impacts.angular_velocity_after[0] == pytest.approx(
        known.impacts.angular_velocity_after[0], rel=1e-4
    )


def test_a_coin_that_lies_is_held_by_its_weight():
    case = scenario(coin=IMPERFECT, floor={"restitution": 0.0}, release={"position": [0, 0, 0.05]})
    seen = simulator_of(Newton()).observe(case, 0.3)
    (_, contacts), toss = seen.stretches, seen.toss("seen", {"solver": "Newton"})
    assert (toss.outcome, toss.ending) == (Outcome.HEADS, Ending.SETTLED)
    assert len(contacts) == 1
    assert seen.states.time[contacts[0][1]] == pytest.approx(0.3)
    path = toss.path.sample(np.array([0.0, 0.0005, 0.2]))
    assert path.position[:, 2] == pytest.approx([0.05, 0.05, path.position[2, 2]], abs=1e-5)
    assert toss.path.floor_force(np.array([0.25]))[0, 2] == pytest.approx(2e-3 * 9.81, rel=1e-6)
    assert {each.name for each in toss.certificate} >= {"solver", "spacing of the times"}


CAUGHT = scenario(release=TUMBLING, ending={"caught": 0.2})
FEW = scenario(release=TUMBLING, ending={"max_impacts": 2})
STANDS = scenario(
    coin={"thickness": 4e-3},
    floor={"restitution": 0.0},
    release={"position": [0, 0, 1.25e-2], "angles": [0, np.pi / 2, 0]},
)


@pytest.mark.parametrize(
    ("engine", "case", "until", "shown"),
    [
        ("analytic", CAUGHT, 0.3, {"ending": Ending.CAUGHT, "end_time": analytic.toss(CAUGHT).end_time}),
        ("analytic", STANDS, 0.1, {"ending": Ending.STANDING, "outcome": Outcome.EDGE}),
        (
            "analytic",
            scenario(release=TUMBLING),
            0.1,
            {"ending": Ending.MAX_TIME, "outcome": Outcome.UNDECIDED},
        ),
        (Newton(), FEW, 1.0, {"ending": Ending.MAX_IMPACTS, "sequence": analytic.toss(FEW).sequence}),
    ],
    ids=["caught", "stands", "goes on", "few impacts"],
)
def test_a_toss_ends_as_its_scenario_and_its_states_say(engine, case, until, shown):
    toss = simulator_of(engine).toss(case, until)
    found = {name: getattr(toss, name) for name in shown}
    assert found == shown | {
        name: pytest.approx(shown[name], abs=1e-4) for name in shown.keys() & {"end_time"}
    }


WRONG = {
    "NaN": (
        changed(velocity=lambda v, _, times: np.where(times[:, None] > 0.2, np.nan, v)),
        r"velocity at t = 0\.2001 s: \[nan nan nan\], accepted: numbers",
    ),
    "too few rows": (
        changed(position=lambda x, *_: x[:7]),
        r"position: shape \(7, 3\), accepted: \(3001, 3\)",
    ),
    "not of norm 1": (changed(quaternion=lambda e, *_: 2 * e), r"quaternion at t = 0 s: norm 2, accepted: 1"),
    "scalar last": (
        changed(quaternion=lambda e, *_: np.roll(e, -1, axis=1)),
        r"quaternion at t = 0: .*; the scalar is last, accepted: that of the release",
    ),
    "space to body": (
        changed(quaternion=lambda e, *_: e * [1, -1, -1, -1]),
        r"quaternion at t = 0: .*; it turns from space to body",
    ),
    "spin in space": (
        changed(
            angular_velocity=lambda w, case, _: w @ np.array(rotation_matrix(case.release.attitude)).T,
        ),
        r"angular_velocity at t = 0: .*; it is in the space frame",
    ),
    "velocity in the body": (
        changed(velocity=lambda v, case, _: v @ np.array(rotation_matrix(case.release.attitude))),
        r"velocity at t = 0: .*; it is in the body frame",
    ),
    "another point": (
        changed(
            position=lambda x, case, _: (
                x - np.array(rotation_matrix(case.release.attitude)) @ case.coin.center_of_mass
            )
        ),
        r"position at t = 0: .*; it is that of the geometric centre",
    ),
    "y up": (
        changed(position=lambda x, *_: x[:, [0, 2, 1]]),
        r"position at t = 0: the coin starts 7\.1 mm below the floor",
    ),
    "below the floor": (
        changed(position=lambda x, *_: x - [0, 0, 0.4]),
        r"position at t = 0: the coin starts 107 mm below the floor",
    ),
    "elsewhere": (
        changed(position=lambda x, *_: x - [0, 0, -0.1]),
        r"position at t = 0: \(0, 0, 0\.4\), accepted: that of the release, \(0, 0, 0\.3\)",
    ),
    "out of order": (
        changed(time=lambda _, __, times: times[::-1].copy()),
        r"time: .* s after .* s, accepted: times in order",
    ),
    "at other times": (
        changed(time=lambda _, __, times: times * 1.1),
        r"time: .* s for .* s, accepted: the times asked for",
    ),
    "times of another number": (
        changed(time=lambda *_: np.zeros(3)),
        r"time: shape \(3,\), accepted: \(3001,\)",
    ),
    "impulses without times": (
        changed(impact_time=lambda *_: np.zeros(2), impact_impulse=lambda *_: np.zeros((3, 3))),
        "impact_time: accepted: times in order, and impact_impulse with three numbers for each",
    ),
    "a spring that pulls": (
        changed(stiffness=lambda *_: -1.0),
        r"stiffness: -1\.0 N/m, accepted: a number above 0",
    ),
    "raises": (
        Answers(lambda *_: 1 / 0),
        r"Answers: ZeroDivisionError: division by zero \(test_simulator\.py:\d+\)",
    ),
    "another kind": (
        Answers(lambda *_: 3),
        r"simulate returned int without position, accepted: position, quat",
    ),
}


@pytest.mark.parametrize(("engine", "told"), WRONG.values(), ids=WRONG)
def test_a_wrong_answer_is_refused_in_one_line_that_says_what_it_seems_to_be(engine, told, tumbling):
    with pytest.raises(UnusableEngineError, match=told) as refusal:
        simulator_of(engine).observe(tumbling, 0.3)
    assert "\n" not in str(refusal.value)
    assert str(refusal.value).startswith("Answers: ")


@pytest.mark.parametrize(
    "answer",
    [lambda states: states, lambda states: [getattr(states, name) for name in WHOLE]],
    ids=["a record", "in turn"],
)
def test_states_in_turn_and_records_are_answers_too(answer, tumbling):
    engines = Answers(lambda case, times: answer(analytic.toss(case).sample(times))), "analytic"
    seen, known = (simulator_of(engine).observe(tumbling, 0.3).states.quaternion for engine in engines)
    assert np.abs(seen - known).max() < 1e-15


def test_a_step_is_set_for_a_call_and_put_back(tumbling):
    engine = Newton()
    coarse = simulator_of(engine).observe(tumbling, 0.2, dt=0.01)
    assert np.diff(coarse.states.time) == pytest.approx(0.01)
    assert engine.dt == 1e-3


@pytest.mark.parametrize("served", [False, True])
def test_an_engine_that_hangs_is_ended_and_said(served, tumbling):
    engine = "yardstick.tests.own_engines:hanging" if served else Hanging()
    begun = time.monotonic()
    asked = simulator_of(engine, 2.0)
    with pytest.raises(UnusableEngineError, match="no answer within 2 s; ended"):
        asked.observe(tumbling, 0.3)
    assert time.monotonic() - begun < 60
    asked.answering.close()


def test_an_engine_in_another_process_answers_as_in_this_one(tumbling):
    asked = simulator_of("yardstick.tests.own_engines:right")
    here, there = (each.observe(tumbling, 0.3) for each in (simulator_of(Newton()), asked))
    assert np.array_equal(here.states.position, there.states.position)
    assert (asked.name, asked.dt) == ("Newton's steps", 1e-3)
    with pytest.raises(UnsupportedError, match=r"^floor\.slope: 0\.1, accepted of Newton's steps: 0$"):
        asked.observe(tumbling.replace("floor.slope", 0.1), 0.3)
    with pytest.raises(UnsupportedError, match=r"floor\.contact = coulomb: accepted: smooth"):
        asked.observe(tumbling.replace("floor.contact", "coulomb"), 0.3)
    asked.answering.close()


ASKS_AND_ENDS = """
import os, threading, time
from cointoss import load
from cointoss_yardstick.simulators.simulator import simulator_of
from cointoss_yardstick.suite.case import cases
from cointoss_yardstick.suite.running import run_case

asked = simulator_of("yardstick.tests.own_engines:hanging")
threading.Thread(target=asked.observe, args=(load("fig24a"), 1.0), daemon=True).start()
time.sleep(1)
print(asked.answering._process.pid, flush=True)
os._exit(0)
"""


def test_the_process_of_an_engine_ends_with_the_one_that_asks():
    stat = Path("/proc") / python("-c", ASKS_AND_ENDS).stdout.strip() / "stat"
    deadline = time.monotonic() + HANGS
    while stat.exists() and ") Z " not in stat.read_text() and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not stat.exists() or ") Z " in stat.read_text()


def test_a_process_that_ends_is_said_and_started_again(tumbling):
    asked = simulator_of("yardstick.tests.own_engines:crashing")
    for _ in range(2):
        with pytest.raises(UnusableEngineError, match="its process ended with status 3: out of luck"):
            asked.observe(tumbling, 0.3)
    asked.answering.close()


def test_another_python_needs_numpy_alone(tumbling, tmp_path, monkeypatch):
    """As where an engine pins other versions: a scenario is then its fields as attributes."""
    (tmp_path / "bare.py").write_text(BARE)
    monkeypatch.chdir(tmp_path)
    asked = simulator_of("bare:Engine")
    seen = asked.observe(tumbling, 0.01)
    assert asked.name == "Engine"
    assert seen.states.quaternion[-1] == pytest.approx(np.array(tumbling.release.attitude))
    with pytest.raises(UnsupportedError, match="SimpleNamespace"):
        asked.observe(tumbling.replace("floor.restitution", 0.0), 0.01)
    asked.answering.close()


BARE = """
import sys
sys.modules["cointoss"] = None

class Engine:
    def simulate(self, scenario, times):
        print("what it prints is no answer")
        if scenario.floor.restitution == 0:
            raise NotImplementedError(type(scenario).__name__)
        assert len(scenario.coin.moments) == 3
        release = scenario.release
        rows = release.position, release.attitude, release.velocity, release.angular_velocity
        return [[row] * len(times) for row in rows]
"""


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        (3, TypeError, "int: has no function simulate"),
        (
            type("Fast", (), {"simulate": print, "dt": 2})(),
            TypeError,
            "dt = 2: accepted: a step above 0 and below 1 s, or none",
        ),
        (
            type("Listed", (), {"simulate": print, "settings": [1]})(),
            TypeError,
            "settings: of type list, accepted: a dict",
        ),
        (
            "nowhere",
            UnusableEngineError,
            "engine: nowhere, accepted: analytic, mujoco, or package.module:name",
        ),
        (
            "no_such_package:engine",
            UnusableEngineError,
            "no_such_package:engine: ModuleNotFoundError: No module named 'no_such_package'",
        ),
        ("yardstick.tests.own_engines:none", UnusableEngineError, "own_engines' has no attribute 'none'"),
        ("yardstick.tests.own_engines:Newton.name", UnusableEngineError, "has no function simulate"),
        ("/no/python -m some:engine", UnusableEngineError, r"can't be run .*; accepted: a Python"),
    ],
)
def test_what_is_no_engine_is_refused(given, error, words):
    with pytest.raises(error, match=words):
        simulator_of(given)


def test_between_samples_an_attitude_is_the_same_by_either_sign():
    known = analytic.toss("fig24a").sample(np.linspace(0, 0.2, 201))
    turned = replace(known, quaternion=known.quaternion * np.where(np.arange(201) % 3, 1, -1)[:, None])
    times, none = np.linspace(0, 0.2, 999), np.zeros((200, 3))
    angles = attitude_angle(Samples(turned, none).sample(times), analytic.toss("fig24a").sample(times))
    assert angles.max() < 1e-3
