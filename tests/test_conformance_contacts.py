"""What both engines must do alike where a coin stays on the floor: slide, stick, roll, stand upright."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss.compare.engines import Engine
from cointoss.models.attitude import rotation_matrix
from cointoss.models.laws import ContactLaw
from cointoss.models.records import Ending, Outcome
from tests.helpers import engines
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, scenario
from tests.helpers.states import energies
from tests.helpers.symmetries import SYMMETRIES

pytestmark = pytest.mark.usefixtures("without_horizon")

R, H = ZLOTY["radius"], ZLOTY["thickness"]
BALANCED = ZLOTY
LOW = {
    "position": [0.0, 0.0, 0.05],
    "velocity": [0.1, -0.2, 0.0],
    "quaternion": list(scenario(release={"angles": [0.4, 0.6, 0.1]}).release.attitude),
    "angular_velocity": [5.0, 10.0, -3.0],
}
NEARLY_UPRIGHT = {
    "position": [0.0, 0.0, 1.35e-2],
    "velocity": [0.0, 0.0, 0.0],
    "quaternion": list(scenario(release={"angles": [0, np.pi / 2 - 0.03, 0.3]}).release.attitude),
    "angular_velocity": [15 * np.sin(0.3), 15 * np.cos(0.3), 0.0],
}
CASES = {
    "slides on a smooth floor": (IMPERFECT, "smooth", LOW),
    "slides on a rough floor": (IMPERFECT, "coulomb", LOW),
    "sticks after sliding": (BALANCED, "coulomb", LOW),
    "rolls on a perfectly rough floor": (IMPERFECT, "perfectly_rough", LOW),
    "upright on a smooth floor": (BALANCED, "smooth", NEARLY_UPRIGHT),
    "upright on a rough floor": (BALANCED, "coulomb", NEARLY_UPRIGHT),
}
BOTH = [pytest.param(engine, name, id=f"{engine}-{name}") for engine in Engine for name in CASES]


def described(name, release=None):
    coin, law, at_release = CASES[name]
    floor = {"restitution": 0.5, "contact": law, "friction": 0.3}
    return scenario(coin=coin, air=AIR, floor=floor, release=release or at_release)


@cache
def toss(engine, name):
    return engines.toss(engine, described(name))


def lowest_points(case, states):
    """Return height and velocity of the coin's lowest rim point, from its attitude alone, (n,) and (n, 3)."""
    turn = Rotation.from_quat(states.quaternion, scalar_first=True).as_matrix()
    up = turn[:, 2]
    across = np.hypot(up[:, 0], up[:, 1])
    point = np.column_stack([-R * up[:, :2] / across[:, None], -H / 2 * np.sign(up[:, 2])])
    arm = np.einsum("nij,nj->ni", turn, point - case.coin.center_of_mass)
    spin = np.einsum("nij,nj->ni", turn, states.angular_velocity)
    return states.position[:, 2] + arm[:, 2], states.velocity + np.cross(spin, arm)


def longest_contact(tossed, inside=0.0):
    """Return times spread over the longest contact, without the part `inside` of it at either end."""
    start, end = tossed.contacts[np.argmax(np.diff(tossed.contacts, axis=1))]
    assert end - start > 0.02, "the coin should stay on the floor"
    return np.linspace(start + inside * (end - start), end - inside * (end - start), 400)


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_contacts_and_impacts_follow_one_another(engine, name):
    tossed = toss(engine, name)
    impacts, (starts, ends) = tossed.impacts.time, tossed.contacts.T
    assert len(impacts) >= 2
    assert len(starts) >= 1
    assert np.all(np.diff(impacts) > 0)
    assert np.all(starts < ends)
    assert np.all(starts[1:] >= ends[:-1])
    assert 0 < impacts[0] < starts[0]
    assert max(impacts[-1], ends[-1]) <= tossed.end_time
    during = (impacts[:, None] > starts) & (impacts[:, None] < ends)
    assert not during.any()


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_a_path_is_continuous_through_impacts_and_contacts(engine, name):
    tossed = toss(engine, name)
    events = np.unique([*tossed.impacts.time, *tossed.contacts.ravel()])
    events = events[(events > 0) & (events < tossed.end_time)][:200]
    assert len(events) >= 3
    moment = 1e-9
    before, after = (
        tossed.sample(events - moment),
        tossed.sample(np.minimum(events + moment, tossed.end_time)),
    )
    # Nothing moves faster than 2 m/s or turns faster than 500 rad/s; MuJoCo's steps join to rounding.
    assert np.abs(after.position - before.position).max() < 2 * moment * 2 + 1e-12
    overlap = np.abs((after.quaternion * before.quaternion).sum(1))
    assert np.sqrt(2 * np.maximum(1 - overlap, 0)).max() < 2 * moment * 500 + 3e-8
    dt = 1e-4
    times = longest_contact(tossed)
    states = tossed.sample(np.arange(times[0], min(times[-1], times[0] + 0.3), dt))
    mean = (states.velocity[1:] + states.velocity[:-1]) / 2
    strayed = np.abs(np.diff(states.position, axis=0) - mean * dt)
    # MuJoCo's steps put the point back onto the floor. Measured: 4e-4 and 0.02 m/s.
    assert strayed.max() < {Engine.ANALYTIC: 1e-3, Engine.MUJOCO: 0.05}[engine] * dt


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_in_a_contact_the_lowest_point_is_on_the_floor(engine, name):
    tossed = toss(engine, name)
    height, _ = lowest_points(described(name), tossed.sample(longest_contact(tossed, inside=0.05)))
    # Rounding, and how well MuJoCo's steps hold the point: 3e-3 where the coin rolls fast.
    assert np.abs(height).max() < {Engine.ANALYTIC: 1e-12, Engine.MUJOCO: 1e-2}[engine] * R


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize(
    ("name", "least", "most"),
    [
        ("slides on a smooth floor", 0.22, 0.25),
        ("slides on a rough floor", 0.025, 0.045),
        ("sticks after sliding", 0.0, 0.003),
        ("rolls on a perfectly rough floor", 0.0, 0.003),
    ],
)
def test_in_a_contact_slip_is_what_the_floor_leaves(engine, name, least, most):
    """The median of its speed [m/s]; where it sticks MuJoCo's point creeps by 1e-3 m/s."""
    tossed = toss(engine, name)
    _, velocity = lowest_points(described(name), tossed.sample(longest_contact(tossed, inside=0.05)))
    assert least <= np.median(np.hypot(velocity[:, 0], velocity[:, 1])) < most


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_energy_never_grows(engine, name):
    """On a smooth floor, and on a rough one while χ is below √5/3: only above do stops of slip add energy."""
    tossed, case = toss(engine, name), described(name)
    energy = energies(case, tossed.sample(np.linspace(0, tossed.end_time, 2001)))
    gain = np.max(energy - np.minimum.accumulate(energy)) / energy[0]
    # MuJoCo's steps in a contact change about 1e-3 of the energy in a second.
    assert gain < {Engine.ANALYTIC: 1e-9, Engine.MUJOCO: 2e-3}[engine]
    assert energy[-1] < 0.95 * energy[0]
    assert np.all(tossed.impacts.energy_change < 0)


@pytest.mark.parametrize(("engine", "name"), BOTH)
def test_a_toss_that_stays_on_the_floor_is_decided_there(engine, name):
    tossed = toss(engine, name)
    if "upright" in name:
        assert tossed.outcome == Outcome.EDGE
    else:
        up = tossed.sample(tossed.end_time).normal[0, 2]
        assert tossed.outcome == (Outcome.HEADS if up > 0 else Outcome.TAILS)
    assert tossed.ending in (Ending.SETTLED, Ending.PAPER, Ending.LYING, Ending.STANDING)
    assert described(name).floor.contact == ContactLaw[CASES[name][1].upper()]


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize(
    ("name", "symmetry"),
    [
        ("slides on a smooth floor", "a turn about the vertical"),
        *(("slides on a rough floor", name) for name in SYMMETRIES if not SYMMETRIES[name].balanced),
        *(("sticks after sliding", name) for name in SYMMETRIES if SYMMETRIES[name].balanced),
        *(("upright on a smooth floor", name) for name in SYMMETRIES),
    ],
)
def test_a_symmetry_of_the_release_is_one_of_the_whole_toss(engine, name, symmetry):
    """Its impacts until the coin stays on the floor, and how it ends; a rattle's later impacts are many."""
    change, here = SYMMETRIES[symmetry], toss(engine, name)
    there = engines.toss(engine, described(name, change.release(CASES[name][2])))
    n = min(6, int(np.sum(here.impacts.time < here.contacts[0, 0])))
    assert n >= 3
    # Rounding moves MuJoCo's first step in a contact, and six impacts multiply it: at most 7e-8 s, 2e-6.
    late, part = {Engine.ANALYTIC: (1e-10, 1e-9), Engine.MUJOCO: (5e-7, 2e-5)}[engine]
    assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], abs=late)
    expected = change.vector(here.impacts.impulse[:n])
    assert np.abs(there.impacts.impulse[:n] - expected).max() < part * np.abs(expected).max()
    assert there.impacts.position[:n] == pytest.approx(
        change.vector(here.impacts.position[:n]) + change.shift, abs=2 * late
    )
    assert there.impacts.point[:n] == pytest.approx(here.impacts.point[:n] @ change.body.T, abs=part * R)
    swap = str.maketrans("HT", "TH") if change.swaps_faces else {}
    assert there.sequence[:n] == here.sequence[:n].translate(swap)
    assert there.contacts[0, 0] == pytest.approx(here.contacts[0, 0], abs=late)
    assert there.ending == here.ending
    swapped = {Outcome.HEADS: Outcome.TAILS, Outcome.TAILS: Outcome.HEADS} if change.swaps_faces else {}
    assert there.outcome == swapped.get(here.outcome, here.outcome)
    # An ending is noticed at the end of a step.
    assert there.end_time == pytest.approx(here.end_time, abs=0.01)


@pytest.mark.parametrize("engine", list(Engine))
@pytest.mark.parametrize(("law", "friction"), [("smooth", 0.0), ("coulomb", 0.3)])
@pytest.mark.parametrize("restitution", [0.0, 0.8])
def test_a_release_in_contact_begins_in_contact(engine, law, friction, restitution):
    """On its rim, at rest, the coin tips at once: nothing bounces, and the floor holds it from the start."""
    up = rotation_matrix(scenario(release={"angles": [0, 0.3, 0]}).release.attitude)[2]
    height = H / 2 * up[2] + R * np.hypot(up[0], up[1])
    case = scenario(
        coin=BALANCED,
        floor={"restitution": restitution, "contact": law, "friction": friction},
        release={"position": [0, 0, height], "angles": [0, 0.3, 0]},
        ending={"test": "lying", "max_time": 0.02},
    )
    tossed = engines.toss(engine, case)
    assert len(tossed.impacts) == 0
    assert tossed.contacts.shape == (1, 2)
    assert tossed.contacts[0] == pytest.approx([0.0, 0.02], abs=1e-6)
    held = tossed.floor_force([1e-4, 0.01])[:, 2]
    assert np.all((held > 0) & (held < 2 * case.coin.mass * case.gravity))
    states = tossed.sample([0.0, 0.01])
    points = states.lowest_points(case)
    assert np.abs(points[:, 2]).max() < 4e-4 * R
    assert states.normal[1, 2] > states.normal[0, 2] + 1e-5
