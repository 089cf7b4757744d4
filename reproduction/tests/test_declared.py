"""Claims declared in TOML are filled in with what a run finds, its sizes, and constants of its module."""

import tomllib
from collections import ChainMap

import numpy as np
import pytest

from cointoss.compare.metrics.estimate import Estimate
from cointoss_reproduction.frame.claim import Criterion
from cointoss_reproduction.frame.declared import filled, value_of

AIR = "air"
SHARE = Estimate(0.25, 0.2, 0.3, 400)
FOUND = {
    "swing": np.array([[1.0, 2.0], [3.0, 5.0]]),
    "shares": {("air", "thin"): SHARE},
    "apart": {"on a soft floor": 0.0123},
    "media": {"air": {"count": 3}, "vacuum": {"count": 4}},
    "thin": "thin",
    "AIR": AIR,
    "known": None,
    "limits": {"low": 1, "high": 2},
    "rates": {"low": 0.5, "high": 1.5},
    "heads": {"thin, in air": 7},
}


def claims_of(text):
    return list(filled(tomllib.loads(text)["claim"], ChainMap(FOUND)))


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("swing[0, -1]", 2.0),
        ("swing[1].max", 5.0),
        ("shares[AIR, thin].low", 0.2),
        ("apart[on a soft floor]", 0.0123),
        ("swing.size", 4),
        ("heads[thin, in air]", 7),
    ],
)
def test_a_field_names_a_part_of_what_was_found(field, value):
    assert value_of(field, FOUND) == value


def test_words_and_units_are_filled_in():
    (claim,) = claims_of("""
        [[claim]]
        claim = "{swing[0, 0]:.1f} and {apart[on a soft floor]:.1f mm} in {AIR}"
        mujoco = "{shares[AIR, thin].value:.0%}"
        expected = "known"
        criteria = [["share of {thin}", "shares[AIR, thin]", "<", 0.28, "less than {limits[high]}"]]
    """)
    assert (claim.claim, claim.mujoco, claim.analytic) == ("1.0 and 12.3 mm in air", "25%", "-")
    assert claim.criteria == (Criterion("share of thin", SHARE, "<", 0.28, "less than 2"),)
    assert claim.expected is claim.holds is None


def test_a_measure_of_several_entries_makes_as_many_criteria_each_with_its_threshold():
    (claim,) = claims_of("""
        [[claim]]
        claim = "rates are high"
        expected = false
        criteria = [["{key} rate", "rates", ">", "limits", "twice {key}"]]
    """)
    assert claim.criteria == (
        Criterion("low rate", 0.5, ">", 1, "twice low"),
        Criterion("high rate", 1.5, ">", 2, "twice high"),
    )
    assert (claim.holds, claim.expected) == (False, False)


def test_claims_of_each_entry_follow_each_other():
    found = claims_of("""
        [[claim]]
        each = "media"
        claim = "{count} in {key}"
        missing = "no coin"

        [[claim]]
        each = "media"
        claim = "again in {key}"
        criteria = [["count in {key}", "count", "=", 3, "three"]]

        [[claim]]
        claim = "{thin}"
        missing = "no floor"
        expected = "open"
    """)
    assert [claim.claim for claim in found] == [
        "3 in air",
        "again in air",
        "4 in vacuum",
        "again in vacuum",
        "thin",
    ]
    assert [claim.holds for claim in found] == [None, True, None, False, None]
    assert found[1].criteria[0].quantity == "count in air"
    assert found[-1].expected is None


def test_a_number_that_was_not_found_is_an_error():
    with pytest.raises(KeyError, match="speed"):
        claims_of('[[claim]]\nclaim = "{speed}"\nmissing = "x"')
