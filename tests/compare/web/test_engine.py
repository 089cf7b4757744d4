"""The engine in a browser is the package's, to the last bit; and errors in a line."""

import json
from importlib.metadata import version

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.web.playable import playable
from cointoss.models.certificate import energies
from cointoss.models.errors import ScenarioError
from cointoss.models.fields import put
from cointoss.models.records import Outcome
from cointoss.models.scenario import Scenario
from tests.helpers.bits import cases, numbers_of
from tests.helpers.corpus import CLASSES
from tests.helpers.draws import LONG_TRANSIENT, ZLOTY, scenario
from tests.helpers.engine_page import changes, written

INERT = scenario(
    coin={**ZLOTY, "inertia": [[9e-8, 1e-9, 0.0], [1e-9, 8e-8, 0.0], [0.0, 0.0, 1.5e-7]]},
    release={"angular_velocity": [3.0, 30.0, 2.0]},
)
MANY = 60
"""Releases of each class of general coins."""
RESTITUTIONS = "{ field: 'floor.restitution', start: -0.5, stop: 1.5, count: 5 }"
SPINS = "{{ field: 'release.angular_velocity.eta', start: 20, stop: 60, count: {} }}"
HEIGHTS = "{{ field: 'release.position.z', start: 0.2, stop: 0.6, count: {} }}"


@pytest.mark.slow
def test_every_number_of_a_toss_is_the_same(loaded):
    """Impacts, states, horizon and ending: by every law, in every air, with resistance, in contact."""
    differing = []
    for name, case in cases().items():
        due = numbers_of(case)
        found = loaded.value(
            f"""(() => {{
              const toss = engine.toss({written(case)}), end = toss.endTime;
              const times = Array.from({{ length: 11 }}, (_, i) => (i === 10 ? end : i * (end / 10)));
              return {{
                ending: toss.ending, outcome: toss.outcome, certain: toss.outcomeCertain,
                trusted: toss.trustedImpacts, time: end,
                impacts: toss.impacts.map(({{ time, energy, impulse }}) => [time, energy, ...impulse]),
                states: [...toss.path(times).states],
              }};
            }})()"""
        )
        if found | {"end": due["end"]} != due:
            differing.append(name)
    assert differing == []


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(cointoss.load("fig24a"), id="a toss"),
        pytest.param(cointoss.load("fig24a").replace("ending.until", 3.0), id="followed to a time"),
        pytest.param(cointoss.load("table").replace("ending.until", 3.0), id="of a thick coin"),
        pytest.param(cointoss.load("fig2").replace("ending.until", "rest"), id="followed to rest"),
        pytest.param(cointoss.load("zloty"), id="more impacts than there is room for at first"),
        pytest.param(scenario(**LONG_TRANSIENT, ending={"max_time": 2.0}), id="a long contact"),
        pytest.param(INERT, id="a given inertia"),
    ],
)
def test_a_toss_and_its_path_are_those_of_the_package(loaded, case):
    toss = analytic.toss(case)
    times = np.unique([*np.linspace(0, toss.path_end, 40), toss.end_time])
    taken = "states: [...path.states], energies: [...path.energies]"
    found = loaded.value(
        f"(() => {{ const toss = engine.toss({written(case)}), path = toss.path({times.tolist()});"
        f" return {{ ...toss, {taken} }}; }})()"
    )
    states = toss.sample(times)
    assert found["sentence"] == toss.ending.sentence
    assert found["sequence"] == toss.sequence
    assert [each["time"] for each in found["impacts"]] == toss.impacts.time.tolist()
    assert (found["endTime"], found["pathEnd"]) == (toss.end_time, toss.path_end)
    assert found["laterTimes"] == toss.later_times.tolist()
    assert np.reshape(found["states"], (-1, 13))[:, :3].tolist() == states.position.tolist()
    assert found["energies"] == pytest.approx(energies(case.body, states), rel=1e-12)


def test_the_floor_holds_the_coin_where_it_stays_in_contact_and_nowhere_else(loaded):
    case = scenario(**LONG_TRANSIENT, ending={"max_time": 2.0})
    toss = analytic.toss(case)
    start, end = toss.contacts[0]
    times = np.array([start / 2, start + (end - start) / 3, start + (end - start) / 2])
    found = loaded.value(f"[...engine.toss({written(case)}).path({times.tolist()}).forces]")
    assert found[:3] == [0, 0, 0]
    assert found[3:] == pytest.approx(toss.path.floor_force(times[1:]).ravel(), rel=1e-5, abs=1e-7)


@pytest.mark.parametrize("until", [3.0, None])
def test_a_page_plays_the_toss_that_the_package_plays(loaded, until):
    case = cointoss.load("fig24a").replace("ending.until", until)
    told = playable(analytic.toss(case), 400)
    found = json.loads(loaded.value(f"workers.toss({written(case)}, 400).then(JSON.stringify)"))
    assert set(told) ^ set(found) == {"certain"}
    for name in ("end_time", "times", "trusted", "sequence", "count", "outcome", "ending", "engine"):
        assert found[name] == pytest.approx(told[name], rel=1e-6) if name == "times" else told[name], name
    assert found.get("later_times", []) == pytest.approx(told.get("later_times", []), rel=1e-6)
    assert found["coin"].pop("center") == told["coin"].pop("center")
    assert found["coin"] == pytest.approx(told["coin"])
    heights = [np.interp(1.0, toss["path"]["time"], toss["path"]["position"][2::3]) for toss in (told, found)]
    assert heights[0] == pytest.approx(heights[1], rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("kind", CLASSES[::3], ids=lambda kind: kind.name)
def test_many_tosses_are_the_same(loaded, kind):
    given = f"{written(kind.scenario)}, {changes(kind.starts(MANY))}, 'certain'"
    taken = "[all.outcome, all.impacts, all.endTime, all.trustedImpacts, all.outcomeCertain]"
    found = loaded.value(f"workers.tossEach({given}).then((all) => {taken}.map((each) => [...each]))")
    native = analytic.toss_rows(kind.rows(MANY), trust="certain")
    due = native.outcome, native.impacts, native.end_time, native.trusted_impacts, native.outcome_certain
    assert found == [np.asarray(each).tolist() for each in due]


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
        (
            "engine.toss({ ...S, 'coin.inertia.xi.xi': 1 })",
            "coin.inertia: accepted: all its 9 numbers, or none",
        ),
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
    given = f"S = {written(cointoss.load('fig24a'))}, X = {RESTITUTIONS}, Y = {HEIGHTS.format(5)}"
    found = loaded.value(f"(() => {{ const {given}; return message(async () => {asked}); }})()")
    assert found.startswith(told)
    assert "\n" not in found


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


@pytest.mark.parametrize("after", [2, pytest.param(None, marks=pytest.mark.slow)])
def test_a_map_has_each_pixel_once_coarse_ones_first_and_is_that_of_the_package(loaded, after):
    case, nx, ny = cointoss.load("fig24a"), 37, 22
    found = loaded.value(
        f"""(async () => {{
          const parts = [];
          const given = {{ after: {json.dumps(after)}, trust: true }};
          await workers.map({written(case)}, {SPINS.format(nx)}, {HEIGHTS.format(ny)}, given,
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
            tossed = np.flatnonzero(codes != -9)
            squares = {(at // nx // finished, at % nx // finished) for at in tossed.tolist()}
            assert len(squares) == -(-nx // finished) * -(-ny // finished)
    assert (codes != -9).all()
    assert strides[0] == max(strides) >= 2
    assert found[-1][-1] == 1
    x, y = f"release.angular_velocity.eta=20:60:{nx}", f"release.position.z=0.2:0.6:{ny}"
    made = cointoss.basin(case, x=x, y=y, trust=True, **({} if after is None else {"after": after}))
    assert np.array_equal(codes.reshape(ny, nx), made.cointoss.codes)
    assert np.array_equal(trusted.reshape(ny, nx) != 1, made.cointoss.untrusted)


FIG24A, OUTCOME = written(cointoss.load("fig24a")), str(analytic.toss("fig24a").outcome)
OWN = "const own = Worker, S = " + FIG24A
SAID = {
    "its version": ("engine.about.version", version("cointoss-dynamics")),
    "outcomes": ("engine.about.outcomes[3]", str(Outcome.EDGE)),
    "memory back": (
        f"""(() => {{
          const values = {{ "release.position.z": Array(200).fill(0.4) }}, S = {FIG24A};
          const used = () => (engine.tossEach(S, values), engine.toss(S).path([0, 1]), engine.memory);
          return used() === Array.from({{ length: 20 }}, used).at(-1);
        }})()""",
        True,
    ),
    "no scenario beyond a field's bounds": (
        f"""(async () => {{
          const S = {{ ...{FIG24A}, "ending.max_impacts": 3 }}, found = [];
          const take = ({{ pixels, codes }}) => pixels.forEach((pixel, i) => (found[pixel] = codes[i] < -1));
          await workers.map(S, {RESTITUTIONS}, {SPINS.format(2)}, {{}}, take);
          return found;
        }})()""",
        2 * [True, False, False, False, True],
    ),
    "up at once a map that is no more asked for": (
        f"""(async () => {{
          const axis = {{ start: 0.2, stop: 0.6, count: 400 }}, given = new AbortController();
          const x = {{ ...axis, field: "release.position.z" }};
          const y = {{ ...axis, field: "release.velocity.z" }};
          let parts = 0;
          const map = workers.map({FIG24A}, x, y, {{}}, () => (parts++, given.abort()), given.signal);
          return [await map.catch((error) => error.name), parts];
        }})()""",
        ["AbortError", 1],
    ),
    "word of a worker that dies, and another": (
        f"""(async () => {{
          {OWN}, made = [];
          window.Worker = class extends own {{
            constructor(...given) {{ super(...given); made.push(this); }}
          }};
          const some = await startWorkers(bytes);
          const asked = some.toss(S, 100);
          made.forEach((each) => each.onerror({{ message: "out of memory", preventDefault() {{}} }}));
          const first = await asked.catch((error) => error.message);
          const again = await some.toss(S, 100);
          some.end();
          window.Worker = own;
          return [first, again.outcome];
        }})()""",
        ["a worker of the engine has died (out of memory)", OUTCOME],
    ),
    "tosses without workers": (
        f"""(async () => {{
          {OWN};
          window.Worker = class {{ constructor() {{ throw new Error("no workers"); }} }};
          const some = await startWorkers(bytes);
          window.Worker = own;
          return [some.count, (await some.toss(S, 100)).outcome];
        }})()""",
        [0, OUTCOME],
    ),
}
"""What is asked of a page, and what it answers."""


@pytest.mark.parametrize(("asked", "due"), SAID.values(), ids=SAID)
def test_the_engine_gives(loaded, asked, due):
    assert loaded.value(asked) == due
