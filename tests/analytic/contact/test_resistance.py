"""Resistance to rolling and pivoting: closed forms, rest, and Euler's disk; its power is in test_power.py."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.contact.resistance import FloorFriction, moment_per_force
from cointoss.analytic.contact.rest import rests
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles
from cointoss.models.certificate import CONTACT_ENERGY
from cointoss.models.records import Ending, Outcome
from tests.helpers.contacts import follow_for, held, put_on_floor, set_upright
from tests.helpers.corpus import draw_toss
from tests.helpers.draws import THIN, ZLOTY, scenario

pytestmark = pytest.mark.usefixtures("without_horizon")

G, R, M = 9.81, ZLOTY["radius"], ZLOTY["mass"]
UNIT = (G / R) ** 0.5


def test_a_disc_that_pivots_upright_is_slowed_by_its_resistance():
    """J_ξ dω_z/dt = -p m g."""
    p, spin, body = 1e-4, 80.0, scenario(coin=THIN).body
    slowing = p * M * G / body.inertia[1][1]
    time = 0.9 * spin / slowing
    states, times = follow_for(
        body, FloorFriction(50.0, 0.0, p), Mode.STICKING, set_upright(spin=(0.0, spin, 0.0)), time
    )
    assert states[:, 11] == pytest.approx(spin - slowing * times, rel=1e-9)


def test_slow_motion_is_resisted_in_proportion_to_it():
    body, friction = scenario().body, FloorFriction(0.0, 2e-4, 3e-4)
    slow = SLOW * UNIT
    fast = moment_per_force(body, friction, (0.0, 0.0, 1.0), (3.0, -4.0, 5.0))
    assert fast == pytest.approx((-1.2e-4, 1.6e-4, -3e-4), rel=1e-14)
    half = moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, slow / 2, -slow / 4))
    assert half == pytest.approx((0.0, -1e-4, 0.75e-4), rel=1e-14)
    assert moment_per_force(body, friction, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("lean", [0.5, -0.9, 1.2])
def test_a_coin_at_rest_stays_while_its_mass_centre_is_within_delta_of_the_contact(lean):
    """The weight's moment is m g a, a the horizontal distance of C from A."""
    delta, body = 1e-3, scenario(coin=THIN).body
    y = set_upright()
    y[6:10] = quaternion_from_angles((0.0, np.pi / 2 + np.arcsin(lean * delta / R), 0.0))
    put_on_floor(body, FloorFriction(0.3), Mode.STICKING, y)
    for mu in (0.0, 0.3):
        mode = Mode.STICKING if mu else Mode.SLIDING
        assert rests(held(body, FloorFriction(mu, delta, 0.0), mode, y), y) == (abs(lean) < 1)
    assert not rests(held(body, FloorFriction(0.3, 0.0, delta), Mode.STICKING, y), y)
    y[10] = 0.1 * UNIT
    assert not rests(held(body, FloorFriction(0.3, delta, 0.0), Mode.STICKING, y), y)


@pytest.mark.parametrize("seed", range(8))
def test_contacts_of_random_tosses_never_gain_energy(seed):
    rng = np.random.default_rng((17, seed))
    case = draw_toss(rng, imperfect=seed % 2 == 1)
    law = ("smooth", "coulomb", "perfectly_rough")[seed % 3]
    case = case.replace(
        "floor.contact",
        law,
        "floor.restitution_kind",
        "kinematic",
        "floor.restitution",
        0.4,
        "floor.rolling_friction",
        rng.uniform(1e-5, 1e-3),
        "floor.pivoting_friction",
        rng.uniform(1e-5, 1e-3),
    )
    tossed = analytic.toss(case)
    gained = [float(setting.value) for setting in tossed.certificate if setting.name == CONTACT_ENERGY]
    assert max(gained, default=0.0) < 1e-7
    assert len(tossed.contacts) > 0 or tossed.ending in (Ending.SETTLED, Ending.PAPER)
    assert tossed.outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)
