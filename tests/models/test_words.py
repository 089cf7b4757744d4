"""Outcomes, endings, faces and laws are words to a person, and integers in arrays and compiled code."""

import operator
import pickle

import numpy as np
import pytest

from cointoss.models.kernel.compiled import compiled
from cointoss.models.laws import ContactLaw, EndingTest, RestitutionKind
from cointoss.models.records import Ending, Face, Outcome

LISTS = (ContactLaw, EndingTest, RestitutionKind, Ending, Face, Outcome)
MEMBERS = [member for words in LISTS for member in words]


@pytest.mark.parametrize("member", MEMBERS, ids=repr)
def test_a_member_prints_as_its_word_and_equals_it(member):
    word, kind = member.name.lower(), type(member)
    assert (str(member), f"{member}", f"{member:>25}") == (word, word, f"{word:>25}")
    assert repr(member) == f"{kind.__name__}.{member.name}"
    assert kind(word) is kind(int(member)) is kind(np.int8(member)) is member
    assert member == word
    assert word == member
    assert [member != other for other in (word, "another")] == [False, True]
    assert [member == other for other in (word, "another")] == [True, False]
    assert member in (word,)
    assert pickle.loads(pickle.dumps(member)) is member


def test_a_number_in_an_array_equals_its_member():
    codes = np.array([0, 1, 2], np.int8)
    for is_so, due in ((operator.eq, [False, False, True]), (operator.ne, [True, True, False])):
        assert is_so(codes, Outcome.TAILS).tolist() == is_so(Outcome.TAILS, codes).tolist() == due
    assert (Outcome.TAILS != np.ma.masked) is (Outcome.TAILS == np.ma.masked) is np.ma.masked
    assert codes[1] == Outcome.HEADS == codes[1] == 1
    assert np.full(2, Outcome.EDGE, np.int8).tolist() == [3, 3]


def test_in_sets_and_as_keys_a_member_is_its_integer():
    codes = np.array([1, 2, 2], np.int8)
    assert set(codes) == set(codes.tolist()) == {Outcome.HEADS, Outcome.TAILS} == {1, 2}
    assert {Outcome.HEADS: "gold"}[codes[0]] == "gold"
    assert Face.TAILS == Outcome.TAILS
    assert {str(Outcome.HEADS): "gold"}["heads"] == "gold"
    assert {"smooth": "ice", ContactLaw.COULOMB: "wood"}[ContactLaw.SMOOTH] == "ice"


@pytest.mark.parametrize(
    ("kind", "word", "says"),
    [
        (Outcome, "head", r"^Outcome: 'head', did you mean heads\? accepted: undecided, heads"),
        (Face, 3, r"^Face: 3, accepted: heads, tails$"),
    ],
)
def test_another_word_is_answered_with_those_there_are(kind, word, says):
    with pytest.raises(ValueError, match=says):
        kind(word)


def test_a_text_that_is_nearly_a_word_is_questioned_where_it_is_compared():
    with pytest.warns(UserWarning, match=r"^Outcome == 'Heads': did you mean heads\?$") as told:
        assert (Outcome.HEADS == "Heads") is False
    assert told[0].filename == __file__
    with pytest.warns(UserWarning, match="did you mean smooth"):
        assert ContactLaw.COULOMB != "smoth"
    with pytest.warns(UserWarning, match=r"^Face == 'H': did you mean heads\?$"):
        assert Face.HEADS != "H"
    assert Outcome.HEADS != "tails"


def test_compiled_code_takes_and_returns_members():
    @compiled
    def other(face):
        return Face.TAILS if face == Face.HEADS else Face.HEADS

    assert [other(face) for face in Face] == ["tails", "heads"]
    assert other(Face.HEADS) is Face.TAILS
