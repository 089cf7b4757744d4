"""The engine in a browser against the package: the same certain outcomes and paths, and errors in a line."""

from base64 import b64encode
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.analytic.horizon.horizon import IMPULSE_ERROR, TIME_ERROR
from cointoss.analytic.toss import state_at_release
from cointoss.compare.engines import Engine
from cointoss.compare.explorer import static
from cointoss.compare.reproduction.setups.general_coins import CLASSES
from cointoss.compare.sweep.reading import read_map
from cointoss.compare.web import wasm
from cointoss.compare.web.wasm.carried import engine_data
from cointoss.compare.web.wasm.interface import PLACES, numbers_of
from cointoss.models.certificate import energies
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Outcome, UnsupportedError
from tests.helpers.browser import Page
from tests.helpers.draws import AIR, LONG_TRANSIENT, scenario
from tests.helpers.explored import SCENARIO, small_map
from tests.helpers.many import draw_releases

WASM = Path(wasm.__file__).parent
ENGINE, WRAPPER = WASM / "engine.wasm", WASM / "engine.js"
LAWS = [str(law) for law in ContactLaw]
LARGEST = 400_000
"""Bytes of the engine, by gzip less than half."""


@pytest.fixture(scope="module")
def loaded(chromium, tmp_path_factory):
    """A page of one file that has loaded the engine."""
    folder = tmp_path_factory.mktemp("engine")
    module, engine = (b64encode(file.read_bytes()).decode() for file in (WRAPPER, ENGINE))
    (folder / "page.html").write_text(
        f"""<!doctype html><title>engine</title><body><script type="module">
        import {{ load }} from "data:text/javascript;base64,{module}";
        const bytes = Uint8Array.from(atob("{engine}"), (c) => c.charCodeAt(0));
        const message = async (ask) => {{
          try {{ await ask(); }} catch (error) {{ return error.message; }}
        }};
        Object.assign(window, {{ load, bytes, message, engine: await load(bytes) }});
        document.body.dataset.ready = "true";
        </script>"""
    )
    with Page(chromium) as page:
        page.open((folder / "page.html").as_uri())
        yield page
        assert page.complaints() == []


def numbers(case):
    """Return the numbers of a scenario as JavaScript; what is endless has no JSON."""
    return "[" + ",".join("Infinity" if np.isinf(n) else repr(n) for n in numbers_of(case).tolist()) + "]"


def tossed(page, case, states, wanted):
    """Return the outcomes of many tosses in the page, as arrays by name."""
    given = f"{numbers(case)}, {np.ravel(states).tolist()}, '{wanted}'"
    plain = "Object.fromEntries(Object.entries(all).map(([name, each]) => [name, each && [...each]]))"
    found = page.value(f"(() => {{ const all = engine.tossEach({given}); return {plain}; }})()")
    return {name: each and np.array(each) for name, each in found.items()}


def test_the_engine_is_small_and_says_what_made_it(loaded):
    assert ENGINE.stat().st_size < LARGEST
    assert loaded.value("engine.about.version") == version("cointoss-dynamics")
    assert loaded.value("engine.about.outcomes[3]") == str(Outcome.EDGE)


@pytest.mark.parametrize("kind", CLASSES, ids=lambda kind: kind.name)
def test_outcomes_that_the_package_calls_certain_are_the_same(loaded, kind):
    count = 60
    native = analytic.toss_many(kind.scenario, kind.releases(count), certain=True)
    found = tossed(loaded, kind.scenario, kind.starts(count), "outcome")
    assert native.outcome_certain is not None
    assert native.outcome_certain.sum() > count / 3
    for name in ("outcome", "ending", "impacts"):
        ours, theirs = getattr(native, name), found[name]
        assert np.array_equal(ours[native.outcome_certain], theirs[native.outcome_certain])
    assert found["trustedImpacts"] is found["outcomeCertain"] is None


def test_outcomes_that_the_page_calls_certain_are_those_of_the_package(loaded):
    kind = next(kind for kind in CLASSES if kind.name == "thick, imperfect, air, smooth")
    native = analytic.toss_many(kind.scenario, kind.releases(60), certain=True)
    found = tossed(loaded, kind.scenario, kind.starts(60), "certain")
    certain = found["outcomeCertain"] == 1
    assert np.array_equal(found["outcome"][certain], native.outcome[certain])
    # Neighbours start at the same places but for rounding, which changes what one in twenty of them says.
    assert np.mean(certain == native.outcome_certain) >= 0.95
    assert 0 < certain.sum() < len(certain)


@pytest.mark.parametrize("law", LAWS)
def test_every_law_is_there(loaded, law):
    """After five impacts face and time are the package's, wherever its own errors cannot change them."""
    friction = 0.3 if law in ("sliding_friction", "coulomb") else 0.0
    floor = {"contact": law, "friction": friction, "restitution": 0.5}
    case = scenario(air=AIR, floor=floor, ending={"max_impacts": 5})
    releases = draw_releases(np.random.default_rng(7), 40)[1]
    states = np.hstack([releases.position, releases.velocity, releases.quaternion, releases.angular_velocity])
    native, found = analytic.toss_many(case, releases, horizon=True), tossed(loaded, case, states, "trust")
    assert native.trusted_impacts is not None
    sure = native.trusted_impacts == 5
    assert sure.sum() > len(sure) / 4
    assert np.array_equal(native.last_face[sure], found["lastFace"][sure])
    assert found["endTime"][sure] == pytest.approx(native.end_time[sure], abs=TIME_ERROR)
    # The horizon follows from the errors of the flights, which rounding hardly changes.
    assert np.abs(native.trusted_impacts - found["trustedImpacts"]).max() <= 1


def test_one_toss_has_the_impacts_and_the_path_of_the_package(loaded):
    case = cointoss.load("fig24a")
    toss, release = analytic.toss(case), state_at_release(case.release).tolist()
    times = np.linspace(0, toss.impacts.time[2], 40)
    found = loaded.value(
        f"(() => {{ const toss = engine.toss({numbers(case)}, {release}); "
        f"const path = toss.path({times.tolist()}); "
        f"return {{ ...toss, states: [...path.states], energies: [...path.energies] }}; }})()"
    )
    assert (found["outcome"], found["ending"]) == (str(toss.outcome), str(toss.ending))
    assert found["sentence"] == toss.ending.sentence
    assert abs(found["trustedImpacts"] - toss.trusted_impacts) <= 1
    trusted = min(found["trustedImpacts"], toss.trusted_impacts)
    assert found["sequence"][:trusted] == toss.sequence[:trusted]
    for ours, theirs in zip(range(trusted), found["impacts"], strict=False):
        assert theirs["time"] == pytest.approx(toss.impacts.time[ours], abs=TIME_ERROR)
        impulse = toss.impacts.impulse[ours]
        assert theirs["impulse"] == pytest.approx(impulse, abs=IMPULSE_ERROR * float(np.linalg.norm(impulse)))
    positions = np.reshape(found["states"], (len(times), 13))[:, :3]
    sampled = toss.path.sample(times)
    assert positions == pytest.approx(sampled.position, abs=1e-7)
    assert found["energies"] == pytest.approx(energies(case.body, sampled), rel=1e-6)


def test_the_floor_holds_the_coin_where_it_stays_in_contact_and_nowhere_else(loaded):
    case = scenario(**LONG_TRANSIENT, ending={"max_time": 2.0})
    toss, release = analytic.toss(case), state_at_release(case.release).tolist()
    start, end = toss.contacts[0]
    times = np.array([start / 2, start + (end - start) / 3, start + (end - start) / 2])
    path = loaded.value(
        f"(() => [...engine.toss({numbers(case)}, {release}).path({times.tolist()}).forces])()"
    )
    forces = np.reshape(path, (3, 3))
    assert np.array_equal(forces[0], np.zeros(3))
    assert forces[1:] == pytest.approx(toss.path.floor_force(times[1:]), rel=1e-5, abs=1e-7)
    assert (forces[1:, 2] > 0).all()


def test_a_toss_with_more_impacts_than_there_is_room_for_is_whole(loaded):
    case = cointoss.load("zloty")
    release = state_at_release(case.release).tolist()
    found = loaded.value(f"engine.toss({numbers(case)}, {release})")
    assert len(found["impacts"]) == len(found["sequence"]) > 512
    assert found["endTime"] > found["impacts"][-1]["time"]


def test_memory_is_given_back(loaded):
    case = cointoss.load("fig24a")
    many = f"engine.tossEach({numbers(case)}, MANY, 'certain')"
    toss = f"engine.toss({numbers(case)}, {state_at_release(case.release).tolist()})"
    release = state_at_release(case.release).tolist()
    loaded.value(f"window.MANY = Array.from({{ length: 200 }}, () => {release}).flat(); 0")
    once = f"(() => {{ {many}; {toss}.path([0, 1]); return engine.memory; }})()"
    again = f"(() => {{ for (let i = 0; i < 20; i++) {{ {many}; {toss}; }} return engine.memory; }})()"
    assert loaded.value(once) == loaded.value(again)


@pytest.mark.parametrize(
    ("asked", "told"),
    [
        ("load(bytes.slice(0, 100))", "engine.wasm: cannot be read ("),
        ("load(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]))", "engine.wasm: is no engine of cointoss"),
        ("load(bytes, '0.0.1')", f"engine.wasm: of version {version('cointoss-dynamics')}; accepted: 0.0.1"),
        ("engine.tossEach([], [], 'all')", "wanted: all; accepted: outcome, trust, certain"),
        ("engine.tossEach(N, [1, 2])", "releases: 2 numbers; accepted: 13 for each"),
        ("engine.toss([], R)", "numbers: 0 of them; accepted: 47"),
        (
            "engine.toss(N.map((n, i) => (i === 1 ? NaN : n)), R)",
            "numbers: NaN at 1; accepted: a finite number",
        ),
        ("engine.toss(N, R.slice(1))", "release: 12 numbers; accepted: 13"),
        (
            "engine.tossEach(N, R.map((n, i) => (i === 3 ? Infinity : n)))",
            "release: Infinity at 3; accepted: a",
        ),
        ("engine.toss(N, R.map((n, i) => (i > 5 ? 0 : n)))", "release: a quaternion of norm 0; accepted: 1"),
        ("engine.toss(N, R).path([0.2, 0.1])", "times: 0.1 at 1; accepted: increasing from 0 to "),
        ("engine.toss(N, R).path([NaN])", "times: NaN at 0; accepted: increasing from 0 to "),
        ("engine.toss(N, R).path([99])", "times: 99 at 0; accepted: increasing from 0 to "),
    ],
)
def test_what_cannot_be_is_told_in_a_line(loaded, asked, told):
    case = cointoss.load("fig24a")
    given = f"const N = {numbers(case)}, R = {state_at_release(case.release).tolist()};"
    found = loaded.value(f"(() => {{ {given} return message(async () => {asked}); }})()")
    assert found.startswith(told)
    assert "\n" not in found


def test_air_with_an_exponent_is_refused():
    case = scenario(air={**AIR, "exponent": 0.5})
    with pytest.raises(UnsupportedError, match=r"air\.exponent = 0\.5: accepted in a page: 0"):
        numbers_of(case)


@pytest.mark.parametrize("most", [20_000, 5])
def test_any_pixel_of_the_explorer_in_a_file_is_tossed_by_the_engine_in_it(page, tmp_path, monkeypatch, most):
    monkeypatch.setitem(static.MOST_IMPACTS, Engine.ANALYTIC, most)
    monkeypatch.setattr(static, "COLUMNS", 2)
    monkeypatch.setattr(static, "ROWS", 2)
    target = tmp_path / "map.html"
    longer = SCENARIO.replace("max_impacts = 4", "max_impacts = 40")
    static.write_static(small_map(tmp_path, size=(24, 18), text=longer), target)
    sweep = read_map(tmp_path / "map.zarr").sweep
    x, y = float(sweep.x.values[3]), float(sweep.y.values[9])
    page.open(f"{target.as_uri()}#x={x}&y={y}")
    page.wait_for("document.getElementById('outcome').textContent.includes(' impacts in ')")
    page.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: tossed only')")
    case = sweep.scenario.replace("release.angular_velocity.eta", x, "release.position.z", y)
    toss = analytic.toss(case.replace("ending.max_impacts", min(most, case.rules.max_impacts)))
    told = page.text("outcome")
    is_cut = most < case.rules.max_impacts
    assert f" s. {f'It is shown up to impact {most}.' if is_cut else toss.ending.sentence}" in told
    assert f"analytic: {toss.outcome} after {len(toss.impacts)} impacts in {toss.end_time:.4f} s." in told
    assert "MuJoCo: tossed only where there is a dot." in told
    assert "Any pixel can be tossed" in page.text("about")
    assert page.complaints() == []
    page.value("document.getElementById('map').focus()")
    page.press("ArrowRight")
    page.wait_for(f"location.hash.includes('x={float(sweep.x.values[4])}')")


def test_a_map_whose_axes_are_no_numbers_of_a_row_has_no_engine():
    case = cointoss.load("fig24a")
    assert engine_data(case, ["release.position.z", "floor.restitution"]) is not None
    assert engine_data(case, ["release.position.z", "coin.radius"]) is None
    in_air = scenario(air={**AIR, "exponent": 0.5})
    assert engine_data(in_air, ["release.position.z"]) is None


@pytest.mark.parametrize("field", PLACES)
def test_a_field_is_at_its_place(field):
    fixed = {"floor.contact": "coulomb", "floor.friction": 0.2, "ending.max_impacts": 100}
    case, (row, at) = cointoss.load("fig24a"), PLACES[field]
    for name, value in fixed.items():
        case = case.replace(name, value)
    changed = case.replace(field, 0.375)
    rows = [
        {"numbers": numbers_of(each), "release": state_at_release(each.release)} for each in (case, changed)
    ]
    differ = {(name, int(i)) for name in rows[0] for i in np.flatnonzero(rows[0][name] != rows[1][name])}
    assert differ == {(row, at)}
    assert rows[1][row][at] == 0.375
