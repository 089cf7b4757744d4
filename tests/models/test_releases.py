"""Many releases are checked as one is."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.models.outcomes import Outcomes
from cointoss.models.parts import Release
from cointoss.models.reading import load
from cointoss.models.releases import QUANTITIES, Releases, check_releases
from tests.helpers.draws import scenario
from tests.helpers.many import releases_of

GOOD = {
    "position": np.full((2, 3), 0.4),
    "velocity": np.zeros((2, 3)),
    "quaternion": np.array([[1.0, 0, 0, 0], [0.5, 0.5, 0.5, 0.5]]),
    "angular_velocity": np.zeros((2, 3)),
}


def changed(name: str, column: int, value: float) -> Releases:
    """Give good releases but for one number of the second."""
    array = GOOD[name].copy()
    array[1, column] = value
    return Releases(**{**GOOD, name: array})


def test_what_are_no_numbers_is_refused():
    with pytest.raises(ValueError, match=r'Releases\.velocity: "fast", accepted: numbers, \(n, 3\)'):
        Releases(**{**GOOD, "velocity": "fast"})


@pytest.mark.parametrize(
    ("name", "shape"),
    [("position", (2, 2)), ("position", (3,)), ("velocity", (3, 3)), ("quaternion", (2,)), ("position", ())],
)
def test_a_wrong_shape_is_refused(name, shape):
    rows = "n" if name == "position" else "2"
    with pytest.raises(
        ValueError, match=rf"Releases\.{name}: shape .*, expected \({rows}, [34]\), a row for"
    ):
        Releases(**{**GOOD, name: np.zeros(shape)})


@pytest.mark.parametrize("value", [np.nan, np.inf, 2e9])
@pytest.mark.parametrize("name", list(GOOD))
def test_a_number_beyond_all_coins_is_refused(name, value):
    with pytest.raises(ValueError, match=rf"Releases\.{name}: row 1 is .*, accepted: numbers within"):
        changed(name, 2, value)


def test_euler_parameters_are_brought_to_norm_1_as_those_of_one_release():
    rng = np.random.default_rng(1)
    e = rng.normal(size=(50, 4))
    e /= np.linalg.norm(e, axis=1)[:, None] * (1 + rng.uniform(-9e-4, 9e-4, 50))[:, None]
    many = releases_of(50, position=[0.4, 0.4, 0.4], quaternion=e)
    for i in range(50):
        one = Release(position=(0.4, 0.4, 0.4), quaternion=tuple(e[i].tolist()))
        assert tuple(many.quaternion[i].tolist()) == one.attitude
    with pytest.raises(ValueError, match=r"Releases\.quaternion: row 1 is .*norm 1"):
        changed("quaternion", 0, 0.6)


def test_the_arrays_are_copies_and_read_only():
    position = GOOD["position"].copy()
    releases = Releases(**{**GOOD, "position": position})
    position[0, 2] = -1
    assert releases.position[0, 2] == 0.4
    with pytest.raises(ValueError, match="read-only"):
        releases.position[0, 2] = 1


def test_an_attitude_from_angles_is_that_of_one_release_to_the_bit():
    angles = np.random.default_rng(2).uniform(-4, 4, (200, 3))
    one_by_one = np.array(
        [Release(position=(0, 0, 1), angles=tuple(row)).attitude for row in angles.tolist()]
    )
    assert np.any(np.sum(one_by_one**2, axis=1) != 1), "some norm should be off by rounding"
    many = releases_of(200, quaternion=one_by_one)
    assert np.array_equal(many.quaternion, one_by_one)
    again = [Release(position=(0, 0, 1), quaternion=tuple(row)).attitude for row in one_by_one.tolist()]
    assert np.array_equal(again, one_by_one)


@pytest.mark.parametrize(
    ("name", "column", "value", "accepted"),
    [
        ("position", 2, 0.0, "a coin above the floor"),
        ("angular_velocity", 0, 1e7, "a spin of at most"),
        ("velocity", 1, 1e8, "air that slows the coin"),
    ],
)
def test_a_release_that_a_scenario_refuses_is_refused(name, column, value, accepted):
    air = {"normal": 0.8, "exponent": 1.0}
    check_releases(scenario(air=air), Releases(**GOOD))
    with pytest.raises(ValueError, match=rf"Releases\.{name}: row 1 is .*, accepted: {accepted}"):
        check_releases(scenario(air=air), changed(name, column, value))
    one = {key: array[1].tolist() for key, array in vars(changed(name, column, value)).items()}
    with pytest.raises(ValueError, match=accepted):
        scenario(air=air, release=one)


def test_outcomes_check_their_shapes_and_are_read_only():
    columns = {
        "outcome": np.zeros(2, np.int8),
        "ending": np.zeros(2, np.int8),
        "impacts": np.zeros(2, np.int32),
        "last_face": np.zeros(2, np.int8),
        "end_time": np.zeros(2),
    }
    outcomes = Outcomes(**columns)
    assert len(outcomes) == 2
    with pytest.raises(ValueError, match="read-only"):
        outcomes.impacts[0] = 1
    with pytest.raises(ValueError, match=r"Outcomes\.end_time: shape \(3,\), expected \(2,\)"):
        Outcomes(**{**columns, "end_time": np.zeros(3)})


def test_releases_are_copies_of_a_scenarios_but_for_what_is_given():
    release = load("fig24a").release
    some = Releases.of("fig24a", 3, height=("20 cm", 0.6), spin=40, velocity_x=[1, 2, 4])
    assert some.position.tolist() == [[0, 0, 0.2], [0, 0, 0.4], [0, 0, 0.6]]
    assert some.angular_velocity.tolist() == [[0, 40, 0]] * 3
    assert some.velocity.tolist() == [[1, 0, 0], [2, 0, 0], [4, 0, 0]]
    assert some.quaternion.tolist() == [list(release.attitude)] * 3
    assert Releases.of(load("fig24a"), 2).position.tolist() == [list(release.position)] * 2
    assert Releases.of("fig24a", 1, height=(0.2, 0.6)).position[:, 2].tolist() == [0.2]


def test_a_spin_keeps_its_axis():
    turning = load("fig24a").replace("release.angular_velocity", [3, 0, -4])
    spun = Releases.of(turning, 2, spin=(10, "600 deg/s"))
    assert np.allclose(spun.angular_velocity, np.outer([10, np.radians(600)], [0.6, 0, -0.8]), rtol=1e-15)
    with pytest.raises(
        ValueError, match=r"spin: this scenario's coin does not spin, .* accepted: angular_vel"
    ):
        Releases.of(turning.replace("release.angular_velocity", [0, 0, 0]), 2, spin=1)


def test_each_number_of_a_release_can_be_given_and_is_tossed_as_its_scenario():
    plain, value = {**QUANTITIES}, 0.25
    for short in ("height", "spin", *(f"quaternion_e{i}" for i in range(4))):
        del plain[short]
    assert len(plain) == 12
    for name, field in plain.items():
        changed = load("fig24a").replace(field, value)
        some = Releases.of("fig24a", 2, **{name: value})
        for part in ("position", "velocity", "angular_velocity"):
            assert tuple(getattr(some, part)[1].tolist()) == getattr(changed.release, part)
        assert tuple(some.quaternion[1].tolist()) == changed.release.attitude
    outcomes = analytic.toss_many("fig24a", Releases.of("fig24a", 2, velocity_z=1, angles_theta="20 deg"))
    toss = analytic.toss(load("fig24a").replace("release.velocity.z", 1, "release.angles.theta", "20 deg"))
    assert (outcomes.outcome[1], outcomes.end_time[1]) == (toss.outcome, toss.end_time)


@pytest.mark.parametrize(
    ("n", "given", "message"),
    [
        (
            4,
            {"height": np.zeros(3)},
            r"height = shape \(3,\), accepted: a number \[m\] or a text with its unit",
        ),
        (4, {"height": "3 s"}, r'height = "3 s", accepted: a number \[m\]'),
        (4, {"spin": None}, r"spin = None, accepted: a number \[rad/s\]"),
        (4, {"spin": np.zeros((4, 3))}, r"spin = shape \(4, 3\), accepted: .* or 4 of them"),
        (4, {"height": 1, "position_z": 1}, "position_z: sets release.position.z again"),
        (4, {"height": (-1, 1)}, "position: row 0 is .* accepted: a coin above the floor"),
        (0, {}, "n = 0, accepted: a whole number from 1"),
        (2.5, {}, "n = 2.5, accepted: a whole number from 1"),
    ],
)
def test_what_makes_no_releases_is_refused(n, given, message):
    with pytest.raises(ValueError, match=rf"^Releases\.(of: )?{message}"):
        Releases.of("fig24a", n, **given)


def test_an_unknown_quantity_is_answered_with_those_there_are():
    with pytest.raises(
        TypeError, match=r"^Releases\.of: hight: unknown; accepted: height, spin, position_x, "
    ):
        Releases.of("fig24a", 4, hight=1)
