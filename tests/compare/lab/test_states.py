"""What the scripts of the lab make of its state: files, addresses and maps, against the package."""

import json
import re
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest

import cointoss
from cointoss.compare.engines import Engine
from cointoss.compare.lab.saved import saved_map, scenario_of
from cointoss.compare.lab.served import MAP, map_asked
from cointoss.compare.web.playable import shown_outcomes
from cointoss.compare.web.server import query_of
from cointoss.models.batch import rows_of
from cointoss.models.devices import Device
from cointoss.models.fields import FIELDS
from cointoss.models.reading import parse
from cointoss.models.rows import fields_of, row_of
from tests.helpers.coins_shown import BLUE, GOLD
from tests.helpers.draws import IMPERFECT, scenario
from tests.helpers.engine_page import written
from tests.helpers.explored import SCENARIO, small_map
from tests.helpers.lab import HEIGHT, SPIN

RELEASES = sorted(folder for folder in (Path(__file__).parents[2] / "releases").iterdir() if folder.is_dir())
CASE = cointoss.load("fig24a")


@pytest.mark.parametrize(
    "case",
    [
        pytest.param(CASE, id="by angles"),
        pytest.param(CASE.replace("release.angles", [0.1, 0.2, 0.3]), id="by three angles"),
        pytest.param(
            scenario(coin=IMPERFECT, release={"quaternion": [0.5, 0.5, -0.5, 0.5]}), id="by quaternion"
        ),
        pytest.param(
            scenario(coin={"inertia": [[9e-8, 1e-9, 2e-9], [1e-9, 8e-8, 0], [2e-9, 0, 1.5e-7]]}), id="inertia"
        ),
    ],
)
def test_a_file_and_a_command_say_the_scenario_and_the_map(loaded, case):
    axes = ", ".join(
        f"{axis}: {{ field: '{field}', start: {start}, stop: {stop}, count: {count} }}"
        for axis, field, start, stop, count in (("x", SPIN, 20, 60, 7), ("y", HEIGHT, 0.2, 0.6, 5))
    )
    state = f"{{ scenario: {written(case)}, after: 2, trust: true }}"
    asked = f"[m.toml({written(case)}, fields), m.command({state}, fields, {{ {axes} }})]"
    text, command = loaded.value(f"import('toml.js').then((m) => {asked})")
    assert parse(text, "coin.toml") == case
    assert command == (
        f"cat > coin.toml << 'END'\n{text}END\ncointoss basin coin.toml --x {SPIN}=20:60:7 \\\n"
        f"  --y {HEIGHT}=0.2:0.6:5 \\\n  --after 2 --trust --out coin.zarr --png coin.png\n"
    )


def state_of(loaded, address, then):
    """Return what is made of the state `found` of an address by a page that begins with CASE."""
    return loaded.value(
        f"""Promise.all(["state.js", "toml.js"].map((name) => import(name))).then(([m, {{ toml }}]) => {{
          const start = {{ ...m.START, scenario: {written(CASE)} }};
          const found = m.fromAddress({json.dumps(address)}, fields, (given) => engine.fault(given), start);
          return {then};
        }}).catch(({{ message }}) => message)"""
    )


@pytest.mark.parametrize("release", RELEASES, ids=lambda folder: folder.name)
def test_an_address_of_an_earlier_release_is_the_state_it_was(loaded, release):
    address = (release / "given" / "lab.txt").read_text(encoding="utf-8").strip()
    text, state, again = state_of(
        loaded, address, "[toml(found.scenario, fields), found, m.address(found, fields)]"
    )
    assert parse(text, "coin.toml") == cointoss.load(release / "given" / "smooth.toml")
    assert state["x"] == {"field": SPIN, "from": 20, "to": 60}
    assert state["y"] == {"field": HEIGHT, "from": 0.2, "to": 0.6}
    assert [state[name] for name in ("after", "trust", "hand", "before")] == [1, True, 0.05, [30, 0.35]]
    assert state_of(loaded, again, "found") == state


WHOLE_COIN = (
    "#coin.mass=0.002&coin.radius=0.0125&coin.thickness=0.002&floor.contact=smooth"
    "&release.position.x=0&release.position.y=0&release.position.z=0.4"
)


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("#nonsense=1", "nonsense: no field of a scenario"),
        ("#coin.mass=NaN(", "coin.mass: NaN(; accepted: a number or a word"),
        (f"{WHOLE_COIN}&floor.restitution=1.5", "floor.restitution = 1.5: accepted: a number"),
        ("#coin.mass=0.002", "coin.radius"),
        ("#coin.radius=0", "coin.mass"),
        ("#x=coin.colour:1:2", "x: coin.colour:1:2; accepted: FIELD:FROM:TO"),
        (f"#x={SPIN}:2:1", f"x: {SPIN}:2:1; accepted: FROM below TO"),
        (f"#x={HEIGHT}:0.2:0.3", f"y: {HEIGHT}; accepted: another field than that of x"),
        ("#map=0", "map: 0; accepted: final, or the number of a touch from 1 to 1000"),
        ("#map=1001", "map: 1001; accepted: final"),
        ("#hand=0.31", "hand: 0.31; accepted: a number from 0 to 0.3"),
        ("#before=1", "before: 1; accepted: two numbers"),
        ("#tour=7", "tour: 7; accepted: caught, touch, bounces, hundred, restitution, air, imperfect, hand"),
        ("#hair=1", "hair: 1; accepted: a number from 1e-15 to 0.001"),
        (f"#x={quote('<b>' * 90)}", f"x: {'<b>' * 20} …; accepted"),
    ],
)
def test_an_address_that_is_no_state_is_told(loaded, address, told):
    assert state_of(loaded, address, "found").startswith(told)


@pytest.fixture(name="trusted_map", scope="module")
def _trusted_map(tmp_path_factory):
    longer = SCENARIO.replace("max_impacts = 4", "max_impacts = 20")
    options = ("--trust", "--after", "6", "--margin", "height")
    return cointoss.read_map(small_map(tmp_path_factory.mktemp("map"), *options, size=(6, 4), text=longer))


def test_a_map_that_was_made_is_pictured_and_told_pixel_by_pixel(loaded, trusted_map):
    x, y = (trusted_map[field].values for field in (SPIN, HEIGHT))
    pixels = [[u, v] for v in y for u in x]
    given = ", ".join(
        json.dumps(each)
        for each in (saved_map(trusted_map, "map.zarr"), None, fields_of(scenario_of(trusted_map)))
    )
    made, places = loaded.value(
        f"""import("saved.js").then(({{ makeSaved }}) => {{
          const saved = makeSaved({given}, fields, {json.dumps(shown_outcomes())});
          const read = (canvas) => [...canvas.getContext("2d").getImageData(0, 0, 6, 4).data];
          const {{ image, hatch }} = saved.drawn(), {{ state, window, about }} = saved;
          const other = {{ ...state.scenario, "floor.friction": 0.7 }};
          const shows = [state, {{ ...state, after: 0 }}, {{ ...state, scenario: other }}].map(saved.shows);
          const places = {json.dumps(pixels)}.map(([u, v]) => saved.place(u, v));
          return [{{ image: read(image), hatch: read(hatch), state, window, about, shows }}, places];
        }})"""
    )
    outcome, trust = trusted_map["outcome"].values, trusted_map["trusted_impacts"].values
    untrusted = trust < 7
    assert 0 < untrusted.sum() < untrusted.size
    assert [[each["x"], each["y"]] for each in places] == pixels
    assert [each["code"] for each in places] == [{"heads": 1, "tails": 2}[each] for each in outcome.ravel()]
    assert [each["trusted"] for each in places] == (~untrusted).ravel().tolist()
    margins = trusted_map["margin"].values.ravel()
    for told, impacts, sure, margin in zip(
        places, trusted_map["impacts"].values.ravel(), trust.ravel(), margins, strict=True
    ):
        assert told["known"].startswith(f"{impacts} impacts, {sure} of them trusted")
        found = re.findall(r"; margin along height ([+−][\d.e-]+) mm", told["known"])
        due = [margin] if np.isfinite(margin) else []
        assert [float(each.replace("−", "-")) for each in found] == pytest.approx(due, rel=5e-3)
    # On a canvas the first row is above.
    colors = [{"heads": GOLD, "tails": BLUE}[each] for each in outcome[::-1].ravel()]
    assert np.reshape(made["image"], (-1, 4))[:, :3].tolist() == [list(each) for each in colors]
    assert np.array_equal(np.reshape(made["hatch"], (4, 6, 4))[:, :, 3] == 255, untrusted[::-1])
    assert list(made["window"].values()) == pytest.approx([16, 64, 0.4 / 3 - 0.0, 0.6 + 0.2 / 3])
    assert (made["state"]["scenario"][SPIN], made["state"]["scenario"][HEIGHT]) == (x[3], y[2])
    assert made["shows"] == [True, False, False]
    assert made["about"].startswith("map.zarr: 6 by 4 tosses by the analytic engine: the face at touch 7")


def test_a_server_is_asked_for_the_map_of_a_row(loaded):
    asked, codes = loaded.value(
        f"""import("served.js").then(async ({{ tossedThere }}) => {{
          const own = window.fetch, asked = [], octets = Int8Array.from({{ length: 24 }}, (_, i) => i);
          const answer = {{ ok: true, arrayBuffer: async () => octets.buffer }};
          window.fetch = async (address) => (asked.push(address), answer);
          const x = {{ field: "{SPIN}", start: 20, stop: 60, count: 4 }};
          const y = {{ field: "{HEIGHT}", start: 0.2, stop: 0.6, count: 3 }};
          const row = engine.row({written(CASE)});
          const {{ codes, trusted }} = await tossedThere({{ row, x, y, after: 2, trust: true }});
          window.fetch = own;
          return [asked[0], [[...codes], [...trusted]]];
        }})"""
    )
    words = query_of(asked.removeprefix("map?"), MAP)
    batch, how = map_asked(words, Engine.ANALYTIC, Engine.ANALYTIC.package.MANY, Device.CPU)
    assert codes == [list(range(12)), list(range(12, 24))]
    assert (how.after, bool(how.trust)) == (2, True)
    spins, heights = np.meshgrid(np.linspace(20, 60, 4), np.linspace(0.2, 0.6, 3))
    due = rows_of(CASE, 12, {SPIN: spins.ravel(), HEIGHT: heights.ravel()})
    np.testing.assert_array_equal(batch.rows(np.arange(12)), due)


def test_a_slider_sets_the_field_to_what_it_shows(loaded):
    """The package reads the text beside it, with its unit."""
    found = loaded.value(
        f"""import("controls.js").then(({{ makeControls }}) => {{
          const boxes = {{}}, axes = {{ x: {{ field: "{SPIN}" }}, y: {{ field: "{HEIGHT}" }} }};
          for (const name of ["map", "release", "coin", "floor", "hand", "hair"])
            boxes[name] = document.createElement("div");
          let state = {{ scenario: {written(CASE)}, ...axes, hand: 0.02, hair: null }};
          const change = (more) => show((state = {{ ...state, ...more }}));
          const {{ show }} = makeControls(boxes, fields, change);
          show(state);
          const sliders = (box) => [...box.querySelectorAll("input[type=range]")];
          const inputs = Object.values(boxes).flatMap(sliders);
          return inputs.map((input) => {{
            input.value = Number(input.min) + 0.375 * (input.max - input.min);
            input.dispatchEvent(new Event("input"));
            const {{ field = "" }} = input.dataset, shown = input.parentElement.querySelector("output");
            return [field, state.scenario[field], shown.textContent, state.hand];
          }});
        }})"""
    )
    for field, value, shown, _ in found:
        if field:
            case = CASE.replace(field, shown.replace("°", " deg").replace("\u00a0", " "))
            assert value == pytest.approx(dict(zip(FIELDS, row_of(case), strict=True))[field], rel=1e-3), (
                field
            )
    _, _, *told = found[-2]
    assert told == ["7.563\u00a0%", pytest.approx(0.0756, abs=1e-4)]


VIEW = """
import("map_view.js").then(({ makeView }) => {
  const canvas = Object.assign(document.createElement("canvas"), { tabIndex: 0 });
  canvas.style = "position: fixed; left: 0; top: 0; width: 400px; height: 262px";
  document.body.append(canvas);
  window.told = [];
  const keeps = (name) => (...given) => told.push([name, ...given]), axis = { word: "a", unit: "" };
  window.view = makeView({
    canvas, choose: keeps("choose"), step: keeps("step"), axes: () => ({ x: axis, y: axis }),
    whole: () => ({ left: 0, right: 4, bottom: 0, top: 2 }), limits: () => ({ least: 0, most: 8 }),
    paint() {}, about: () => null, hover() {}, moved() {}, end() {},
  });
  canvas.focus();
})
"""
"""A view of 312 by 200 pixels beside margins of 74 at the left and 10 above, on values to 4 and to 2."""


def test_a_map_is_chosen_from_stepped_through_zoomed_and_moved(loaded):
    loaded.value(VIEW)
    whole, narrow = [0, 4, 0, 2], 2 * np.exp(-0.4)
    drag = (("mousePressed", 200, 100), ("mouseMoved", 278, 150), ("mouseReleased", 278, 150))
    for act, due, window in (
        (lambda: loaded.click(74 + 78, 10 + 50), ["choose", 1, 1.5], whole),
        (lambda: loaded.press("ArrowUp"), ["step", 0, 1], whole),
        (lambda: loaded.press("ArrowDown", shift=True), ["step", 0, -10], whole),
        (lambda: loaded.press("ArrowRight"), ["step", 1, 0], whole),
        (lambda: loaded.press("ArrowLeft"), ["step", -1, 0], whole),
        (lambda: loaded.press("+"), None, [1, 3, 0.5, 1.5]),
        (lambda: loaded.press("0"), None, whole),
        (lambda: loaded.press("-"), None, [-2, 6, -1, 3]),
        (lambda: loaded.press("0"), None, whole),
        (
            lambda: loaded.mouse("mouseWheel", 74 + 78, 10 + 50, deltaX=0, deltaY=-120),
            None,
            [1 - narrow / 2, 1 + 1.5 * narrow, 1.5 - 0.75 * narrow, 1.5 + 0.25 * narrow],
        ),
        (lambda: loaded.press("0"), None, whole),
        (
            lambda: [loaded.mouse(kind, x, y, button="left", buttons=1) for kind, x, y in drag],
            None,
            [-1, 3, 0.5, 2.5],
        ),
    ):
        act()
        told, found = loaded.value("[told.pop() ?? null, Object.values(view.window())]")
        assert told == (due and [due[0], pytest.approx(due[1]), pytest.approx(due[2])])
        assert found == pytest.approx(window)


HEADS, TAILS = np.array([200, 100, 0]), np.array([0, 20, 160])
COLUMNS, ROWS_UP = 72, 48


def reconstructed(page, codes, stride, trusted=None):
    """Return the part of heads and the doubts of a map, rows upwards, of a toss in each square."""
    random = np.random.default_rng(1)
    known = np.full(codes.shape, -1)
    for corner in np.ndindex(ROWS_UP // stride, COLUMNS // stride):
        at = tuple(stride * np.array(corner) + random.integers(stride, size=2))
        known[at] = codes[at]
    given = {
        "columns": COLUMNS,
        "rows": ROWS_UP,
        "stride": stride,
        "codes": known.ravel().tolist(),
        "trusted": None if trusted is None else trusted.ravel().tolist(),
        "colors": {"-1": [9, 9, 9], "1": HEADS.tolist(), "2": TAILS.tolist()},
    }
    pixels, doubts = page.value(
        f"import('reconstruct.js').then(({{ reconstruct }}) => reconstruct({json.dumps(given)}))"
        ".then(({ pixels, doubts }) => [[...pixels], [...doubts]])"
    )
    colors, parts = np.reshape(pixels, (ROWS_UP, COLUMNS, 4)), (HEADS - TAILS)[[0, 2]]
    share = (colors[:, :, [0, 2]] - TAILS[[0, 2]]) / parts
    assert (colors[:, :, 3] == 255).all()
    assert np.abs(share[:, :, 0] - share[:, :, 1]).max() < 0.02
    return share[:, :, 0], np.reshape(doubts, (ROWS_UP, COLUMNS))


@pytest.mark.parametrize("stride", [2, 3, 4, 6])
@pytest.mark.parametrize("is_upright", [True, False])
def test_both_halves_have_their_colours_and_a_boundary_between_them(loaded, stride, is_upright):
    along = np.arange(COLUMNS) if is_upright else np.arange(ROWS_UP)[:, np.newaxis]
    middle = along.size // 2
    share, _ = reconstructed(
        loaded, np.where(along < middle, 1, 2) * np.ones((ROWS_UP, COLUMNS), int), stride
    )
    across = share if is_upright else share.T
    assert np.abs(across[:, : middle - 3 * stride] - 1).max() < 0.01
    assert np.abs(across[:, middle + 3 * stride :]).max() < 0.01
    # Halfway where the boundary is, but for the distance between tosses, without steps.
    assert np.abs((across > 0.5).sum(axis=1) - middle).max() <= 1.5 * stride
    assert np.abs(np.diff(across, axis=1)).max() < 0.75


@pytest.mark.parametrize("stride", [2, 3, 4])
def test_a_checkerboard_that_is_finer_than_the_tosses_is_grey(loaded, stride):
    codes = 1 + np.add.outer(np.arange(ROWS_UP), np.arange(COLUMNS)) % 2
    share, _ = reconstructed(loaded, codes, stride)
    assert abs(share.mean() - 0.5) < 0.05
    assert share.std() < 0.1


def test_what_is_doubted_is_so_in_part_where_neighbours_disagree(loaded):
    trusted = np.where(np.arange(COLUMNS) < COLUMNS // 2, 0, 1) * np.ones((ROWS_UP, 1), dtype=int)
    _, doubts = reconstructed(loaded, np.ones((ROWS_UP, COLUMNS), dtype=int), 4, trusted)
    assert (doubts[:, :24] == 255).all()
    assert (doubts[:, 48:] == 0).all()
    assert (np.diff(doubts.mean(axis=0)) <= 1e-9).all()
