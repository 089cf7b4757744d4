"""Numbers of two runs are compared each with its own tolerance, and a verdict that would change is named."""

import json
import math
import os
import re

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from cointoss.study import Estimate
from cointoss_reproduction.frame import provenance
from cointoss_reproduction.frame.checking import BESIDE, COUNT, ESTIMATE, PRINTED, SMALL, _columns, compared
from saved import fake
from tests.helpers.command_line import cointoss, refused

CODE = """
from cointoss.study import share_of
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study

LENGTH = 0.123456

def cell(coin):
    return {"length": LENGTH, "share": share_of(50, 100)}

REPRODUCTION = study(__name__, Cells(cell, {"coin": ("thin", "thick")}))
"""
SAID = """
title = "a fake"
seconds = 0

[measure.length]
value = "length"
take = "max"

[measure.share]
value = "share"
where = "coin == 'thin'"

[[claim]]
claim = "it is short"
criteria = [["length", "length", "<", 1.0, "a metre"], ["share", "share", "<", 0.9, "so"]]
"""
LONGER = ("LENGTH = 0.123456", "LENGTH = 1.5")


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """Return the folder of a run of a fake study, and what changes its code or what it says."""

    def write(before="", after="", *, said=SAID):
        fake(monkeypatch, tmp_path / "studies", "fake", CODE.replace(before, after) if before else CODE, said)

    write()
    assert cointoss("reproduce", "fake", "--out", tmp_path / "kept").exit_code == 0
    return tmp_path / "kept", write


def check(folder):
    answered = cointoss("reproduce", "fake", "--check", folder)
    return answered.exit_code, answered.stdout.splitlines()


def of(folder, name):
    return folder / "reproduction" / "fake" / name


CLAIM = SAID[SAID.index("[[claim]]") :]
LAST_BIT = ("LENGTH = 0.123456", "LENGTH = 0.12345600000000001")
CHANGED = {
    "nothing": (
        (), SAID, True, 0, 0, ["fake: 0 of 1 verdicts change, 0 of 8 numbers are off", "  8 equal to the bit"]
    ),
    "a last bit": (LAST_BIT, SAID, True, 1, 3, ["fake: 0 of 1 verdicts change, 3 of 8 numbers are off"]),
    "a last bit elsewhere": (LAST_BIT, SAID, False, 0, 0, ["  not to the bit: no provenance.json there"]),
    "words": (
        (), f'{SAID}mujoco = "by 0.2"\n', True, 1, 0, ["  in other words: it is short: - there, by 0.2 here"]
    ),
    "words elsewhere": (
        (), f'{SAID}mujoco = "by 0.2"\n', False, 0, 0, ["  in other words: it is short: - there, by 0.2 here"]
    ),
    "a verdict": (
        LONGER, SAID, True, 1, 3,
        [
            "  changes: it is short: holds there, does not hold here",
            "  off: it is short: length: 0.123456 there, 1.5 here",
            "  off: cells.csv length[0]: 0.123456 there, 1.5 here",
        ],
    ),
    "more claims": (
        (), SAID + CLAIM + CLAIM.replace("short", "new"), True, 1, 0,
        [
            "fake: 2 of 3 verdicts change, ",
            "  changes: it is short (2): no such claim there, holds here",
            "  changes: it is new: no such claim there, holds here",
        ],
    ),
    "fewer criteria": (
        (), SAID.replace(', ["share", "share", "<", 0.9, "so"]', ""), True, 1, 1,
        ["  off: it is short: 2 criteria there, 1 criteria here"],
    ),
    "fewer rows": (
        ('("thin", "thick")', '("thin",)'), SAID, True, 1, 3,
        ["  off: cells.csv length: 2 rows there, 1 rows here"],
    ),
    "more columns": (
        ('{"length": LENGTH,', '{"length": LENGTH, "width": 1,'), SAID, True, 1, 1,
        ["  off: cells.csv width: 0 rows there, 2 rows here"],
    ),
    # A hundredth of its threshold is rounding of what a claim measures.
    "a hundredth of the threshold": (
        ("LENGTH = 0.123456", "LENGTH = 0.133"), SAID, False, 1, 2, ["  off: cells.csv length[1]: 0.1"]
    ),
    "more than a hundredth": (
        ("LENGTH = 0.123456", "LENGTH = 0.134"), SAID, False, 1, 3, ["  off: it is short: length: 0.1"]
    ),
    "more than a hundredth of the smaller": (
        ("LENGTH = 0.123456", "LENGTH = 0.173456"), SAID.replace('"<", 1.0,', '"<", 10.0,'), False, 1, 3,
        ["  off: it is short: length: 0.123456 there"],
    ),
    "a time": (("LENGTH = 0.123456", "LENGTH = 0.9"), f"timed = true\n{SAID}", True, 0, 0, []),
    "a time and a verdict": (LONGER, f"timed = true\n{SAID}", True, 1, 0, []),
}  # fmt: skip


@pytest.mark.parametrize("what", CHANGED)
def test_what_a_run_changes_is_named(kept, what):
    folder, write = kept
    code, said, as_made, due, off, named = CHANGED[what]
    write(*code, said=said)
    if not as_made:
        of(folder, "provenance.json").unlink()
    status, lines = check(folder)
    assert status == due
    assert len([line for line in lines if line.startswith("  off: ")]) == off
    for start in named:
        assert any(line.startswith(start) for line in lines), f"{start} is not among {lines}"


def test_a_quick_run_is_compared_with_one_of_the_quick_size(kept):
    folder, write = kept
    sized = SAID + "\n[quick]\ntosses = 200\n"
    write("def cell(coin):", "def cell(coin, tosses=100):\n    LENGTH = tosses / 1000", said=sized)
    assert cointoss("reproduce", "fake", "--quick", "--out", folder).exit_code == 0
    assert "0.2" in of(folder, "cells.csv").read_text()
    assert cointoss("reproduce", "fake", "--quick", "--check", folder).exit_code == 0


def test_a_study_that_is_checked_compares_itself_with_what_was_kept_beside_it(kept):
    folder, write = kept
    (folder / "length").write_text("0.7")
    write("def cell(coin):", "def cell(coin, out=None):\n    LENGTH = float((out / 'length').read_text())")
    assert cointoss("reproduce", "fake", "--out", folder).exit_code == 0
    assert "0.7" in of(folder, "cells.csv").read_text()
    assert check(folder)[0] == 0


def test_what_cannot_be_compared_is_refused_before_any_work(kept, tmp_path):
    folder, write = kept
    write("def cell(coin):", "def cell(coin):\n    raise KeyboardInterrupt")
    assert "holds no claims.json" in refused("reproduce", "fake", "--check", tmp_path)
    assert "accepted: the same without --quick" in refused("reproduce", "fake", "--quick", "--check", folder)
    assert "not with --check" in refused("reproduce", "fake", "--out", tmp_path, "--check", folder)
    assert "comes after the names" in refused("reproduce", "--check", "fake")
    of(folder, "provenance.json").write_text("[]")
    assert "provenance.json: needs sources" in refused("reproduce", "fake", "--check", folder)
    for odd in ('{"a": 1}', '[{"claim": [5]}]', '[{"claim": "a"}]', '[{"claim": "a\\nb", "missing": "c"}]'):
        of(folder, "claims.json").write_text(odd)
        assert "claims.json: " in refused("reproduce", "fake", "--check", folder)


@pytest.mark.parametrize("odd", [b"coin,length\nthin\n", b"coin\n\xc3\n", b"", None])
def test_a_table_that_no_run_writes_is_refused_in_one_line(kept, odd):
    path = of(kept[0], "cells.csv")
    path.unlink()
    if odd is None:
        os.mkfifo(path)
    else:
        path.write_bytes(odd)
    assert "cells.csv: " in refused("reproduce", "fake", "--check", kept[0])


@pytest.mark.parametrize(
    "odd", ['"a"', "[[1, 2]]", "null", '{"value": "a", "low": 0, "high": 1, "count": 1}', 100_000 * "["]
)
def test_criteria_that_no_run_writes_are_refused_in_one_line(kept, odd):
    path = of(kept[0], "claims.json")
    text = path.read_text()
    for name in ("measured", "threshold"):
        other = re.sub(f'"{name}": [0-9.]+', lambda _, name=name: f'"{name}": {odd}', text, count=1)
        assert other != text
        path.write_text(other)
        assert "claims.json: " in refused("reproduce", "fake", "--check", kept[0])


def test_words_in_place_of_numbers_are_off(kept):
    path = of(kept[0], "cells.csv")
    path.write_text(path.read_text().replace("0.123456", "long"))
    status, lines = check(kept[0])
    assert status == 1
    assert lines[0].startswith("fake: 0 of 1 verdicts change, 2 of ")


@pytest.mark.parametrize(
    ("there", "here", "small", "agrees", "reason"),
    [
        (Estimate(0.5, 0.4, 0.6, 9), Estimate(0.59, 0.4, 0.6, 9), 0, True, ESTIMATE),
        (Estimate(0.5, 0.4, 0.6, 9), Estimate(0.61, 0.4, 0.7, 9), 0, False, ESTIMATE),
        (Estimate(0.5, 0.4, 0.6, 9), Estimate(0.55, 0.54, 0.56, 9), 0, False, ESTIMATE),
        # 2.58 √129 = 29.30, 2.58 √130 = 29.42; 2.58 √6 = 6.3, 2.58 √7 = 6.8
        (100, 129, 0, True, COUNT),
        (100, 130, 0, False, COUNT),
        (0, 6, 0, True, COUNT),
        (0, 7, 0, False, COUNT),
        (1.23, 1.2399, 0, True, PRINTED),
        (1.23, 1.2401, 0, False, PRINTED),
        (0.999, 1.0005, 0, True, PRINTED),
        (1.0005, 0.999, 0, True, PRINTED),
        (1e-15, 4e-15, 1e-10, True, SMALL),
        (1e-15, 2e-10, 1e-10, False, SMALL),
    ],
)
def test_each_kind_of_number_has_its_own_tolerance(there, here, small, agrees, reason):
    one = compared("here", there, here, exact=False, small=small)
    assert (one.agrees, one.reason) == (agrees, reason)


@pytest.mark.parametrize(
    ("beside", "there", "here", "agrees", "reason"),
    [
        (100.0, 1e-9, 0.09, True, BESIDE),
        (100.0, 1e-9, 0.2, False, BESIDE),
        (-100.0, 1e-9, 0.09, True, BESIDE),
        (1e-12, 1e-9, 1e-6, False, PRINTED),
    ],
)
def test_a_thousandth_of_the_largest_in_its_column_is_rounding(beside, there, here, agrees, reason):
    _, one = _columns({"x": [beside, there]}, {"x": [beside, here]}, exact=False)
    assert (one.agrees, one.reason) == (agrees, reason)


NUMBERS = st.integers(-200, 200) | st.floats(-200, 200)
ESTIMATES = st.lists(st.floats(0, 1), min_size=3, max_size=3).map(
    lambda ends: Estimate(sorted(ends)[1], min(ends), max(ends), 100)
)
COLUMN = st.lists(NUMBERS | ESTIMATES | st.sampled_from([None, "so", True]), max_size=3)


@given(there=COLUMN, here=COLUMN)
@example(there=[0], here=[1])
@example(there=[1.0], here=[1000.0])
def test_two_runs_agree_alike_whichever_is_the_earlier(there, here):
    one, other = (
        [(found.place, found.agrees, found.reason) for found in _columns({"x": a}, {"x": b}, exact=False)]
        for a, b in ((there, here), (here, there))
    )
    assert one == other


@pytest.mark.parametrize("exact", [True, False])
def test_shares_of_no_trials_agree(exact):
    none = Estimate(math.nan, 0.0, 1.0, 0)
    assert compared("", none, Estimate(math.nan, 0.0, 1.0, 0), exact=exact).agrees
    assert not compared("", none, Estimate(0.5, 0.0, 1.0, 0), exact=exact).agrees
    assert not compared("", None, 1.0, exact=exact).agrees


def test_other_versions_and_machines_are_told_in_words(monkeypatch, tmp_path):
    one = provenance.provenance(tmp_path, quick=False)
    assert provenance.unlike(one, one) == ""
    monkeypatch.setattr("platform.machine", lambda: "generic")
    other = provenance.provenance(tmp_path, quick=False)
    assert provenance.unlike(one, other).endswith("there, generic here")
    assert provenance.unlike({**one, "sources": "0"}, one) == "other sources"
    assert json.loads(json.dumps(one)) == one
