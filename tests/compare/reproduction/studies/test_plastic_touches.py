"""The study of a threshold of restitution: its page shows what it saved, and what it claims."""

from cointoss.compare.reproduction.claim import unexpected
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.studies.plastic_touches import PlasticTouchesRecord, claims
from tests.helpers.pages import saved

SAVED = read_numbers(saved("plastic-touches"), PlasticTouchesRecord)


def test_the_saved_claims_come_out_as_known():
    assert unexpected(claims(SAVED)) == ()


def test_a_threshold_that_leaves_the_rattle_is_seen():
    same = PlasticTouchesRecord(dict.fromkeys(SAVED.zloty, SAVED.zloty["0"]), SAVED.hands)
    assert unexpected(claims(same)) == (claims(same)[0].claim,)
