"""What the scripts of lab and player compute, each by itself, against the package and closed forms."""

import json
import re
from math import cos, pi, sin
from pathlib import Path
from urllib.parse import quote

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import norm

import cointoss
from cointoss import analytic
from cointoss.compare.engines import Engine
from cointoss.compare.lab.saved import saved_map, scenario_of
from cointoss.compare.lab.served import MAP, map_asked
from cointoss.compare.metrics.estimates import share_of
from cointoss.compare.web.playable import path_of, playable, shown_outcomes
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
TOSS = analytic.toss(CASE)
PLAYED = {
    **playable(TOSS, 200),
    "path": path_of(TOSS, 200, with_spin=True),
    "heights": TOSS.impacts.position[:, 2].tolist(),
}
ATTITUDES = Rotation.from_quat(np.reshape(PLAYED["path"]["quaternion"], (-1, 4)), scalar_first=True)
TWO = f"{{ '{SPIN}': 27, '{HEIGHT}': 0.4, 'release.angular_velocity.zeta': 5 }}"
CAUGHT = f"{{ '{SPIN}': 27, '{HEIGHT}': 0.4, 'release.velocity.z': 2, 'ending.caught': 0.4 }}"
HALF_HEADS = """{ tossEach: async () => ({ outcome: Array(100).fill(1), lastFace: Array(100).fill(2),
  impacts: Array.from({ length: 100 }, (_, i) => 2 + i % 2) }) }"""
"""Tosses that end with heads, every second one of which shows tails at the third touch."""
STATE = (
    "{ x: { field: 'a', from: 0, to: 1 }, y: { field: 'b', from: 2, to: 4 }, after: 1, scenario: { c: 1 } }"
)
OTHER = "{ x: { field: 'a', from: 4, to: 9 }, y: { field: 'b', from: 2, to: 4 }, after: 1, scenario: {} }"
COIN = "{ thickness: 0.002, center: [0, 0, 1e-4] }"
LAID = {
    "time": [0, 1],
    "position": [0, 0, 1, 3, 4, 0.01],
    "quaternion": [1, 0, 0, 0, 0.48, 0.6, 0.64, 0],
}
JOB = """{ x: { field: 'a', start: 0, stop: 2, count: 3 }, y: { field: 'b', start: 5, stop: 6, count: 2 },
  codes: [1, 2, -2, 1, 1, 2], trusted: [1, 0, 1, 1, 0, 1], isTossed: [1, 1, 1, 0, 1, 1] }"""
ABOUT_Y = f"[1, 0, 0, 0, {cos(0.6)}, 0, {sin(0.6)}, 0]"
TURNED = f"{{ time: [0, 1], position: [0, 0, 0, 2, 4, 6], quaternion: {ABOUT_Y} }}"
THROWS = """[[2, 40, 'heads'], [2.2, 40, 'tails'], [1.8, 40, 'heads'], [2, 40, 'heads']].map(
  ([speed, spin, outcome]) => ({ speed, spin, outcome }))"""
SPEEDS = np.std([2, 2.2, 1.8, 2], ddof=1)
FACES = "[{ sequence: 'HHT', outcome: 'tails' }, { sequence: 'HH', outcome: 'heads' }]"
SHOWN = """const box = document.createElement('div');
  m.showSequences(box, [TOSS], null, 1);
  m.markTouch(box, [TOSS], 0.72)"""
UPSIDE_DOWN = "{ time: [0, 1], quaternion: [1, 0, 0, 0, 0, 1, 0, 0] }"
THIRD = "{ c: { default: 3 } }"
PLACED = """(() => {
  const canvas = document.createElement("canvas"), chosen = [], nothing = () => {};
  canvas.style = "position: fixed; left: 0; top: 0; width: 148px; height: 142px";
  document.body.append(canvas);
  const map = async (scenario, x, y, _, onPart) => {
    const pixels = Int32Array.from({ length: x.count * y.count }, (_, i) => i);
    onPart({ stride: 1, pixels, codes: Int8Array.from(pixels, (i) => i % 100), trusted: null, finished: 1 });
  };
  const told = { choose: ({ code, x, y }) => chosen.push(code, x, y), place: nothing, moved: nothing };
  Object.assign(told, { end: nothing, nearest: nothing, progress: nothing, problem: nothing });
  const more = { outcomes: {}, saved: null, marks: () => [] };
  const shown = m.makeLiveMap({ canvas, workers: { map }, fields, told, ...more });
  const x = { field: "coin.radius", from: 0, to: 3 }, y = { field: "coin.mass", from: 0, to: 8 };
  shown.update({ x, y, home: { x, y }, scenario: {}, after: 1, trust: false, hand: null, before: null });
  canvas.dispatchEvent(new MouseEvent("click", { clientX: 74 + 41, clientY: 10 + 25 }));
  canvas.remove();
  return chosen;
})()"""
"""A click on a map of 30 by 40 pixels of two on the screen, of which each has its number, less hundreds, as
its code: it falls on column 20 of the row that is 12 below the highest."""
AXES = "[{ word: 'spin', unit: 'rad/s' }, { word: 'height', unit: 'm' }]"


def wave(scatter):
    """Return the most heads of a hand whose turns scatter: a normal's part within quarter turns."""
    whole = np.arange(-40, 41)
    return np.sum(norm.cdf((whole + 0.25) / scatter) - norm.cdf((whole - 0.25) / scatter))


def shares(*counts):
    """Return shares with both ends of their intervals."""
    found = [share_of(met, count) for met, count in counts]
    return [part for one in found for part in (one.value, one.low, one.high)]


ROWS = [
    # A hand: Wilson's interval, the ellipse of one standard deviation, heads at a touch, Keller's curve.
    (
        "hand",
        "[[30, 100], [0, 10], [10, 10]].flatMap((each) => Object.values(m.wilson(...each)).slice(0, 3))",
        pytest.approx(shares((30, 100), (0, 10), (10, 10))),
    ),
    (
        "hand",
        f"m.ellipse({{ x: {{ field: '{SPIN}' }}, y: {{ field: '{HEIGHT}' }}, scenario: {TWO} }}, 0.02)"
        ".filter((_, i) => i % 24 === 0).flat()",
        pytest.approx([27.54, 0.4, 27, 0.408, 26.46, 0.4, 27, 0.392, 27.54, 0.4]),
    ),
    (
        "hand",
        f"m.ellipse({{ x: {{ field: '{SPIN}' }}, y: {{ field: 'release.angular_velocity.zeta' }},"
        f" scenario: {TWO} }}, 0.02).filter((_, i) => i % 24 === 0).flat()",
        pytest.approx([27.54, 5.1, 27, 5, 26.46, 4.9, 27, 5, 27.54, 5.1]),
    ),
    ("hand", f"Object.keys(m.releases({CAUGHT}, 0.02, 5))", ["release.velocity.z", SPIN]),
    (
        "hand",
        f"(async () => {{ let last; const hand = {{ scenario: {TWO}, after: 2, hand: 0.02 }};"
        f" await m.countHeads({HALF_HEADS}, hand, (told) => (last = told), {{}}); return last; }})()",
        {
            **dict(zip(("share", "low", "high"), shares((1000, 2000)), strict=True)),
            "count": 2000,
            "isWhole": True,
        },
    ),
    *(
        ("challenge", f"m.kellersCurve({part})", pytest.approx(wave(part), abs=1e-9))
        for part in (0.02, 0.1, 0.3, 0.7)
    ),
    ("challenge", f"m.longestRow({THROWS})", 2),
    ("challenge", "m.turnsOf({ speed: 2, spin: 40 })", pytest.approx(80 / (pi * 9.81))),
    (
        "challenge",
        f"m.handOf({THROWS})",
        pytest.approx(
            {"speed": 2, "spin": 40, "scatter": SPEEDS / 2 / 2**0.5, "turns": SPEEDS * 40 / (pi * 9.81)}
        ),
    ),
    # A flick to the right and up, in pixels per millisecond, within bounds.
    *(
        ("flick", f"Object.values(m.thrown({flick}))", pytest.approx(due))
        for flick, due in (
            ("0, 2", [2.4, 36]),
            ("1.5, 2", [2.4, 66]),
            ("-1.5, 2", [2.4, 66]),
            ("0, 0", [1, 32]),
            ("-1e9, -1e9", [1, 100]),
            ("0, 1e9", [3, 100]),
        )
    ),
    # Between two states.
    (
        "glide",
        f"[m.between({STATE}, {OTHER}, 0.25, {THIRD})].flatMap(({{ x, scenario }}) =>"
        " [x.from, x.to, scenario.c])",
        [1, 3, 1.5],
    ),
    ("glide", f"m.between({STATE}, {{ ...{OTHER}, after: 2 }}, 0.25, {THIRD})", None),
    ("glide", f"m.between({STATE}, {OTHER}, 0.25, {{ c: {{ default: 'a' }} }})", None),
    # A hundred coins.
    (
        "hundred",
        f"[...m.spread({{ '{SPIN}': 45 }}, 1e-3)]",
        pytest.approx(45 * np.linspace(1 - 1e-3, 1 + 1e-3, 100), rel=1e-12),
    ),
    (
        "hundred",
        f"[m.headsByTouch({FACES}), m.partingTouch({FACES}), m.ends({FACES})]",
        [[2, 2, 1], 3, {"heads": 1, "tails": 1}],
    ),
    ("hundred", f"m.partingTouch({FACES}.slice(1))", None),
    *(
        (
            "hundred",
            f"m.isHeads({{ path: {UPSIDE_DOWN} }}, {{ at: 0, part: {part} }})",
            due,
        )
        for part, due in ((0.4, True), (0.6, False))
    ),
    *(
        (
            "hundred",
            f"m.tossHundred(() => ({{ outcome: '{outcome}', coin: {COIN},"
            f" path: {json.dumps(LAID)} }}), {{ '{SPIN}': 1 }}, 0).then(([{{ path }}]) =>"
            " [...path.position.slice(-3), ...path.quaternion.slice(-4)])",
            pytest.approx([3, 4, height, *attitude / np.linalg.norm(attitude)]),
        )
        for outcome, height, attitude in (
            ("tails", 0.0009, np.array([0, 0.6, 0.64, 0])),
            ("heads", 0.0011, np.array([0.48, 0, 0, 0])),
        )
    ),
    # The nearest other colour.
    (
        "nearest",
        "[[14], [14, 6], [14, 6, 11]].map((some) => m.nearestOther("
        "Array.from({ length: 25 }, (_, i) => (some.includes(i) ? 2 : i === 13 ? -2 : 1)), 5, [2, 2], 1))",
        [[2, 0], [-1, -1], [-1, 0]],
    ),
    (
        "nearest",
        f"[[2, -1], [0, 0.5], [-0.125, 0]].map((way) => m.nearestText('heads', way, {AXES}).slice(27))",
        [
            "The nearest other colour lies to the lower right of the middle: "
            "roughly +2 rad/s in spin and −1 m in height.",
            "The nearest other colour lies above the middle: roughly +0.5 m in height.",
            "The nearest other colour lies to the left of the middle: roughly −0.13 rad/s in spin.",
        ],
    ),
    # Axes as numpy.linspace has them, and what is told of numbers.
    (
        "axes",
        "[0, 1, 2, 3, 4, 5, 6].map((i) => m.valueAt({ start: 0.1, stop: 0.7, count: 7 }, i))",
        np.linspace(0.1, 0.7, 7).tolist(),
    ),
    (
        "axes",
        "[20, 30, 60].map((value) => m.indexOf({ start: 20, stop: 60, count: 5 }, value))",
        [0, 1, 4],
    ),
    ("words", "[0.1 + 0.2, 1 / 3].map(m.shownAs)", ["0.3", "0.3333333333"]),
    (
        "live_map",
        "[[1], [0.5], [2], [0.0125], [1e-3], [3.2e-13, true]].map((given) => m.depthText(...given))",
        [
            "",
            "0.5 of the map",
            "2 of the map",
            "1.3e-2 of the map",
            "1e-3 of the map",
            "3.2e-13 of the map; doubles end here",
        ],
    ),
    ("live_map", PLACED, pytest.approx([(30 * 27 + 20) % 100, 3 * 20.5 / 30, 8 * 27.5 / 40])),
    (
        "plot",
        "[0, 1234.5678, 1e-4, 123456, null].map(m.numberText)",
        ["0", "1234.6", "1e-4", "1.2e+5", "–"],
    ),
    (
        "plot",
        f"(() => {{ const span = m.makeSpan([{{ end_time: 1, times: [], path: {TURNED} }}]);"
        " span.show(0.2, 0.6); span.zoom(0.5); return [span.low, span.high]; })()",
        pytest.approx([0.3, 0.5]),
    ),
    (
        "plot",
        "(() => { const box = document.createElement('div'), lines = [{ time: [0, 1], values: [0, 1] }];"
        f" const span = m.makeSpan([{{ end_time: 1, times: [], path: {TURNED} }}]);"
        " document.body.append(box); m.makePlot(box, { range: [0, 1], lines }, span);"
        " const { points } = box.querySelector('polyline'); box.remove();"
        " return [...points].map(({ y }) => y); })()",
        [290 - 48, 26],
    ),
    # A text of marks far apart begins inside of the frame, and ends there.
    (
        "plot",
        f"(() => {{ const box = document.createElement('div'), path = {TURNED};"
        " const span = m.makeSpan([0.15, 0.95].map((end_time) => ({ end_time, times: [], path })));"
        " box.style.width = '600px'; document.body.append(box);"
        " m.makePlot(box, { range: [0, 1], lines: [] }, span); const { left } = box.getBoundingClientRect();"
        " const text = box.querySelector('svg svg text').getBoundingClientRect(); box.remove();"
        " return [text.left - left > 66, text.right - left < 586, text.width > 100]; })()",
        [True, True, True],
    ),
    # At twice the speed frames after 0.1 s and 0.15 s.
    (
        "player",
        "(() => { const box = document.createElement('div'), frames = [], seen = [];"
        " for (const id of ['play', 'time', 'clock', 'speed', 'marks'])"
        " box.append(Object.assign(document.createElement('input'), { id, value: 2 }));"
        " document.body.append(box); const { requestAnimationFrame } = window;"
        " window.requestAnimationFrame = (frame) => frames.push(frame);"
        f" const tosses = [{{ end_time: 1, times: [], path: {TURNED} }}];"
        " m.makePlayer((time) => seen.push(time)).load(tosses, true, 1);"
        " if (!frames.length) box.firstChild.click();"
        " for (const now of [7000, 7100, 7250]) frames.shift()(now);"
        " Object.assign(window, { requestAnimationFrame }); box.remove(); return seen.slice(-3); })()",
        pytest.approx([0, 0.2, 0.5]),
    ),
    (
        "ticks",
        "[[0, 1, 5], [20, 60, 4], [0, 7, 4], [0, 12, 4]].map((given) => m.ticks(...given).step)",
        [0.2, 10, 2, 5],
    ),
    ("ticks", "m.ticks(20.5, 61, 5).values", [30, 40, 50, 60]),
    (
        "ticks",
        "[m.logTicks(0.5, 200, 7), m.logTicks(0.5, 20, 7)]",
        [[1, 10, 100], [0.5, 1, 2, 5, 10, 20]],
    ),
    (
        "sampled",
        "[-1, 0, 0.5, 1, 2, 3, 4].map((time) => m.valueAt([0, 1, 3], [0, 10, 30], time))",
        [None, 0, 5, 10, 20, 30, None],
    ),
    ("sampled", "m.placeIn([0, 1, 3], 1)", {"at": 1, "part": 0}),
    # What is saved.
    (
        "save",
        f"m.csv({JOB}, true, {{ 1: {{ label: 'heads' }}, 2: {{ label: 'tails' }} }}).split('\\n')",
        [
            "a,b,outcome,trusted",
            "0,5,heads,1",
            "1,5,tails,0",
            "2,5,no scenario,1",
            "0,6,not tossed,1",
            "1,6,heads,0",
            "2,6,tails,1",
            "",
        ],
    ),
    ("save", f"m.csv({JOB}, false, {{}}).split('\\n')[0]", "a,b,outcome"),
    # The coins: zloty, US nickel, euro.
    *(
        ("coins", f"Object.values(m.COINS['{name}'])", pytest.approx(due))
        for name, due in (
            ("zloty", [0.025 / 2, 0.002, 0.002]),
            ("nickel", [0.02121 / 2, 0.00195, 0.005]),
            ("euro", [0.02325 / 2, 0.00233, 0.0075]),
            ("three-way", [0.02121 / 2, 0.0177, pytest.approx(0.005 * 0.0177 / 0.00195, rel=1e-3)]),
        )
    ),
    # How a toss is played: where the coin is, what is plotted of it, and its faces.
    (
        "posed",
        f"[m.poseAt({TURNED}, 0.5)].flatMap(({{ position, attitude }}) => [...position, ...attitude])",
        pytest.approx([1, 2, 3, 0, sin(0.3), 0, cos(0.3)]),
    ),
    (
        "motion",
        "m.heightOf([TOSS]).lines[0].values",
        pytest.approx(1e3 * np.array(PLAYED["path"]["position"][2::3])),
    ),
    (
        "motion",
        "m.heightOf([TOSS]).dots[0].values",
        pytest.approx(1e3 * TOSS.impacts.position[:, 2], rel=1e-4),
    ),
    (
        "motion",
        "m.placeOf([{ ...TOSS, path: { time: [0, 1], position: [0, 0, 0, 1e-3, 2e-3, 0.4] } }])"
        ".lines.map(({ name, values }) => [name, values[1]])",
        [["x analytic", 1], ["y analytic", 2]],
    ),
    (
        "motion",
        "m.tiltsOf([TOSS]).lines[0].values",
        pytest.approx(np.degrees(np.arccos(ATTITUDES.as_matrix()[:, 2, 2].clip(-1, 1))), abs=1e-2),
    ),
    ("motion", "m.spinOf([TOSS]).lines.map(({ values }) => values[0])", [40.15, 0.0]),
    ("motion", "m.energyOf([TOSS]).lines[0].values", pytest.approx(1e3 * np.array(PLAYED["path"]["energy"]))),
    ("motion", "m.energyOf([TOSS]).levels[0].value", pytest.approx(2 * 9.81 * np.hypot(0.0125, 0.001))),
    (
        "outcome",
        "m.outcomeText(TOSS)",
        f"{TOSS.outcome} after 16 impacts in {TOSS.end_time:.4f} s. {TOSS.ending.sentence}",
    ),
    (
        "sequences",
        f"(() => {{ {SHOWN}; return ['mapped', 'horizon', 'now']"
        ".map((kind) => box.querySelector(`span.${kind}`).dataset.touch); })()",
        ["1", str(TOSS.trusted_impacts - 1), "1"],
    ),
    (
        "sequences",
        "[m.commonPrefix('HHT', 'HHHT'), m.commonPrefix('HT', 'HT'), m.commonPrefix('T', 'H')]",
        [2, 2, 0],
    ),
]


@pytest.mark.parametrize(
    ("module", "asked", "due"), ROWS, ids=[f"{module}: {asked[:60]}" for module, asked, _ in ROWS]
)
def test_a_function_gives(loaded, module, asked, due):
    given = f"const TOSS = {json.dumps(PLAYED)}, m = await import('{module}.js')"
    assert loaded.value(f"(async () => {{ {given}; return {asked}; }})()") == due


def test_releases_of_a_hand_scatter_as_asked(loaded):
    asked = f"Object.entries(m.releases({TWO}, 0.02, m.TOSSES)).map(([field, all]) => [field, [...all]])"
    found = dict(loaded.value(f"import('hand.js').then((m) => {asked})"))
    spins, heights, turns = (np.array(found[f]) for f in (SPIN, HEIGHT, "release.angular_velocity.zeta"))
    assert spins / 27 == pytest.approx(turns / 5)
    assert abs(np.corrcoef(spins, heights)[0, 1]) < 4 / 2000**0.5
    for values, mean in ((spins, 27), (heights, 0.4)):
        # Within four standard errors.
        assert values.mean() == pytest.approx(mean, rel=4 * 0.02 / 2000**0.5)
        assert values.std() == pytest.approx(0.02 * mean, rel=4 / (2 * 2000) ** 0.5)


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
