"""The study of a threshold of restitution: its page shows what it saved, and what it claims."""

from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.studies.plastic_touches import PlasticTouchesRecord
from tests.helpers.pages import saved
from tests.helpers.studies import missed

SAVED = read_numbers(saved("plastic-touches"), PlasticTouchesRecord)


def test_a_threshold_that_leaves_the_rattle_is_seen():
    same = PlasticTouchesRecord(dict.fromkeys(SAVED.zloty, SAVED.zloty["0"]), SAVED.hands)
    (wrong,) = missed("plastic-touches", same)
    assert "end the rattle" in wrong
