"""A toss that shows what is wanted: brute force over a map, margins that hold, and what there is not."""

import itertools
import math
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.find import search
from cointoss.compare.find.faces import faces_shown
from cointoss.compare.find.fields import spans
from cointoss.compare.find.find import find
from cointoss.compare.metrics.estimates import share_of
from cointoss.compare.sweep.toss_many import toss_many
from cointoss.compare.sweep.window import Window
from cointoss.models.batch import PLACE, rows_of
from cointoss.models.laws import ContactLaw
from cointoss.models.quantities import LARGEST
from cointoss.models.reading import load, parse
from cointoss.models.records import Outcome
from cointoss.models.stages import at_work
from cointoss.models.unlikely import UnitWarning
from tests.helpers.basin_runs import SCENARIO

COIN = parse(SCENARIO, "coin")
WINDOW = {"release.position.z": "0.3:0.31", "release.angular_velocity.eta": (20, 21)}


def shown_on_a_grid(case, touches, count):
    """Return the sequences of faces at the first touches that a grid of tosses over the window shows."""
    axes = {"release.position.z": (0.3, 0.31, count), "release.angular_velocity.eta": (20, 21, count)}
    limits = {"ending.max_impacts": np.arange(touches) + 1}
    faces = toss_many(case, axes | limits).last_face.transpose(..., "toss").values
    return {"".join(word[0].upper() for word in row) for row in faces.reshape(-1, touches).tolist()}


def test_what_a_grid_shows_is_found_and_nothing_else():
    """All sequences of three touches, by brute force over a grid; what is found shows it when tossed."""
    by_grid, found = shown_on_a_grid(COIN, 3, 60), {}
    for word in map("".join, itertools.product("HT", repeat=3)):
        one: Any = find(COIN, WINDOW, sequence=word, tosses=1024)
        if one:
            assert analytic.toss(one.scenario).sequence.startswith(word)
            found[word] = one
        else:
            assert one.lines[0].startswith(
                "none in 1,024 tosses, covering release.position.z from 0.3 to 0.31 m"
            )
    assert set(found) >= by_grid
    assert 2 <= len(by_grid) <= len(found) < 8, "some there are, some there are not"


def test_the_toss_shows_it_up_to_its_margins():
    """HTH or HHT, one of which is in the window; at the margin it shows something else."""
    words = (find(COIN, WINDOW, sequence=word, tosses=1024) for word in ("HTH", "HHT"))
    found: Any = next(filter(None, words))
    ends = [(room, end) for room in found.rooms for end in (-room.down, room.up) if math.isfinite(end)]
    assert len(ends) >= 2
    for (room, end), (part, is_so) in itertools.product(ends, ((0.4, True), (0.9, True), (1.0, False))):
        moved = found.scenario.replace(room.span.field, room.value + part * end)
        assert analytic.toss(moved).sequence.startswith(found.target.sequence) is is_so


@pytest.mark.parametrize("outcome", ["edge", Outcome.EDGE])
def test_an_outcome_is_found_and_all_fields_may_vary(outcome):
    """A thick coin dropped near its edge: on it, and beside it."""
    thick = COIN.replace("coin.thickness", 0.01, "floor.restitution", 0.3, "air.normal", 0.8)
    found: Any = find(
        thick,
        {"release.angles.theta": "60 deg:90 deg", "coin.thickness": ("9 mm", "11 mm")},
        outcome=outcome,
        tosses=32,
    )
    assert found.toss.outcome == Outcome.EDGE
    assert 9e-3 <= found.scenario.coin.thickness <= 11e-3
    assert found.lines[-1].startswith("outcome: edge, ")
    none = find(thick, {"release.angles.theta": "0 deg:10 deg"}, outcome="edge", tosses=64)
    assert (bool(none), none.scenario) == (False, None)
    with pytest.raises(ValueError, match="no toss shows it"):
        none.to_toml()


def test_the_same_seed_finds_the_same_toss():
    first, second, other = (find(COIN, WINDOW, sequence="HT", tosses=512, seed=seed) for seed in (1, 1, 2))
    assert first.scenario == second.scenario
    assert first.scenario != other.scenario


def test_points_that_make_no_scenario_are_no_tosses():
    """The floor is in the middle of the window; of 256 points half have the coin's rim above it."""
    found = find(COIN, {"release.position.z": "-1:1"}, sequence="HTHTHTHTHT", tosses=256)
    assert not found
    assert found.tosses + found.refused == 256
    assert abs(found.tosses - 128) < 8
    most = share_of(0, found.tosses).high
    assert found.lines[0].startswith(
        f"none in {found.tosses} tosses, covering release.position.z from -1 to 1 m"
    )
    assert f", where {found.refused} more points make no scenario" in found.lines[0]
    assert found.lines[1].startswith(f"at most {100 * most:.2g} % of the tosses in the window")


def test_the_faces_are_those_of_tosses_that_end_there_whatever_differs_between_them():
    """The coin, the floor, its law, and the attitude; some coins make fewer touches."""
    n, rng = 60, np.random.default_rng(2)
    given = {
        "release.position.z": rng.uniform(0.2, 0.6, n),
        "release.angles.theta": rng.uniform(0.1, 1.0, n),
        "coin.thickness": np.repeat(rng.uniform(1e-3, 1e-2, n // 4), 4),
        "floor.restitution": rng.uniform(0.0, 0.9, n),
        "floor.contact": np.where(rng.random(n) < 0.5, ContactLaw.SMOOTH.value, ContactLaw.COULOMB.value),
    }
    rows = rows_of(COIN, n, given)
    faces = faces_shown(rows, 5)
    assert (faces == 0).any()
    for touch in range(5):
        rows[:, PLACE["ending.max_impacts"]] = touch + 1
        ended = analytic.toss_rows(rows)
        assert np.array_equal(faces[:, touch], np.where(ended.impacts == touch + 1, ended.last_face, 0))


def test_a_spin_may_vary_about_the_axis_that_the_coin_has():
    turning = COIN.replace("release.angular_velocity", [20.0, 15.0, 0.0])
    shown = (find(turning, {"spin": (20, 21)}, sequence=word, tosses=64) for word in "HT")
    found: Any = next(filter(None, shown))
    w = np.array(found.scenario.release.angular_velocity)
    assert 20 <= np.linalg.norm(w) <= 21
    assert w[0] / w[1] == pytest.approx(4 / 3)


@pytest.mark.filterwarnings(f"ignore::{UnitWarning.__module__}.UnitWarning")
def test_margins_are_looked_for_in_numbers_that_a_release_can_have():
    case = load("fig24a")
    window = Window(scenario=case, spans=spans({"release.position.z": (-1e9, 1e9)}, case))
    # A margin may be as wide as the window, to either side.
    assert window.values(np.array([[-1.0], [0.75], [2.0]])).ravel().tolist() == [-LARGEST, 5e8, LARGEST]
    assert window.rows(np.array([[-1.0], [2.0]]))[1].tolist() == [False, True]


def test_a_search_is_one_stage_from_its_beginning_to_its_end(monkeypatch):
    seen, own = [], search._margins
    monkeypatch.setattr(
        search, "_margins", lambda *given: seen.append([one.name for one in at_work]) or own(*given)
    )
    assert find(COIN, WINDOW, sequence="H", tosses=256)
    assert seen[0] == ["finding H", "measuring margins"]
