"""A coin that rocks on its edge: it is said to stand only where its rocking cannot lift it over."""

import numpy as np
import pytest

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import lower_rim_of
from cointoss.analytic.contact.edge.restoring import held_on_edge, restoring_acceleration
from cointoss.analytic.contact.edge.rocking import rocks_on_edge, steady_lean
from cointoss.analytic.contact.edge.rolling import roll_by, to_lowest
from cointoss.analytic.contact.edge.standing import on_edge
from cointoss.analytic.contact.floor_laws import friction_in_contact
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import lean_and_rate, rim_contact
from cointoss.analytic.numerics.tolerances import STEADY
from cointoss.analytic.runs import run
from cointoss.models.attitude import rotation_matrix
from cointoss.models.laws import ContactLaw, EndingTest
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import held, put_on_floor, upright_coin
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario

SMOOTH = FloorFriction(0.0)
G, R_COIN = 9.81, ZLOTY["radius"]


def rocking(rng, body, rules):
    """Give a coin that rocks on its edge while it rolls and turns, with its contact."""
    friction = friction_in_contact(rules)
    mode = Mode.SLIDING if rules.law == ContactLaw.SMOOTH else Mode.STICKING
    turn, roll = rng.choice([(1, 3), (12, 2.5), (6, 12)])
    y = upright_coin(body, rng.uniform(0, 6), rng.normal(0, turn), rng.normal(0, roll))
    up, most = rotation_matrix(tuple(y[6:10]))[2], steady_lean(body)
    y[10:12] += rng.uniform(-0.8, 0.8) * most * (G / R_COIN) ** 0.5 * np.array([-up[1], up[0]])
    upright.tilt(y, rng.uniform(-0.2, 0.2) * most)
    y[3:5] -= rim_contact(body, y, lower_rim_of(y)).velocity[:2]
    put_on_floor(body, friction, mode, y)
    return held(body, friction, mode, y), y


@pytest.mark.parametrize("count", [16, pytest.param(400, marks=pytest.mark.long)])
@pytest.mark.parametrize(
    "floor",
    [
        {"contact": "smooth"},
        {"contact": "coulomb", "friction": 0.2},
        {"contact": "perfectly_rough"},
    ],
)
def test_a_coin_that_is_said_to_stand_while_it_rocks_comes_to_stand(floor, count):
    """With `test = "lying"` it is followed on until its rocking has died away."""
    rng, stood, earlier = np.random.default_rng(5), 0, 0
    for _ in range(count):
        center = (*rng.uniform(-1e-3, 1e-3, 2), rng.uniform(-5e-5, 5e-5))
        coin = {"thickness": rng.choice([6e-4, 1e-3, 2e-3, 4e-3]), "center_of_mass": center}
        case = scenario(coin=coin, floor={**floor, "restitution": rng.uniform(0.2, 0.9)}, air=AIR)
        body, rules = case.body, case.rules
        contact, y = rocking(rng, body, rules)
        if not rocks_on_edge(contact, y):
            continue
        assert not on_edge(body, y)
        stood += 1
        ended = run(body, rules._replace(test=EndingTest.LYING), y)
        assert ended.outcome == Outcome.EDGE
        assert on_edge(body, ended.started.states[-1])
        assert max(abs(lean_and_rate(state)[0]) for state in ended.started.states) < 4 * steady_lean(body)
        early = run(body, rules, y)
        assert early.outcome == Outcome.EDGE
        assert early.end_time <= ended.end_time
        earlier += early.ending == Ending.STANDING and not on_edge(body, early.started.states[-1])
    assert stood >= earlier >= count / 8


@pytest.mark.parametrize(("thickness", "turn"), [(6e-4, 9.2), (8e-4, 13.0)])
def test_a_coin_that_is_hardly_held_where_its_center_is_lowest_is_not_said_to_stand(thickness, turn):
    """It rolls to and fro near there, through few phases, and fastest between them."""
    coin = {"thickness": thickness, "center_of_mass": (1.6e-3, 1.8e-3, 0)}
    case = scenario(coin=coin, floor={"restitution": 0.5}, air=AIR)
    body = case.body
    for rate in (1.6, 2.2):  # the larger is refused in whichever phases it is tried
        y = upright_coin(body, 4.07, turn, 3.0)
        up = rotation_matrix(tuple(y[6:10]))[2]
        y[10:12] += rate * steady_lean(body) * (G / R_COIN) ** 0.5 * np.array([-up[1], up[0]])
        put_on_floor(body, SMOOTH, Mode.SLIDING, y)
        assert not rocks_on_edge(held(body, SMOOTH, Mode.SLIDING, y), y)
    assert run(body, case.rules, y).outcome == Outcome.TAILS


def test_the_lowest_phase_is_where_the_center_is_below():
    body = scenario(coin=IMPERFECT).body
    for phase in (0.3, 2.0, 5.0):
        y, rolled = upright_coin(body, phase, 3.0, 20.0), np.empty(13)
        roll_by(held(body, SMOOTH, Mode.SLIDING, y), False, y, to_lowest(body, y) / 2, rolled)
        center = np.array(rotation_matrix(tuple(rolled[6:10]))) @ np.array(body.center)
        assert center[2] == pytest.approx(-np.hypot(*body.center[:2]), rel=1e-9)


def test_a_coin_that_rocks_leaves_its_edge_on_the_side_on_which_it_is_hardly_held():
    """Rolling while it turns, it is held on one rim by more than four times as much as on the other."""
    case = scenario(coin={"thickness": 1e-3}, floor={"restitution": 0.9}, air=AIR)
    body = case.body
    y = upright_coin(body, 0.4, 2.5, -15.4)
    upright.tilt(y, -0.35 * steady_lean(body))
    put_on_floor(body, SMOOTH, Mode.SLIDING, y)
    contact = held(body, SMOOTH, Mode.SLIDING, y)
    strong, weak = (restoring_acceleration(contact, rim, 1e-9, y) for rim in (-1.0, 1.0))
    assert strong > 4 * weak > 0
    assert not rocks_on_edge(held(body, SMOOTH, Mode.SLIDING, y), y)
    assert run(body, case.rules, y).outcome in {Outcome.HEADS, Outcome.TAILS}


@pytest.mark.parametrize("height", [2e-4, -2e-4])
def test_a_still_coin_is_turned_back_up_to_four_times_the_steady_lean_and_not_beyond(height):
    """Its mass centre is as high as can be, and over the lowest point at (h/2 - |z|)/(r + the rest of c)."""
    case = scenario(coin={"thickness": 1e-3, "center_of_mass": [1.2e-3, 0, height]})
    body = case.body
    y = upright_coin(body, np.pi / 2, 0.0, 0.0)
    assert np.array(rotation_matrix(tuple(y[6:10])))[2, 0] == pytest.approx(1)
    contact, rim = held(body, SMOOTH, Mode.SLIDING, y), np.sign(height)
    tips = steady_lean(body) / STEADY
    assert tips == pytest.approx(3e-4 / 13.7e-3)
    inside, beyond = (restoring_acceleration(contact, rim, part * tips, y) for part in (0.999, 1.001))
    assert inside > 0 > beyond
    assert restoring_acceleration(contact, -rim, 1.5 * tips, y) > 0


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_a_coin_that_turns_as_it_rolls_is_tipped_to_the_side_to_which_it_turns(direction):
    """J_ζ ω_ζ Ω is more than m g h/2: the one rim turns it back, the other does not, and it is not held."""
    body = scenario().body
    y = upright_coin(body, 0.4, 60.0, 60.0 * direction)
    contact = held(body, SMOOTH, Mode.SLIDING, y)
    back = [restoring_acceleration(contact, rim * direction, 1e-9, y) for rim in (1.0, -1.0)]
    assert max(back) > 0 > min(back)
    assert not held_on_edge(contact, y)
    slower = upright_coin(body, 0.4, 20.0, 5.0 * direction)
    assert held_on_edge(held(body, SMOOTH, Mode.SLIDING, slower), slower)
