"""The lab in a browser, walked through: what it shows against the package, its address, and its failures."""

import csv
import io
import json
import re

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.models.batch import rows_of
from cointoss.models.reading import parse
from tests.helpers.browser import Page
from tests.helpers.coins_shown import NO_WEBGL, UNNAMED, box, faces, picture, set_time
from tests.helpers.command_line import printed
from tests.helpers.lab import (
    ADDRESSED,
    COUNTED,
    HEIGHT,
    SAVED,
    SPIN,
    TOSSED,
    WHOLE,
    clicks,
    place_of,
    saved,
    sequences,
    slides,
    state,
)

OFFLINE = {"offline": True, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
PAPER = "getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"
DRAWS = """
window.draws = [];
const draw = CanvasRenderingContext2D.prototype.drawImage;
CanvasRenderingContext2D.prototype.drawImage = function (image, ...place) {
  if (this.canvas.id === "map") {
    if (!window.draws.some((one) => one.image === image)) {
      const { data } = image.getContext("2d").getImageData(0, 0, image.width, image.height);
      window.draws.push({ image, isWhole: data.every((part, i) => i % 4 < 3 || part === 255), widths: [] });
    }
    window.draws.find((one) => one.image === image).widths.push(place[2]);
  }
  return draw.call(this, image, ...place);
};
"""
"""A script that keeps which pictures are drawn on the map, whether they are whole, and how wide."""
SCROLLING = """
[...document.querySelectorAll("body *")].filter((one) => one.scrollHeight > one.clientHeight
  && ["auto", "scroll"].includes(getComputedStyle(one).overflowY)).map((one) => one.id)
"""
THROWN = "document.getElementById('thrown').textContent"
SLIDER = "document.querySelector('[data-field=\"{}\"]').value"
STOP = "document.getElementById('stop').textContent"


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_a_coin_and_its_map_are_the_package_s_with_the_network_off(page, lab_path, width, scheme):
    page.call("Network.emulateNetworkConditions", **OFFLINE)
    page.call("Page.addScriptToEvaluateOnNewDocument", source=SAVED)
    page.open(lab_path.as_uri(), width=width, height=1900, scheme=scheme)
    page.wait_for(f"{TOSSED} && {WHOLE}")
    assert parse(saved(page, "toml"), "coin.toml") == cointoss.load("fig24a")
    rows = list(csv.DictReader(io.StringIO(saved(page, "csv"))))
    values = [np.array([float(row[field]) for row in rows]) for field in (SPIN, HEIGHT)]
    codes = np.array([row["outcome"] for row in rows])
    case = cointoss.load("fig24a").replace("ending.max_impacts", 2)
    rows = rows_of(case, len(codes), dict(zip((SPIN, HEIGHT), values, strict=True)))
    assert np.mean(analytic.toss_rows(rows).after(1) == np.where(codes == "heads", 1, 2)) > 0.99
    set_time(page, 0)
    assert faces(picture(page, "coins")) > 500
    assert (np.mean(page.value(PAPER)) > 130) == (scheme == "light")
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert page.value(UNNAMED) == 0
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}


def test_a_click_tosses_a_pixel_and_its_link_opens_it_elsewhere(chromium, page, lab_path, tmp_path):
    page.open(lab_path.as_uri())
    page.wait_for(TOSSED)
    page.click(*place_of(page, 0.3, 0.4))
    page.wait_for("location.hash.includes('before=')")
    x, y = (float(state(page)[field]) for field in (SPIN, HEIGHT))
    assert (x, y) == (pytest.approx(20 + 0.3 * 40, abs=0.2), pytest.approx(0.2 + 0.4 * 0.4, abs=0.003))
    toss = analytic.toss(cointoss.load("fig24a").replace(SPIN, x, HEIGHT, y))
    trusted = min(toss.trusted_impacts, len(toss.impacts))
    assert sequences(page)["this toss"][:trusted] == toss.sequence[:trusted]
    assert f"{toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    page.value("document.getElementById('map').focus()")
    page.press("ArrowRight")
    page.wait_for(f"!location.hash.includes('eta={x}&')")
    # A pixel of the map is two of the screen.
    columns = round((box(page, "map")[2] - 74 - 14) / 2)
    assert float(state(page)[SPIN]) - x == pytest.approx(40 / columns)
    assert state(page)["before"] == f"{x:g}:{y!r}"
    clicks(page, "both", "hand", "trust")
    set_time(page, 0)
    for half in np.array_split(picture(page, "coins"), 2, axis=1):
        assert faces(half) > 500
    page.wait_for(f"{COUNTED} && location.hash.includes('hand=') && location.hash.includes('trust=1')")
    # A tab in the background draws no frames.
    due = state(page)
    printed("lab", "table", "--out", tmp_path / "other.html")
    with Page(chromium) as second:
        second.open((tmp_path / "other.html").as_uri() + page.value("location.hash"))
        second.wait_for(f"{COUNTED} && {TOSSED} && {ADDRESSED}")
        assert state(second) == due
        for id_ in ("outcome", "horizon", "share", "sequences"):
            assert second.text(id_) == page.text(id_)


def test_an_address_that_is_no_state_is_told_in_a_line(kept, lab_path):
    kept.open(f"{lab_path.as_uri()}#map=0", width=420)
    assert kept.text("problem") == (
        "The address is no state of the lab: map: 0; accepted: final, or the number of a touch from 1 to"
        " 1000. Shown is what the page begins with."
    )
    kept.wait_for(f"{TOSSED} && {WHOLE}")


def test_one_zooms_to_where_doubles_end(page, lab_path):
    page.open(lab_path.as_uri(), width=420)
    page.value("document.getElementById('map').focus()")
    for _ in range(60):
        page.press("+")
    page.wait_for("document.getElementById('ends').textContent.startsWith('Double precision ends here')")
    page.wait_for(
        "/^All that is seen is (heads|tails)/.test(document.getElementById('boundary').textContent)"
    )
    page.wait_for(f"{WHOLE} && location.hash.includes('x=')")
    # As many pixels as doubles.
    _, low, high = state(page)["x"].split(":")
    assert 100 < (float(high) - float(low)) / np.spacing(float(high)) < 2000
    page.press("0")
    page.wait_for("document.getElementById('ends').textContent === ''")


@pytest.mark.parametrize("moving", [True, False])
def test_a_zoom_glides_where_one_likes_motion_and_pictures_follow_a_slider(tab, lab_path, moving):
    # Without the coins, which a browser without a card draws slowly.
    tab.call("Page.addScriptToEvaluateOnNewDocument", source=DRAWS + NO_WEBGL)
    tab.open(lab_path.as_uri(), width=420, height=1900, moving=moving)
    tab.wait_for(WHOLE)
    tab.value("document.getElementById('map').focus()")
    tab.press("+")
    tab.wait_for(f"draws.length > 1 && {WHOLE}")
    widths = np.array(tab.value("draws[0].widths")) / (box(tab, "map")[2] - 74 - 14)
    # What was seen before grows to twice its size.
    assert (widths[0], widths[-1]) == pytest.approx((1, 2))
    assert (np.diff(widths) >= -1e-9).all()
    assert ((widths > 1.001) & (widths < 1.999)).any() == moving
    before = tab.value("draws.length")
    for value in (0.5, 0.6, 0.7):
        slides(tab, "floor.restitution", value)
        tab.wait_for(WHOLE)
    assert tab.value("draws.length") > before
    assert all(tab.value("draws.map(({ isWhole }) => isWhole)"))
    # A scenario that cannot be is told, and the state stays.
    slides(tab, HEIGHT, 0.001, least="0")
    tab.wait_for("document.getElementById('problem').textContent.includes('release.position.z')")
    assert float(tab.value(f"document.querySelector('[data-field=\"{HEIGHT}\"]').value")) == pytest.approx(
        0.40001
    )


@pytest.mark.parametrize(
    ("script", "told"),
    [
        ("delete window.WebAssembly;", "The lab cannot toss: this browser has no WebAssembly."),
        ("delete window.Worker;", ""),
        (NO_WEBGL, ""),
    ],
    ids=["no WebAssembly", "no workers", "no WebGL"],
)
def test_a_browser_that_lacks_something_is_told_and_the_page_goes_on(tab, lab_path, script, told):
    tab.call("Page.addScriptToEvaluateOnNewDocument", source=script)
    tab.open(lab_path.as_uri(), width=420)
    assert tab.text("problem") == told
    if not told:
        tab.wait_for(f"{WHOLE} && {TOSSED}")


def test_the_tour_is_walked_and_left_at_any_point(page, tmp_path):
    printed("lab", "--out", tmp_path / "lab.html")
    page.open((tmp_path / "lab.html").as_uri(), width=1280, height=800)
    stops = page.value("import('tour.js').then(({ STOPS }) => STOPS)")
    page.wait_for(TOSSED)
    # Coin, map, controls and energy are seen without scrolling, the coin below its label.
    for id_ in ("flick", "map", "shows", "play", "energy"):
        left, top, width, height = box(page, id_)
        assert 0 <= left <= left + width <= 1280
        assert 0 <= top <= top + height <= 800, id_
    panel = page.value("document.querySelector('.panel').getBoundingClientRect().bottom")
    assert panel <= box(page, "coins")[1]
    assert page.value(SCROLLING) == []
    for number, stop in enumerate(stops, start=1):
        told = "{}. {title}. {text}".format(number, **stop)
        page.wait_for(f"{STOP} === {json.dumps(told)}")
        page.wait_for(
            f"{TOSSED} && document.getElementById('crowd').hidden === {json.dumps(stop['name'] != 'hundred')}"
        )
        assert page.value("document.querySelector('#tour [aria-current]').textContent") == str(number)
        clicks(page, *["next"][: len(stops) - number])
    assert page.value("document.getElementById('next').disabled")
    clicks(page, "back", "trust")
    page.wait_for(f"location.hash.endsWith('tour={stops[-2]['name']}') && location.hash.includes('trust=1')")
    assert "You have changed something" not in page.text("stop")
    slides(page, "floor.restitution", 0.5)
    page.wait_for(f"{STOP}.includes('You have changed something')")


def test_one_moves_slowly_between_stops(page, lab_path):
    page.open(f"{lab_path.as_uri()}#tour=air", moving=True)
    page.wait_for(f"{TOSSED} && {WHOLE}")
    page.value(
        """(() => {
        window.seen = [];
        // A frame is 20 ms after the last, however busy the machine is.
        const clocks = new Map(), tick = (show) => clocks.set(show, (clocks.get(show) ?? 0) + 20).get(show);
        window.requestAnimationFrame = (show) => setTimeout(() => show(tick(show)));
        const slider = document.querySelector('[data-field="coin.center_of_mass.xi"]');
        const look = () => { seen.push(Number(slider.value)); requestAnimationFrame(look); };
        look();
    })()"""
    )
    clicks(page, "next")
    page.wait_for("location.hash.endsWith('tour=imperfect')")
    values = page.value("[...new Set(seen)]")
    assert len(values) > 5
    assert values == sorted(values, reverse=True)
    assert (values[0], values[-1]) == (0, -1)


def test_coins_that_are_thrown_are_counted_and_marked(page, lab_path):
    page.open(f"{lab_path.as_uri()}#tour=caught")
    page.wait_for(TOSSED)
    left, top, width, height = box(page, "flick")
    x, y = left + width / 2, top + height / 2
    given = []
    for speed in (0, 6):  # a click, and a flick
        before = page.value(THROWN)
        page.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        for step in range(1, 6):
            page.mouse("mouseMoved", x, y - 8 * speed * step, button="left", buttons=1)
        page.mouse("mouseReleased", x, y - 40 * speed, button="left", clickCount=1)
        page.wait_for(f"{THROWN} !== {json.dumps(before)}")
        given.append([float(page.value(SLIDER.format(field))) for field in (SPIN, "release.velocity.z")])
    ((found, told),) = re.findall(r" ((?:[HT] ?)+): ([\d.]+) turns", page.value(THROWN))
    turns = np.prod(given, axis=1) / (np.pi * 9.81)
    assert float(told) == pytest.approx(turns[1], abs=0.006)
    assert found.split() == ["H" if abs(each - round(each)) < 1 / 4 else "T" for each in turns]
    page.wait_for(WHOLE)
    # The stop's map is of 10 to 100 rad/s and 0.5 to 3 m/s; about the first dot is a white ring, smoothed.
    (spin, up), _ = given
    x, y = place_of(page, (spin - 10) / 90, (up - 0.5) / 2.5)
    shown, (left, top, *_) = picture(page, "map"), box(page, "map")
    across, down = round(x - left), round(y - top)
    assert np.min([shown[down, across - 6], shown[down, across + 6], shown[down - 6, across]]) > 150
    clicks(page, "again")
    page.wait_for("document.getElementById('challenge').hidden")


def test_the_face_of_a_throw_is_told_when_it_has_come_down(page, lab_path):
    page.open(f"{lab_path.as_uri()}#tour=caught", moving=True)
    page.wait_for(TOSSED)
    page.value("document.getElementById('flick').focus()")
    page.press(" ")
    page.wait_for("document.getElementById('outcome').textContent === 'The coin is in the air.'")
    assert page.text("state-analytic") == ""
    page.wait_for(f"{THROWN} !== ''")
    assert page.text("outcome").startswith(page.text("state-analytic"))
