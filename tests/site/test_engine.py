"""The engine in a browser against the package, beside the numbers of test_libm; and errors in a line."""

import json
from importlib.metadata import version

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.models.certificate import energies
from cointoss.models.errors import ScenarioError
from cointoss.models.fields import put
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario
from tests.helpers.draws import LONG_TRANSIENT, ZLOTY, scenario
from tests.helpers.engine_page import ENGINE, written

LARGEST = 640_000
"""Bytes of the engine, by gzip less than half."""


def test_the_engine_is_small_and_says_what_made_it(loaded):
    assert ENGINE.stat().st_size < LARGEST
    assert loaded.value("engine.about.version") == version("cointoss-dynamics")
    assert loaded.value("engine.about.outcomes[3]") == str(Outcome.EDGE)


def test_one_toss_has_the_words_and_the_energies_of_the_package(loaded):
    case = cointoss.load("fig24a")
    toss = analytic.toss(case)
    times = np.linspace(0, toss.impacts.time[2], 40)
    toss_here = f"const toss = engine.toss({written(case)}), path = toss.path({times.tolist()});"
    found = loaded.value(f"(() => {{ {toss_here} return {{ ...toss, energies: [...path.energies] }}; }})()")
    assert (found["sentence"], found["sequence"]) == (toss.ending.sentence, toss.sequence)
    assert found["energies"] == pytest.approx(energies(case.body, toss.path.sample(times)), rel=1e-12)


def test_the_floor_holds_the_coin_where_it_stays_in_contact_and_nowhere_else(loaded):
    case = scenario(**LONG_TRANSIENT, ending={"max_time": 2.0})
    toss = analytic.toss(case)
    start, end = toss.contacts[0]
    times = np.array([start / 2, start + (end - start) / 3, start + (end - start) / 2])
    path = loaded.value(f"(() => [...engine.toss({written(case)}).path({times.tolist()}).forces])()")
    forces = np.reshape(path, (3, 3))
    assert np.array_equal(forces[0], np.zeros(3))
    assert forces[1:] == pytest.approx(toss.path.floor_force(times[1:]), rel=1e-5, abs=1e-7)
    assert (forces[1:, 2] > 0).all()


def test_a_toss_with_more_impacts_than_there_is_room_for_is_whole(loaded):
    case = cointoss.load("zloty")
    found = loaded.value(f"engine.toss({written(case)})")
    assert len(found["impacts"]) == len(found["sequence"]) > 512
    assert found["endTime"] > found["impacts"][-1]["time"]


def test_memory_is_given_back(loaded):
    case = written(cointoss.load("fig24a"))
    values = "{ 'release.position.z': Array.from({ length: 200 }, () => 0.4) }"
    many, toss = f"engine.tossEach({case}, {values}, 'certain')", f"engine.toss({case})"
    once = f"(() => {{ {many}; {toss}.path([0, 1]); return engine.memory; }})()"
    again = f"(() => {{ for (let i = 0; i < 20; i++) {{ {many}; {toss}; }} return engine.memory; }})()"
    assert loaded.value(once) == loaded.value(again)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("load(bytes.slice(0, 100))", "engine.wasm: cannot be read ("),
        ("load(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]))", "engine.wasm: is no engine of cointoss"),
        ("load(bytes, '0.0.1')", f"engine.wasm: of version {version('cointoss-dynamics')}; accepted: 0.0.1"),
        ("engine.tossEach(S, { gravity: [9] }, 'all')", "wanted: all; accepted: outcome, trust, certain"),
        (
            "engine.tossEach(S, { gravity: [9], 'coin.mass': [1, 2] })",
            "changes: accepted: lists of one length",
        ),
        ("engine.tossEach(S, { 'floor.contact': ['smooth'] })", "floor.contact: accepted: a field that is a"),
        ("engine.tossEach(S, { 'coin.size': [1] })", "coin.size = 1: unknown key; accepted: mass, radius, "),
        ("engine.toss(null)", "scenario: accepted: an object of its fields"),
        (
            "engine.toss({ ...S, 'release.quaternion.e0': 1 })",
            "release.quaternion = [1, 0, 0, 0]: accepted: either",
        ),
        ("engine.toss(S).path([0.2, 0.1])", "times: 0.1 at 1; accepted: increasing from 0 to "),
        ("engine.toss(S).path([NaN])", "times: NaN at 0; accepted: increasing from 0 to "),
        ("engine.toss(S).path([99])", "times: 99 at 0; accepted: increasing from 0 to "),
        ("workers.toss({ ...S, 'coin.radius': -1 }, 10)", "coin.radius = -1: accepted: a number >= 1e-09"),
        (
            "workers.map({ ...S, 'coin.radius': -1 }, X, Y, {}, () => {})",
            "coin.radius = -1: accepted: a number >= 1e-09",
        ),
        (
            "workers.map(S, Y, { ...Y, field: 'floor.contact' }, {}, () => {})",
            "floor.contact: accepted: a field that is a number",
        ),
    ],
)
def test_what_cannot_be_is_told_in_a_line(loaded, asked, told):
    given = f"const S = {written(cointoss.load('fig24a'))};"
    given += (
        f"const X = {RESTITUTIONS}, Y = {{ field: 'release.position.z', start: 0.2, stop: 0.6, count: 5 }};"
    )
    found = loaded.value(f"(() => {{ {given} return message(async () => {asked}); }})()")
    assert found.startswith(told)
    assert "\n" not in found


RESTITUTIONS = "{ field: 'floor.restitution', start: -0.5, stop: 1.5, count: 5 }"


def test_pixels_beyond_a_field_s_bounds_are_no_scenario(loaded):
    case = written(cointoss.load("fig24a").replace("ending.max_impacts", 3))
    spins = "{ field: 'release.angular_velocity.eta', start: 20, stop: 60, count: 2 }"
    take = "({ pixels, codes }) => pixels.forEach((pixel, i) => (found[pixel] = codes[i]))"
    asked = f"await workers.map({case}, {RESTITUTIONS}, {spins}, {{}}, {take})"
    found = loaded.value(f"(async () => {{ const found = []; {asked}; return found; }})()")
    assert np.array_equal(np.reshape(found, (2, 5)) == -2, [[True, False, False, False, True]] * 2)


@pytest.mark.parametrize(
    "changed",
    [
        {"coin.radius": -1.5},
        {"coin.radius": float("nan")},
        {"coin.radius": True},
        {"coin.mass": 2000000000.5, "floor.restitution": 1.5},
        {"coin.center_of_mass.xi": 0.0127},
        {"coin.center_of_mass.zeta": 0.00123456789},
        {"coin.center_of_mass.xi": 0.0101},
        {"floor.contact": "rough"},
        {"floor.restitution_kind": "energetic"},
        {"floor.contact": "knurled", "floor.pivoting_friction": 0.0001},
        {"floor.rolling_friction": 0.0095, "floor.pivoting_friction": 0.0125},
        {"air.exponent": 1.5},
        {"air.normal": 123456789.5},
        {"release.position.z": 0.00123},
        {"release.position.z": 12345678900.5},
        {"release.angular_velocity.eta": 1.5e7},
        {"release.angles.theta": 15000000.5},
        {"ending.caught": 0.0051},
        {"ending.max_impacts": 2.5},
        {"ending.max_time": 1.5e-10},
        {"ending.test": "never"},
        {"ending.until": -1.5},
        {"gravity": -0.5},
    ],
)
def test_a_scenario_is_refused_in_the_words_of_the_package(loaded, changed):
    case = cointoss.load("fig24a")
    tables = case.as_tables()
    for name, value in changed.items():
        put(tables, name, value)
    with pytest.raises(ScenarioError) as refused:
        Scenario(**tables)
    values = ", ".join(
        f"'{name}': {'NaN' if value != value else json.dumps(value)}" for name, value in changed.items()
    )
    assert loaded.value(f"engine.fault({{ ...{written(case)}, {values} }})") == str(refused.value)


def test_a_given_inertia_is_taken_and_refused_as_by_the_package(loaded):
    J = [[9e-8, 1e-9, 0.0], [1e-9, 8e-8, 0.0], [0.0, 0.0, 1.5e-7]]
    case = scenario(coin={**ZLOTY, "inertia": J})
    toss = analytic.toss(case)
    found = loaded.value(f"engine.toss({written(case)})")
    assert (found["sequence"], found["endTime"]) == (toss.sequence, toss.end_time)
    tables = case.as_tables()
    tables["coin"]["inertia"][2][2] = 2.5e-7
    with pytest.raises(ScenarioError) as refused:
        Scenario(**tables)
    told = loaded.value(f"engine.fault({{ ...{written(case)}, 'coin.inertia.zeta.zeta': 2.5e-7 }})")
    assert told == str(refused.value)
    missing = loaded.value(f"engine.fault({{ ...{written(case)}, 'coin.inertia.zeta.zeta': null }})")
    assert missing == "coin.inertia: accepted: all its 9 numbers, or none"


@pytest.mark.parametrize("after", [2, None])
def test_a_map_has_each_pixel_once_coarse_ones_first_and_is_that_of_the_package(loaded, after):
    case, nx, ny = cointoss.load("fig24a"), 37, 22
    axes = (
        f"{{ field: 'release.angular_velocity.eta', start: 20, stop: 60, count: {nx} }},"
        f"{{ field: 'release.position.z', start: 0.2, stop: 0.6, count: {ny} }}"
    )
    found = loaded.value(
        f"""(async () => {{
          const parts = [];
          await workers.map({written(case)}, {axes}, {{ after: {json.dumps(after)}, trust: true }},
            ({{ stride, pixels, codes, trusted, finished }}) =>
              parts.push([stride, [...pixels], [...codes], [...trusted], finished]));
          return parts;
        }})()"""
    )
    codes, trusted = np.full((2, ny * nx), -9)
    strides = [part[0] for part in found]
    for _, pixels, some, sure, finished in found:
        assert (codes[pixels] == -9).all()
        codes[pixels], trusted[pixels] = some, sure
        if finished:
            columns, rows = -(-nx // finished), -(-ny // finished)
            tossed = np.flatnonzero(codes != -9)
            squares = {(at // nx // finished, at % nx // finished) for at in tossed.tolist()}
            assert len(squares) == columns * rows
    codes, trusted = codes.reshape(ny, nx), trusted.reshape(ny, nx)
    assert (codes != -9).all()
    assert max(strides) >= 2
    assert strides[0] == max(strides)
    assert found[-1][-1] == 1
    more = {"after": after} if after is not None else {}
    made = cointoss.basin(
        case,
        x=f"release.angular_velocity.eta=20:60:{nx}",
        y=f"release.position.z=0.2:0.6:{ny}",
        trust=True,
        **more,
    )
    assert made.cointoss.untrusted is not None
    assert np.array_equal(codes, made.cointoss.codes)
    assert np.array_equal(trusted != 1, made.cointoss.untrusted)


def test_a_pixel_beyond_the_bounds_of_its_field_is_no_scenario(loaded):
    codes = loaded.value(
        f"""(async () => {{
          const codes = [];
          const x = {{ field: "floor.restitution", start: 0.5, stop: 1.5, count: 5 }};
          const y = {{ field: "release.position.z", start: 0.3, stop: 0.4, count: 2 }};
          await workers.map({written(cointoss.load("fig24a"))}, x, y, {{ after: 0 }},
            (part) => codes.push([...part.codes]));
          return codes;
        }})()"""
    )
    (first,) = codes
    assert [code == -2 for code in first] == [False, False, False, True, True] * 2


def test_a_map_that_is_given_up_ends_at_once(loaded):
    told = loaded.value(
        f"""(async () => {{
          const axis = {{ start: 0.2, stop: 0.6, count: 400 }};
          const given = new AbortController();
          let parts = 0;
          const x = {{ ...axis, field: "release.position.z" }};
          const y = {{ ...axis, field: "release.velocity.z" }};
          const map = workers.map({written(cointoss.load("fig24a"))}, x, y, {{}},
            () => (parts++, given.abort()), given.signal);
          return [await map.catch((error) => error.name), parts];
        }})()"""
    )
    assert told == ["AbortError", 1]


def test_a_worker_that_dies_is_told_and_replaced(loaded):
    told = loaded.value(
        f"""(async () => {{
          const own = Worker, made = [], case_ = {written(cointoss.load("fig24a"))};
          window.Worker = class extends own {{
            constructor(...given) {{ super(...given); made.push(this); }}
          }};
          const some = await startWorkers(bytes);
          const asked = some.toss(case_, 100);
          made.forEach((each) => each.onerror({{ message: "out of memory", preventDefault() {{}} }}));
          const first = await asked.catch((error) => error.message);
          const again = await some.toss(case_, 100);
          some.end();
          window.Worker = own;
          return [first, again.outcome];
        }})()"""
    )
    assert told == ["a worker of the engine has died (out of memory)", str(analytic.toss("fig24a").outcome)]


def test_a_page_without_workers_tosses_itself(loaded):
    told = loaded.value(
        f"""(async () => {{
          const own = Worker;
          window.Worker = class {{ constructor() {{ throw new Error("no workers"); }} }};
          const some = await startWorkers(bytes);
          window.Worker = own;
          return [some.count, (await some.toss({written(cointoss.load("fig24a"))}, 100)).outcome];
        }})()"""
    )
    assert told == [0, str(analytic.toss("fig24a").outcome)]
