"""What the lab's tour and its hand say, against the package."""

import json
import re

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.metrics.estimates import share
from cointoss.models.batch import rows_of
from tests.helpers.coins_shown import box
from tests.helpers.command_line import cointoss as command
from tests.helpers.lab import COUNTED, HEIGHT, SPIN, TOSSED, WHOLE, go

SCROLLING = """
[...document.querySelectorAll("body *")].filter((one) => one.scrollHeight > one.clientHeight
  && ["auto", "scroll"].includes(getComputedStyle(one).overflowY)).map((one) => one.id)
"""


def scenario_of(stop):
    """Return the scenario of a state of the lab."""
    fields = {name: value for name, value in stop["scenario"].items() if "." in name}
    plain = cointoss.load("fig24a").replace("air.normal", 0, "air.tangential", 0, "release.angles", [0, 0, 0])
    return plain.replace(*(part for pair in fields.items() for part in pair))


def faces_after(held, count, fields, after):
    """Return the faces up at the touch after some impacts, the outcome where a toss ended before."""
    rows = rows_of(held.replace("ending.max_impacts", after + 1), count, fields)
    return analytic.toss_rows(rows).after(after)


def row_of(scenario, values, after, **fixed):
    """Return the faces along a row of a map, over values of the spin."""
    pairs = [part for name, value in fixed.items() for part in (name.replace("__", "."), value)]
    held = scenario.replace(*pairs) if pairs else scenario
    if after is None:
        return analytic.toss_rows(rows_of(held, len(values), {SPIN: values})).outcome
    return faces_after(held, len(values), {SPIN: values}, after)


def changes(faces_):
    return int(np.sum(faces_[1:] != faces_[:-1]))


@pytest.fixture(name="stops", scope="module")
def _stops(kept):
    """The stops of the tour, by name."""
    found = kept.value("import('tour.js').then(({ STOPS }) => STOPS)")
    assert len(found) == 8
    return {stop["name"]: stop for stop in found}


def link(kept, name):
    """Return the address of a stop."""
    links = kept.value("[...document.querySelectorAll('#tour a')].map((link) => link.hash)")
    (found,) = [one for one in links if one.endswith(f"tour={name}")]
    return found


def test_each_stop_stands_beside_its_sentences(kept, stops):
    for number, (name, stop) in enumerate(stops.items(), start=1):
        go(kept, f"#tour={name}")
        assert kept.text("stop") == f"{number}. {stop['title']}. {stop['text']}"
        assert kept.text("problem") == ""
        assert kept.value("document.querySelector('#tour [aria-current]').textContent") == str(number)
        assert kept.value("document.getElementById('crowd').hidden") == (name != "hundred")
        assert kept.value("document.getElementById('share').hidden") == (name != "hand")


def test_the_tour_is_walked_by_next_and_back_and_left_at_any_point(page, lab_path, stops):
    page.open(lab_path.as_uri(), width=420)
    names = list(stops)
    for name in names:
        page.value("document.getElementById('next').click()")
        page.wait_for(f"location.hash.endsWith('tour={name}')")
    assert page.value("document.getElementById('next').disabled")
    page.value("document.getElementById('back').click()")
    page.wait_for(f"location.hash.endsWith('tour={names[-2]}')")
    page.value("document.getElementById('trust').click()")
    page.wait_for("location.hash.includes('trust=1')")
    assert "You have changed something" not in page.text("stop")
    page.value("document.querySelector('[data-field=\"floor.restitution\"]').value = 0.5")
    page.value(
        "document.querySelector('[data-field=\"floor.restitution\"]').dispatchEvent(new Event('input'))"
    )
    page.wait_for("document.getElementById('stop').textContent.includes('You have changed something')")


def test_the_page_begins_with_the_tour_and_moves_slowly_between_its_stops(page, tmp_path):
    target = tmp_path / "lab.html"
    assert command("lab", "--out", target).exit_code == 0
    page.open(target.as_uri(), width=1280, height=800, moving=True)
    assert page.text("stop").startswith("1. Caught. Not if you catch it.")
    assert page.value(
        "[...document.querySelectorAll('h1, main > :last-child h2')].map((one) => one.textContent)"
    ) == [
        "Is a coin toss random?",
        "So is a coin toss random? No, and yes.",
    ]
    # Coin, map, controls and energy are seen without scrolling, the coin below its label.
    page.wait_for(TOSSED)
    for id_ in ("flick", "map", "shows", "play", "energy"):
        left, top, width, height = box(page, id_)
        assert 0 <= left <= left + width <= 1280
        assert 0 <= top <= top + height <= 800, id_
    assert (
        page.value("document.querySelector('.panel').getBoundingClientRect().bottom") <= box(page, "coins")[1]
    )
    assert page.value(SCROLLING) == []
    page.value("location.hash = " + json.dumps(link(page, "air")))
    page.wait_for(WHOLE)
    page.value(
        """(() => {
        window.seen = [];
        const slider = document.querySelector('[data-field="coin.center_of_mass.xi"]');
        const look = () => { seen.push(Number(slider.value)); requestAnimationFrame(look); };
        look();
        document.getElementById('next').click();
    })()"""
    )
    page.wait_for("location.hash.endsWith('tour=imperfect')")
    values = page.value("[...new Set(seen)]")
    assert len(values) > 5
    assert values == sorted(values, reverse=True)
    assert (values[0], values[-1]) == (0, -1)


def test_the_share_of_a_hand_is_that_of_the_package(kept, stops):
    stop = stops["hand"]["state"]
    go(kept, link(kept, "hand"))
    kept.wait_for(COUNTED)
    told = re.findall(
        r"Of 2,000 tosses .* ([\d.]+) % show heads \[([\d.]+), ([\d.]+); 99 %", kept.text("share")
    )
    given = f"{json.dumps(stop['scenario'])}, {stop['hand']}, TOSSES"
    listed = f"Object.entries(releases({given})).map(([field, all]) => [field, [...all]])"
    fields = dict(kept.value(f"import('hand.js').then(({{ releases, TOSSES }}) => {listed})"))
    assert set(fields) == {HEIGHT, SPIN}
    for field, mean in ((HEIGHT, 0.4), (SPIN, 27)):
        values = np.array(fields[field])
        # Within four standard errors.
        assert values.mean() == pytest.approx(mean, rel=4 * 0.02 / 2000**0.5)
        assert values.std() == pytest.approx(0.02 * mean, rel=4 / (2 * 2000) ** 0.5)
    reach = f"import('hand.js').then(({{ ellipse }}) => ellipse({json.dumps(stop)}, {stop['hand']})[0])"
    assert kept.value(reach) == pytest.approx([1.02 * 27, 0.4])
    # About half in the end, and nearly all at the first touch.
    ended = share(analytic.toss_rows(rows_of(scenario_of(stop), 2000, fields)).outcome == 1)
    assert told == [tuple(f"{100 * part:.1f}" for part in (ended.value, ended.low, ended.high))]
    assert ended.low < 0.5 < ended.high
    assert np.mean(faces_after(scenario_of(stop), 2000, fields, 0) == 1) > 0.99


def test_a_hundred_coins_part_where_the_stop_says(kept, stops):
    stop = stops["hundred"]["state"]
    for hair, at in ((1e-6, 6), (1e-9, 7), (1e-15, None)):
        given = f"{json.dumps(stop['scenario'])}, {hair}"
        spins = kept.value(f"import('hundred.js').then(({{ spread }}) => [...spread({given})])")
        assert len(spins) == 100
        assert max(spins) / 45 - 1 == pytest.approx(hair, rel=0.5)
        faces = np.array([tossed_faces(scenario_of(stop).replace(SPIN, spin), 12) for spin in spins])
        apart = [touch for touch, row in enumerate(faces.T, start=1) if len(set(row)) > 1]
        assert (apart[0] if apart else None) == at
        go(kept, f"{link(kept, 'hundred').replace('hair=0.000001', f'hair={hair}')}")
        kept.wait_for(f"document.getElementById('parting').textContent.includes({json.dumps(PARTED[at])})")
    different = re.findall(r"only (\d+) different numbers", kept.text("parting"))
    assert different == [str(len(set(spins)))]


def test_a_coin_of_the_hundred_lies_once_its_face_is_certain(kept):
    path = {"time": [0, 1], "position": [0, 0, 1, 3, 4, 0.01], "quaternion": [1, 0, 0, 0, 0.48, 0.6, 0.64, 0]}
    toss = {"outcome": "tails", "coin": {"thickness": 0.002, "center": [0, 0, 1e-4]}, "path": path}
    told = f"tossHundred(() => ({json.dumps(toss)}), {{}}, 0).then(([one]) => one.path)"
    laid = kept.value(f"import('hundred.js').then(({{ tossHundred }}) => {told})")
    due = [3, 4, 0.0009, *np.array([0, 0.6, 0.64, 0]) / np.hypot(0.6, 0.64)]
    assert laid["position"][-3:] + laid["quaternion"][-4:] == pytest.approx(due)


PARTED = {6: "up to touch 5, and part at touch 6.", 7: "and part at touch 7.", None: "at every touch."}


def tossed_faces(scenario, touches):
    """Return the faces at the first touches, the last one for those that there were not."""
    sequence = cointoss.toss(scenario).sequence
    return [sequence[min(touch, len(sequence)) - 1] for touch in range(1, touches + 1)]


def test_the_stops_of_the_tour_say_what_is_so(stops):
    spins = np.linspace(20, 60, 1001)
    scenarios = {name: scenario_of(stop["state"]) for name, stop in stops.items()}

    # From a sixth of a turn to 9.7, and heads within a quarter of whole turns.
    x, y = stops["caught"]["state"]["x"], stops["caught"]["state"]["y"]
    assert x["from"] * y["from"] / (np.pi * 9.81) == pytest.approx(1 / 6, abs=0.01)
    assert x["to"] * y["to"] / (np.pi * 9.81) == pytest.approx(9.7, abs=0.05)
    for speed in (1.0, 2.0):
        spun = np.linspace(10, 50, 201) * (2 / speed)
        turns = spun * speed / (np.pi * 9.81)
        found = row_of(scenarios["caught"], spun, None, release__velocity__z=speed)
        assert np.array_equal(found == 1, np.abs(turns - np.round(turns)) < 1 / 4)

    fine = np.linspace(20, 60, 8001)
    for height in (0.2, 0.4, 0.6):
        assert 3 <= changes(row_of(scenarios["touch"], spins, 0, release__position__z=height)) <= 5
        assert 200 <= changes(row_of(scenarios["bounces"], fine, 1, release__position__z=height)) < 1000
    # Six times nearer each stripe is several of some 200 columns wide.
    near = 50 + 40 / 2**6 * np.linspace(-0.5, 0.5, 201)
    assert 10 <= changes(row_of(scenarios["bounces"], near, 1)) <= 40
    spun, high = np.random.default_rng(0).normal([[45], [0.4]], [[0.02 * 45], [0.02 * 0.4]], (2, 20_000))
    by_hand = {SPIN: spun, HEIGHT: high}
    assert np.mean(faces_after(scenarios["touch"], 20_000, by_hand, 0) == 1) > 0.999

    # The finer one looks, the more thin stripes are seen.
    for count in (641, 8001):
        fine = np.linspace(20, 60, count)
        assert 11 <= changes(row_of(scenarios["restitution"], fine, None, floor__restitution=0.0)) <= 16
    assert changes(row_of(scenarios["restitution"], spins, None, floor__restitution=0.3)) > 100

    heights = np.linspace(0.2, 0.6, 12)
    spins = np.linspace(20, 60, 160)

    def faces_of(scenario, after):
        return np.array([row_of(scenario, spins, after, release__position__z=height) for height in heights])

    air, aside = scenarios["air"], scenarios["imperfect"]
    vacuum = air.replace("air.normal", 0, "air.tangential", 0)
    assert np.mean(faces_of(air, 2) != faces_of(vacuum, 2)) == pytest.approx(1 / 3, abs=0.05)
    perfect = aside.replace("coin.center_of_mass", [0, 0, 0])
    assert np.hypot(*aside.coin.center_of_mass[:2]) == pytest.approx(1.4e-3, abs=5e-5)
    assert np.mean(faces_of(aside, 0) != faces_of(perfect, 0)) == pytest.approx(1 / 30, abs=0.01)
    assert np.mean(faces_of(aside, 2) != faces_of(perfect, 2)) == pytest.approx(0.31, abs=0.04)
