"""The coin that is thrown by hand in the lab, and the challenge."""

import json
import re
import time

import numpy as np
import pytest
from scipy.stats import norm

from tests.helpers.coins_shown import box, picture
from tests.helpers.lab import TOSSED, WHOLE

CAUGHT = "document.querySelectorAll('#tour a')[0].click()"
THROWN = "document.getElementById('thrown').textContent"


def throws(page):
    """Return the faces of the throws as the challenge lists them, and the turns of the last one."""
    page.wait_for(f"{THROWN} !== ''")
    ((faces, turns),) = re.findall(r" ((?:[HT] ?)+): ([\d.]+) turns", page.value(THROWN))
    return faces.split(), float(turns)


def given(page):
    """Return speed upwards and spin of the coin."""
    fields = ("release.velocity.z", "release.angular_velocity.eta")
    return [
        float(page.value(f"document.querySelector('[data-field=\"{field}\"]').value")) for field in fields
    ]


def throw_by_key(page, held):
    """Hold the space bar for a time [s], and wait until the coin has come down."""
    before = page.value(THROWN)
    page.value("document.getElementById('flick').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key=" ")
    time.sleep(held)
    page.call("Input.dispatchKeyEvent", type="keyUp", key=" ")
    page.wait_for(f"{THROWN} !== {json.dumps(before)}")


def middle(page):
    left, top, width, height = box(page, "flick")
    return left + width / 2, top + height / 2


@pytest.fixture(name="caught")
def _caught(page, lab_path):
    """The lab at the stop of the coin that is caught."""
    page.open(lab_path.as_uri())
    page.value(CAUGHT)
    page.wait_for(f"location.hash.endsWith('tour=caught') && {TOSSED}")
    return page


def test_a_click_and_a_flick_throw_the_coin_and_its_face_is_kellers(caught):
    x, y = middle(caught)
    for speed in (0, 6):  # a click, and a flick
        before = caught.value(THROWN)
        caught.mouse("mousePressed", x, y, button="left", buttons=1, clickCount=1)
        for step in range(1, 6):
            caught.mouse("mouseMoved", x, y - 8 * speed * step, button="left", buttons=1)
        caught.mouse("mouseReleased", x, y - 40 * speed, button="left", clickCount=1)
        caught.wait_for(f"{THROWN} !== {json.dumps(before)}")
    faces, told = throws(caught)
    assert len(faces) == 2
    turns = np.prod(given(caught)) / (np.pi * 9.81)
    assert told == pytest.approx(turns, abs=0.006)
    assert faces[-1] == ("H" if abs(turns - round(turns)) < 1 / 4 else "T")
    caught.value("document.getElementById('again').click()")
    caught.wait_for("document.getElementById('challenge').hidden")


def test_a_throw_stays_as_a_dot_on_the_map(caught):
    places = []
    for held in (0.5, 0.05):
        throw_by_key(caught, held)
        places.append(given(caught))
    caught.wait_for(WHOLE)
    (speed, spin), last = places
    assert speed > last[0] + 0.1  # the key that is held longer throws harder
    shown = picture(caught, "map")
    height, width = shown.shape[:2]
    # The margins are those of map_view.js; the stop's map is of 10 to 100 rad/s and 0.5 to 3 m/s.
    x = round(74 + (spin - 10) / 90 * (width - 74 - 14))
    y = round(10 + (3 - speed) / 2.5 * (height - 10 - 52))
    ring = [shown[y, x - 6], shown[y, x + 6], shown[y - 6, x], shown[y + 6, x]]
    # White, smoothed at its edge; gold has 31 of blue, blue 13 of red.
    assert np.min(ring) > 150
    assert np.abs(shown[y, x].astype(int) - shown[y, x - 3]).max() < 10


def test_the_face_of_a_throw_is_told_when_it_has_come_down(page, lab_path):
    page.open(f"{lab_path.as_uri()}#tour=caught", moving=True)
    page.wait_for(TOSSED)
    page.value("document.getElementById('flick').focus()")
    for kind in ("keyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key=" ")
    page.wait_for("document.getElementById('outcome').textContent === 'The coin is in the air.'")
    assert page.text("state-analytic") == ""
    page.wait_for(f"{THROWN} !== ''")
    (face,), _ = throws(page)
    assert page.text("state-analytic") == {"H": "heads", "T": "tails"}[face]
    assert page.text("outcome").startswith(page.text("state-analytic"))


def test_a_hand_that_catches_scatters_no_height(caught):
    stop = "import('tour.js').then(({ STOPS }) => STOPS[0].state.scenario)"
    asked = "([one, { releases }]) => Object.keys(releases(one, 0.02, 5))"
    fields = caught.value(f"Promise.all([{stop}, import('hand.js')]).then({asked})")
    assert set(fields) == {"release.velocity.z", "release.angular_velocity.eta"}


def test_the_fastest_and_the_slowest_flick_are_scenarios(caught):
    limits = caught.value("import('flick.js').then(({ SPEEDS, SPINS }) => [SPEEDS, SPINS])")
    for flick in ("0, 0", "0, 1e9", "-1e9, -1e9", "1e9, 0"):
        found = caught.value(f"import('flick.js').then(({{ thrown }}) => thrown({flick}))")
        assert limits[0][0] <= found["speed"] <= limits[0][1]
        assert limits[1][0] <= found["spin"] <= limits[1][1]


def test_kellers_curve_is_the_share_of_the_square_wave(caught):
    for scatter in (0.02, 0.1, 0.3, 0.7):
        whole = np.arange(-40, 41)
        due = np.sum(norm.cdf((whole + 0.25) / scatter) - norm.cdf((whole - 0.25) / scatter))
        found = caught.value(f"import('challenge.js').then(({{ kellersCurve }}) => kellersCurve({scatter}))")
        assert found == pytest.approx(due, abs=1e-9)
    made = [
        {"speed": 2, "spin": 40, "outcome": "heads"},
        {"speed": 2.2, "spin": 40, "outcome": "tails"},
        {"speed": 1.8, "spin": 40, "outcome": "heads"},
        {"speed": 2, "spin": 40, "outcome": "heads"},
    ]
    asked = f"[handOf({json.dumps(made)}), longestRow({json.dumps(made)})]"
    hand, row = caught.value(f"import('challenge.js').then(({{ handOf, longestRow }}) => {asked})")
    speeds = [each["speed"] for each in made]
    assert row == 2
    assert hand["scatter"] == pytest.approx(np.std(speeds, ddof=1) / 2 / 2**0.5)
    assert hand["turns"] == pytest.approx(np.std(speeds, ddof=1) * 40 / (np.pi * 9.81))
