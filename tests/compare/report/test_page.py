"""The report's page in a headless Chromium: mouse and keyboard, light and dark, wide and narrow."""

import json
from base64 import b64decode

import numpy as np
import pytest

from cointoss.compare.report.comparison import BOTH, compared
from cointoss.compare.report.folder import write_report
from cointoss.compare.report.page import render
from cointoss.compare.report.verdict import verdicts_of
from cointoss.models.reading import parse
from cointoss.models.sources import scenario_text
from tests.helpers.coins_shown import UNNAMED, faces, picture, set_time
from tests.helpers.off import Off

TEXT = scenario_text("fig24a") + "\n[ending]\nmax_impacts = 6\n"
KNURLED = scenario_text("contact_knurled").replace("max_impacts = 100", "max_impacts = 2")
"""What MuJoCo cannot toss."""
DOCUMENTED = "Off 2.0, as documented"
LEFT, RIGHT = 66, 14
"""Margins of a plot, those of plot.js."""
PLOTS = ["height", "tilt", "energy", "apart", "spin", "place"]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    target = tmp_path_factory.mktemp("report")
    write_report(compared(parse(TEXT, "made"), TEXT, "made"), target, "none here")
    return target


def place(page, name, part):
    """Return where a plot has a part of the time that it shows."""
    page.value(f"document.getElementById('plot-{name}').scrollIntoView()")
    left, top, width = page.value(
        f"(() => {{ const b = document.querySelector('#plot-{name} > svg').getBoundingClientRect();"
        " return [b.left, b.top, b.width]; })()"
    )
    return left + LEFT + part * (width - LEFT - RIGHT), top + 120


SMALLEST = (
    "Math.min(...[...document.querySelectorAll('body *')].filter((one) => one.checkVisibility() &&"
    " [...one.childNodes].some((part) => part.nodeType === 3 && part.data.trim()))"
    ".map((one) => parseFloat(getComputedStyle(one).fontSize)))"
)
"""The smallest type on the page [px]."""
VERDICT = "parseFloat(getComputedStyle(document.querySelector('.verdict')).fontSize)"
TIME = "Number(document.getElementById('time').value)"
CLICK = "document.getElementById('{}').click()"


def texts(page, selector):
    return page.value(f"[...document.querySelectorAll('{selector}')].map((one) => one.textContent)")


def told(page, name):
    """Return what a plot says of the pointer: its time, and the first two values."""
    parts = texts(page, f"#plot-{name} .values span")
    return float(parts[-1].split()[1]), [float(part.split()[-1]) for part in parts[:2]]


def ticks(page, name):
    return texts(page, f"#plot-{name} text[text-anchor=middle]")


def fits(page):
    """Return whether the page is no wider than its window, in type that can be read."""
    return page.value("document.documentElement.scrollWidth <= innerWidth") and page.value(SMALLEST) >= 16


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_the_page_fits_and_needs_nothing_else(page, folder, width, scheme):
    page.open((folder / "report.html").as_uri(), width=width, scheme=scheme)
    drawn = page.value(
        "[...document.querySelectorAll('.plot')]"
        ".map((plot) => [plot.id.slice(5), plot.querySelectorAll('polyline').length])"
    )
    assert dict(drawn) == {name: 4 if name in ("spin", "place") else 2 for name in PLOTS}
    assert fits(page)
    # In the dark no block is white.
    grounds = page.value(
        "[...document.querySelectorAll('body, .card, .figure')]"
        ".map((one) => getComputedStyle(one).backgroundColor)"
    )
    levels = [np.mean([int(part) for part in ground[4:-1].split(",")]) for ground in grounds]
    assert min(levels) > 200 if scheme == "light" else max(levels) < 60
    # Both coins are there, each in its half.
    page.value("document.getElementById('played').scrollIntoView()")
    for half in np.array_split(picture(page, "coins"), 2, axis=1):
        assert faces(half) > 500
    assert page.value(UNNAMED) == 0
    assert {address.partition(":")[0] for address in page.asked()} <= {"file", "data", "about"}


@pytest.mark.parametrize("width", [1280, 420])
def test_a_key_presents_verdict_coins_and_faces_in_large_type_and_another_returns(page, folder, width):
    page.open((folder / "report.html").as_uri(), width=width, height=800)
    shown = (
        "['.verdict', '#coins', '.sequences', 'h1', '.two', '.plot', '.numbers', 'figcaption', 'details']"
        ".map((one) => document.querySelector(one).checkVisibility())"
    )
    whole, presented = [True] * 9, [True] * 3 + [False] * 6
    assert page.value(shown) == whole
    page.value("scrollTo(0, 700)")
    page.press("p")
    assert page.value(shown) == presented
    assert page.value(VERDICT) > 25
    assert fits(page)
    assert width != 1280 or page.value("document.documentElement.scrollHeight <= innerHeight")
    assert faces(picture(page, "coins")) > 500
    assert page.value("document.activeElement.id") == "play"
    page.press("Escape")
    assert page.value(f"[scrollY, document.activeElement.id, ...{shown}]") == [700, "present", *whole]
    # By its button too; a letter in a list chooses there.
    page.value(CLICK.format("present"))
    page.value("document.getElementById('speed').focus()")
    page.press("p")
    assert page.value(shown) == presented
    page.value(CLICK.format("present"))
    assert page.value(shown) == whole


def test_the_first_screen_has_what_matters_and_the_rest_is_below(page, folder):
    """Coins stand where motion is unwanted; powers are raised; an impact loses energy."""
    page.open((folder / "report.html").as_uri(), width=1280, height=800)
    bottom = "document.querySelector('{}').getBoundingClientRect().bottom <= innerHeight"
    for shown in (".verdict", "#coins", "#play", ".faces", ".onward"):
        assert page.value(bottom.format(shown)), shown
    assert page.value(VERDICT) > 20
    assert page.value(TIME) == 0
    page.value("document.querySelector('.onward a').click()")
    page.wait_for("scrollY >= 700")
    assert not any("^" in cell for cell in texts(page, "td"))
    assert "-2-b" in texts(page, "sup")
    place = texts(page, ".numbers th").index("lost [mJ]")
    lost = texts(page, f".numbers td:nth-child({place + 1})")
    assert [float(each) > 0 for each in lost] == [True] * 6


def test_the_coins_play_when_the_page_is_opened_and_a_film_can_be_saved_from_it(page, tmp_path):
    shown = render(compared(parse(TEXT, "made"), TEXT, "made"), film=(b"a film", b"a frame"))
    (tmp_path / "report.html").write_text(shown, encoding="utf-8")
    page.open((tmp_path / "report.html").as_uri(), moving=True)
    page.wait_for(f"{TIME} > 0.01")
    saved, name = page.value("(({ href, download }) => [href, download])(document.getElementById('save'))")
    assert name == "made.mp4"
    assert b64decode(saved.removeprefix("data:video/mp4;base64,")) == b"a film"


def test_plots_tell_their_values_zoom_and_lead_the_coins(page, folder):
    page.open((folder / "report.html").as_uri())
    end = float(page.value("document.getElementById('time').max"))
    page.click(*place(page, "spin", 0.3))
    assert page.value(TIME) == pytest.approx(0.3 * end, abs=0.01)
    set_time(page, 0.5 * end)
    marks = page.value("[...document.querySelectorAll('.plot .now')].map((one) => one.getAttribute('x1'))")
    assert len(marks) == len(PLOTS)
    width = page.value("document.querySelector('#plot-tilt > svg').clientWidth")
    assert float(marks[1]) == pytest.approx(LEFT + 0.5 * (width - LEFT - RIGHT), abs=1)
    page.value(CLICK.format("play"))
    page.wait_for(f"{TIME} > {0.51 * end}")
    page.value(CLICK.format("play"))
    assert page.text("play") == "Play"

    page.mouse("mouseMoved", *place(page, "height", 0.1))
    time, heights = told(page, "height")
    assert time == pytest.approx(0.1 * end, abs=0.01 * end)
    # Its first fall; the air takes little of it.
    assert heights == pytest.approx([400 - 1e3 * 9.81 * time**2 / 2] * 2, rel=0.01)

    from_, to, left = place(page, "tilt", 0.4), place(page, "tilt", 0.6), {"button": "left", "buttons": 1}
    page.mouse("mousePressed", *from_, clickCount=1, **left)
    page.mouse("mouseMoved", *to, **left)
    page.mouse("mouseReleased", *to, button="left", clickCount=1)
    for name in PLOTS:
        shown = [float(text) for text in ticks(page, name) if text != "horizon"]
        assert 0.39 * end < min(shown) < max(shown) < 0.61 * end

    page.value("document.querySelector('#plot-energy > svg').focus()")
    page.mouse("mouseMoved", *place(page, "energy", 0.5))
    before, _ = told(page, "energy")
    page.press("ArrowRight")
    after, _ = told(page, "energy")
    assert after - before == pytest.approx(0.2 * end / 100, rel=0.01)
    page.press("0")
    assert ticks(page, "energy")[0] == "0"
    page.value(CLICK.format("zoom-in"))
    assert "0" not in ticks(page, "energy")


def test_the_coins_go_on_until_they_lie_and_their_proof_is_marked(page, tmp_path):
    text = scenario_text("fig24a")
    found = compared(parse(text, "made"), text, "made")
    write_report(found, tmp_path, "none here")
    page.open((tmp_path / "report.html").as_uri())
    last = max(each.motion.end_time for each in found.filmed)
    assert last > max(toss.end_time for toss in found.tosses) + 0.1
    assert page.value("Number(document.getElementById('time').max)") == pytest.approx(last, abs=1e-5)
    assert page.text("marks") == "from its mark on each can't turn over"
    set_time(page, last)
    assert page.text("clock") == f"{last:.3f} s"
    held = json.loads(page.value("document.getElementById('data').textContent"))["tosses"]
    for toss, each in zip(found.tosses, held, strict=True):
        assert toss.end_time - 1e-6 <= min(each["later_times"]) <= max(each["later_times"]) <= last + 1e-6
        assert len(each["times"]) == len(toss.impacts)


@pytest.mark.parametrize(
    ("text", "engines", "told", "names"),
    [
        pytest.param(KNURLED, BOTH, "two", ["analytic"], id="one that can toss it"),
        pytest.param(
            *(TEXT, ["mujoco", Off(DOCUMENTED)], "three", ["analytic", "MuJoCo", DOCUMENTED]),
            marks=pytest.mark.slow,
            id="three",
        ),
    ],
)
def test_the_page_of_one_or_of_three_engines_tells_them_apart(page, tmp_path, text, engines, told, names):
    found = compared(parse(text, "made"), text, "made", engines)
    write_report(found, tmp_path, "none here")
    page.open((tmp_path / "report.html").as_uri(), width=420)
    assert texts(page, "title") == [f"made: one coin, {told} engines"]
    assert texts(page, ".panel b") == names
    shown = "[...document.querySelectorAll('.rowlabels span')].map((one) => getComputedStyle(one).color)"
    assert len(set(page.value(shown))) == len(names)
    page.value("document.getElementById('played').scrollIntoView()")
    for part in np.array_split(picture(page, "coins"), len(names), axis=1):
        assert faces(part) > 300
    assert page.value("document.querySelectorAll('#plot-apart polyline').length") == 2 * (len(names) - 1)
    assert len(texts(page, ".verdict")) == len(verdicts_of(found))
    # The bar of each engine's row is after the faces that must agree, and so are its pale faces.
    others = [pair.common_horizon for pair in found.against]
    horizons = [max(others, default=len(found.measure.impacts)), *others]
    for row, horizon in enumerate(horizons, start=1):
        assert len(texts(page, f".pair span:nth-child({row}):not(.beyond):not(.none)")) == horizon
        assert len(texts(page, f".bars i.bar:nth-child({row})")) == (horizon < len(found.measure.impacts))
    assert fits(page)
