"""The study of a threshold of restitution: its page shows what it saved, and what it claims."""

from compare.reproduction.claim import unexpected
from compare.reproduction.saving import read_numbers
from compare.reproduction.studies.plastic_touches import PlasticTouchesRecord, claims, result
from tests.helpers.pages import printed, saved

SAVED = read_numbers(saved("plastic-touches"), PlasticTouchesRecord)


def test_the_page_shows_what_the_study_saved():
    assert printed("CONTACT.md", "plastic-touches") == result(SAVED).text
    assert unexpected(claims(SAVED)) == ()


def test_a_threshold_that_leaves_the_rattle_is_seen():
    same = PlasticTouchesRecord(dict.fromkeys(SAVED.zloty, SAVED.zloty["0"]), SAVED.hands)
    assert unexpected(claims(same)) == (claims(same)[0].claim,)
