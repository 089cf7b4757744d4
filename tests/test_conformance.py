"""What both engines must do alike: one suite, run on each, and one against the other."""

import numpy as np
import pytest

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.trajectories import attitude_angle, distance
from cointoss.models.parts import Air
from cointoss.models.reading import load
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import AIR, IMPERFECT, PAPER_OFFSET, THIN, ZLOTY, draw_coin, draw_release, scenario
from tests.helpers.engines import toss

pytestmark = [
    pytest.mark.parametrize("engine", list(Engine)),
    pytest.mark.usefixtures("without_horizon"),
]

TUMBLING = {
    "position": [0.0, 0.0, 0.3],
    "velocity": [0.1, -0.2, 0.3],
    "angles": [0.4, 0.6, 0.1],
    "angular_velocity": [20.0, 35.0, -10.0],
}
FEW = {"max_impacts": 2}


def test_momentum_and_restitution_hold_at_every_impact(engine):
    tossed = toss(engine, scenario(coin=IMPERFECT, release=TUMBLING, ending={"max_impacts": 5}))
    impacts, m = tossed.impacts, 2e-3
    assert len(impacts) == 5
    gained = m * (impacts.velocity_after - impacts.velocity_before)
    # MuJoCo's contact lasts a microsecond, in which weight takes 1e-8 N s.
    assert gained == pytest.approx(impacts.impulse, abs=3e-8)
    ratio = -impacts.contact_velocity_after[:, 2] / impacts.contact_velocity_before[:, 2]
    assert ratio == pytest.approx(np.full(len(impacts), 0.8), abs=2e-3)


def test_samples_meet_the_impacts(engine):
    tossed = toss(engine, scenario(coin=IMPERFECT, air=AIR, release=TUMBLING, ending={"max_impacts": 3}))
    states = tossed.sample(tossed.impacts.time)
    assert states.position == pytest.approx(tossed.impacts.position, abs=1e-12)
    at_release = tossed.sample([0.0])
    assert at_release.position[0] == pytest.approx(TUMBLING["position"], abs=1e-16)
    assert at_release.angular_velocity[0] == pytest.approx(TUMBLING["angular_velocity"], rel=1e-15)
    mixed = tossed.sample([0.1, 0.0, 0.05])
    assert mixed.time.tolist() == [0.1, 0.0, 0.05]
    assert mixed.position[1] == pytest.approx(TUMBLING["position"], abs=1e-16)


@pytest.mark.parametrize("tilt", [0.0, np.pi / 4])
def test_the_drops_of_fig_3_keep_attitude_until_they_land(engine, tilt):
    release = {"position": [0, 0, 1.86], "angles": [0, tilt, 0]}
    tossed = toss(engine, scenario(air=AIR, release=release, ending={"max_impacts": 1}))
    start = scenario(release=release).release.attitude
    assert np.abs(tossed.impacts.quaternion[0] - start).max() < 1e-10
    assert tossed.sequence == "H"


@pytest.mark.parametrize("coin", [ZLOTY, THIN])
@pytest.mark.parametrize("spin", [0.0, 1.0, 20.0, 50.0])
@pytest.mark.parametrize("angles", [[0.3, 0, 0], [0.3, np.pi, 0]])
def test_a_flat_coin_that_spins_bounces_flat(engine, coin, spin, angles):
    """Flat within rounding, at every angle about ζ: where a search for the lowest rim point meets nothing."""
    release = {"angles": angles, "angular_velocity": [0, 0, spin], "velocity": [0.2, 0.1, 0]}
    tossed = toss(engine, scenario(coin=coin, floor={"restitution": 0.5}, release=release, ending=FEW))
    impacts = tossed.impacts
    assert len(impacts) == 2
    assert impacts.velocity_after[:, 2] / impacts.velocity_before[:, 2] == pytest.approx(
        [-0.5, -0.5], abs=1e-4
    )
    assert impacts.velocity_after[:, :2] == pytest.approx(np.array([[0.2, 0.1]] * 2), abs=1e-9)
    assert impacts.angular_velocity_after == pytest.approx(
        np.array([[0, 0, spin]] * 2), abs=1e-6 * max(spin, 1)
    )
    turned = tossed.sample([tossed.end_time]).quaternion[0]
    psi = 0.3 + spin * tossed.end_time * (1 if angles[1] == 0 else -1)
    expected = scenario(release={"angles": [psi, angles[1], 0]}).release.attitude
    assert abs(turned @ expected) == pytest.approx(1, abs=1e-9)


def test_endings_are_named_alike(engine):
    assert toss(engine, scenario(ending={"max_time": 0.1})).ending == Ending.MAX_TIME
    assert toss(engine, scenario(ending={"max_impacts": 1})).ending == Ending.MAX_IMPACTS
    flat = toss(engine, scenario())
    assert (flat.ending, flat.outcome) == (Ending.SETTLED, Outcome.HEADS)
    tails = toss(engine, scenario(release={"angles": [0, np.pi, 0]}))
    assert (tails.ending, tails.outcome) == (Ending.SETTLED, Outcome.TAILS)


def test_a_coin_at_rest_on_the_floor_is_settled(engine):
    for thickness in (0.0, 2e-3):
        coin, release = {**ZLOTY, "thickness": thickness}, {"position": [0, 0, thickness / 2]}
        tossed = toss(engine, scenario(coin=coin, release=release))
        assert (tossed.ending, tossed.outcome) == (Ending.SETTLED, Outcome.HEADS)
        assert len(tossed.impacts) == 0


def test_a_thin_coin_thrown_down_from_the_floor_rebounds_as_newton_says(engine):
    """At a gap of nothing the made-up thickness of MuJoCo's shape must not be in the floor."""
    tilt, r = 0.5, 1.25e-2
    tossed = toss(
        engine,
        scenario(
            coin=THIN,
            release={
                "position": [0, 0, r * np.sin(tilt)],
                "angles": [0, tilt, 0],
                "velocity": [0, 0, -0.5],
            },
            ending={"max_impacts": 1},
        ),
    )
    # K_zz = 1/m + (r cos s)^2/J, J = m r^2/4.
    expected = 1.8 * 0.5 * 2e-3 / (1 + 4 * np.cos(tilt) ** 2)
    assert tossed.impacts.impulse[0, 2] == pytest.approx(expected, rel=1e-4)
    assert tossed.impacts.time[0] == pytest.approx(0, abs=1e-8)


def test_samples_of_no_times_are_empty_and_a_table_of_times_is_refused(engine):
    tossed = toss(engine, scenario(ending={"max_impacts": 1}))
    nothing = tossed.sample([])
    assert nothing.position.shape == (0, 3)
    assert nothing.quaternion.shape == (0, 4)
    with pytest.raises(ValueError, match=r"shape \(1, 2\)"):
        tossed.sample([[0.0, 0.1]])


def test_tosses_are_reproducible_to_the_bit(engine):
    case = scenario(coin=IMPERFECT, air=AIR, release=TUMBLING, ending={"max_impacts": 4})
    a, b = toss(engine, case), toss(engine, case)
    assert np.array_equal(a.impacts.impulse, b.impacts.impulse)
    assert np.array_equal(a.sample([0.2]).quaternion, b.sample([0.2]).quaternion)


def test_paths_agree_with_the_other_engine_up_to_the_first_touch(engine):
    rng = np.random.default_rng(51)
    other = next(name for name in Engine if name is not engine)
    for _ in range(25):
        case = scenario(coin=draw_coin(rng), air=AIR, release=draw_release(rng), ending={"max_impacts": 1})
        a, b = toss(engine, case), toss(other, case)
        times = np.linspace(0, min(a.impacts.time[0], b.impacts.time[0]), 20)
        path_a, path_b = a.sample(times[:-1]), b.sample(times[:-1])
        assert distance(path_a, path_b).max() < 1e-6 * case.coin.radius
        assert attitude_angle(path_a, path_b).max() < 1e-6


@pytest.mark.parametrize(("exponent", "thickness"), [(0.5, 0.0), (1.0, 2e-3)])
def test_first_touches_agree_with_the_other_engine_in_air_that_is_not_linear(engine, exponent, thickness):
    offset = [*PAPER_OFFSET[:2], PAPER_OFFSET[2] if thickness else 0.0]
    case = scenario(
        coin={**ZLOTY, "thickness": thickness, "center_of_mass": offset},
        air={**AIR, "exponent": exponent},
        release=TUMBLING,
        ending={"max_impacts": 1},
    )
    vacuum = toss(engine, case.replace("air", Air())).impacts
    other = next(name for name in Engine if name is not engine)
    a, b = toss(engine, case), toss(other, case)
    assert a.impacts.time[0] == pytest.approx(b.impacts.time[0], abs=1e-9)
    assert abs(vacuum.time[0] - a.impacts.time[0]) > 1e-4, "the air should be felt"
    # MuJoCo's contact lasts a third of a microsecond, in which the coin turns.
    assert a.impacts.impulse[0] == pytest.approx(b.impacts.impulse[0], rel=4e-4, abs=1e-9)
    times = np.linspace(0, min(a.impacts.time[0], b.impacts.time[0]), 20)[:-1]
    path_a, path_b = a.sample(times), b.sample(times)
    assert distance(path_a, path_b).max() < 1e-6 * case.coin.radius
    assert attitude_angle(path_a, path_b).max() < 1e-6


def test_in_vacuum_the_exponent_of_the_air_changes_nothing(engine):
    case = scenario(coin=IMPERFECT, release=TUMBLING, ending={"max_impacts": 3})
    known, tossed = toss(engine, case), toss(engine, case.replace("air.exponent", 0.5))
    assert np.array_equal(tossed.impacts.time, known.impacts.time)
    assert np.array_equal(tossed.impacts.impulse, known.impacts.impulse)
    assert tossed.trusted_impacts == known.trusted_impacts


def test_the_euro_on_the_table_comes_to_lie_with_the_same_face_up(engine):
    lies = toss(engine, load("table"))
    assert (lies.outcome, lies.ending) == (Outcome.HEADS, Ending.LYING)
    assert lies.sequence[:3] == "HTH"
    # It wobbles for two seconds; the steps of MuJoCo's contact err by a thousandth of the energy in a second.
    assert lies.end_time == pytest.approx(2.52, abs=0.02)
