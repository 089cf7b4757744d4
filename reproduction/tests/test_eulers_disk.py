"""The study of Euler's disk: its claims hold, and a fall by another power would be seen."""

import numpy as np
import pytest

from cointoss_reproduction.studies.eulers_disk.study import LOSSES, REPRODUCTION, alone, exponent
from saved import missed, unseen


def test_the_exponent_is_that_of_the_time_left():
    left = np.geomspace(1e-3, 10.0, 20)
    assert exponent(left, 0.3 * left**0.4) == pytest.approx(0.4, rel=1e-12)


def test_a_rate_that_is_not_the_closed_forms_is_seen():
    field, size, tilt, closed, slope = LOSSES["air"]
    law, *_ = alone((field, size, tilt, closed, 1.1 * slope))
    assert np.array(law["rate"]) == pytest.approx(1 / 1.1, rel=1e-2)


def test_its_claims_hold():
    cells = REPRODUCTION.make(unseen).data
    assert missed("eulers-disk", cells) == ()
