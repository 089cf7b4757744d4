"""What the lab's tour says of its stops is so."""

import json
import re

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.metrics.estimates import share
from cointoss.models.batch import rows_of
from tests.helpers.lab import COUNTED, SPIN, go

SPINS, FINE = np.linspace(20, 60, 1001), np.linspace(20, 60, 8001)
# Six times nearer each stripe of the second touch is several of some 200 columns wide.
NEAR = 50 + 40 / 2**6 * np.linspace(-0.5, 0.5, 201)


@pytest.fixture(name="stops", scope="module")
def _stops(loaded):
    """The states of the tour's stops, by name."""
    return {stop["name"]: stop["state"] for stop in loaded.value("import('tour.js').then((m) => m.STOPS)")}


def scenario_of(state):
    """Return the scenario of a state of the lab."""
    fields = {name: value for name, value in state["scenario"].items() if "." in name}
    plain = cointoss.load("fig24a").replace("air.normal", 0, "air.tangential", 0, "release.angles", [0, 0, 0])
    return plain.replace(*(part for pair in fields.items() for part in pair))


def faces_of(scenario, after, spins, **more):
    """Return the faces over spins at the touch after some impacts, or in the end where that is None."""
    fields = {SPIN: np.asarray(spins), **{name.replace("__", "."): value for name, value in more.items()}}
    if after is not None:
        scenario = scenario.replace("ending.max_impacts", after + 1)
    many = analytic.toss_rows(rows_of(scenario, len(spins), fields))
    return many.outcome if after is None else many.after(after)


@pytest.mark.parametrize(
    ("name", "after", "spins", "more", "fewest", "most"),
    [
        *(("touch", 0, SPINS, {"release__position__z": height}, 3, 5) for height in (0.2, 0.4, 0.6)),
        *(("bounces", 1, FINE, {"release__position__z": height}, 200, 1000) for height in (0.2, 0.4, 0.6)),
        ("bounces", 1, NEAR, {}, 10, 40),
        # The finer one looks, the more thin stripes are seen.
        ("restitution", None, np.linspace(20, 60, 641), {"floor__restitution": 0.0}, 11, 16),
        ("restitution", None, FINE, {"floor__restitution": 0.0}, 11, 16),
        ("restitution", None, SPINS, {"floor__restitution": 0.3}, 100, 1000),
    ],
)
def test_along_a_row_the_face_changes_so_often(stops, name, after, spins, more, fewest, most):
    found = faces_of(scenario_of(stops[name]), after, spins, **more)
    assert fewest <= np.sum(found[1:] != found[:-1]) <= most


@pytest.mark.parametrize(
    ("name", "without", "after", "part"),
    [
        ("air", {"air.normal": 0, "air.tangential": 0}, 2, pytest.approx(1 / 3, abs=0.05)),
        ("imperfect", {"coin.center_of_mass": [0, 0, 0]}, 0, pytest.approx(1 / 30, abs=0.01)),
        ("imperfect", {"coin.center_of_mass": [0, 0, 0]}, 2, pytest.approx(0.31, abs=0.04)),
    ],
)
def test_so_many_tosses_show_another_face_without_it(stops, name, without, after, part):
    spins, heights = (
        each.ravel() for each in np.meshgrid(np.linspace(20, 60, 160), np.linspace(0.2, 0.6, 12))
    )
    case = scenario_of(stops[name])
    other = case.replace(*(each for pair in without.items() for each in pair))
    found, due = (faces_of(each, after, spins, release__position__z=heights) for each in (case, other))
    assert np.mean(found != due) == part


def test_a_coin_that_is_caught_shows_the_face_of_its_turns(stops):
    x, y = stops["caught"]["x"], stops["caught"]["y"]
    ends = [x[end] * y[end] / (np.pi * 9.81) for end in ("from", "to")]
    assert ends == [pytest.approx(1 / 6, abs=0.01), pytest.approx(9.7, abs=0.05)]
    spins, speed = np.linspace(20, 100, 201), 2.0
    turns = spins * speed / (np.pi * 9.81)
    found = faces_of(scenario_of(stops["caught"]), None, spins, release__velocity__z=speed)
    assert np.array_equal(found == 1, np.abs(turns - np.round(turns)) < 1 / 4)


def test_a_hand_keeps_the_face_of_one_touch_and_the_mass_centre_lies_aside(stops):
    spins, heights = np.random.default_rng(0).normal([[45], [0.4]], [[0.02 * 45], [0.02 * 0.4]], (2, 20_000))
    found = faces_of(scenario_of(stops["touch"]), 0, spins, release__position__z=heights)
    assert np.mean(found == 1) > 0.999
    aside = scenario_of(stops["imperfect"]).coin.center_of_mass
    assert np.hypot(*aside[:2]) == pytest.approx(1.4e-3, abs=5e-5)


def test_the_share_of_a_hand_is_that_of_the_package(loaded, kept, stops):
    stop = stops["hand"]
    listed = (
        f"Object.values(m.releases({json.dumps(stop['scenario'])}, 0.02, m.TOSSES)).map((all) => [...all])"
    )
    heights, spins = (np.array(each) for each in loaded.value(f"import('hand.js').then((m) => {listed})"))
    go(kept, "#tour=hand")
    kept.wait_for(COUNTED)
    told = re.findall(r"tosses .* ([\d.]+) % show heads \[([\d.]+), ([\d.]+); 99 %", kept.text("share"))
    # About half in the end, and nearly all at the first touch.
    case = scenario_of(stop)
    ended = share(faces_of(case, None, spins, release__position__z=heights) == 1)
    assert told == [tuple(f"{100 * part:.1f}" for part in (ended.value, ended.low, ended.high))]
    assert ended.low < 0.5 < ended.high
    assert np.mean(faces_of(case, 0, spins, release__position__z=heights) == 1) > 0.99


@pytest.mark.parametrize(
    ("hair", "at", "told"),
    [
        (1e-6, 6, "up to touch 5, and part at touch 6."),
        (1e-9, 7, "and part at touch 7."),
        (1e-15, None, "at every touch."),
    ],
)
def test_a_hundred_coins_part_where_the_stop_says(loaded, kept, stops, hair, at, told):
    spins = loaded.value(f"import('hundred.js').then((m) => [...m.spread({{ '{SPIN}': 45 }}, {hair})])")
    scenario = scenario_of(stops["hundred"])
    faces = np.array([faces_of(scenario, touch, spins) for touch in range(12)])
    apart = [touch for touch, row in enumerate(faces, start=1) if len(set(row)) > 1]
    assert next(iter(apart), None) == at
    link = kept.value("[...document.querySelectorAll('#tour a')].map((one) => one.hash)[3]")
    go(kept, link.replace("hair=0.000001", f"hair={hair}"))
    kept.wait_for(f"document.getElementById('parting').textContent.includes('{told}')")
    different = re.findall(r"only (\d+) different numbers", kept.text("parting"))
    assert different == ([str(len(set(spins)))] if len(set(spins)) < 100 else [])
