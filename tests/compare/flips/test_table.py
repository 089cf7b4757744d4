"""Tables of counts as people write them, and what is wrong with others."""

import re

import pytest

from cointoss.compare.fitting.errors import ObservationError
from cointoss.compare.flips.counts import MOST_FLIPS, Flips
from cointoss.compare.flips.table import PAIRS, key_of, read_flips
from cointoss.models.unused import UnusedFieldWarning


@pytest.fixture
def read(tmp_path):
    """Read the counts of a table's text."""

    def read_text(text: str) -> Flips:
        (path := tmp_path / "seen.csv").write_text(text, encoding="utf-8")
        return read_flips(path)

    return read_text


@pytest.mark.parametrize(
    "text",
    [
        "person,same,flips\nAnna,520,1000\nBen,4,10\n",
        "Participant;n_same;N\nAnna;520;1000\nBen;4;10\n",
        "# counts\nSUBJECT\tSame side\tother-side\nAnna\t520\t480\nBen\t4\t6\n",
        "name,tosses,same count,different\nAnna,1000,520,480\nBen,10,4,6\n",
        "person,different,total\nAnna,480,1000\nBen,6,10\n",
        "person,heads_to_heads,heads_to_tails,tails_to_tails,tails_to_heads\n"
        "Anna,260,240,260,240\nBen,4,6,0,0\n",
        "id,HH,HT,TT,TH\nAnna,260,240,260,240\nBen,4,6,0,0\n",
        "person,Start,heads,tails\nAnna,heads,260,240\nBen,H,4,6\nAnna,T,240,260\n",
        "person,same,flips\nAnna,500,900\nBen,4,10\nAnna,20,100\n",
    ],
)
def test_each_way_to_count_says_the_same(read, text):
    found = read(text)
    counts = found.same.tolist(), found.flips.tolist()
    assert dict(zip(found.people, zip(*counts, strict=True), strict=True)) == {
        "Anna": (520, 1000),
        "Ben": (4, 10),
    }


def test_rows_without_names_are_numbered(read):
    assert read("same,flips\n1,2\n0,0\n").people == ("1", "2")


def test_a_column_of_something_else_is_not_used(read):
    with pytest.warns(UnusedFieldWarning, match="columns day, heads: not used"):
        assert read("day,same,flips,heads\n3,1,2,1\n").same.tolist() == [1]


def test_sides_are_read_in_any_spelling():
    assert [key_of(name) for name in ("hh", "Heads->Tails", "tail_to_tails", "TH (count)")] == list(PAIRS)
    assert [key_of(name) for name in ("n_heads", "N", "number of flips", "height")] == [
        "heads",
        "flips",
        "flips",
        None,
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("same,flips\n-1,10\n", "column same: row 1 is '-1', accepted: a whole number from 0"),
        ("same,flips\nmany,10\n", "column same: row 1 is 'many', accepted: a whole number from 0"),
        ("same,flips\n1.5,10\n", "column same: row 1 is '1.5', accepted: a whole number from 0"),
        (
            "same;flips\n4,000;5,000\n",
            "column same: row 1 is '4.000', accepted: a whole number from 0, without",
        ),
        (
            "same,flips\n4.000,5.000\n",
            "column same: row 1 is '4.000', accepted: a whole number from 0, without",
        ),
        ('same,flips\n"4,000","5,000"\n', "column same: row 1 is '4,000', accepted: a whole number from 0"),
        ("same,flips\n1,\n", "column flips: row 1 is '', accepted: a whole number from 0"),
        ("same,flips\n1,2\n12,10\n", "row 2: same 12 and flips 10; accepted: no more than all"),
        ("same,other,n\n1,2,4\n", "row 1: same 1, other 2 and n 4; accepted: no more than all"),
        ("same,flips,N\n1,2,2\n", "columns flips and N; accepted: one of them"),
        ("same,flips,hh\n1,2,2\n", "columns same and hh; accepted: one way to count"),
        ("heads,tails\n1,2\n", "the side at the release is not known; accepted: same and flips; same"),
        ("hh,ht,tt\n1,2,3\n", "columns hh, ht, tt; accepted: same and flips"),
        ("start,heads,tails\n?,1,2\n", "column start: row 1 is '?', accepted: heads, tails, h or t"),
        ("start,heads,tails\nthumb,1,2\n", "column start: row 1 is 'thumb', accepted: heads, tails, h or t"),
        ("same,flips,edge\n1,2,0\n", "column edge: accepted: none, and flips without those on the edge"),
        ("person,same\nAnna,3\n", "no columns of counts; accepted: same and flips"),
        ("same,flips\n", "no rows; accepted: one or more"),
        ("same,flips\n0,0\n", "no flips; accepted: at least one"),
        ("same,flips\n3\n", "row 1 has 1 cells; accepted: 2"),
        (
            f"person,same,flips\nAnna,0,{MOST_FLIPS + 1}\n",
            f"flips of Anna: 1e+06, accepted: a whole number from 0 to {MOST_FLIPS}",
        ),
    ],
)
def test_what_no_counts_are_is_refused(read, text, message):
    with pytest.raises(ObservationError, match=rf"^\S*seen.csv: .*{re.escape(message)}.*$"):
        read(text)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"same": [3], "flips": [2]}, r"Flips.same: \[0\] is 3, accepted: a whole number from 0 to 2"),
        ({"same": [1, 1], "flips": [2]}, r"Flips.same: shape \(2,\), accepted: one of flips and of same"),
        ({"same": [1], "flips": [2], "people": ("a", "b")}, "2 names, accepted: 1, one a person"),
        (
            {"same": ["a"], "flips": [2]},
            r"^Flips.same: \['a'\], accepted: whole numbers from 0, one for each",
        ),
        ({"same": [1], "flips": [[1], 2]}, r"^Flips.flips: \[\[1\], 2\], accepted: whole numbers from 0"),
        ({"same": [0] * 1001, "flips": [1] * 1001}, r"Flips.flips: shape \(1001,\), accepted: one of"),
        ({"same": [float("nan")], "flips": [2]}, r"Flips.same: \[0\] is nan"),
    ],
)
def test_a_record_of_no_counts_is_refused(given, message):
    with pytest.raises(ObservationError, match=message):
        Flips(**given)
