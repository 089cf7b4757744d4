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


def test_the_same_run_agrees_to_the_bit(kept):
    status, lines = check(kept[0])
    assert status == 0
    assert lines[0].startswith("fake: 0 of 1 verdicts change, 0 of 8 numbers are off")
    assert lines[1:] == ["  8 equal to the bit"]


def test_a_last_bit_is_off_where_bits_are_the_same_and_not_elsewhere(kept):
    folder, write = kept
    write("LENGTH = 0.123456", "LENGTH = 0.12345600000000001")
    status, lines = check(folder)
    assert status == 1
    assert len([line for line in lines if line.startswith("  off: ")]) == 3
    of(folder, "provenance.json").unlink()
    status, lines = check(folder)
    assert status == 0
    assert lines[1] == "  not to the bit: no provenance.json there"


def test_words_that_a_claim_says_otherwise_are_shown_and_are_off_where_bits_are_the_same(kept):
    folder, write = kept
    write(said=f'{SAID}mujoco = "by 0.2"\n')
    status, lines = check(folder)
    assert status == 1
    assert lines[-1] == "  in other words: it is short: - there, by 0.2 here"
    of(folder, "provenance.json").unlink()
    status, lines = check(folder)
    assert status == 0
    assert lines[-1].startswith("  in other words: ")


def test_a_claim_that_would_change_and_a_number_that_is_off_are_named(kept):
    folder, write = kept
    write(*LONGER)
    status, lines = check(folder)
    assert status == 1
    assert "  changes: it is short: holds there, does not hold here" in lines
    for place in ("it is short: length", "cells.csv length[0]"):
        assert any(line.startswith(f"  off: {place}: 0.123456 there, 1.5 here") for line in lines)


def test_claims_and_criteria_that_one_run_alone_has_are_off(kept):
    folder, write = kept
    claim = SAID[SAID.index("[[claim]]") :]
    write(said=SAID + claim + claim.replace("short", "new"))
    status, lines = check(folder)
    assert status == 1
    assert lines[0].startswith("fake: 2 of 3 verdicts change, ")
    for name in ("it is short (2)", "it is new"):
        assert f"  changes: {name}: no such claim there, holds here" in lines
    write(said=SAID.replace(', ["share", "share", "<", 0.9, "so"]', ""))
    status, lines = check(folder)
    assert status == 1
    assert any(line.startswith("  off: it is short: 2 criteria there, 1 criteria here") for line in lines)


def test_rows_and_columns_that_one_run_alone_has_are_off(kept):
    folder, write = kept
    write('("thin", "thick")', '("thin",)')
    assert any("off: cells.csv length: 2 rows there, 1 rows here" in line for line in check(folder)[1])
    write('{"length": LENGTH,', '{"length": LENGTH, "width": 1,')
    assert any("off: cells.csv width: 0 rows there, 2 rows here" in line for line in check(folder)[1])


def test_a_hundredth_of_its_threshold_is_rounding_of_what_a_claim_measures(kept):
    folder, write = kept
    of(folder, "provenance.json").unlink()
    table = ["cells.csv length[0]", "cells.csv length[1]"]
    for length, off in (("0.133", table), ("0.134", ["it is short: length", *table])):
        write("LENGTH = 0.123456", f"LENGTH = {length}")
        found = [line.removeprefix("  off: ") for line in check(folder)[1] if line.startswith("  off: ")]
        assert [place.partition(": 0.1")[0] for place in found] == off


def test_of_times_the_verdicts_alone_are_compared(kept):
    folder, write = kept
    write("LENGTH = 0.123456", "LENGTH = 0.9", said=f"timed = true\n{SAID}")
    assert check(folder)[0] == 0
    write(*LONGER, said=f"timed = true\n{SAID}")
    assert check(folder)[0] == 1


def test_a_run_of_another_size_is_compared_with_one_of_the_same_size(kept):
    folder, write = kept
    sized = 'settable = ["tosses", "device"]\n' + SAID
    write(
        "def cell(coin):", "def cell(coin, tosses=100, device='cpu'):\n    LENGTH = tosses / 1000", said=sized
    )
    assert (
        cointoss("reproduce", "fake", "--out", folder, "--set", "tosses=2e2", "--set", "device=b").exit_code
        == 0
    )
    assert json.loads(of(folder, "provenance.json").read_text())["sizes"] == {"tosses": 200, "device": "b"}
    assert "0.2" in of(folder, "cells.csv").read_text()
    assert check(folder)[0] == 0
    answered = cointoss("reproduce", "fake", "--set", "tosses=300", "--check", folder)
    assert answered.exit_code == 1
    assert "length[0]: 0.2 there, 0.3 here" in answered.stdout


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


def alike(there, here, **how):
    one = compared("here", there, here, exact=False, **how)
    return one.agrees, one.reason


def in_a_column(*there_and_here):
    found = _columns(*({"x": list(column)} for column in zip(*there_and_here, strict=True)), exact=False)
    return [(one.agrees, one.reason) for one in found]


def test_each_kind_of_number_has_its_own_tolerance():
    assert alike(Estimate(0.5, 0.4, 0.6, 9), Estimate(0.59, 0.4, 0.6, 9)) == (True, ESTIMATE)
    assert alike(Estimate(0.5, 0.4, 0.6, 9), Estimate(0.61, 0.4, 0.7, 9)) == (False, ESTIMATE)
    assert alike(Estimate(0.5, 0.4, 0.6, 9), Estimate(0.55, 0.54, 0.56, 9)) == (False, ESTIMATE)
    # 2.58 √129 = 29.30, 2.58 √130 = 29.42; 2.58 √6 = 6.3, 2.58 √7 = 6.8
    assert alike(100, 129) == (True, COUNT)
    assert alike(100, 130) == (False, COUNT)
    assert alike(0, 6) == (True, COUNT)
    assert alike(0, 7) == (False, COUNT)
    assert alike(1.23, 1.2399) == (True, PRINTED)
    assert alike(1.23, 1.2401) == (False, PRINTED)
    assert alike(0.999, 1.0005) == alike(1.0005, 0.999) == (True, PRINTED)
    assert alike(1e-15, 4e-15, small=1e-10) == (True, SMALL)
    assert alike(1e-15, 2e-10, small=1e-10) == (False, SMALL)
    assert in_a_column((100.0, 100.0), (1e-9, 0.09)) == [(True, PRINTED), (True, BESIDE)]
    assert in_a_column((100.0, 100.0), (1e-9, 0.2)) == [(True, PRINTED), (False, BESIDE)]


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


def test_criteria_of_other_thresholds_agree_alike_whichever_is_the_earlier(kept):
    folder, write = kept
    of(folder, "provenance.json").unlink()
    write("LENGTH = 0.123456", "LENGTH = 0.173456", said=SAID.replace('"<", 1.0,', '"<", 10.0,'))
    assert any("off: it is short: length: 0.123456 there" in line for line in check(folder)[1])


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
