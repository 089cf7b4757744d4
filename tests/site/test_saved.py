"""A map that was made, in the lab: its pixels, tosses by both engines, finer maps, and the page as a file."""

import re
from itertools import product

import numpy as np
import pytest

from cointoss import analytic, coin_mj, read_map, toss_many
from cointoss.compare.lab import static
from cointoss.models.reading import parse
from tests.helpers.coins_shown import BLUE, GOLD, UNNAMED, faces, picture, set_time
from tests.helpers.command_line import printed
from tests.helpers.explored import FIELDS, SCENARIO, serving
from tests.helpers.lab import RESTED, WHOLE, clicks, place_of, sequences, slides, state

CASE = parse(SCENARIO, "here")
BOTH = "document.querySelectorAll('#outcome p').length === 2 && !/tossing/.test(outcome.textContent)"
ASKED = "performance.getEntriesByType('resource').some((one) => one.name.includes('/map?'))"


def pixel(page, u, v):
    """Return where a pixel of the whole map is on the page."""
    return place_of(page, (u + 0.5) / 24, (v + 0.5) / 18)


def chosen(page):
    """Return the release that is chosen, once the address has it."""
    found = state(page)
    return tuple(float(found[field]) for field in FIELDS)


def case_at(x, y):
    return CASE.replace(FIELDS[0], x, FIELDS[1], y)


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_a_map_is_walked_through(page, server, map_path, width, scheme):
    """Opened, clicked, stepped through, zoomed into past its pixels, and changed."""
    found = read_map(map_path)
    x, y = (found[field].values for field in FIELDS)
    page.open(server.url, width=width, height=1900, scheme=scheme)
    page.wait_for(f"{BOTH} && {WHOLE}")
    assert (page.text("name"), page.text("problem")) == ("coin: 2 g, 25 mm", "")
    assert chosen(page) == (x[12], y[9])
    page.click(*pixel(page, 11, 6))
    assert chosen(page) == (x[11], y[6])
    page.wait_for(BOTH)
    toss = analytic.toss(case_at(x[11], y[6]))
    tossed = sequences(page)
    assert (tossed["analytic"], tossed["MuJoCo"][:2]) == (toss.sequence, toss.sequence[:2])
    assert "before" in tossed
    assert f"analytic: {toss.outcome} after {len(toss.impacts)} impacts" in page.text("outcome")
    assert page.text("readout").endswith(f"{found['outcome'].values[6, 11]}; 2 impacts")
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
    shown, alike = picture(page, "map"), []
    left, top = place_of(page, 0, 1)
    for across, up in product((0.15, 0.7, 0.9), (0.15, 0.85)):
        at = place_of(page, across, up)
        page.click(*at)
        face = analytic.toss(case_at(*chosen(page))).impacts.face[1]
        assert page.text("readout").endswith("; heads" if face == 1 else "; tails")
        seen = tuple(shown[round(at[1] - top) + 10, round(at[0] - left) + 74])
        alike.append(seen == (GOLD if face == 1 else BLUE))
    assert sum(alike) >= 4  # of six, some of them at boundaries
    page.press("0")
    page.wait_for(WHOLE)
    before = picture(page, "map").copy()
    slides(page, "floor.restitution", 0.4)
    page.wait_for("document.getElementById('map').ariaBusy === 'true'")
    page.wait_for(WHOLE)
    assert np.mean((picture(page, "map") != before).any(axis=2)) > 0.05
    assert page.value("document.documentElement.scrollWidth <= innerWidth")
    assert page.value(UNNAMED) == 0
    assert all(re.match(r"http://127\.0\.0\.1:|data:|blob:|about:", address) for address in page.asked())
    # Few pixels are asked for first.
    sizes = re.findall(r"/map\?\S*columns=(\d+)", "\n".join(page.asked()))
    assert int(sizes[0]) < int(sizes[-1]) / 2


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
    page.click(*pixel(page, 7, 5))
    page.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: tossed only where')")
    assert sequences(page)["analytic"] == analytic.toss(case_of(7, 5)).sequence
    left, top = pixel(page, 6, 4)
    page.click(left + 9, top)  # in the next pixel
    page.wait_for(f"{BOTH} && document.querySelectorAll('#sequences .row[role=img]').length === 3")
    assert sequences(page)["MuJoCo"] == coin_mj.toss(case_of(6, 4)).sequence
    whole = state(page)["x"]
    clicks(page, *4 * ["zoom-in"])
    if engine == "mujoco":
        page.wait_for("document.getElementById('problem').textContent.startsWith('MuJoCo tosses no map')")
    else:
        page.wait_for(f"{WHOLE} && location.hash.includes('x=') && !location.hash.includes('{whole}')")
        assert page.text("problem") == ""
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about", "blob"}


def test_a_server_that_has_ended_is_told(tab, map_path):
    with serving(map_path) as lab:
        tab.open(lab.url)
        tab.wait_for(BOTH)
    tab.click(*pixel(tab, 11, 6))
    tab.wait_for("document.getElementById('outcome').textContent.includes('is it still running?')")
    clicks(tab, "zoom-in", "zoom-in")
    tab.wait_for("document.getElementById('problem').textContent.includes('is it still running?')")
