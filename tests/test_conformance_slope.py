"""What both engines must do alike on a slope: closed forms, a symmetry, and tosses within their trust."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.models.certificate import CONTACT_ENERGY, FLIGHT_ENERGY
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_release, scenario
from tests.helpers.engines import toss

G = 9.81
NICKEL = {"mass": 5e-3, "radius": 10.6e-3, "thickness": 1.95e-3}
DELTA = NICKEL["radius"] * np.tan(np.radians(0.54))
ENGINES = pytest.mark.parametrize("engine", list(Engine))


def on_slope(slope, release, *, coin=ZLOTY, air=None, ending=None, **floor):
    floor = {"contact": "smooth", "restitution": 0.6, "slope": slope, **floor}
    return scenario(coin=coin, air=air or {}, floor=floor, release=release, ending=ending or {})


@ENGINES
def test_a_flat_coin_bounces_downhill_in_ever_longer_hops(engine):
    """Its hops are those of a ball under g cos(a), and x = g sin(a) t²/2 throughout."""
    slope, height = 0.4, 1.0
    case = on_slope(slope, {"position": [0.0, 0.0, height + 1e-3]}, ending={"max_impacts": 4})
    found = toss(engine, case).impacts
    down = G * np.cos(slope)
    first = (2 * height / down) ** 0.5
    times = first + 2 * first * np.cumsum([0.0, *0.6 ** np.arange(1, 4)])
    assert found.time == pytest.approx(times, rel=1e-4)
    assert found.position[:, 0] == pytest.approx(G * np.sin(slope) * times**2 / 2, rel=3e-4)
    assert found.velocity_after[:, 0] == pytest.approx(G * np.sin(slope) * times, rel=3e-4)


@ENGINES
@pytest.mark.parametrize("coin", [ZLOTY, IMPERFECT])
def test_a_smooth_slope_in_vacuum_is_a_level_floor_that_accelerates(engine, coin):
    """The same impacts as over a level floor under g cos(a), moved along x by g sin(a) t²/2."""
    slope, release = 0.4, {**draw_release(np.random.default_rng(3)), "position": [0.0, 0.0, 0.1]}
    ending = {"max_impacts": 4}
    sloping = toss(engine, on_slope(slope, release, coin=coin, ending=ending)).impacts
    level = on_slope(0.0, release, coin=coin, ending=ending).replace("gravity", G * np.cos(slope))
    other = toss(engine, level).impacts
    assert sloping.time == pytest.approx(other.time, rel=1e-5)
    moved = G * np.sin(slope) * other.time**2 / 2
    assert sloping.position[:, 0] - other.position[:, 0] == pytest.approx(moved, rel=1e-4, abs=1e-7)
    size = np.linalg.norm(other.impulse, axis=1)
    assert np.linalg.norm(sloping.impulse - other.impulse, axis=1) == pytest.approx(0, abs=1e-3 * size.max())


@pytest.mark.parametrize(("contact", "friction"), [("smooth", 0.0), ("coulomb", 0.3)])
@pytest.mark.parametrize("air", [{}, AIR])
@pytest.mark.parametrize("coin", [ZLOTY, IMPERFECT])
def test_engines_agree_within_their_trust(contact, friction, air, coin):
    release = {**draw_release(np.random.default_rng(5)), "position": [0.0, 0.0, 0.15]}
    case = on_slope(
        0.3, release, coin=coin, air=air, contact=contact, friction=friction, ending={"max_impacts": 6}
    )
    here, there = toss(Engine.ANALYTIC, case), toss(Engine.MUJOCO, case)
    n = min(here.trusted_impacts, there.trusted_impacts)
    assert n >= 1
    assert list(there.impacts.face[:n]) == list(here.impacts.face[:n])
    assert there.impacts.time[:n] == pytest.approx(here.impacts.time[:n], rel=2e-3)
    assert there.impacts.position[:n, 0] == pytest.approx(here.impacts.position[:n, 0], rel=5e-3)


@ENGINES
@pytest.mark.parametrize("air", [{}, AIR])
def test_energy_changes_by_the_work_of_the_slope_and_the_air_alone(engine, air):
    release = {**draw_release(np.random.default_rng(6)), "position": [0.0, 0.0, 0.15]}
    case = on_slope(
        0.3, release, coin=IMPERFECT, air=air, contact="coulomb", friction=0.3, ending={"max_time": 1.0}
    )
    measured = {
        line.name: line.value for line in toss(engine, case).certificate if not isinstance(line.value, str)
    }
    # MuJoCo's steps of flight and of contact have errors of their own.
    flights, contacts = {Engine.ANALYTIC: (1e-9, 1e-7), Engine.MUJOCO: (1e-4, 2e-2)}[engine]
    assert measured[FLIGHT_ENERGY] < flights
    assert measured.get(CONTACT_ENERGY, 0.0) < contacts


def nickel_on_edge(degrees, **ending):
    release = {"position": [0.0, 0.0, NICKEL["radius"]], "angles": [0.0, np.pi / 2, 0.0]}
    floor = {"contact": "coulomb", "friction": 0.3, "rolling_friction": DELTA}
    return on_slope(np.radians(degrees), release, coin=NICKEL, ending=ending, **floor)


@ENGINES
def test_a_nickel_on_its_edge_is_held_up_to_the_angle_of_its_rolling_friction_and_rolls_above(engine):
    """Above it (1 + J/(m r²)) dv/dt = g (sin(a) - δ/r cos(a))."""
    held = toss(engine, nickel_on_edge(0.5))
    assert (held.outcome, held.ending) == (Outcome.EDGE, Ending.AT_REST)
    for degrees in (0.6, 5.0):
        angle = np.radians(degrees)
        rolling = toss(engine, nickel_on_edge(degrees, max_time=0.5))
        assert (rolling.outcome, rolling.ending) == (Outcome.EDGE, Ending.ROLLING)
        gained = G * (np.sin(angle) - DELTA / NICKEL["radius"] * np.cos(angle)) / 1.5
        # At first resistance is less, while the coin turns slower than 1e-3 √(g/r).
        speeds = rolling.sample(np.array([0.25, 0.5])).velocity[:, 0]
        assert np.diff(speeds) / 0.25 == pytest.approx(
            [gained], rel=2e-3 if engine == Engine.ANALYTIC else 2e-2
        )


@ENGINES
@pytest.mark.parametrize(("mu", "stops"), [(0.2, False), (0.5, True)])
def test_a_coin_that_lies_slides_downhill_or_stops(engine, mu, stops):
    """v = v_0 + g (sin(a) - μ cos(a)) t."""
    slope, speed = 0.3, 0.3
    release = {"position": [0.0, 0.0, 1e-3], "velocity": [speed, 0.0, 0.0]}
    gained = G * (np.sin(slope) - mu * np.cos(slope))
    until = 0.2 if not stops else 1.5 * speed / -gained
    case = on_slope(slope, release, contact="coulomb", friction=mu, restitution=0.0, ending={"until": until})
    found = toss(engine, case)
    assert (found.outcome, found.ending) == (Outcome.HEADS, Ending.LYING)
    end = found.sample(np.array([until]))
    travelled = speed**2 / (2 * -gained) if stops else speed * until + gained * until**2 / 2
    assert end.position[0, 0] == pytest.approx(travelled, rel=5e-3)
    assert end.velocity[0, 0] == pytest.approx(0.0 if stops else speed + gained * until, rel=5e-3, abs=2e-3)
