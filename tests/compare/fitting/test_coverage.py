"""Intervals of tumbling coins that were filmed and heard: all hold the truth, across jumps of the misfit."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from cointoss import Observed, analytic, fit
from cointoss.compare.fitting.misfit import Misfit
from cointoss.models.records import Toss
from cointoss.models.scenario import Scenario

MM, MS, ATTITUDE, FRAMES, TOUCHES = 1e-3, 1e-3, np.radians(2), 12, 3
SPIN, TILT = "release.angular_velocity", "release.angles.theta"
WIDTHS = {"release.velocity.z": 0.5, "release.position.z": 0.1, TILT: 0.4}
"""Half the span in which a field is looked for; that of a spin is `SPIN_WIDTH`."""
SPIN_WIDTH = 8.0
FREE = (
    ("floor.restitution", "release.velocity.z", f"{SPIN}.xi", f"{SPIN}.eta", TILT),
    ("floor.restitution", "release.position.z", f"{SPIN}.xi", f"{SPIN}.eta", f"{SPIN}.zeta"),
)
COIN = Scenario(
    coin={"mass": 0.005, "radius": 0.0125, "thickness": 0.002},
    floor={"restitution": 0.7, "contact": "smooth"},
    release={"position": [0, 0, 0.3], "velocity": [0.3, 0, 0], "angles": [0.4, 0, 0]},
)
LAWS = ("smooth", "smooth", "perfectly_rough")


def tossed(rng: np.random.Generator, law: str) -> tuple[Scenario, Toss, dict[str, float]]:
    """Return a coin that tumbles and makes four touches, 5 ms apart at least, with some of its fields."""
    while True:
        drawn = {
            "floor.restitution": rng.uniform(0.5, 0.9),
            "release.position.z": rng.uniform(0.2, 0.5),
            "release.velocity.z": rng.uniform(-0.5, 2),
            TILT: rng.uniform(0.1, 1.4),
            "release.angles.phi": rng.uniform(0, 6.28),
            f"{SPIN}.xi": rng.uniform(-30, 30),
            f"{SPIN}.eta": rng.uniform(-30, 30),
            f"{SPIN}.zeta": rng.uniform(-15, 15),
        }
        coin = COIN.replace("floor.contact", law, *(x for pair in drawn.items() for x in pair))
        toss = analytic.toss(coin.replace("ending.test", "lying"))
        times = toss.impacts.time[: TOUCHES + 1]
        tumbles = np.hypot(drawn[f"{SPIN}.xi"], drawn[f"{SPIN}.eta"]) > 8
        if tumbles and len(times) > TOUCHES and np.diff(times).min() > 5 * MS:
            return coin, toss, drawn


def held(seed: int) -> NDArray[np.bool_]:
    """Return which of a set's true values are in their intervals, (k,).

    The film of even seeds ends with the first touch, that of others with the third.
    """
    rng = np.random.default_rng([11, seed])
    coin, toss, fields = tossed(rng, LAWS[seed % 3])
    times = toss.impacts.time[:TOUCHES]
    at = np.linspace(0, times[0], FRAMES + 1)[:-1] if seed % 2 == 0 else np.linspace(0, times[-1], FRAMES)
    states = toss.sample(at)
    turned = Rotation.from_rotvec(rng.normal(0, ATTITUDE, (FRAMES, 3)))
    attitudes = Rotation.from_quat(states.quaternion, scalar_first=True) * turned
    observed = Observed(
        touch_times=times + rng.normal(0, MS, TOUCHES),
        touch_sd=MS,
        faces=toss.impacts.face[:TOUCHES],
        times=at,
        heights=states.position[:, 2] + rng.normal(0, MM, FRAMES),
        height_sd=MM,
        quaternions=attitudes.as_quat(scalar_first=True),
        quaternion_sd=ATTITUDE,
    )
    truth = {field: fields[field] for field in FREE[seed // 2 % 2]}
    spans = {}
    for field, value in truth.items():
        half = WIDTHS.get(field, SPIN_WIDTH)
        middle = value + half * rng.uniform(-0.8, 0.8)
        spans[field] = (max(middle - half, 0.0) if field == TILT else middle - half, middle + half)
    found = fit(observed, coin, {**spans, "floor.restitution": (0.3, 1.0)})
    misfit = Misfit(scenario=coin, spans=tuple(each.span for each in found.values), observed=observed)
    true = misfit.predicted(np.array([*truth.values()]))
    assert found.chi_square < np.sum(true.residuals[true.is_tested] ** 2) + 1e-3, "nothing explains it better"
    ends = [found[field].interval or (np.nan, np.nan) for field in truth]
    return np.array([low <= true <= high for (low, high), true in zip(ends, truth.values(), strict=True)])


@pytest.mark.slow
def test_intervals_reach_across_jumps_of_the_misfit():
    """Of set 52 most of what explains it is lost where all three touches are fitted at once."""
    assert np.all(held(52))


@pytest.mark.long
@pytest.mark.parametrize("first", range(0, 100, 5))
def test_intervals_of_100_tumbling_coins_with_five_free_fields_hold_the_truth(first):
    """All five hold it in 95 of 100 sets by the level of each: in fewer than 3 of 5 in one case of 800."""
    assert sum(np.all(held(seed)) for seed in range(first, first + 5)) >= 3
