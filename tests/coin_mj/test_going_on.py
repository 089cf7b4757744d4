"""MuJoCo's coin is followed after its toss is decided, and its toss stays what it was."""

import numpy as np
import pytest

from cointoss import analytic, coin_mj
from cointoss.models.reading import load
from cointoss.models.records import Ending
from tests.helpers.draws import scenario


def test_it_bounces_on_as_the_other_engine_s_coin_does():
    """Both settle at the third impact, and lie in the end."""
    release = {"position": [0, 0, 0.05], "angles": [0, 0.3, 0]}
    case = scenario(floor={"restitution": 0.5}, release=release, ending={"until": 0.5})
    ours, theirs = analytic.toss(case), coin_mj.toss(case)
    assert theirs.trusted_impacts == len(theirs.impacts) == len(ours.impacts) == 3
    assert theirs.later_times[:5] == pytest.approx(ours.later_times[:5], abs=2e-6)
    times = np.array([0.11, 0.13, 0.15, 0.3, 0.4, 0.5])
    assert theirs.sample(times).position == pytest.approx(ours.sample(times).position, abs=1e-6)


def test_a_caught_coin_stays_in_the_hand():
    toss = coin_mj.toss(
        load("fig24a").replace("ending.caught", 0.2, "release.position.z", 0.5, "ending.until", 2)
    )
    assert toss.ending == Ending.CAUGHT
    states = toss.sample([toss.end_time, 1.0, 2])
    assert np.ptp(states.position, axis=0).max() < 1e-15
