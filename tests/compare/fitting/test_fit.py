"""A fit: closed forms, intervals that cover the truth, and coins that no values of the model explain."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss import Observed, analytic, fit
from cointoss.compare.fitting.fit import Fitted
from cointoss.compare.sweep.axes import Span
from cointoss.models.scenario import Scenario

MS = 1e-3
FLAT = Scenario(
    coin={"mass": 0.005, "radius": 0.0125, "thickness": 0.002},
    floor={"restitution": 0.8, "contact": "smooth"},
    release={"position": [0, 0, 0.3]},
)
TUMBLING = FLAT.replace("release.angles", [0, 0.5, 0], "release.angular_velocity", [12, 3, 5])
ANY = {"floor.restitution": (0.3, 1.0), "release.position.z": (0.02, 0.6), "clock": (0.5, 1.5)}


def touches(scenario: Scenario, count: int) -> np.ndarray:
    """Return the times of the first touches, which are that many."""
    followed = scenario.replace("ending.test", "lying", "ending.max_impacts", count)
    times = analytic.toss(followed).impacts.time
    assert len(times) == count
    return times


def seen(scenario: Scenario, count: int, rng: np.random.Generator, clock: float = 1.0) -> Observed:
    """Return touches as a microphone hears them."""
    return Observed(touch_times=clock + touches(scenario, count) + rng.normal(0, MS, count), touch_sd=MS)


def test_the_restitution_of_a_flat_coin_is_the_ratio_of_the_times_between_its_touches():
    """With three touches and three values t3 - t2 = χ (t2 - t1); the error of χ is that of the ratio."""
    t = np.array([1.0, 1.35, 1.35 + 0.35 * 0.72])
    found = fit(Observed(touch_times=t, touch_sd=MS), FLAT, ANY, starts=256)
    chi, between = found["floor.restitution"], t[1] - t[0]
    assert chi.value == pytest.approx(0.72, abs=1e-7)
    assert chi.sd == pytest.approx(MS / between * np.sqrt(1 + 1.72**2 + 0.72**2), rel=1e-4)
    # (t3 - t2 - χ (t2 - t1))² is 6.63 times its variance at the ends of the interval (Fieller).
    above = 6.635 * MS**2
    ends = np.roots(
        [between**2 - 2 * above, -2 * between * (t[2] - t[1]) - 2 * above, (t[2] - t[1]) ** 2 - 2 * above]
    )
    assert chi.interval == pytest.approx(tuple(sorted(ends)), abs=chi.sd / 50)
    # The height is that from which the coin hits the floor at g (t2 - t1) / 2 χ.
    fall = between / (2 * 0.72)
    assert found["release.position.z"].value == pytest.approx(FLAT.coin.thickness / 2 + 9.81 * fall**2 / 2)
    assert (found["clock"].value, found.degrees) == (pytest.approx(t[0] - fall), 0)
    assert "nothing is left" in found.verdict


def test_touches_that_come_ever_later_are_those_of_no_coin():
    t = np.array([1.0, 1.2, 1.45, 1.75])
    found = fit(Observed(touch_times=t, touch_sd=MS), FLAT, ANY, starts=256)
    assert not found.is_possible
    assert found["floor.restitution"].at_end
    assert found.p_value < 1e-10
    assert found.verdict.startswith("this model cannot do what was seen with any values of its free fields")
    assert [each.interval for each in found.values] == [None] * 3
    assert not any(each.is_cut for each in found.values)
    assert replace(found, chi_square=1e5).verdict.endswith("freedom, p < 1e-300")


@pytest.mark.slow
def test_touches_beyond_the_horizon_test_nothing():
    toss = analytic.toss(TUMBLING.replace("ending.test", "lying"))
    trusted = toss.trusted_impacts
    assert 3 < trusted < len(toss.impacts) - 4
    times = toss.impacts.time[: trusted + 4].copy()
    times[trusted:] += 0.02  # whatever they are
    heard = Observed(touch_times=times, touch_sd=MS)
    found = fit(heard, TUMBLING, {"floor.restitution": (0.8 - 1e-8, 0.8 + 1e-8)}, starts=4)
    assert found.untested_touches == tuple(range(trusted + 1, trusted + 5))
    assert found.is_possible
    assert found.degrees == trusted - 1


def test_what_was_not_seen_is_not_determined():
    rng = np.random.default_rng(5)
    spans = {"floor.restitution": (0.5, 0.95), "release.position.x": (-1.0, 1.0)}
    found = fit(seen(FLAT, 5, rng, clock=0), FLAT, spans, starts=64)
    assert found["release.position.x"].sd == np.inf
    assert found.degrees == 4, "what changes nothing explains nothing"
    # Of four degrees of freedom 1 % exceed 13.277.
    for chi_square, is_possible in ((13.27, True), (13.28, False)):
        assert replace(found, chi_square=chi_square).is_possible is is_possible
    assert found["floor.restitution"].sd < 0.01
    assert np.isinf(found.covariance[1, 1])
    assert found.as_dict()["values"]["release.position.x"]["sd"] == np.inf


def test_values_that_explain_it_too_are_among_the_others():
    """A coin that leans to the other side touches at the same times: no microphone hears where it leans."""
    leaning = FLAT.replace("release.angles", [0, 0.3, 0])
    heard = Observed(touch_times=touches(leaning, 3), touch_sd=MS)
    found = fit(heard, leaning, {"release.angles.theta": (-0.6, 0.6)}, starts=64)
    sides = [each["release.angles.theta"].value for each in (found, *found.others)]
    assert [min(abs(side - lean) for side in sides) < 0.01 for lean in (0.3, -0.3)] == [True, True]


@pytest.mark.parametrize(("faces", "is_possible"), [("HH?", True), ("HT?", False)])
def test_a_face_rejects_the_toss_that_shows_the_other(faces, is_possible):
    heard = Observed(touch_times=touches(FLAT, 3), touch_sd=MS, faces=faces)
    found = fit(heard, FLAT, {"restitution": "0.5:0.95"}, starts=16)
    assert found.is_possible == is_possible
    assert found.degrees == 2, "three touches less one value: a face is no number"


@pytest.mark.parametrize("ends", [(-10.0, 10.0), (10.0, -10.0)])
def test_an_attitude_fixes_the_side_and_the_spin_about_the_normal(ends):
    coin = FLAT.replace("release.angular_velocity.zeta", 7.0)
    at = np.array([0.05, 0.1, 0.15])
    shown = Observed(times=at, quaternions=-analytic.toss(coin).sample(at).quaternion, quaternion_sd=0.01)
    found = fit(shown, coin, {"release.angular_velocity.zeta": ends}, starts=32)
    spin = found["release.angular_velocity.zeta"]
    assert spin.value == pytest.approx(7.0, abs=1e-6)
    assert spin.sd == pytest.approx(0.01 / np.sqrt(np.sum(at**2)), rel=1e-3)
    far = 6.635**0.5 * spin.sd
    assert spin.interval == pytest.approx((7.0 - far, 7.0 + far), abs=far / 50)


@pytest.mark.parametrize("ends", [(0.5, 0.9), (0.9, 0.5)])
@pytest.mark.parametrize(
    ("value", "interval", "is_cut", "at_end"),
    [
        (0.7, (0.6, 0.8), False, False),
        (0.7, (0.5, 0.8), True, False),
        (0.7, (0.6, 0.9), True, False),
        (0.9, (0.6, 0.9), True, True),
        (0.5, None, False, True),
    ],
)
def test_a_value_at_the_end_of_its_span_and_an_interval_that_is_cut_there_are_told(
    ends, value, interval, is_cut, at_end
):
    span = Span(field="floor.restitution", unit="", start=ends[0], stop=ends[1])
    found = Fitted(span=span, value=value, sd=0.1, interval=interval)
    assert (found.is_cut, found.at_end) == (is_cut, at_end)


@pytest.mark.slow
def test_the_same_seed_finds_the_same_on_any_number_of_cores(monkeypatch):
    shown, found = seen(FLAT, 4, np.random.default_rng(8)), []
    for cores in "13":
        monkeypatch.setenv("COINTOSS_THREADS", cores)
        found.append(fit(shown, FLAT, ANY, starts=16, seed=3).as_dict())
    assert found[0] == found[1]
