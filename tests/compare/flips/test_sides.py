"""Whether a coin is fair: published counts, the size of a sample in closed form, and tables of heads."""

import json
from typing import Any

import pytest
from scipy.stats import binomtest, norm

from cointoss import Sides
from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.flips.sides import needed_flips, together
from cointoss.compare.flips.table import read_flips, read_table
from cointoss.compare.sweep.errors import SweepError
from tests.helpers.command_line import printed

PRINTED = """\
name;start;heads;tosses
Kerrich;unknown;5067;10000
Ku;heads;10231;20000
Larwood;t;10014;20000
"""
"""J. E. Kerrich, An experimental introduction to the theory of probability (1946); D. Aldous, P. Ku and
J. Larwood, 40,000 coin tosses yield ambiguous evidence for dynamical bias (2009)."""


@pytest.fixture
def counts(here):
    """Write a table of counts."""

    def write(text: str) -> str:
        (here / "counts.csv").write_text(text, encoding="utf-8")
        return "counts.csv"

    return write


def test_belgian_euros_are_nearly_told_from_fair_coins():
    """140 heads of 250 spins: by chance in less than 7 % (The Guardian, 4 January 2002)."""
    euro = Sides(heads=140, tails=110)
    assert euro.p_value == pytest.approx(0.066, abs=5e-4)
    wilson = binomtest(140, 250).proportion_ci(0.99, method="wilson")
    assert euro.share.ends == pytest.approx((0.56, wilson.low, wilson.high), abs=1e-12)
    assert euro.verdict.startswith("a fair coin can do what was counted: p = 0.066\n")
    assert Sides(heads=1400, tails=1100).verdict.startswith(
        "a fair coin cannot do what was counted: p = 2.1e-09"
    )


def test_a_bias_of_a_hundredth_needs_the_flips_of_the_normal_approximation():
    spread = norm.isf(0.005) * 0.5 + norm.isf(0.1) * (0.51 * 0.49) ** 0.5
    assert needed_flips() == pytest.approx((spread / 0.01) ** 2, rel=5e-3)
    few, many = Sides(heads=5, tails=5), Sides(heads=20_000, tails=20_000)
    assert f"{needed_flips() - 10:,} more would show a bias of 1 %" in few.verdict
    assert "these are enough to show a bias of 1 %" in many.verdict


@pytest.mark.parametrize(
    "text",
    [
        "heads,tails\n3,2\n",
        "heads,flips\n3,5\n",
        "tails;n\n2;5\n",
        "start,heads,tails,flips\nunknown,1,1,2\nUnknown,2,1,3\n",
        "HTTHH",
        "# mine\nh t\nT h\nH\n",
        "1,0,0,1,1\n",
        "1\n0\n0\n1\n1\n",
    ],
)
def test_heads_are_read_from_counts_and_from_rows_of_sides(counts, text):
    found = read_table(counts(text))
    assert found.flips is None
    assert together(found.sides.values()) == Sides(heads=3, tails=2)
    with pytest.raises(
        ObservationError, match=r"counts.csv: the side at the release is not known; accepted: same"
    ):
        read_flips("counts.csv")


def test_the_same_side_is_counted_where_the_start_is_known(counts):
    found: Any = read_table(counts(PRINTED))
    assert found.sides["Kerrich"] == Sides(heads=5067, tails=4933)
    assert (found.flips.people, found.flips.same.tolist()) == (("Ku", "Larwood"), [10231, 9986])
    pairs: Any = read_table(counts("HH,HT,TT,TH\n5,1,3,2\n"))
    assert (pairs.sides, pairs.flips.same.tolist()) == ({"1": Sides(heads=7, tails=4)}, [8])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("heads,flips\n6,5\n", "row 1: heads 6 and flips 5; accepted: no more than all flips"),
        ("heads,tails,flips\n3,2,6\n", "row 1: heads 3, tails 2 and flips 6; accepted: no more than all"),
        ("HTX\n", "no columns of counts; accepted: same and flips.* or 0110 \\(1: heads\\)"),
        ("HT10\n", "no columns of counts"),
        ("", "no columns of counts"),
    ],
)
def test_what_counts_no_sides_is_refused(counts, text, message):
    with pytest.raises(ObservationError, match=f"^counts.csv: {message}"):
        read_table(counts(text))


@pytest.mark.parametrize(("heads", "tails", "named"), [(-1, 2, "heads"), (1.5, 2, "heads"), (0, 0, "tails")])
def test_a_record_of_no_sides_is_refused(heads, tails, named):
    with pytest.raises(SweepError, match=f"^{named}: .*accepted: a whole number from"):
        Sides(heads=heads, tails=tails)


def test_the_command_says_whether_the_coin_is_fair(counts):
    typed = printed("flips", "--heads", 493, "--tails", 507)
    assert typed == printed("flips", counts("H" * 493 + "T" * 507))
    assert "1        1000  49.3 [45.2, 53.4]   0.68" in typed
    assert Sides(heads=493, tails=507).verdict in typed
    told = json.loads(printed("flips", "counts.csv", "--json"))
    assert told["sides"]["1"] == Sides(heads=493, tails=507).as_dict()
    assert told["offset"] is told["tosses"] is None


def test_the_command_adds_a_hand_where_the_start_is_known(counts):
    told = printed("flips", counts(PRINTED))
    rows = (
        "all      50000  50.6 [50.0, 51.2]",
        "Ku       20000  51.2 [50.2, 52.1]",
        "Larwood  20000  49.9 [49.0, 50.8]",
    )
    assert [row for row in rows if row not in told] == []
