"""A map that was made, in the lab: its pixels, tosses by both engines, finer maps, and the page as a file."""

import re
from itertools import product

import numpy as np
import pytest

from cointoss import analytic, coin_mj, read_map, toss_many
from cointoss.compare.lab import static
from cointoss.models.reading import parse
from tests.helpers.coins_shown import BLUE, GOLD, UNNAMED, box, faces, picture, set_time
from tests.helpers.command_line import printed
from tests.helpers.explored import FIELDS, SCENARIO, serving, small_map
from tests.helpers.lab import WHOLE

CASE = parse(SCENARIO, "here")
BOTH = "document.querySelectorAll('#outcome p').length === 2 && !/tossing/.test(outcome.textContent)"
ASKED = "performance.getEntriesByType('resource').some((one) => one.name.includes('/map?'))"
RESTED = """
new Promise((kept) => {
  let address = location.hash, since = performance.now();
  const look = () => {
    if (location.hash !== address) [address, since] = [location.hash, performance.now()];
    if (performance.now() - since > 600) kept(); else requestAnimationFrame(look);
  };
  look();
})
"""
"""Waits until the address has been the same for longer than it takes to be written."""


def place_of(page, u, v, count=(24, 18)):
    """Return where a pixel of the whole map is on the page; the margins are those of map_view.js."""
    left, top, width, height = box(page, "map")
    return (
        left + 74 + (u + 0.5) / count[0] * (width - 74 - 14),
        top + 10 + (1 - (v + 0.5) / count[1]) * (height - 10 - 52),
    )


def chosen(page):
    """Return the release that is chosen, once the address has it."""
    page.value(RESTED)
    given = dict(re.findall(r"([\w.]+)=([^&]+)", page.value("location.hash")))
    return tuple(float(given[field]) for field in FIELDS)


def case_at(x, y):
    return CASE.replace(FIELDS[0], x, FIELDS[1], y)


def sequences(page):
    cells = "[...row.querySelectorAll('span')].map((cell) => cell.textContent).join('')"
    row = f"[row.querySelector('b').textContent, {cells}]"
    return dict(
        page.value(f"[...document.querySelectorAll('#sequences .row[role=img]')].map((row) => {row})")
    )


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_a_map_is_walked_through(page, server, map_path, width, scheme):
    """Opened, clicked, stepped through, zoomed into past its pixels, and changed."""
    found = read_map(map_path)
    x, y = (found[field].values for field in FIELDS)
    page.open(server.url, width=width, height=1900, scheme=scheme)
    page.wait_for(BOTH)
    page.wait_for(f"location.hash.length > 1 && {WHOLE}")
    assert (page.text("name"), page.text("problem")) == ("coin: 2 g, 25 mm", "")
    assert page.text("about").startswith(
        "map.zarr: 24 by 18 tosses by the analytic engine: the face at touch 2"
    )
    assert chosen(page) == (x[12], y[9])
    words, shown = found["outcome"].values, picture(page, "map")
    left, top, *_ = box(page, "map")
    for u, v in ((0, 0), (23, 0), (0, 17), (23, 17), (11, 6), (5, 13)):
        at, down = place_of(page, u, v)
        assert (
            tuple(shown[round(down - top), round(at - left)]) == {"heads": GOLD, "tails": BLUE}[words[v, u]]
        )

    page.click(*place_of(page, 11, 6))
    assert chosen(page) == (x[11], y[6])
    page.wait_for(BOTH)
    toss = analytic.toss(case_at(x[11], y[6]))
    tossed = sequences(page)
    assert tossed["analytic"] == toss.sequence
    assert tossed["MuJoCo"][:2] == toss.sequence[:2]
    assert "before" in tossed
    assert f"analytic: {toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    assert page.text("readout").endswith(f"{words[6, 11]}; 2 impacts")
    assert "The map shows touch 2, framed." in page.text("horizon")
    assert page.value("document.querySelectorAll('#energy polyline').length") == 2
    set_time(page, 0)
    for half in np.array_split(picture(page, "coins"), 2, axis=1):
        assert faces(half) > 500
    page.value("document.getElementById('map').focus()")
    for key, u, v in (("ArrowRight", 12, 6), ("ArrowUp", 12, 7), ("ArrowLeft", 11, 7), ("ArrowDown", 11, 6)):
        page.press(key)
        assert chosen(page) == (x[u], y[v])
    assert not page.value(ASKED)

    for _ in range(3):
        page.press("+")
    page.wait_for(f"{ASKED} && {WHOLE}")
    page.value(RESTED)
    left, top, wide, high = box(page, "map")
    shown, seen, alike = picture(page, "map"), set(), 0
    for across, up in product((0.15, 0.7, 0.9), (0.15, 0.85)):
        at = left + 74 + across * (wide - 88), top + 10 + up * (high - 62)
        page.click(*at)
        face = analytic.toss(case_at(*chosen(page))).impacts.face[1]
        assert page.text("readout").endswith("; heads" if face == 1 else "; tails")
        alike += tuple(shown[round(at[1] - top), round(at[0] - left)]) == (GOLD if face == 1 else BLUE)
        seen.add(face)
    assert seen == {1, 2}
    assert alike >= 4  # of six, some of them at boundaries
    page.press("0")
    page.wait_for(WHOLE)
    before = picture(page, "map").copy()
    page.value(
        "(() => { const input = document.querySelector('[data-field=\"floor.restitution\"]');"
        " input.value = 0.4; input.dispatchEvent(new Event('input')); })()"
    )
    page.wait_for("document.getElementById('map').ariaBusy === 'true'")
    page.wait_for(WHOLE)
    assert np.mean((picture(page, "map") != before).any(axis=2)) > 0.05
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert page.value(UNNAMED) == 0
    assert {address.rpartition(":")[0] for address in page.asked() if address.startswith("http")} == {
        "http://127.0.0.1"
    }


def test_untrusted_pixels_are_hatched_and_a_margin_is_told(page, tmp_path):
    longer = SCENARIO.replace("max_impacts = 4", "max_impacts = 20")
    options = ("--trust", "--after", "6", "--margin", "height")
    found = read_map(path := small_map(tmp_path, *options, size=(6, 4), text=longer))
    untrusted = found["trusted_impacts"].values < 7
    assert 0 < untrusted.sum() < untrusted.size
    with serving(path) as lab:
        page.open(lab.url, height=1900)
        page.wait_for(BOTH)
        assert "not trusted" in page.text("legend")
        shown, (left, top, _, _) = picture(page, "map").astype(int), box(page, "map")
        for row, column in product(range(4), range(6)):
            x, y = (round(at) for at in place_of(page, column, row, (6, 4)))
            if (row, column) != (2, 3):  # which is chosen
                part = shown[y - round(top) - 9 :, x - round(left) - 9 :][:18, :18]
                assert (len(np.unique(part.reshape(-1, 3), axis=0)) > 1) == untrusted[row, column]
        told = page.text("readout")
    assert f", {found['trusted_impacts'].values[2, 3]} of them trusted" in told
    ((margin,),) = [re.findall(r"margin along height ([+−][\d.e-]+) mm", told)]
    assert float(margin.replace("−", "-")) == pytest.approx(found["margin"].values[2, 3], rel=5e-3)


@pytest.mark.parametrize("engine", ["analytic", "mujoco"])
def test_a_file_tosses_with_the_network_off(page, tmp_path, monkeypatch, engine):
    """Of a map over the spin, which stands for components of the angular velocity."""
    monkeypatch.setattr(static, "TOSSED", (2, 2))
    axes = {"height": "0.2:0.6:18", "spin": "20:60:24"}
    made = toss_many(CASE.replace("release.angular_velocity", [0, 30, 40]), axes, engine=engine)
    made.cointoss.save(tmp_path / "a map.zarr")

    def case_of(u, v):
        spin = made["release.spin"].values[u] * np.array([0, 0.6, 0.8])
        return CASE.replace("release.angular_velocity", spin, FIELDS[1], made[FIELDS[1]].values[v])

    printed("explore", tmp_path / "a map.zarr", "--static", tmp_path / "page.html")
    offline = {"offline": True, "latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
    page.call("Network.emulateNetworkConditions", **offline)
    page.open((tmp_path / "page.html").as_uri(), height=1900)
    page.wait_for(BOTH)
    assert set(sequences(page)) == {"analytic", "MuJoCo"}
    page.click(*place_of(page, 7, 5))
    page.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: tossed only where')")
    assert sequences(page)["analytic"] == analytic.toss(case_of(7, 5)).sequence
    left, top = place_of(page, 6, 4)
    page.click(left + 9, top)  # in the next pixel
    page.wait_for(f"{BOTH} && document.querySelectorAll('#sequences .row[role=img]').length === 3")
    assert sequences(page)["MuJoCo"] == coin_mj.toss(case_of(6, 4)).sequence
    page.value(RESTED)
    whole = re.findall("&(x=[^&]+)", page.value("location.hash"))[0]
    for _ in range(4):
        page.value("document.getElementById('zoom-in').click()")
    if engine == "mujoco":
        page.wait_for("document.getElementById('problem').textContent.startsWith('MuJoCo tosses no map')")
    else:
        page.wait_for(
            f"{WHOLE} && location.hash.includes('x=release.spin') && !location.hash.includes('{whole}')"
        )
        assert page.text("problem") == ""
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}


def test_a_server_that_has_ended_is_told(tab, map_path):
    with serving(map_path) as lab:
        tab.open(lab.url)
        tab.wait_for(BOTH)
    tab.click(*place_of(tab, 11, 6))
    tab.wait_for("document.getElementById('outcome').textContent.includes('is it still running?')")
    for _ in range(2):
        tab.value("document.getElementById('zoom-in').click()")
    tab.wait_for("document.getElementById('problem').textContent.includes('is it still running?')")
