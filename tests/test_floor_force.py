"""The floor's force in sustained contacts: what momentum gains beyond weight and drag, on both engines."""

import numpy as np
import pytest

from cointoss.analytic.contact.automaton import Mode
from cointoss.analytic.toss import Pieces
from cointoss.compare.engines import Engine
from cointoss.models.attitude import rotation_matrix
from cointoss.models.drag import linear_drag
from cointoss.models.records import Ending
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario
from tests.helpers.engines import toss

pytestmark = [
    pytest.mark.parametrize("engine", list(Engine)),
    pytest.mark.usefixtures("without_horizon"),
]

M, G, R = ZLOTY["mass"], 9.81, ZLOTY["radius"]
LEAN = 1.1
ROLLING = {
    "position": [0, 0, R * np.sin(LEAN) + ZLOTY["thickness"] / 2 * np.cos(LEAN)],
    "angles": [0, LEAN, 0],
    "angular_velocity": [0, 40.0, 3.0],
}
UPRIGHT = {
    "position": [0.0, 0.0, 0.0145],
    "angles": [0.0, 1.57, 4.7],
    "angular_velocity": [-2.0, 2.0, -50.0],
}
CASES = {
    "smooth": (
        Mode.SLIDING,
        scenario(air=AIR, floor={"restitution": 0.3, "contact": "smooth"}, release=ROLLING),
    ),
    "sliding": (
        Mode.SLIDING,
        scenario(
            air=AIR,
            floor={"restitution": 0.3, "contact": "coulomb", "friction": 0.1},
            release={**ROLLING, "velocity": [1.0, 0.3, 0.0]},
        ),
    ),
    "sticking": (
        Mode.STICKING,
        scenario(air=AIR, floor={"restitution": 0.3, "contact": "coulomb", "friction": 0.9}, release=ROLLING),
    ),
    "upright": (
        Mode.UPRIGHT,
        scenario(
            coin=IMPERFECT,
            air=AIR,
            floor={"restitution": 0.3, "contact": "smooth"},
            release=UPRIGHT,
        ),
    ),
}
# Of m g. The differences' own error is below 1e-6; MuJoCo's force is the mean of those at the ends of a step,
# and in a step of 0.12 rad the force changes by up to a tenth of itself.
NEAR = {Engine.ANALYTIC: 1e-5, Engine.MUJOCO: 6e-2}
APART = 1e-5
"""Of the times whose difference is taken [s]."""


def from_momentum(tossed, times):
    """Return m dv/dt less weight and drag, from differences of the path, (n, 3)."""
    case, states = tossed.scenario, tossed.sample(times)
    faster, slower = (tossed.sample(times + step).velocity for step in (APART / 2, -APART / 2))
    drag = linear_drag(R, ZLOTY["thickness"], AIR["normal"], AIR["tangential"])
    force = M * ((faster - slower) / APART + [0, 0, G])
    for i, (e, v, w) in enumerate(
        zip(states.quaternion, states.velocity, states.angular_velocity, strict=True)
    ):
        turned = np.array(rotation_matrix(tuple(e)))
        of_B = turned.T @ v - np.cross(w, case.coin.center_of_mass)
        along = np.array([drag.force_tangential, drag.force_tangential, drag.force_normal])
        force[i] += turned @ (along * of_B)
    return force


def times_of(tossed, motion):
    """Return times in the longest sustained contact, of the analytic engine in one motion."""
    if isinstance(tossed.path, Pieces):
        edges, kinds = tossed.path.started.times, tossed.path.started.modes[:-1]
        spans = [(a, b) for a, b, kind in zip(edges[:-1], edges[1:], kinds, strict=True) if kind == motion]
    else:
        spans = list(tossed.contacts)
    longest = max(spans, key=lambda span: span[1] - span[0])
    return np.linspace(*longest, 42)[1:-1]


@pytest.mark.parametrize("kind", CASES)
def test_the_floors_force_is_what_momentum_gains_beyond_weight_and_drag(engine, kind):
    motion, case = CASES[kind]
    tossed = toss(engine, case)
    times = times_of(tossed, motion)
    force, expected = tossed.floor_force(times), from_momentum(tossed, times)
    error = np.linalg.norm(force - expected, axis=1) / (M * G)
    assert np.quantile(error, 0.9) < NEAR[engine]
    assert np.median(np.linalg.norm(force, axis=1)) > 0.1 * M * G
    if case.floor.friction > 0 and engine is Engine.ANALYTIC:
        along = np.hypot(force[:, 0], force[:, 1]) / force[:, 2]
        assert (np.abs(along - case.floor.friction).max() < 1e-6) == (motion == Mode.SLIDING)


def test_in_flight_the_floor_has_no_force(engine):
    tossed = toss(engine, CASES["upright"][1])
    first = min(tossed.impacts.time[0], tossed.contacts[0, 0])
    assert not tossed.floor_force(np.linspace(0, 0.999 * first, 20)).any()


def test_at_the_end_of_a_contact_the_floor_holds_the_coin_still(engine):
    _, case = CASES["smooth"]
    tossed = toss(engine, case)
    start, end = tossed.contacts[-1]
    at_end, before = tossed.floor_force([end, end - 1e-6 * (end - start)])
    assert at_end == pytest.approx(before, abs=1e-2 * M * G)


@pytest.mark.slow_after_first
def test_a_coin_that_has_come_to_lie_flat_has_a_force_that_is_a_number(engine):
    """The analytic engine lays it flat in a contact that takes no time, where no rim point is lowest."""
    resistance = {"rolling_friction": 5e-4, "pivoting_friction": 1e-4}
    floor = {"restitution": 0.5, "contact": "coulomb", "friction": 0.3, **resistance}
    release = {"position": [0, 0, 0.02], "angles": [0, 0.1, 0], "angular_velocity": [0, 0, 5]}
    tossed = toss(engine, scenario(air=AIR, floor=floor, release=release, ending={"test": "lying"}))
    assert tossed.ending is Ending.LYING
    assert np.isfinite(tossed.floor_force([tossed.end_time])).all()


def test_times_outside_a_toss_are_refused(engine):
    tossed = toss(engine, CASES["smooth"][1])
    with pytest.raises(ValueError, match="is outside the toss"):
        tossed.floor_force([tossed.end_time + 1])
