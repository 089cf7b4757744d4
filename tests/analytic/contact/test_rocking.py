"""A coin that rocks on its edge: it is said to stand only where its rocking cannot lift it over."""

import numpy as np
import pytest

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.contact import lower_rim_of
from cointoss.analytic.contact.edge.restoring import restoring_acceleration
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


def rocking(body, friction, mode, phase, turn, roll, rate, lean):
    """Give a coin that rocks on its edge while it turns and rolls [rad/s], with its contact.

    Args:
        body: the coin.
        friction: the floor's.
        mode: of contact.
        phase: of its roll.
        turn: about the vertical.
        roll: about its normal.
        rate: of n_z, in parts of the steady lean times √(g/r).
        lean: -n_z, in parts of the steady lean.
    """
    y, most = upright_coin(body, phase, turn, roll), steady_lean(body)
    up = rotation_matrix(tuple(y[6:10]))[2]
    y[10:12] += rate * most * (G / R_COIN) ** 0.5 * np.array([-up[1], up[0]])
    upright.tilt(y, lean * most)
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
        mode = Mode.SLIDING if rules.law == ContactLaw.SMOOTH else Mode.STICKING
        turn, roll = rng.choice([(1, 3), (12, 2.5), (6, 12)])
        motion = rng.uniform(0, 6), rng.normal(0, turn), rng.normal(0, roll)
        rocks = rng.uniform(-0.8, 0.8), rng.uniform(-0.2, 0.2)
        contact, y = rocking(body, friction_in_contact(rules), mode, *motion, *rocks)
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


LOW = (1.6e-3, 1.8e-3, 0.0)


@pytest.mark.parametrize(
    ("thickness", "center", "chi", "motion", "ends"),
    [
        # It rolls to and fro near where C is lowest, through few phases, and fastest between them.
        (6e-4, LOW, 0.5, (4.07, 9.2, 3.0, 1.6, 0.0), {Outcome.EDGE}),
        (8e-4, LOW, 0.5, (4.07, 13.0, 3.0, 1.6, 0.0), {Outcome.TAILS}),
        # At such a rate it is refused in whichever phases it is tried.
        (6e-4, LOW, 0.5, (4.07, 9.2, 3.0, 2.2, 0.0), {Outcome.TAILS}),
        (8e-4, LOW, 0.5, (4.07, 13.0, 3.0, 2.2, 0.0), {Outcome.TAILS}),
        # Rolling while it turns, it is held on one rim by more than four times as much as on the other.
        (1e-3, (0.0, 0.0, 0.0), 0.9, (0.4, 2.5, -15.4, 0.0, -0.35), {Outcome.HEADS, Outcome.TAILS}),
    ],
)
def test_a_coin_that_is_hardly_held_in_a_phase_or_on_a_side_is_not_said_to_stand(
    thickness, center, chi, motion, ends
):
    """Whether or not it comes to stand in the end; `motion` is that of `rocking`."""
    coin = {"thickness": thickness, "center_of_mass": center}
    case = scenario(coin=coin, floor={"restitution": chi}, air=AIR)
    contact, y = rocking(case.body, SMOOTH, Mode.SLIDING, *motion)
    assert not rocks_on_edge(contact, y)
    assert run(case.body, case.rules, y).outcome in ends


def test_the_lowest_phase_is_where_the_center_is_below():
    body = scenario(coin=IMPERFECT).body
    for phase in (0.3, 2.0, 5.0):
        y, rolled = upright_coin(body, phase, 3.0, 20.0), np.empty(13)
        roll_by(held(body, SMOOTH, Mode.SLIDING, y), False, y, to_lowest(body, y) / 2, rolled)
        center = np.array(rotation_matrix(tuple(rolled[6:10]))) @ np.array(body.center)
        assert center[2] == pytest.approx(-np.hypot(*body.center[:2]), rel=1e-9)


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
