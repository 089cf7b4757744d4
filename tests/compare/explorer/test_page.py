"""The explorer's page in a headless Chromium: mouse and keyboard, light and dark, wide and narrow."""

import json
import re
from itertools import product
from urllib.parse import parse_qs

import numpy as np
import pytest

from cointoss import analytic, read_map
from cointoss.compare.explorer import static
from cointoss.models.reading import parse
from tests.helpers.coins_shown import BLUE, GOLD, NO_WEBGL, UNNAMED, box, faces, picture, set_time
from tests.helpers.command_line import cointoss
from tests.helpers.explored import FIELDS, SCENARIO, serving, small_map

BOUNDARY = "document.getElementById('boundary').textContent"
TOSSED = (
    "document.querySelectorAll('#outcome p').length === 2"
    " && !/tossing/i.test(document.getElementById('outcome').textContent)"
)


def place_of(page, u, v, count=(24, 18)):
    """Return where a pixel of the whole map is on the page; the margins are those of map.js."""
    left, top, width, height = box(page, "map")
    return (
        left + 74 + (u + 0.5) / count[0] * (width - 74 - 14),
        top + 10 + (1 - (v + 0.5) / count[1]) * (height - 10 - 52),
    )


def chosen(page):
    """Return the release that the address names."""
    given = parse_qs(page.value("location.hash").removeprefix("#"))
    return float(given["x"][0]), float(given["y"][0])


def sequences(page):
    rows = page.value(
        "[...document.querySelectorAll('#sequences .row[role=img]')].map((row) =>"
        " [row.querySelector('b').textContent,"
        "  [...row.querySelectorAll('span')].map((cell) => cell.textContent).join(''),"
        "  row.querySelectorAll('.beyond').length])"
    )
    return {label: (sequence, beyond) for label, sequence, beyond in rows}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 420])
def test_a_click_tosses_a_pixel_by_both_engines(page, server, map_path, width, scheme):
    page.open(server.url, width=width, height=1900, scheme=scheme)
    codes = read_map(map_path).cointoss.codes
    shown = picture(page, "map")
    left, top, *_ = box(page, "map")
    for u, v in ((0, 0), (23, 0), (0, 17), (23, 17), (11, 6), (5, 13)):
        x, y = place_of(page, u, v)
        expected = GOLD if codes[v, u] == 1 else BLUE
        assert tuple(shown[round(y - top), round(x - left)]) == expected

    page.click(*place_of(page, 11, 6))
    page.wait_for(TOSSED)
    made = read_map(map_path)
    x, y = made[FIELDS[0]].values[11], made[FIELDS[1]].values[6]
    assert chosen(page) == (x, y)
    toss = analytic.toss(parse(SCENARIO, "here").replace(FIELDS[0], x, FIELDS[1], y))
    found = sequences(page)
    assert found["analytic"] == (
        toss.sequence,
        len(toss.sequence) - min(toss.trusted_impacts, len(toss.sequence)),
    )
    assert found["MuJoCo"][0][:2] == toss.sequence[:2]
    assert f"analytic: {toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    shown = {1: "heads", 2: "tails"}[codes[6, 11]]
    assert page.text("faces").startswith(
        f"Face at touch 2, the map's colour:{shown}Final face:{toss.outcome}"
    )
    assert "The map shows touch 2, framed." in page.text("horizon")
    assert page.value("document.querySelector('#sequences .mapped').dataset.touch") == "1"
    assert page.value("document.querySelectorAll('#energy polyline').length") == 2
    # Both coins are there, each in its half.
    set_time(page, 0)
    coins = picture(page, "coins")
    for half in np.array_split(coins, 2, axis=1):
        assert faces(half) > 500
    background = np.median(picture(page, "pixel").reshape(-1, 3), axis=0).mean()
    assert background > 200 if scheme == "light" else background < 60
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert {address.rpartition(":")[0] for address in page.asked() if address.startswith("http")} == {
        "http://127.0.0.1"
    }


def test_the_page_opens_with_the_toss_in_the_middle(page, server, map_path):
    page.open(server.url, moving=True)
    page.wait_for("Number(document.getElementById('time').value) > 0.01")
    made = read_map(map_path)
    assert chosen(page) == (made[FIELDS[0]].values[12], made[FIELDS[1]].values[9])
    page.wait_for(TOSSED)
    assert set(sequences(page)) == {"analytic", "MuJoCo"}


def test_the_map_keeps_its_shape_in_any_window(page, server):
    for width, height in ((1280, 900), (1280, 600), (900, 1200), (420, 900)):
        page.open(server.url, width=width, height=height)
        _, _, wide, high = box(page, "map")
        assert (wide - 74 - 14) / (high - 10 - 52) == pytest.approx(24 / 18, rel=0.01)
        assert page.value("document.documentElement.scrollWidth <= innerWidth")


def test_the_keyboard_steps_to_neighbours_and_zooms(page, server, map_path):
    page.open(server.url)
    made = read_map(map_path)
    x, y = made[FIELDS[0]].values, made[FIELDS[1]].values
    page.value("document.getElementById('map').focus()")
    page.press("Enter")
    page.wait_for(TOSSED)
    u, v = (
        int(np.flatnonzero(values == value)[0]) for values, value in zip((x, y), chosen(page), strict=True)
    )
    for key, du, dv in (("ArrowRight", 1, 0), ("ArrowUp", 0, 1), ("ArrowLeft", -1, 0), ("ArrowDown", 0, -1)):
        page.press(key)
        u, v = u + du, v + dv
        assert chosen(page) == (x[u], y[v])
        assert f"spin about η = {x[u]:.5g}"[:19] in page.text("readout").replace("\u00a0", " ")
    page.press("ArrowRight", shift=True)
    assert chosen(page) == (x[min(u + 10, 23)], y[v])
    for _ in range(3):
        page.press("ArrowRight", shift=True)
    assert chosen(page)[0] == x[23]
    page.wait_for(TOSSED)
    assert re.search(
        r"The toss before has the same sequence|the one before (show the same faces up to touch \d+|differ)",
        page.text("horizon"),
    )
    for id_ in ("readout", "outcome"):
        assert page.value(f"document.getElementById('{id_}').getAttribute('aria-live')") == "polite"
    assert page.value(UNNAMED) == 0


def test_the_mouse_hovers_and_zooms_into_a_finer_map(page, server):
    page.open(server.url)
    assert page.value("document.title") == "coin: 2 g, 25 mm: cointoss explore"
    assert page.text("name") == "coin: 2 g, 25 mm"
    assert page.text("about").startswith("map.zarr: 24 by 18 tosses")
    assert page.text("fields") == f"Across: spin about η ({FIELDS[0]}). Up: height ({FIELDS[1]})."
    at = place_of(page, 12, 9)
    page.mouse("mouseMoved", *at)
    page.wait_for("document.getElementById('readout').textContent.includes('2 impacts')")
    assert "tile" not in " ".join(page.asked())
    for _ in range(4):
        page.mouse("mouseWheel", *at, deltaX=0, deltaY=-120)
    page.wait_for("performance.getEntriesByType('resource').some((one) => one.name.includes('/tile?'))")
    scenario = parse(SCENARIO, "here")
    left, top, *_ = box(page, "map")
    seen = set()
    for dx, dy in product((-150, 0, 150), (-120, 0, 120)):
        page.wait_for(
            f"document.getElementById('map').dispatchEvent(new PointerEvent('pointermove',"
            f" {{clientX: {at[0] + dx}, clientY: {at[1] + dy}}})) &&"
            " /heads|tails/.test(document.getElementById('readout').textContent)"
        )
        shown = picture(page, "map")[round(at[1] + dy - top), round(at[0] + dx - left)]
        page.click(at[0] + dx, at[1] + dy)
        x, y = chosen(page)
        face = analytic.toss(scenario.replace(FIELDS[0], x, FIELDS[1], y)).impacts.face[1]
        assert tuple(shown) == (GOLD if face == 1 else BLUE)
        seen.add(face)
    assert seen == {1, 2}
    page.wait_for(TOSSED)
    first = chosen(page)
    page.press("ArrowRight")
    page.press("ArrowUp")
    steps = [b - a for a, b in zip(first, chosen(page), strict=True)]
    assert 0 < steps[0] < 40 / 23 / 2
    assert 0 < steps[1] < 0.4 / 17 / 2
    assert steps[0] / (40 / 23) == pytest.approx(steps[1] / (0.4 / 17))
    assert page.text("boundary") == ""
    for _ in range(12):
        page.press("+")
    page.wait_for(f"/^All that is seen is (heads|tails)[.] .* the middle: /.test({BOUNDARY})")
    assert page.value(
        "import('./nearest.js').then(({ nearestOther, nearestText }) => nearestText('heads',"
        " nearestOther([2, 1, 1, 1, 2, 1, 1, 1, 1, 1, 1, -1], 4, [2, 1], 1).map((pixels) => pixels / 3),"
        " [{ word: 'spin', unit: 'rad/s' }, { word: 'friction', unit: '' }]))"
    ) == (
        "All that is seen is heads. The nearest other colour lies to the left of the middle: "
        "roughly −0.67 rad/s in spin."
    )


def test_the_margin_of_a_pixel_is_told(page, tmp_path):
    path = small_map(tmp_path, "--margin", "height", size=(3, 3))
    found = read_map(path)["margin"].values[2, 1]
    with serving(path) as explorer:
        page.open(f"{explorer.url}#x=40&y=0.6")
        shown = float(
            re.findall(r"margin along height ([+−][\d.e-]+) mm", page.text("release"))[0].replace("−", "-")
        )
        page.wait_for(TOSSED)
    assert shown == pytest.approx(found, rel=5e-3)


def test_untrusted_pixels_are_hatched(page, tmp_path):
    longer = SCENARIO.replace("max_impacts = 4", "max_impacts = 20")
    path = small_map(tmp_path, "--trust", "--after", "6", size=(6, 4), text=longer)
    found = read_map(path)
    untrusted = found.cointoss.untrusted
    assert untrusted is not None
    assert 0 < untrusted.sum() < untrusted.size
    with serving(path) as explorer:
        page.open(explorer.url)
        page.wait_for("document.body.dataset.ready")
        assert "untrusted" in page.text("legend")
        shown, (left, top, _, _) = picture(page, "map").astype(int), box(page, "map")
        for row, column in product(range(4), range(6)):
            x, y = (round(at) for at in place_of(page, column, row, (6, 4)))
            around = shown[y - round(top) - 9 : y - round(top) + 9, x - round(left) - 9 : x - round(left) + 9]
            assert (np.unique(around.reshape(-1, 3), axis=0).shape[0] > 1) == untrusted[row, column]
        page.mouse("mouseMoved", *place_of(page, 2, 1, (6, 4)))
        count = found["trusted_impacts"].values[1, 2]
        page.wait_for(f"document.getElementById('readout').textContent.includes(', {count} of them trusted')")


def test_each_sequence_has_its_own_horizon(page, server):
    page.open(server.url)
    page.wait_for(TOSSED)
    toss = {"engine": "analytic", "sequence": 40 * "HHTTH", "trusted": 2, "count": 280, "path": {}}
    page.value(
        "import('./sequences.js').then(({ showSequences }) =>"
        f" showSequences(document.getElementById('sequences'), [{json.dumps(toss)}], null, null))"
    )
    assert sequences(page) == {"analytic": (3 * "HHTTH" + "HHT", 16)}
    assert page.value("document.querySelector('#sequences .horizon').dataset.touch") == "1"
    assert "… 280 faces" in page.text("sequences")
    told = page.value("document.querySelector('#sequences .row').getAttribute('aria-label')")
    assert (
        told
        == f"analytic: {' '.join(3 * 'HHTTH' + 'HHT')} … 280 faces; horizon of trust after touch 2 of 280"
    )


def test_a_toss_is_played_until_it_is_paused(page, server):
    page.open(f"{server.url}#x=40&y=0.4", width=420, height=500, moving=True)
    time = "Number(document.getElementById('time').value)"
    page.wait_for(f"{time} > 0.01")
    page.wait_for(TOSSED)
    page.value("document.getElementById('play').click()")
    paused = page.value(time)
    assert 0.01 < paused < page.value("Number(document.getElementById('time').max)")
    assert page.text("clock") == f"{paused:.3f} s"
    assert page.value(f"new Promise((kept) => setTimeout(() => kept({time}), 200))") == paused
    assert page.text("play") == "Play"
    set_time(page, 10)
    touches = page.value(
        "[...document.querySelectorAll('#sequences .now')].map((cell) => cell.dataset.touch)"
    )
    assert touches == ["3", "3"]


def test_without_webgl_the_map_and_the_sequences_work(tab, server):
    tab.call("Page.addScriptToEvaluateOnNewDocument", source=NO_WEBGL)
    tab.open(server.url)
    tab.click(*place_of(tab, 11, 6))
    tab.wait_for(TOSSED)
    assert "no WebGL" in tab.text("hint")
    assert set(sequences(tab)) >= {"analytic", "MuJoCo"}


def test_a_server_that_has_ended_is_told(tab, map_path):
    with serving(map_path) as explorer:
        tab.open(explorer.url)
    tab.click(*place_of(tab, 11, 6))
    tab.wait_for(TOSSED)
    assert "does not answer; is it still running?" in tab.text("outcome")


def test_a_law_that_mujoco_lacks_is_told(page, tmp_path):
    text = SCENARIO.replace('"smooth"', '"knurled"')
    with serving(small_map(tmp_path, size=(3, 3), text=text)) as explorer:
        page.open(f"{explorer.url}#x=40&y=0.4")
        page.wait_for(TOSSED)
    assert 'floor.contact = "knurled": accepted by the MuJoCo engine' in page.text("outcome")
    assert set(sequences(page)) == {"analytic"}


@pytest.mark.slow
def test_the_static_page_works_from_a_file_with_the_network_off(page, map_path, tmp_path, monkeypatch):
    """Where the engine for a browser was not built; tests/site has the page with it."""
    monkeypatch.setattr(static, "engine_data", lambda *_: None)
    monkeypatch.setattr(static, "TOSSED", (2, 2))
    target = tmp_path / "a map.html"
    answered = cointoss("explore", map_path, "--static", target)
    assert (answered.exit_code, answered.stdout) == (0, f"{target}\n"), answered.stderr
    assert "wasm-unsafe-eval" not in target.read_text("utf-8")
    held = json.loads(re.findall(r'id="data">(.*)</script>', target.read_text("utf-8"))[0])
    assert (held["columns"], held["rows"]) == ([6, 18], [4, 13])
    # At most 12 by 9 pixels are tossed, and the map is cut to MOST_PIXELS; an engine has its own place.
    toss = max(len(json.dumps(pair)) for pair in held["tosses"].values())
    assert toss * 12 * 9 + 9 * static.MOST_PIXELS * 4 / 3 + 1_500_000 + 400_000 < static.MOST_BYTES
    page.call(
        "Network.emulateNetworkConditions",
        offline=True,
        latency=0,
        downloadThroughput=-1,
        uploadThroughput=-1,
    )
    page.open(target.as_uri())
    page.wait_for(TOSSED)
    assert set(sequences(page)) == {"analytic", "MuJoCo"}
    page.click(*place_of(page, 7, 5))
    page.wait_for(TOSSED)
    made = read_map(map_path)
    assert chosen(page) == (made[FIELDS[0]].values[6], made[FIELDS[1]].values[4])
    assert set(sequences(page)) == {"analytic", "MuJoCo"}
    page.press("ArrowRight")
    assert chosen(page) == (made[FIELDS[0]].values[18], made[FIELDS[1]].values[4])
    set_time(page, 0)
    assert faces(picture(page, "coins")) > 500
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}
