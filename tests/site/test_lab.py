"""The lab in a browser: its map, tosses, hand and tour against the package, its address, and its failures."""

import csv
import io
import json
import re
from urllib.parse import parse_qs, quote

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.lab import lab
from cointoss.compare.reproduction.estimates import share
from cointoss.models.reading import parse
from cointoss.models.releases import Releases
from tests.helpers.browser import Page
from tests.helpers.coins_shown import BLUE, GOLD, NO_WEBGL, UNNAMED, box, faces, picture, set_time
from tests.helpers.command_line import cointoss as command

SPIN, HEIGHT = "release.angular_velocity.eta", "release.position.z"
WHOLE = "document.getElementById('map').ariaBusy === 'false'"
TOSSED = "document.getElementById('outcome').textContent.includes(' impacts in ')"
ADDRESSED = "location.hash.length > 1"
PAPER = "getComputedStyle(document.body).backgroundColor"
COUNTED = "document.getElementById('share').dataset.whole === 'true'"
WHOLE_COIN = (
    "#coin.mass=0.002&coin.radius=0.0125&coin.thickness=0.002&floor.contact=smooth&release.position.z=0.4"
)
SAVED = """
window.saved = [];
URL.createObjectURL = (blob) => { window.saved.push(blob); return "#saved"; };
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory):
    """The lab, as `cointoss lab` writes it."""
    target = tmp_path_factory.mktemp("lab") / "lab.html"
    answered = command("lab", "--out", target)
    assert answered.exit_code == 0, answered.stderr
    assert target.stat().st_size < lab.MOST_BYTES
    return target


@pytest.fixture(scope="module")
def kept(chromium, path):
    """A tab for tests that change its state by addresses."""
    with Page(chromium) as page:
        page.open(path.as_uri(), width=900)
        page.wait_for(WHOLE)
        yield page
        assert page.complaints() == []


def offline(page):
    nothing = {"latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
    page.call("Network.emulateNetworkConditions", offline=True, **nothing)


def go(page, address):
    """Show the state of an address, and wait until all of it is there."""
    page.value(
        f"document.getElementById('outcome').textContent = ''; location.hash = {json.dumps(address)}; 0"
    )
    page.wait_for(TOSSED)
    page.wait_for(WHOLE)


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


def saved(page, button):
    """Return the text of the file that a button saves."""
    page.value(f"document.getElementById('{button}').click()")
    page.wait_for("window.saved.length === 1")
    return page.value("window.saved.pop().text()")


def scenario_of(stop):
    """Return the scenario of a state of the lab."""
    fields = {name: value for name, value in stop["scenario"].items() if "." in name}
    plain = cointoss.load("fig24a").replace("air.normal", 0, "air.tangential", 0, "release.angles", [0, 0, 0])
    return plain.replace(*(part for pair in fields.items() for part in pair))


def row_of(scenario, field, values, after, **fixed):
    """Return the faces along a row of a map."""
    pairs = [part for name, value in fixed.items() for part in (name.replace("__", "."), value)]
    held = scenario.replace(*pairs) if pairs else scenario
    assert field == SPIN
    count = len(values)
    release = held.release
    spins = np.tile(release.angular_velocity, (count, 1))
    spins[:, 1] = values
    releases = Releases(
        position=np.tile(release.position, (count, 1)),
        velocity=np.tile(release.velocity, (count, 1)),
        quaternion=np.tile(release.attitude, (count, 1)),
        angular_velocity=spins,
    )
    if after is None:
        return analytic.toss_many(held, releases).outcome
    return analytic.toss_many(held.replace("ending.max_impacts", after + 1), releases).after(after)


def changes(faces_):
    return int(np.sum(faces_[1:] != faces_[:-1]))


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 420])
def test_the_page_shows_a_coin_and_its_map_with_the_network_off(page, path, width, scheme):
    offline(page)
    page.open(path.as_uri(), width=width, height=1900, scheme=scheme)
    page.wait_for(f"{WHOLE} && {TOSSED}")
    shown = picture(page, "map")[10:-52, 74:-14].reshape(-1, 3)
    for color in (GOLD, BLUE):
        assert np.mean((shown == color).all(axis=1)) > 0.3
    set_time(page, 0)
    assert faces(picture(page, "coins")) > 500
    paper = np.mean([int(part) for part in re.findall(r"\d+", page.value(PAPER))])
    assert paper > 200 if scheme == "light" else paper < 60
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert page.value(UNNAMED) == 0
    assert page.complaints() == []
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}


def test_what_is_seen_is_what_the_package_tosses(page, path):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=SAVED)
    page.open(path.as_uri(), width=420)
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
    assert "--after 2" in asked
    drawn = np.random.default_rng(0).choice(len(rows), 200, replace=False)
    for at in drawn:
        case = scenario.replace(
            *(part for field in (SPIN, HEIGHT) for part in (field, float(rows[at][field])))
        )
        toss = analytic.toss(case)
        if toss.trusted_impacts > 2:
            assert rows[at]["outcome"] == ("heads" if toss.impacts.face[2] == 1 else "tails")


def test_a_click_tosses_a_pixel_and_arrows_step_to_the_next(page, path):
    page.open(path.as_uri())
    page.wait_for(TOSSED)
    page.click(*place_of(page, 0.3, 0.4))
    page.wait_for("document.getElementById('horizon').textContent.includes('The pixel before')")
    page.wait_for("location.hash.includes('before=')")
    found = state(page)
    x, y = float(found[SPIN]), float(found[HEIGHT])
    assert x == pytest.approx(20 + 0.3 * 40, abs=0.2)
    assert y == pytest.approx(0.2 + 0.4 * 0.4, abs=0.003)
    toss = analytic.toss(cointoss.load("fig24a").replace(SPIN, x, HEIGHT, y))
    trusted = min(toss.trusted_impacts, len(toss.impacts))
    assert trusted > 2
    assert sequences(page)["this pixel"][:trusted] == toss.sequence[:trusted]
    assert f"{toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    assert page.value("document.querySelector('#sequences .mapped').dataset.touch") == "2"
    page.value("document.getElementById('map').focus()")
    page.press("ArrowRight")
    page.wait_for(f"!location.hash.includes('eta={x}&')")
    stepped = state(page)
    assert 0 < float(stepped[SPIN]) - x < 0.2
    assert float(stepped[HEIGHT]) == y
    assert stepped["before"] == f"{x}:{y}"
    page.wait_for("!document.getElementById('both').disabled")
    page.value("document.getElementById('both').click()")
    set_time(page, 0)
    for half in np.array_split(picture(page, "coins"), 2, axis=1):
        assert faces(half) > 500
    assert page.value("document.querySelectorAll('#energy polyline').length") == 2
    assert page.complaints() == []


def test_the_map_follows_a_slider(page, path):
    page.open(path.as_uri())
    page.wait_for(WHOLE)
    before = picture(page, "map").copy()
    slide(page, "floor.restitution", 0.5)
    page.wait_for("location.hash.includes('floor.restitution=0.5')")
    page.wait_for(WHOLE)
    after = picture(page, "map")
    assert np.mean((before != after).any(axis=2)) > 0.05
    # A scenario that cannot be is told, and the state stays.
    page.value(f"document.querySelector('[data-field=\"{HEIGHT}\"]').min = 0")
    slide(page, HEIGHT, 0.001)
    page.wait_for("document.getElementById('problem').textContent.includes('release.position.z')")
    assert float(state(page)[HEIGHT]) == 0.40001
    assert page.complaints() == []


def test_a_link_opens_the_same_state_on_another_page(chromium, page, path, tmp_path):
    page.open(path.as_uri())
    for id_ in ("hand", "trust"):
        page.value(f"document.getElementById('{id_}').click()")
    slide(page, "coin.thickness", 4.5)
    slide(page, "release.angles.theta", 3)
    page.value("document.getElementById('map').focus()")
    page.press("+")
    page.press("ArrowUp")
    page.wait_for("location.hash.includes('before=')")
    page.wait_for(f"{COUNTED} && {WHOLE}")
    address = page.value("location.hash")
    other = tmp_path / "other.html"
    assert command("lab", "table", "--out", other).exit_code == 0
    with Page(chromium) as second:
        second.open(other.as_uri() + address)
        second.wait_for(f"{COUNTED} && {WHOLE} && {TOSSED}")
        second.value("new Promise((kept) => setTimeout(kept, 500))")
        assert second.value("location.hash") == address
        for id_ in ("outcome", "horizon", "share", "sequences"):
            assert second.text(id_) == page.text(id_)
        assert np.array_equal(picture(second, "map"), picture(page, "map"))


@pytest.mark.parametrize(
    ("address", "told"),
    [
        ("#nonsense=1", "nonsense: no field of a scenario"),
        ("#coin.mass=NaN(", "coin.mass: NaN(; accepted: a number or a word"),
        (f"{WHOLE_COIN}&floor.restitution=1.5", "floor.restitution = 1.5: accepted: a number"),
        ("#coin.mass=0.002", "coin.radius"),
        ("#x=coin.colour:1:2", "x: coin.colour:1:2; accepted: FIELD:FROM:TO"),
        (f"#x={SPIN}:2:1", f"x: {SPIN}:2:1; accepted: FROM below TO"),
        (f"#x={HEIGHT}:0.2:0.3", f"y: {HEIGHT}; accepted: another field than that of x"),
        ("#map=0", "map: 0; accepted: final, or the number of a touch from 1 to 1000"),
        ("#hand=2", "hand: 2; accepted: a number from 0 to 0.3"),
        ("#before=1", "before: 1; accepted: two numbers"),
        ("#tour=7", "tour: 7; accepted: a number from 1 to 6"),
        (f"#x={quote('<b>' * 90)}", "x: <b><b>"),
    ],
)
def test_an_address_that_is_no_state_is_told_in_a_line(kept, path, address, told):
    kept.open(path.as_uri() + address, width=900)
    problem = kept.text("problem")
    assert problem.startswith(f"The address is no state of the lab: {told}")
    assert problem.endswith("Shown is what the page begins with.")
    assert len(problem) < 600
    kept.wait_for(f"{TOSSED} && {WHOLE}")


def test_one_zooms_to_where_doubles_end(page, path):
    page.open(path.as_uri(), width=420)
    page.value("document.getElementById('map').focus()")
    for _ in range(60):
        page.press("+")
    page.wait_for("document.getElementById('ends').textContent.startsWith('Double precision ends here')")
    page.wait_for(WHOLE)
    field, low, high = parse_qs(page.value("location.hash")[1:])["x"][0].split(":")
    assert field == SPIN
    # As many pixels as doubles.
    assert 100 < (float(high) - float(low)) / np.spacing(float(high)) < 2000
    page.press("0")
    page.wait_for("document.getElementById('ends').hidden")
    assert page.complaints() == []


def test_two_fingers_zoom(page, path):
    page.open(path.as_uri())
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


def test_the_share_of_a_hand_is_that_of_the_package(kept):
    go(kept, kept.value("document.querySelectorAll('#tour a')[5].hash"))
    kept.wait_for(COUNTED)
    told = re.findall(
        r"Of 2,000 tosses .* ([\d.]+) % are heads at touch 1 \[([\d.]+), ([\d.]+); 99 %", kept.text("share")
    )
    stop = kept.value("import('tour.js').then(({ STOPS }) => STOPS[5].state)")
    given = f"{json.dumps(stop['scenario'])}, {stop['hand']}, TOSSES"
    listed = f"Object.entries(releases({given})).map(([field, all]) => [field, [...all]])"
    fields = dict(kept.value(f"import('hand.js').then(({{ releases, TOSSES }}) => {listed})"))
    assert set(fields) == {HEIGHT, SPIN}
    for field, mean in ((HEIGHT, 0.4), (SPIN, 45)):
        values = np.array(fields[field])
        # Within four standard errors.
        assert values.mean() == pytest.approx(mean, rel=4 * 0.02 / 2000**0.5)
        assert values.std() == pytest.approx(0.02 * mean, rel=4 / (2 * 2000) ** 0.5)
    count = 2000
    nothing = np.zeros(count)
    releases = Releases(
        position=np.column_stack([nothing, nothing, fields[HEIGHT]]),
        velocity=np.zeros((count, 3)),
        quaternion=np.tile([1.0, 0, 0, 0], (count, 1)),
        angular_velocity=np.column_stack([nothing, fields[SPIN], nothing]),
    )
    for after, least, most in ((0, 0.99, 1), (2, 0.4, 0.6)):
        scenario = scenario_of(stop).replace("ending.max_impacts", after + 1)
        expected = share(analytic.toss_many(scenario, releases).after(after) == 1)
        assert least <= expected.value <= most
        if after == 0:
            shown = tuple(f"{100 * part:.1f}" for part in (expected.value, expected.low, expected.high))
            assert told == [shown]


def test_the_stops_of_the_tour_say_what_is_so(kept):
    stops = kept.value("import('tour.js').then(({ STOPS }) => STOPS)")
    links = kept.value("[...document.querySelectorAll('#tour a')].map((link) => link.hash)")
    assert len(links) == len(stops) == 6
    for stop, link in zip(stops, links, strict=True):
        go(kept, link)
        assert kept.text("stop") == stop["text"]
        assert kept.text("problem") == ""
    spins = np.linspace(20, 60, 1001)
    scenarios = [scenario_of(stop["state"]) for stop in stops]

    # From a sixth of a turn to 9.7, and heads within a quarter of whole turns.
    x, y = stops[0]["state"]["x"], stops[0]["state"]["y"]
    assert x["from"] * y["from"] / (np.pi * 9.81) == pytest.approx(1 / 6, abs=0.01)
    assert x["to"] * y["to"] / (np.pi * 9.81) == pytest.approx(9.7, abs=0.05)
    for speed in (1.0, 2.0):
        spun = np.linspace(10, 50, 201) * (2 / speed)
        turns = spun * speed / (np.pi * 9.81)
        found = row_of(scenarios[0], SPIN, spun, None, release__velocity__z=speed)
        assert np.array_equal(found == 1, np.abs(turns - np.round(turns)) < 1 / 4)

    for height in (0.2, 0.4, 0.6):
        assert 3 <= changes(row_of(scenarios[1], SPIN, spins, 0, release__position__z=height)) <= 5
        assert changes(row_of(scenarios[1], SPIN, spins, 1, release__position__z=height)) > 100

    assert changes(row_of(scenarios[2], SPIN, spins, None, floor__restitution=0.0)) == 11
    assert changes(row_of(scenarios[2], SPIN, spins, None, floor__restitution=0.3)) > 100
    assert changes(row_of(scenarios[2], SPIN, spins, None, floor__restitution=0.6)) > 300

    heights = np.linspace(0.2, 0.6, 12)
    spins = np.linspace(20, 60, 160)

    def faces_of(scenario, after):
        return np.array(
            [row_of(scenario, SPIN, spins, after, release__position__z=height) for height in heights]
        )

    vacuum = scenarios[3].replace("air.normal", 0, "air.tangential", 0)
    assert np.mean(faces_of(scenarios[3], 2) != faces_of(vacuum, 2)) == pytest.approx(1 / 3, abs=0.05)
    perfect = scenarios[4].replace("coin.center_of_mass", [0, 0, 0])
    assert np.hypot(*scenarios[4].coin.center_of_mass[:2]) == pytest.approx(1.4e-3, abs=5e-5)
    assert np.mean(faces_of(scenarios[4], 0) != faces_of(perfect, 0)) == pytest.approx(1 / 30, abs=0.01)
    assert np.mean(faces_of(scenarios[4], 2) != faces_of(perfect, 2)) == pytest.approx(0.31, abs=0.04)


@pytest.mark.parametrize(
    ("script", "told"),
    [
        ("delete window.WebAssembly;", "The lab cannot toss: this browser has no WebAssembly."),
        ("delete window.Worker;", ""),
        (NO_WEBGL, ""),
    ],
    ids=["no WebAssembly", "no workers", "no WebGL"],
)
def test_a_browser_that_lacks_something_is_told_and_the_page_goes_on(page, path, script, told):
    page.call("Page.addScriptToEvaluateOnNewDocument", source=script)
    page.open(path.as_uri(), width=420)
    assert page.text("problem") == told
    if not told:
        page.wait_for(f"{WHOLE} && {TOSSED}")


def test_the_browser_is_measured(page, path):
    page.open(path.as_uri())
    page.value("document.getElementById('measured').open = true; document.getElementById('measure').click()")
    page.wait_for("!document.getElementById('measure').disabled")
    rows = page.value(
        "[...document.querySelectorAll('#measurements tr')].map((row) => row.children[1].textContent)"
    )
    forms = (
        r"\d+ ms",
        r"[\d,]+ tosses/s",
        r"[\d,]+ tosses/s",
        r"[\d.]+ s",
        r"[\d.]+ s, [\d,]+ tosses/s",
        r"[\d.]+ MB",
    )
    assert len(rows) == len(forms)
    assert all(re.fullmatch(form, row) for form, row in zip(forms, rows, strict=True))
    assert page.complaints() == []
