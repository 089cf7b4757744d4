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
from cointoss.models.contour import Contour
from tests.helpers.contacts import held, put_on_floor, tilts_of
from tests.helpers.draws import draw_coin, scenario

MODES = (Mode.SLIDING, Mode.INCIPIENT_SLIP, Mode.STICKING, Mode.UPRIGHT)
LOSSES = (
    (1.0, Contour()),
    (1.0, Contour(2e-5)),
    (1.0, Contour(0.0, 3e-7)),
    (1.0, Contour(0.0, 0.0, 2e-5)),
    (1.0, Contour(1e-5, 1e-7, 2e-5)),
    (0.0, Contour()),
)
"""Parts of the friction that is drawn, 0 of a smooth floor, and what is lost as A runs round the rim."""


def contacts(seed, slope):
    """Yield coins in contact under each of `LOSSES` in each of `MODES`: body, friction, mode and state."""
    rng = np.random.default_rng(seed)
    coin = draw_coin(rng) | {"thickness": 2e-3}
    body = scenario(coin=coin, floor={"contact": "smooth", "slope": slope}).body
    for part, contour in LOSSES:
        mu, rolling, pivoting = part * rng.uniform((0.1, 1e-5, 1e-5), (0.9, 4e-3, 4e-3))
        friction = FloorFriction(mu, rolling, pivoting, contour)
        for mode in MODES:
            tilt = np.pi / 2 if mode == Mode.UPRIGHT else rng.uniform(0.2, 1.4)
            attitude = quaternion_from_angles((rng.uniform(0, 6), tilt, rng.uniform(0, 6)))
            y = np.array([0, 0, 0, *rng.uniform(-0.3, 0.3, 3), *attitude, *rng.uniform(-20, 20, 3)])
            put_on_floor(body, friction, mode, y)
            yield body, friction, mode, y


def moment_of_resistance(body, friction, y, N):
    """Return -N (δ ω_h/|ω_h| + p sgn ω_z ẑ) - P/(φ' sin θ) ĝ, φ' sin θ = ω · ĝ.

    P is N (c |φ'| + c_v φ'²) + (π/4) η r³ φ'²/sin θ; c grows in proportion to slow ω · ĝ. The normal leans
    along ĝ: the horizontal part of ζ, seen from the coin.
    """
    R, contour, sine = np.array(rotation_matrix(tuple(y[6:10]))), friction.contour, np.sin(tilts_of(y))
    turn, lean = R @ y[10:13], (np.eye(3)[2] - R[2, 2] * R[2]) / sine
    along, slow = lean @ y[10:13], SLOW * (body.gravity / body.radius) ** 0.5
    on_rim = N * (contour.friction * np.clip(along / slow, -1, 1) + contour.viscosity * along / sine)
    on_rim += np.pi / 4 * contour.air * body.radius**3 * along / sine**2
    rolling = friction.rolling * turn[:2] / np.hypot(*turn[:2])
    return N * np.array([*-rolling, -friction.pivoting * np.sign(turn[2])]) - on_rim / sine * (R @ lean)


@pytest.mark.parametrize("slope", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(6))
def test_the_lowest_point_stays_on_the_floor_and_stays_there_where_friction_holds_it(seed, slope):
    """It is there without that velocity, and D v_A/dt = 0, by differences; else their vertical parts."""
    for body, friction, mode, y in contacts(seed, slope):
        dy, dt, part = np.empty(13), 1e-6, slice(0 if mode == Mode.STICKING else 2, 3)
        flow(held(body, friction, mode, y), y, dy)
        for rim in (-1.0, 1.0) if mode == Mode.UPRIGHT else (lower_rim_of(y),):
            A = rim_contact(body, y, rim)
            assert np.abs([y[2] + A.arm[2], *A.velocity[part]]).max() < 1e-15
            v, v_0 = (np.array(rim_contact(body, y + side * dt * dy, rim).velocity) for side in (1, -1))
            assert np.abs(((v - v_0) / (2 * dt))[part]).max() <= 1e-6 * np.linalg.norm(dy)


def rims(body, friction, mode, y):
    """Return the rim points in contact, and the floor's force on each.

    Where they do not stick or begin to slip each bears its load, with friction against its own slip, less
    where that is slow.
    """
    F = np.array(floor_force(held(body, friction, mode, y), y))
    points, loads = [rim_contact(body, y, lower_rim_of(y))], [F[2]]
    if mode in (Mode.STICKING, Mode.INCIPIENT_SLIP):
        return [(points[0], F)]
    if mode == Mode.UPRIGHT:
        points, loads = both_rims(body, friction, y), upright.rim_forces(body, friction, y)
    slow = SLOW * (body.gravity * body.radius) ** 0.5
    slips = [np.array([*A.velocity[:2], 0]) / max(np.hypot(*A.velocity[:2]), slow) for A in points]
    forces = [N * ([0, 0, 1] - friction.sliding * slip) for N, slip in zip(loads, slips, strict=True)]
    assert sum(forces) == pytest.approx(F, abs=1e-13)
    return list(zip(points, forces, strict=True))


@pytest.mark.parametrize("slope", [0.0, 0.5])
@pytest.mark.parametrize("seed", range(6))
def test_momenta_and_energy_change_by_the_floors_forces_of_the_same_instant(seed, slope):
    """M dv/dt = F + m g, J dω/dt + ω × J ω = a × F + the moment of resistance, and DE/dt is their power."""
    for body, friction, mode, y in contacts(seed, slope):
        dy, points = np.empty(13), rims(body, friction, mode, y)
        flow(held(body, friction, mode, y), y, dy)
        R, J, w = np.array(rotation_matrix(tuple(y[6:10]))), np.array(body.inertia), y[10:13]
        F = np.sum([F for _, F in points], axis=0)
        weight = body.mass * np.array([body.downhill, 0, -body.gravity])
        resistance = moment_of_resistance(body, friction, y, F[2])
        assert body.mass * dy[3:6] - weight == pytest.approx(F, abs=1e-13)
        moment = R @ (J @ dy[10:13] + np.cross(w, J @ w)) - sum(np.cross(A.arm, F) for A, F in points)
        assert moment == pytest.approx(resistance, abs=1e-13)
        gained = body.mass * y[3:6] @ dy[3:6] + w @ J @ dy[10:13]
        given = weight @ y[3:6] + resistance @ (R @ w) + sum(F @ np.array(A.velocity) for A, F in points)
        assert gained == pytest.approx(given, abs=1e-12)
