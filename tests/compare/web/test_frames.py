"""Tosses and maps in the frames of a notebook: they play, quiet and apart from each other."""

import time

import numpy as np
import pytest

import cointoss
from cointoss import analytic, coin_mj, read_map
from cointoss.compare.lab import static
from cointoss.models.reading import load, parse
from tests.helpers.coins_shown import UNNAMED, faces, picture, set_time
from tests.helpers.explored import FIELDS, SCENARIO
from tests.helpers.lab import slides
from tests.helpers.processes import HANGS

STAGE = 300
"""Height of the coins in a frame of full height, at most [px]."""
SEQUENCES = (
    "[...document.querySelectorAll('#sequences .row[role=img]')].map((row) =>"
    " [row.querySelector('b').textContent, row.querySelector('b').classList[0],"
    "  [...row.querySelectorAll('span')].map((cell) => cell.textContent).join(''),"
    "  row.querySelectorAll('.beyond').length])"
)
TOUCHES = "[...document.querySelectorAll('#sequences .now')].map((cell) => cell.dataset.touch)"
TIME = "Number(document.getElementById('time').value)"


@pytest.fixture(scope="module")
def fig24a():
    return analytic.toss("fig24a")


@pytest.fixture(scope="module")
def by_mujoco():
    return coin_mj.toss("fig24a")


@pytest.fixture
def notebook(page, tmp_path):
    """Return what shows frames below each other, as a notebook does, and returns their pages."""

    def shown(*frames, **window):
        cells = [f'<div id="cell-{i}">{frame._repr_html_()}</div>' for i, frame in enumerate(frames)]
        target = tmp_path / "notebook.html"
        target.write_text(f"<!DOCTYPE html><title>mine</title><body>{''.join(cells)}", encoding="utf-8")
        return page.open_frames(target.as_uri(), len(frames), **window)

    return shown


def row(toss, label, kind):
    beyond = len(toss.sequence) - min(toss.trusted_impacts, len(toss.sequence))
    return [label, kind, toss.sequence, beyond]


def painted(page, cell, coins=1):
    """Return what the window shows of a cell once each of its coins is there, in its part of the stage."""
    deadline = time.monotonic() + HANGS
    while True:
        shown = picture(page, cell)
        if all(faces(part) > 500 for part in np.array_split(shown[:STAGE], coins, axis=1)):
            return shown
        assert time.monotonic() < deadline, "a coin is missing"


def assert_quiet(page, *frames):
    for one in (page, *frames):
        assert one.complaints() == []
        assert {address.partition(":")[0] for address in one.asked()} <= {"file", "data", "about", "blob"}


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (420, "dark")])
def test_a_frame_shows_the_coin_its_sequence_and_its_energy(page, notebook, fig24a, width, scheme):
    shown = fig24a.play()
    assert repr(shown) == "<Frame: toss of 2 g, 25 mm, from 40.001 cm; a notebook shows it>"
    (frame,) = notebook(shown, width=width, scheme=scheme)
    assert frame.value(SEQUENCES) == [row(fig24a, "analytic", "analytic")]
    set_time(frame, fig24a.end_time)
    assert frame.value(TOUCHES) == [str(len(fig24a.impacts) - 1)]
    assert f"analytic: {fig24a.outcome} after {len(fig24a.impacts)} impacts" in frame.text("outcome")
    assert frame.value("document.querySelectorAll('#energy polyline').length") == 1
    assert frame.value("document.documentElement.scrollWidth <= innerWidth")
    assert width == 420 or frame.value("document.documentElement.scrollHeight <= innerHeight")
    assert frame.value(UNNAMED) == 0
    background = np.median(painted(page, "cell-0")[:, 2], axis=0).mean()
    assert background > 200 if scheme == "light" else background < 60
    assert_quiet(page, frame)


def test_both_engines_play_together(page, notebook, fig24a, by_mujoco):
    (frame,) = notebook(by_mujoco.play(fig24a))
    expected = [row(by_mujoco, "MuJoCo", "mujoco"), row(fig24a, "analytic", "analytic")]
    assert frame.value(SEQUENCES) == expected
    panels = "[...document.querySelectorAll('.panel')].map((one) => [one.classList[1], one.textContent])"
    assert frame.value(panels) == [
        ["mujoco", f"MuJoCo {by_mujoco.outcome}"],
        ["analytic", f"analytic {fig24a.outcome}"],
    ]
    set_time(frame, fig24a.impacts.time[1] + 1e-3)
    assert frame.value(TOUCHES) == ["1", "1"]
    painted(page, "cell-0", coins=2)
    assert_quiet(page, frame)


@pytest.mark.parametrize(("engine", "second"), [(analytic, "mujoco"), (coin_mj, "analytic")])
def test_two_tosses_by_one_engine_have_names_and_colours_of_their_own(notebook, engine, second):
    tosses = [engine.toss(load("fig24a").replace("coin.thickness", h)) for h in ("2 mm", "6 mm")]
    (frame,) = notebook(tosses[0].play(tosses[1]))
    kinds = ("this toss", tosses[0].engine), ("other toss", second)
    assert frame.value(SEQUENCES) == [row(toss, *kind) for toss, kind in zip(tosses, kinds, strict=True)]
    levels = "[...document.querySelectorAll('#energy svg svg text')].map((one) => one.textContent)"
    assert frame.value(levels) == [f"least energy to turn over: {name}" for name, _ in kinds]


def test_frames_leave_each_other_and_the_notebook_alone(page, notebook, fig24a, by_mujoco):
    first, second = notebook(fig24a.play(), by_mujoco.play(), height=2000)
    set_time(second, 0.5)
    set_time(first, 0.25)
    first.value("document.title = 'changed'")
    assert (first.value(TIME), second.value(TIME)) == (0.25, 0.5)
    assert second.value(SEQUENCES) == [row(by_mujoco, "MuJoCo", "mujoco")]
    assert page.value("document.title") == "mine"
    for frame in (first, second):
        assert frame.value("origin") == "null"
        assert frame.value(
            "(() => { try { return parent.document; } catch (error) { return error.name; } })()"
        ) == ("SecurityError")
    for cell in ("cell-0", "cell-1"):
        painted(page, cell)
    assert_quiet(page, first, second)


def test_a_map_is_explored_in_a_frame(page, notebook, map_path, monkeypatch):
    monkeypatch.setattr(static, "TOSSED_IN_FRAME", (1, 1))
    found = read_map(map_path)
    (frame,) = notebook(found.cointoss.page(), width=420, scheme="dark")
    frame.wait_for("document.querySelectorAll('#sequences .row[role=img]').length === 2")
    press = "document.getElementById('map').dispatchEvent(new KeyboardEvent('keydown', {{ key: '{}' }}))"
    x, y = (found[field].values[at] for field, at in zip(FIELDS, (12, 9), strict=True))
    case = parse(SCENARIO, "here").replace(FIELDS[0], x, FIELDS[1], y)
    assert frame.value(SEQUENCES)[0] == row(analytic.toss(case), "analytic", "analytic")
    frame.value(press.format("ArrowLeft"))
    frame.wait_for("document.getElementById('outcome').textContent.includes('MuJoCo: tossed only')")
    toss = analytic.toss(case.replace(FIELDS[0], found[FIELDS[0]].values[11]))
    told = f"{toss.outcome} after {len(toss.impacts)} impacts in {toss.end_time:.4f} s."
    assert told in frame.text("outcome")
    assert frame.value("document.documentElement.scrollWidth <= innerWidth")
    assert frame.value("location.href") == "about:srcdoc"
    assert_quiet(page, frame)


def test_the_lab_in_a_frame_follows_its_sliders(page, notebook):
    shown = cointoss.lab("table")
    assert repr(shown) == "<Frame: lab with 7.5 g, 23.25 mm, from 10 cm; a notebook shows it>"
    (frame,) = notebook(shown)
    assert frame.text("stop") == ""
    for restitution in (0.5, 0.25):
        slides(frame, "floor.restitution", restitution)
        sequence = analytic.toss(load("table").replace("floor.restitution", restitution)).sequence
        frame.wait_for(f"({SEQUENCES})[0]?.[2] === '{sequence}'")
    assert frame.value("document.documentElement.scrollWidth <= innerWidth")
    assert_quiet(page, frame)


def test_a_large_map_is_thinned(map_path, monkeypatch):
    monkeypatch.setattr(static, "MOST_PIXELS", 24 * 18 // 4)
    monkeypatch.setattr(static, "TOSSED_IN_FRAME", (1, 1))
    shown = []
    monkeypatch.setattr(static, "lab_page", lambda _, **more: shown.append(more) or "")
    read_map(map_path).cointoss.page()
    assert shown[-1]["saved"]["stride"] == 2
