"""How far two sequences agree, and must."""

import numpy as np

from cointoss import analytic
from cointoss.compare.metrics.sequences import agreement_horizon, common_prefix
from tests.helpers.draws import AIR, scenario

TUMBLING = {"angles": [0.0, 0.122, 0.0], "angular_velocity": [0.0, 40.15, 0.0]}


def test_sequences_share_their_leading_symbols():
    assert common_prefix("HHTH", "HHTT") == 3
    assert common_prefix("HH", "HHTT") == 2
    assert common_prefix("T", "H") == common_prefix("", "H") == 0


def test_the_horizon_shrinks_with_the_error():
    tossed = analytic.toss(scenario(release=TUMBLING, air=AIR))
    n = len(tossed.impacts)
    horizons = [agreement_horizon(tossed, np.full(n, error)) for error in (1e-15, 1e-6, 1e-3, 0.3)]
    assert horizons[0] == n
    assert horizons == sorted(horizons, reverse=True)
    assert horizons[-1] < n / 2


def test_no_face_must_be_shared_after_an_impulse_that_is_as_wrong_as_none():
    tossed = analytic.toss(scenario(release=TUMBLING, air=AIR))
    for wrong in (0.5, np.inf):
        assert agreement_horizon(tossed, np.array([1e-15, 1e-15, wrong, 0.0, 0.0])) == 3
