"""The player of tosses in a headless Chromium: its time, coin and floor, its sound, its faces."""

import json
from itertools import pairwise

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss import analytic
from cointoss.compare.web.playable import playable
from cointoss.compare.web.scripts import POLICY, files_of, one_file
from tests.helpers.coins_shown import BLUE, GOLD, faces, picture, set_time

WOBBLE = 3.0
"""How long the coin lies after its proof, as a part of the time up to it."""
COUNTED = """
window.contexts = 0; window.tones = [];
const gain = { setValueAtTime: (value) => tones.push(value), exponentialRampToValueAtTime() {} };
const made = () => ({ connect: (next) => next, gain, frequency: {}, start() {}, stop() {} });
window.AudioContext = class {
  constructor() { contexts++; }
  currentTime = 0;
  resume() {}
  createGain = made;
  createOscillator = made;
};
"""
"""Stands for the browser's sound, and keeps how loud each click is."""


INSIDE = """
(({ top, bottom }, out, box) => top >= out.top && bottom <= out.bottom && box.scrollWidth <= box.clientWidth)(
  document.querySelector(".horizon").getBoundingClientRect(),
  document.getElementById("sequences").getBoundingClientRect(), document.getElementById("sequences"))
"""
"""Whether the bar of the horizon and all faces are inside of their box."""
SIDES = """
["#marks .proof", "#time"].map((one) => document.querySelector(one).getBoundingClientRect())
  .map(({ left, width }) => [left, width])
"""
"""The left sides and the widths of the mark and of the slider [px]."""


def lying_on(toss):
    """Return a toss whose coin lies where its proof left it, for a time in which it touches often."""
    path, end = toss["path"], toss["end_time"]
    later = np.linspace(end, (1 + WOBBLE) * end, 400)[1:].tolist()
    for name, size in (("position", 3), ("quaternion", 4), ("energy", 1)):
        path[name] = path[name] + path[name][-size:] * len(later)
    path["time"] = path["time"] + later
    return {**toss, "later_times": later}


@pytest.fixture(scope="module")
def toss():
    return playable(analytic.toss("fig24a"))


@pytest.fixture
def played(page, tmp_path, toss):
    """Return what opens a page with a toss that goes on after its proof, or one that does not."""

    def opened(*, goes_on=True, **window):
        data = [lying_on(json.loads(json.dumps(toss))) if goes_on else toss]
        target = tmp_path / "played.html"
        target.write_text(one_file(files_of("cointoss.compare.web.play"), data, POLICY), encoding="utf-8")
        page.open(target.as_uri(), **window)
        return data[0]

    return opened


def places(page, times):
    """Return the places of times on the axis, as parts of it, and the times of these places."""
    return page.value(
        "import('timeline.js').then(({ makeTimeline }) => {"
        " const tosses = JSON.parse(document.getElementById('data').textContent);"
        " const { placeOf, timeAt, end } = makeTimeline(tosses);"
        f" return {json.dumps(times)}.map((time) => [placeOf(time) / end, timeAt(placeOf(time))]); }})"
    )


def test_flight_and_bounces_have_four_fifths_of_the_axis(page, played):
    shown = played()
    end = shown["path"]["time"][-1]
    times = np.linspace(0, end, 101).tolist()
    parts, back = zip(*places(page, times), strict=True)
    assert all(a < b for a, b in pairwise(parts))
    assert back == pytest.approx(times)
    assert (parts[0], parts[-1]) == (0, 1)
    # The last flight before which the coin rose by more than a hundredth of its fall.
    time, height = np.array(shown["path"]["time"]), np.array(shown["path"]["position"])[2::3]
    touches = [0, *shown["times"]]
    rises = [
        height[(time > a) & (time <= b)].max() - max(np.interp([a, b], time, height))
        if a
        else height[0] - np.interp(b, time, height)
        for a, b in pairwise(touches)
    ]
    last = touches[1 + max(np.flatnonzero(np.array(rises) > max(rises) / 100))]
    assert places(page, [last])[0][0] == pytest.approx(0.8)
    assert last < shown["end_time"] < 0.3 * end


def test_an_axis_whose_bounces_fill_it_is_linear(page, played):
    shown = played(goes_on=False)
    times = np.linspace(0, shown["end_time"], 11).tolist()
    assert [part for part, _ in places(page, times)] == pytest.approx(np.linspace(0, 1, 11).tolist())
    assert page.value("document.getElementById('marks').hidden")
    assert page.value("document.querySelectorAll('#energy .squeezed, #energy .proof').length") == 0


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_the_proof_is_marked_and_the_clock_tells_true_times(page, played, width, scheme):
    shown = played(width=width, scheme=scheme)
    words = "from here on it can't turn over"
    assert page.text("marks") == words
    assert words in page.text("energy")
    assert "shaded: on a scale of its own" in page.text("energy")
    (place, _), end = places(page, [shown["end_time"]])[0], shown["path"]["time"][-1]
    mark, slider = page.value(SIDES)
    assert mark[0] + 2 == pytest.approx(slider[0] + 8 + place * (slider[1] - 16), abs=1)
    set_time(page, place * end)
    assert page.text("clock") == f"{shown['end_time']:.3f} s"
    line = "Number(document.querySelector('#energy .{}').getAttribute('x1'))"
    now, proof = (page.value(line.format(one)) for one in ("now", "proof"))
    assert now == pytest.approx(proof, abs=0.5)
    texts = "[...document.querySelectorAll('#energy text[text-anchor=middle]')]"
    ticks = page.value(f"{texts}.map((one) => Number(one.textContent))")
    assert ticks == sorted(set(ticks))
    assert max(ticks) > shown["end_time"]
    # The rows of faces wrap.
    tops = page.value("[...document.querySelectorAll('#sequences [data-touch]')].map((one) => one.offsetTop)")
    assert tops == sorted(tops)
    assert (len(set(tops)) > 1) == (width == 420)
    assert page.value(INSIDE)
    assert page.value("document.documentElement.scrollWidth <= innerWidth")


def test_coin_and_floor_are_both_seen_at_release_and_at_every_touch(page, played):
    shown = played(goes_on=False, height=1000)
    floor = [np.array(color) for color in ((228, 231, 235), (204, 210, 217))]
    set_time(page, 0)
    assert faces(picture(page, "coins")) > 500
    for time in (0, *shown["times"]):
        set_time(page, time)
        coins = picture(page, "coins").astype(int)
        assert min((np.abs(coins - color).max(axis=-1) <= 4).sum() for color in floor) > 1000
    # The face that is up is seen from above.
    path = shown["path"]
    up = Rotation.from_quat(np.reshape(path["quaternion"], (-1, 4)), scalar_first=True).as_matrix()[:, 2, 2]
    for at, (seen, other) in ((np.argmax(up), (GOLD, BLUE)), (np.argmin(up), (BLUE, GOLD))):
        set_time(page, path["time"][at])
        coins = picture(page, "coins")[48:].astype(int)
        counts = [(np.abs(coins - color).max(axis=-1) <= 60).sum() for color in (seen, other)]
        assert counts[0] > 500 > counts[1]


def test_touches_are_heard_once_a_button_is_pressed(page, played):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=COUNTED)
    shown = played(goes_on=False, moving=True)
    button = "document.getElementById('sound')"
    page.wait_for("Number(document.getElementById('time').value) > 0.3")
    assert shown["times"][0] < 0.3
    assert page.value("[contexts, tones.length]") == [0, 0]
    assert page.value(f"{button}.ariaPressed") == "false"
    page.value(f"{button}.click()")
    page.value("document.getElementById('speed').value = '1'")
    page.wait_for("document.getElementById('play').textContent === 'Play'")
    page.value("document.getElementById('play').click()")
    page.wait_for("document.getElementById('play').textContent === 'Play'")
    loud = page.value("tones")
    assert page.value("contexts") == 1
    # The first touch is the hardest, and is played twice at most: in one frame may be more than one touch.
    assert 5 < len(loud) <= 2 * len(shown["times"])
    assert max(loud) == pytest.approx(0.3)
    assert min(loud) < 0.2
    page.value(f"{button}.click()")
    page.value("document.getElementById('play').click()")
    page.wait_for("Number(document.getElementById('time').value) > 0.5")
    assert page.value("tones.length") == len(loud)
