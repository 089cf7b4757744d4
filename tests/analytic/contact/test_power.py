"""What the floor takes of a coin in contact: in every mode, under every resistance, level and on a slope."""

import numpy as np
import pytest

from cointoss.analytic.contact import upright
from cointoss.analytic.contact.automaton import Mode, flow
from cointoss.analytic.contact.contact import lower_rim_of
from cointoss.analytic.contact.resistance import FloorFriction
from cointoss.analytic.contact.rim_contact import both_rims, rim_contact
from cointoss.analytic.contact.sampling import floor_force
from cointoss.analytic.numerics.tolerances import SLOW
from cointoss.models.attitude import quaternion_from_angles, rotation_matrix
from cointoss.models.contour import Contour, leaning
from tests.helpers.contacts import assert_lowest_point_stays, held, put_on_floor, tilts_of
from tests.helpers.draws import draw_coin, scenario

ON_ONE_RIM = (Mode.SLIDING, Mode.INCIPIENT_SLIP, Mode.STICKING)
LOSSES = (Contour(), Contour(2e-5), Contour(0.0, 3e-7), Contour(0.0, 0.0, 2e-5), Contour(1e-5, 1e-7, 2e-5))


def contacts(seed, slope, modes):
    """Yield coins in contact under each of `LOSSES`: body, friction, mode and state."""
    rng = np.random.default_rng(seed)
    coin = draw_coin(rng) | ({"thickness": 2e-3} if Mode.UPRIGHT in modes else {})
    body = scenario(coin=coin, floor={"contact": "smooth", "slope": slope}).body
    for contour in LOSSES:
        mu, rolling, pivoting = rng.uniform((0.1, 1e-5, 1e-5), (0.9, 4e-3, 4e-3))
        friction = FloorFriction(mu, rolling, pivoting, contour)
        for mode in modes:
            tilt = np.pi / 2 if mode == Mode.UPRIGHT else rng.uniform(0.2, 1.4)
            attitude = quaternion_from_angles((rng.uniform(0, 6), tilt, rng.uniform(0, 6)))
            y = np.array([0, 0, 0, *rng.uniform(-0.3, 0.3, 3), *attitude, *rng.uniform(-20, 20, 3)])
            put_on_floor(body, friction, mode, y)
            yield body, friction, mode, y


def changes(body, friction, mode, y):
    """Return the rates of a state, and the floor's force on the coin."""
    dy, contact = np.empty(13), held(body, friction, mode, y)
    flow(contact, y, dy)
    return dy, np.array(floor_force(contact, y))


def moment_of_resistance(body, friction, y, N):
    """Return -N (δ ω_h/|ω_h| + p sgn ω_z ẑ) - P/(φ' sin θ) ĝ, φ' sin θ = ω · ĝ.

    P is N (c |φ'| + c_v φ'²) + (π/4) η r³ φ'²/sin θ; c grows in proportion to slow ω · ĝ.
    """
    R, contour, sine = np.array(rotation_matrix(tuple(y[6:10]))), friction.contour, np.sin(tilts_of(y))
    turn, lean = R @ y[10:13], np.array(leaning(tuple(R[2])))
    along, slow = lean @ y[10:13], SLOW * (body.gravity / body.radius) ** 0.5
    on_rim = N * (contour.friction * np.clip(along / slow, -1, 1) + contour.viscosity * along / sine)
    on_rim += np.pi / 4 * contour.air * body.radius**3 * along / sine**2
    rolling = friction.rolling * turn[:2] / np.hypot(*turn[:2])
    return N * np.array([*-rolling, -friction.pivoting * np.sign(turn[2])]) - on_rim / sine * (R @ lean)


@pytest.mark.parametrize("slope", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(6))
def test_the_lowest_point_stays_on_the_floor_and_stays_there_where_friction_holds_it(seed, slope):
    for contact in contacts(seed, slope, ON_ONE_RIM):
        assert_lowest_point_stays(*contact)


@pytest.mark.parametrize("slope", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(6))
def test_momenta_change_by_the_floors_force_and_its_moments_of_the_same_instant(seed, slope):
    """M dv/dt = F + m g and J dω/dt + ω × J ω = a × F + the moment of resistance."""
    for body, friction, mode, y in contacts(seed, slope, ON_ONE_RIM):
        dy, F = changes(body, friction, mode, y)
        A, J, w = rim_contact(body, y, lower_rim_of(y)), np.array(body.inertia), y[10:13]
        assert body.mass * (dy[3:6] - [body.downhill, 0, -body.gravity]) == pytest.approx(F, abs=1e-13)
        moment = np.array(A.R) @ (J @ dy[10:13] + np.cross(w, J @ w)) - np.cross(A.arm, F)
        assert moment == pytest.approx(moment_of_resistance(body, friction, y, F[2]), abs=1e-13)


@pytest.mark.parametrize("slope", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(6))
def test_energy_is_lost_at_the_rate_of_the_law(seed, slope):
    """DE/dt is the power of weight, slip and resistance; upright each rim slips under its own load."""
    for body, friction, mode, y in contacts(seed, slope, (*ON_ONE_RIM, Mode.UPRIGHT)):
        dy, F = changes(body, friction, mode, y)
        turn = np.array(rotation_matrix(tuple(y[6:10]))) @ y[10:13]
        gained = body.mass * y[3:6] @ dy[3:6] + y[10:13] @ np.array(body.inertia) @ dy[10:13]
        given = body.mass * (body.downhill * y[3] - body.gravity * y[5])
        given += moment_of_resistance(body, friction, y, F[2]) @ turn
        if mode == Mode.UPRIGHT:
            loads = upright.rim_forces(body, friction, y)
            slips = [np.hypot(*A.velocity[:2]) for A in both_rims(body, friction, y)]
            slow = np.minimum(np.array(slips) / (SLOW * (body.gravity * body.radius) ** 0.5), 1.0)
            given -= friction.sliding * np.sum(np.array(loads) * slips * slow)
        else:
            given += F @ np.array(rim_contact(body, y, lower_rim_of(y)).velocity)
        assert gained == pytest.approx(given, abs=1e-12)
