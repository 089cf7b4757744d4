"""A hand catches the coin: the face up when the mass centre first comes down to a height, on both engines."""

import json

import numpy as np
import pytest
from scipy.optimize import brentq

from cointoss.compare.engines import Engine
from cointoss.models.records import Ending, Outcome
from tests.helpers.command_line import cointoss
from tests.helpers.draws import AIR, IMPERFECT, scenario
from tests.helpers.engines import toss

pytestmark = pytest.mark.usefixtures("without_horizon")

G, HAND = 9.81, 1.2
EXACT = {Engine.ANALYTIC: 1e-12, Engine.MUJOCO: 1e-9}
# A spring's restitution errs by up to 7e-5, at a speed of 4 m/s.
BOUNCED = {Engine.ANALYTIC: 1e-9, Engine.MUJOCO: 3e-5}
engines = pytest.mark.parametrize("engine", list(Engine))


def thrown(height=1.0, up=3.0, spin=38.0, **parts):
    """A coin thrown up from a height, flat, and to be caught at `HAND`."""
    release = {"position": [0, 0, height], "velocity": [0.2, 0, up], "angular_velocity": [spin, 0, 0]}
    return scenario(release=release, ending={"caught": HAND}, **parts)


@engines
@pytest.mark.parametrize("spin", [5.0, 12.0, 38.0, -60.0])
def test_in_vacuum_a_coin_is_caught_on_its_parabola(engine, spin):
    caught = toss(engine, thrown(spin=spin))
    time = (3 + np.sqrt(9 - 2 * G * (HAND - 1))) / G
    assert caught.ending == Ending.CAUGHT
    assert caught.end_time == pytest.approx(time, abs=EXACT[engine])
    assert caught.outcome == (Outcome.HEADS if np.cos(spin * time) > 0 else Outcome.TAILS)
    assert len(caught.impacts) == len(caught.contacts) == 0
    assert caught.sample([caught.end_time]).position[0] == pytest.approx([0.2 * time, 0, HAND], abs=1e-9)


@engines
def test_released_above_the_hand_a_coin_is_caught_on_its_first_way_down(engine):
    caught = toss(engine, thrown(height=1.5, up=0.0))
    assert caught.end_time == pytest.approx(np.sqrt(2 * 0.3 / G), abs=EXACT[engine])


@engines
@pytest.mark.parametrize("exponent", [0.0, 0.5])
def test_in_air_an_unbalanced_coin_is_caught_where_its_path_without_a_hand_comes_down(engine, exponent):
    coin = IMPERFECT
    thick_air = {name: 5 * value for name, value in AIR.items()}
    held = thrown(coin=coin, air={**thick_air, "exponent": exponent})
    caught = toss(engine, held)
    free = toss(engine, held.replace("ending.caught", None, "ending.max_time", 0.6))
    down = brentq(lambda t: free.sample([t]).position[0, 2] - HAND, 0.3, 0.6, xtol=1e-14)
    assert caught.ending == Ending.CAUGHT
    assert caught.end_time == pytest.approx(down, abs=1e-9)
    # The air has taken more than 1 ms.
    assert down < (3 + np.sqrt(9 - 2 * G * (HAND - 1))) / G - 1e-3


@engines
def test_a_coin_that_bounces_above_the_hand_is_caught_then(engine):
    bounced = toss(engine, thrown(height=1.0, up=-5.0, spin=0.0))
    assert len(bounced.impacts) == 1
    assert bounced.ending == Ending.CAUGHT
    E = 0.8**2 * (25 / 2 + G * (1.0 - 1e-3))
    up = np.sqrt(2 * E)
    assert bounced.end_time - bounced.impacts.time[0] == pytest.approx(
        (up + np.sqrt(up**2 - 2 * G * (HAND - 1e-3))) / G, abs=BOUNCED[engine]
    )


@engines
@pytest.mark.parametrize("law", ["smooth", "coulomb"])
def test_a_coin_that_never_comes_to_the_hand_is_not_caught_and_has_no_face(engine, law):
    missed = toss(engine, thrown(up=1.0, floor={"contact": law, "friction": 0.2}, air=AIR))
    assert missed.ending == Ending.NOT_CAUGHT
    assert missed.outcome == Outcome.UNDECIDED
    # Only of laws that never add energy is it known at once.
    assert (len(missed.impacts) == 1) == (law == "smooth")


@engines
def test_an_arc_just_above_the_hand_is_caught_and_one_just_below_is_not(engine):
    for part, ending in ((1 + 1e-6, Ending.CAUGHT), (1 - 1e-6, Ending.NOT_CAUGHT)):
        assert toss(engine, thrown(up=part * np.sqrt(2 * G * (HAND - 1)))).ending == ending


def test_the_engines_catch_the_same_face_at_the_same_time():
    for spin in range(20, 60):
        one, other = (toss(engine, thrown(spin=float(spin), air=AIR)) for engine in Engine)
        assert one.outcome == other.outcome
        assert one.end_time == pytest.approx(other.end_time, abs=1e-9)


def test_the_command_line_names_the_catch(tmp_path):
    path = tmp_path / "hand.toml"
    path.write_text(thrown().to_toml())
    told = json.loads(cointoss("toss", str(path), "--json").stdout)
    assert (told["ending"], told["sequence"], told["impacts"]) == ("caught", "", [])
    assert "caught: A hand caught the coin" in cointoss("toss", str(path)).stdout
