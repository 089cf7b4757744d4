"""What the lab's tour and its hand say, against the package."""

import json
import re

import numpy as np
import pytest

import cointoss
from cointoss import analytic
from cointoss.compare.metrics.estimates import share
from cointoss.models.batch import rows_of
from tests.helpers.lab import COUNTED, HEIGHT, SPIN, go


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
    for field, mean in ((HEIGHT, 0.4), (SPIN, 27)):
        values = np.array(fields[field])
        # Within four standard errors.
        assert values.mean() == pytest.approx(mean, rel=4 * 0.02 / 2000**0.5)
        assert values.std() == pytest.approx(0.02 * mean, rel=4 / (2 * 2000) ** 0.5)
    for after, least, most in ((0, 0.99, 1), (2, 0.4, 0.6)):
        expected = share(faces_after(scenario_of(stop), 2000, fields, after) == 1)
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
        found = row_of(scenarios[0], spun, None, release__velocity__z=speed)
        assert np.array_equal(found == 1, np.abs(turns - np.round(turns)) < 1 / 4)

    for height in (0.2, 0.4, 0.6):
        assert 3 <= changes(row_of(scenarios[1], spins, 0, release__position__z=height)) <= 5
        assert changes(row_of(scenarios[1], spins, 1, release__position__z=height)) > 100

    # The finer one looks, the more thin stripes are seen.
    for count in (641, 8001):
        fine = np.linspace(20, 60, count)
        assert 11 <= changes(row_of(scenarios[2], fine, None, floor__restitution=0.0)) <= 16
    assert changes(row_of(scenarios[2], spins, None, floor__restitution=0.3)) > 100
    assert changes(row_of(scenarios[2], spins, None, floor__restitution=0.6)) > 300

    heights = np.linspace(0.2, 0.6, 12)
    spins = np.linspace(20, 60, 160)

    def faces_of(scenario, after):
        return np.array([row_of(scenario, spins, after, release__position__z=height) for height in heights])

    vacuum = scenarios[3].replace("air.normal", 0, "air.tangential", 0)
    assert np.mean(faces_of(scenarios[3], 2) != faces_of(vacuum, 2)) == pytest.approx(1 / 3, abs=0.05)
    perfect = scenarios[4].replace("coin.center_of_mass", [0, 0, 0])
    assert np.hypot(*scenarios[4].coin.center_of_mass[:2]) == pytest.approx(1.4e-3, abs=5e-5)
    assert np.mean(faces_of(scenarios[4], 0) != faces_of(perfect, 0)) == pytest.approx(1 / 30, abs=0.01)
    assert np.mean(faces_of(scenarios[4], 2) != faces_of(perfect, 2)) == pytest.approx(0.31, abs=0.04)
