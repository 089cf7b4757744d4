"""What the scripts of lab and player compute, function by function, against the package and closed forms."""

import json
from math import cos, pi, sin

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from scipy.stats import norm

import cointoss
from cointoss import analytic
from cointoss.compare.metrics.estimates import share_of
from cointoss.compare.web.playable import path_of, playable
from tests.helpers.lab import HEIGHT, SPIN

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
