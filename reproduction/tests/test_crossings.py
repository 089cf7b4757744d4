"""Crossings of lines, on made maps with known answers."""

import numpy as np
import pytest

from cointoss import Outcome
from cointoss_reproduction.setups.crossings import crossings
from tests.helpers.made_maps import faces, hyperbolas, line


@pytest.mark.parametrize(
    ("outcomes", "count"), [("HHTHTT", 3), ("H??H?T?", 1), ("??HT", 1), ("????", 0), ("H", 0)]
)
@pytest.mark.parametrize("undecided", [Outcome.UNDECIDED, Outcome.TRANSIENT])
def test_crossings_of_a_line(outcomes, count, undecided):
    passed = line(outcomes)
    assert crossings(np.where(passed == Outcome.UNDECIDED, undecided, passed)) == count


def test_crossings_of_hyperbolas_grow_with_the_rows_height():
    y = np.arange(1, 9)
    outcomes = hyperbolas(np.linspace(1e-3, 10 - 1e-3, 2000), y)
    # x y passes 1, 2, ... up to 10 y, which the row does not reach.
    assert crossings(outcomes).tolist() == (10 * y - 1).tolist()


def test_crossings_after_n_impacts_that_double_the_phase():
    phase = (np.arange(1 << 14) + 0.5) / (1 << 14)
    after = np.array([faces(2.0**n * phase % 1 < 0.5) for n in range(10)])
    assert crossings(after).tolist() == [2 ** (n + 1) - 1 for n in range(10)]
    # Every second point still sees all: the line is fine enough.
    assert crossings(after[:, ::2]).tolist() == crossings(after).tolist()
    assert crossings(after[:, None, :]).shape == (10, 1)
