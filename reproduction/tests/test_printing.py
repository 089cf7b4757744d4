"""What `cointoss reproduce` prints: tables and claims laid out for the width of a terminal."""

from pathlib import Path

import pytest

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.output.tables import table
from cointoss.compare.output.terminal import laid_out
from cointoss_reproduction.frame.claim import Claim, Criterion
from cointoss_reproduction.frame.printing import page
from cointoss_reproduction.frame.result import Result
from cointoss_reproduction.frame.runner import kept
from saved import DOCS

SHARES = table(["coin", "on **edge** [%]"], [["`zloty`", "0.30 [0.08, 1.18]"], ["a|b", "11"]])


def test_a_table_is_aligned_numbers_at_the_right():
    assert laid_out(f"Of all tosses:\n\n{SHARES}\n\nNo more.", 80).splitlines() == [
        "Of all tosses:",
        "",
        "coin         on edge [%]",
        "────────────────────────",
        "zloty  0.30 [0.08, 1.18]",
        "a|b                   11",
        "",
        "No more.",
    ]


def test_a_table_that_is_too_wide_wraps_its_cells_and_breaks_no_interval():
    lines = laid_out(SHARES, 20).splitlines()
    assert max(map(len, lines)) <= 20
    assert lines == [
        "coin     on edge [%]",
        "────────────────────",
        "zloty           0.30",
        "        [0.08, 1.18]",
        "",
        "a|b               11",
    ]


def test_words_longer_than_the_terminal_are_kept_whole():
    assert laid_out(table(["one", "two"], [["unbreakable", "1"]]), 5).splitlines()[-1] == "unbreakable    1"


@pytest.mark.parametrize("width", [90, 120])
def test_the_tables_of_the_pages_fit_and_lose_nothing(width):
    tables = kept("edge", DOCS).tables
    shown = laid_out(tables, width)
    assert max(map(len, shown.splitlines())) <= width
    marks = str.maketrans("", "", "|`*─\\ \n")
    rulers = tables.replace("---:", "").replace("---", "")
    assert sorted(shown.translate(marks)) == sorted(rulers.translate(marks))


def test_claims_are_printed_with_their_verdicts_and_counted():
    far = Claim(
        claim="heads are rarer than tails",
        criteria=[Criterion("share", Estimate(0.5, 0.4, 0.6, 100), "<", 0.45, "rarer")],
    )
    claims = (
        Claim(
            claim="two and two are four",
            analytic="4",
            criteria=[Criterion("sum", 4, "=", 4, "the sum of two and two")],
        ),
        Claim(claim="two and two are five", criteria=[Criterion("sum", 4, "=", 5, "five")]),
        far,
        Claim(claim="the coin is thin", missing="its thickness"),
    )
    assert (
        page("sums", Result(claims=claims, data={}), Path("out"), 40)
        == """\
✓ holds: two and two are four
    analytic  4
    measured  sum: 4 (= 4: the sum of
              two and two)

✗ does not hold: two and two are five
    measured  sum: 4 (= 5: five)

? cannot be tested: heads are rarer than
  tails
    measured  share: 0.50 [0.40, 0.60]
              (< 0.45: rarer)
    open      about 400 tosses would
              decide it (there were 100)

? cannot be tested: the coin is thin
    open      its thickness

sums: 1 holds, 1 does not hold and 2 cannot be tested
out"""
    )


def test_a_paragraph_that_begins_with_an_absolute_value_is_no_table():
    assert laid_out("|ΔS|/|S| of all impacts", 80) == "|ΔS|/|S| of all impacts"
