"""The lab in a browser: its map, tosses, hand and tour against the package, its address, and its failures."""

import csv
import io
import re
from pathlib import Path
from urllib.parse import parse_qs, quote

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.models.reading import parse
from tests.helpers.browser import Page
from tests.helpers.coins_shown import BLUE, GOLD, NO_WEBGL, UNNAMED, box, faces, picture, set_time
from tests.helpers.command_line import cointoss as command
from tests.helpers.lab import ADDRESSED, COUNTED, HEIGHT, SAVED, SPIN, TOSSED, WHOLE, saved

RELEASES = sorted(folder for folder in (Path(__file__).parents[1] / "releases").iterdir() if folder.is_dir())
OFFLINE = {"offline": True, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
PAPER = "getComputedStyle(document.body).backgroundColor"
TEXTS = """
const { clearRect, fillText } = CanvasRenderingContext2D.prototype;
Object.assign(CanvasRenderingContext2D.prototype, {
  clearRect(...box) { window.texts = []; return clearRect.apply(this, box); },
  fillText(...text) { window.texts?.push(text[0]); return fillText.apply(this, text); },
});
"""
"""A script that keeps what is written on the map."""
WHOLE_COIN = (
    "#coin.mass=0.002&coin.radius=0.0125&coin.thickness=0.002&floor.contact=smooth"
    "&release.position.x=0&release.position.y=0&release.position.z=0.4"
)


def place_of(page, u, v):
    """Return where a part of both sides of the map is on the page; the margins are those of map_view.js."""
    left, top, width, height = box(page, "map")
    return left + 74 + u * (width - 74 - 14), top + 10 + (1 - v) * (height - 10 - 52)


def state(page):
    page.wait_for(ADDRESSED)
    return {name: values[0] for name, values in parse_qs(page.value("location.hash")[1:]).items()}


def slide(page, field, value):
    input_ = f"document.querySelector('[data-field=\"{field}\"]')"
    page.value(f"{input_}.value = {value}; {input_}.dispatchEvent(new Event('input'))")


def sequences(page):
    faces_ = "[...row.querySelectorAll('span')].map((cell) => cell.textContent).join('')"
    row = f"[row.querySelector('b').textContent, {faces_}]"
    return dict(
        page.value(f"[...document.querySelectorAll('#sequences .row[role=img]')].map((row) => {row})")
    )


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 420])
def test_the_page_shows_a_coin_and_its_map_with_the_network_off(page, lab_path, width, scheme):
    page.call("Network.emulateNetworkConditions", **OFFLINE)
    page.open(lab_path.as_uri(), width=width, height=1900, scheme=scheme)
    page.wait_for(TOSSED)
    page.wait_for(WHOLE)
    shown = picture(page, "map")[10:-52, 74:-14].reshape(-1, 3)
    for color in (GOLD, BLUE):
        assert np.mean((shown == color).all(axis=1)) > 0.3
    set_time(page, 0)
    assert faces(picture(page, "coins")) > 500
    paper = np.mean([int(part) for part in re.findall(r"\d+", page.value(PAPER))])
    assert paper > 200 if scheme == "light" else paper < 60
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert page.value(UNNAMED) == 0
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}


def test_what_is_seen_is_what_the_package_tosses(page, lab_path):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=SAVED)
    page.open(lab_path.as_uri(), width=420)
    page.wait_for(WHOLE)
    rows = list(csv.DictReader(io.StringIO(saved(page, "csv"))))
    text = saved(page, "toml")
    scenario = parse(text, "coin.toml")
    assert scenario == cointoss.load("fig24a")
    page.value("document.getElementById('copy').click()")
    page.wait_for("!document.getElementById('command').hidden")
    asked = page.text("command")
    assert text in asked
    spans = [re.findall(rf"--{axis} (\S+)=(\S+):(\S+):(\d+)", asked)[0] for axis in "xy"]
    assert [span[0] for span in spans] == [SPIN, HEIGHT]
    values = [np.linspace(float(start), float(stop), int(count)) for _, start, stop, count in spans]
    assert [float(row[SPIN]) for row in rows[: len(values[0])]] == values[0].tolist()
    assert sorted({float(row[HEIGHT]) for row in rows}) == values[1].tolist()
    assert "--after 1" in asked
    drawn = np.random.default_rng(0).choice(len(rows), 200, replace=False)
    for at in drawn:
        place = {field: float(rows[at][field]) for field in (SPIN, HEIGHT)}
        case = scenario.replace(SPIN, place[SPIN], HEIGHT, place[HEIGHT])
        toss = analytic.toss(case)
        if toss.trusted_impacts > 1:
            assert rows[at]["outcome"] == ("heads" if toss.impacts.face[1] == 1 else "tails")


def test_a_click_tosses_a_pixel_and_arrows_step_to_the_next(page, lab_path):
    page.open(lab_path.as_uri())
    page.wait_for(TOSSED)
    page.click(*place_of(page, 0.3, 0.4))
    page.wait_for("document.getElementById('horizon').textContent.includes('before')")
    page.wait_for("location.hash.includes('before=')")
    found = state(page)
    x, y = float(found[SPIN]), float(found[HEIGHT])
    assert x == pytest.approx(20 + 0.3 * 40, abs=0.2)
    assert y == pytest.approx(0.2 + 0.4 * 0.4, abs=0.003)
    toss = analytic.toss(cointoss.load("fig24a").replace(SPIN, x, HEIGHT, y))
    trusted = min(toss.trusted_impacts, len(toss.impacts))
    assert trusted > 2
    assert sequences(page)["this toss"][:trusted] == toss.sequence[:trusted]
    assert f"{toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    assert page.value("document.querySelector('#sequences .mapped').dataset.touch") == "1"
    page.value("document.getElementById('map').focus()")
    page.press("ArrowRight")
    page.wait_for(f"!location.hash.includes('eta={found[SPIN]}&')")
    stepped = state(page)
    columns = round((box(page, "map")[2] - 74 - 14) / 2)  # a pixel of the map is two of the screen
    assert float(stepped[SPIN]) - x == pytest.approx(40 / columns)
    assert float(stepped[HEIGHT]) == y
    assert stepped["before"] == f"{found[SPIN]}:{found[HEIGHT]}"
    page.wait_for("!document.getElementById('both').disabled")
    page.value("document.getElementById('both').click()")
    set_time(page, 0)
    for half in np.array_split(picture(page, "coins"), 2, axis=1):
        assert faces(half) > 500
    assert page.value("document.querySelectorAll('#energy polyline').length") == 2


def test_a_link_opens_the_same_state_on_another_page(chromium, page, lab_path, tmp_path):
    page.open(lab_path.as_uri(), width=420, height=1900)
    for id_ in ("hand", "trust"):
        page.value(f"document.getElementById('{id_}').click()")
    slide(page, "coin.thickness", 4.5)
    slide(page, "release.angles.theta", 3)
    page.value("document.getElementById('map').focus()")
    page.press("+")
    page.press("ArrowUp")
    page.wait_for("location.hash.includes('before=')")
    page.wait_for(COUNTED)
    address = page.value("location.hash")
    other = tmp_path / "other.html"
    assert command("lab", "table", "--out", other).exit_code == 0
    with Page(chromium) as second:
        second.open(other.as_uri() + address, width=420, height=1900)
        second.wait_for(f"{COUNTED} && {TOSSED}")
        second.value("new Promise((kept) => setTimeout(kept, 500))")
        assert second.value("location.hash") == address
        for id_ in ("outcome", "horizon", "share", "sequences"):
            assert second.text(id_) == page.text(id_)


@pytest.mark.parametrize("release", RELEASES, ids=lambda folder: folder.name)
def test_an_address_of_an_earlier_release_is_the_toss_it_was(page, lab_path, release):
    address = (release / "given" / "lab.txt").read_text(encoding="utf-8").strip()
    page.open(lab_path.as_uri() + address, width=420)
    page.wait_for(f"{COUNTED} && {TOSSED} && {WHOLE}")
    assert page.text("problem") == ""
    page.value("document.getElementById('copy').click()")
    page.wait_for("!document.getElementById('command').hidden")
    asked = page.text("command")
    _, text, line = re.split(r"^cat > coin.toml << 'END'\n|^END\n", asked, flags=re.MULTILINE)
    assert parse(text, "coin.toml") == cointoss.load(release / "given" / "smooth.toml")
    spans = {axis: re.findall(rf"--{axis} (\S+)=(\S+):(\S+):\d+", line)[0] for axis in "xy"}
    assert {axis: (field, float(low), float(high)) for axis, (field, low, high) in spans.items()} == {
        "x": (SPIN, pytest.approx(20, abs=0.2), pytest.approx(60, abs=0.2)),
        "y": (HEIGHT, pytest.approx(0.2, abs=2e-3), pytest.approx(0.6, abs=2e-3)),
    }
    assert "--after 1 --trust" in line
    assert len(sequences(page)) == 2


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
        ("#hand=2", "hand: 2; accepted: a number from 0 to 0.3"),
        ("#before=1", "before: 1; accepted: two numbers"),
        ("#tour=7", "tour: 7; accepted: caught, touch, bounces, hundred, restitution, air, imperfect, hand"),
        ("#hair=1", "hair: 1; accepted: a number from 1e-15 to 0.001"),
        (f"#x={quote('<b>' * 90)}", "x: <b><b>"),
    ],
)
def test_an_address_that_is_no_state_is_told_in_a_line(kept, lab_path, address, told):
    kept.open(lab_path.as_uri() + address, width=420)
    problem = kept.text("problem")
    assert problem.startswith(f"The address is no state of the lab: {told}")
    assert problem.endswith("Shown is what the page begins with.")
    assert len(problem) < 600
    kept.wait_for(f"{TOSSED} && {WHOLE}")


def test_one_zooms_to_where_doubles_end(page, lab_path):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=TEXTS)
    page.open(lab_path.as_uri(), width=420)
    page.value("document.getElementById('map').focus()")
    for _ in range(60):
        page.press("+")
    page.wait_for("document.getElementById('ends').textContent.startsWith('Double precision ends here')")
    # The address is written a quarter of a second after the last step of the zoom.
    page.wait_for(
        f"{WHOLE} && (window.since ??= performance.now(), performance.now() - window.since > 500)"
        " && location.hash.includes('x=')"
    )
    field, low, high = parse_qs(page.value("location.hash")[1:])["x"][0].split(":")
    assert field == SPIN
    # As many pixels as doubles.
    assert 100 < (float(high) - float(low)) / np.spacing(float(high)) < 2000
    # Of one colour, and the values at the axes are plain numbers.
    page.wait_for(
        "/^All that is seen is (heads|tails)/.test(document.getElementById('boundary').textContent)"
    )
    assert 0 < np.ptp([float(text) for text in page.value("texts") if text.startswith("0.4")]) < 1e-12
    page.press("0")
    page.wait_for("document.getElementById('ends').textContent === ''")


def test_beyond_a_field_s_bounds_the_map_is_grey(page, lab_path):
    page.open(f"{lab_path.as_uri()}#tour=restitution", width=420)
    page.wait_for(WHOLE)
    untossed = page.value("getComputedStyle(document.documentElement).getPropertyValue('--untossed').trim()")
    grey = [int(untossed[at : at + 2], 16) for at in (1, 3, 5)]

    def part():
        # The depth of the zoom stands in the upper right corner.
        return np.mean((picture(page, "map")[12:-54, 76:176] == grey).all(axis=2))

    assert part() == 0
    page.value("document.getElementById('zoom-out').click()")
    page.wait_for("document.getElementById('map').ariaBusy === 'true'")
    page.wait_for(WHOLE)
    # About the coin at 0.3, from -0.3 to 1.5; 0 to 1 is tossed.
    assert part() == pytest.approx(0.8 / 1.8, abs=0.05)
    assert page.text("problem") == ""


def test_two_fingers_zoom(page, lab_path):
    page.open(lab_path.as_uri(), width=420, height=1900)
    page.wait_for(WHOLE)
    x, y = place_of(page, 0.5, 0.5)

    def touch(kind, *points):
        page.call(
            "Input.dispatchTouchEvent",
            type=kind,
            touchPoints=[{"x": x + at, "y": y, "id": i} for i, at in enumerate(points)],
        )

    touch("touchStart", -40)
    touch("touchStart", -40, 40)
    touch("touchMove", -80, 80)
    touch("touchEnd")
    page.wait_for("/eta:3\\d/.test(location.hash)")
    _, low, high = state(page)["x"].split(":")
    assert float(high) - float(low) == pytest.approx(20, rel=0.1)


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
