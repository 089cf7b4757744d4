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


TABLES = {
    "aligned, numbers at the right": (
        f"Of all tosses:\n\n{SHARES}\n\nNo more.",
        80,
        [
            "Of all tosses:",
            "",
            "coin         on edge [%]",
            "────────────────────────",
            "zloty  0.30 [0.08, 1.18]",
            "a|b                   11",
            "",
            "No more.",
        ],
    ),
    "too wide: cells wrap, and no interval is broken": (
        SHARES,
        20,
        [
            "coin     on edge [%]",
            "────────────────────",
            "zloty           0.30",
            "        [0.08, 1.18]",
            "",
            "a|b               11",
        ],
    ),
    "words longer than the terminal are kept whole": (
        table(["one", "two"], [["unbreakable", "1"]]),
        5,
        ["one          two", "────────────────", "unbreakable    1"],
    ),
    "a paragraph that begins with an absolute value is no table": (
        "|ΔS|/|S| of all impacts",
        80,
        ["|ΔS|/|S| of all impacts"],
    ),
}


@pytest.mark.parametrize("name", TABLES)
def test_a_table_is_laid_out_for_the_terminal(name):
    text, width, lines = TABLES[name]
    assert laid_out(text, width).splitlines() == lines


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
