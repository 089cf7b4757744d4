"""The shares of the outcomes of a map."""

from cointoss.compare.basins.fractions import fractions
from cointoss.models.records import Outcome
from tests.helpers.made_maps import halves, line


def test_fractions_count_every_outcome_and_the_undecided():
    assert fractions(line("HHHTTE??")) == {
        Outcome.UNDECIDED: 0.25,
        Outcome.HEADS: 0.375,
        Outcome.TAILS: 0.25,
        Outcome.EDGE: 0.125,
        Outcome.PERPETUAL: 0.0,
        Outcome.TRANSIENT: 0.0,
    }
    assert fractions(halves(3, 8))[Outcome.HEADS] == 0.5
