"""Numbers of two runs are compared each with its own tolerance, and a verdict that would change is named."""

import json
import math
import os
import re
import sys

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from cointoss_reproduction import studies
from cointoss_reproduction.frame import provenance
from cointoss_reproduction.frame.checking import BESIDE, COUNT, ESTIMATE, PRINTED, SMALL, compared
from tests.helpers.command_line import cointoss, refused

FAKE = """
from dataclasses import dataclass
from cointoss_reproduction.frame.claim import Claim, Criterion, Estimate
from cointoss_reproduction.frame.result import Reproduction, Result

@dataclass
class Numbers:
    length: float
    faces: list

def make(progress):
    share = Estimate(0.5, 0.45, 0.55, 600)
    criteria = [Criterion("length", LENGTH, "<", 1.0, "a metre"), Criterion("share", share, "<", 0.6, "so")]
    return Result(claims=[Claim(claim="it is short", criteria=criteria)], data=Numbers(LENGTH, [40, 60]))

LENGTH = 0.123456
REPRODUCTION = Reproduction(title="a fake", seconds=0, make=make, draw={}, timed=TIMED)
"""


@pytest.fixture
def fake(tmp_path, monkeypatch):
    """Return the folder of a run of a fake study, and what changes its code."""
    folder = tmp_path / "studies"
    folder.mkdir()
    monkeypatch.setattr(studies, "__path__", [*studies.__path__, str(folder)])

    def write(before="", after="", *, timed="False"):
        sys.modules.pop(f"{studies.__name__}.fake", None)
        text = FAKE.replace("TIMED", timed).replace(before, after) if before else FAKE.replace("TIMED", timed)
        (folder / "fake.py").write_text(text + f"# {len(list(folder.iterdir()))} {before} {after}\n")
        for bytecode in folder.glob("__pycache__/*"):
            bytecode.unlink()

    write()
    assert cointoss("reproduce", "fake", "--out", tmp_path / "kept").exit_code == 0
    yield tmp_path / "kept", write
    sys.modules.pop(f"{studies.__name__}.fake", None)


def check(kept):
    answered = cointoss("reproduce", "fake", "--check", kept)
    return answered.exit_code, answered.stdout.splitlines()


def test_the_same_run_agrees_to_the_bit(fake):
    kept, _ = fake
    status, lines = check(kept)
    assert status == 0
    assert lines[0].startswith("fake: 0 of 1 verdicts change, 0 of 9 numbers are off")
    assert lines[1:] == ["  9 equal to the bit"]


def test_a_last_bit_is_off_where_bits_are_the_same_and_not_elsewhere(fake):
    kept, write = fake
    write("LENGTH = 0.123456", "LENGTH = 0.12345600000000001")
    status, lines = check(kept)
    assert status == 1
    assert len([line for line in lines if line.startswith("  off: ")]) == 2
    (kept / "reproduction" / "fake" / "provenance.json").unlink()
    status, lines = check(kept)
    assert status == 0
    assert lines[1] == "  not to the bit: no provenance.json there"


def test_words_that_a_claim_says_otherwise_are_shown_and_are_off_where_bits_are_the_same(fake):
    kept, write = fake
    write('claim="it is short",', 'claim="it is short", mujoco="by 0.2",')
    status, lines = check(kept)
    assert status == 1
    assert lines[-1] == "  in other words: it is short: - there, by 0.2 here"
    (kept / "reproduction" / "fake" / "provenance.json").unlink()
    status, lines = check(kept)
    assert status == 0
    assert lines[-1].startswith("  in other words: ")


def test_words_that_a_run_does_not_have_are_other_words(fake):
    kept, _ = fake
    file = kept / "reproduction" / "fake" / "claims.json"
    listed = json.loads(file.read_text())
    del listed[0]["mujoco"]
    file.write_text(json.dumps(listed))
    status, lines = check(kept)
    assert status == 1
    assert lines[-1] == f"  in other words: {listed[0]['claim']}: nothing there, - here"


def test_a_claim_that_would_change_and_a_number_that_is_off_are_named(fake):
    kept, write = fake
    write("LENGTH = 0.123456", "LENGTH = 1.5")
    status, lines = check(kept)
    assert status == 1
    assert "  changes: it is short: holds there, does not hold here" in lines
    assert any(line.startswith("  off: numbers.json length: 0.123456 there, 1.5 here") for line in lines)


def test_claims_and_criteria_that_one_run_alone_has_are_off(fake):
    kept, write = fake
    claim = 'Claim(claim="it is short", criteria=criteria)'
    write(claim, f"{claim}, {claim}, {claim.replace('short', 'new')}")
    status, lines = check(kept)
    assert status == 1
    assert lines[0].startswith("fake: 2 of 3 verdicts change, ")
    for name in ("it is short (2)", "it is new"):
        assert f"  changes: {name}: no such claim there, holds here" in lines
    write(', Criterion("share", share, "<", 0.6, "so")', "")
    status, lines = check(kept)
    assert status == 1
    assert any(line.startswith("  off: it is short: 2 criteria there, 1 criteria here") for line in lines)


def test_a_hundredth_of_its_threshold_is_rounding_of_what_a_claim_measures(fake):
    kept, write = fake
    (kept / "reproduction" / "fake" / "provenance.json").unlink()
    for length, off in (
        ("0.133", ["numbers.json length"]),
        ("0.134", ["it is short: length", "numbers.json length"]),
    ):
        write("LENGTH = 0.123456", f"LENGTH = {length}")
        found = [line.removeprefix("  off: ") for line in check(kept)[1] if line.startswith("  off: ")]
        assert [place.partition(": 0.1")[0] for place in found] == off


def test_of_times_the_verdicts_alone_are_compared(fake):
    kept, write = fake
    write("LENGTH = 0.123456", "LENGTH = 0.9", timed="True")
    assert check(kept)[0] == 0
    write("LENGTH = 0.123456", "LENGTH = 1.5", timed="True")
    assert check(kept)[0] == 1


def test_what_cannot_be_compared_is_refused_before_any_work(fake, tmp_path):
    kept, write = fake
    write("def make(progress):", "def make(progress):\n    raise KeyboardInterrupt")
    assert "holds no claims.json" in refused("reproduce", "fake", "--check", tmp_path)
    assert "accepted: the same without --quick" in refused("reproduce", "fake", "--quick", "--check", kept)
    (kept / "reproduction" / "fake" / "provenance.json").write_text("[]")
    assert "provenance.json: needs sources" in refused("reproduce", "fake", "--check", kept)
    (kept / "reproduction" / "fake" / "claims.json").write_text('{"a": 1}')
    assert "claims.json: " in refused("reproduce", "fake", "--check", kept)
    for odd in (
        '{"claim": [5], "holds": true}',
        '{"claim": "a", "holds": "yes"}',
        '{"claim": "a\\nb", "holds": null}',
    ):
        (kept / "reproduction" / "fake" / "claims.json").write_text(f"[{odd}]")
        assert "claims.json: claim 1: " in refused("reproduce", "fake", "--check", kept)
    assert "not with --check" in refused("reproduce", "fake", "--out", tmp_path, "--check", kept)
    assert "comes after the names" in refused("reproduce", "--check", "fake")


@pytest.mark.parametrize(
    ("odd", "named"),
    [
        ('{"length": 1e400}', "1e400: no finite number"),
        ('{"length": NaN}', "NaN: no finite number"),
        ('{"faces": [-Infinity]}', "-Infinity: no finite number"),
        ('{"length": 1' + 400 * "0" + "}", "a whole number of 401 digits"),
        ('{"share": {"value": "a", "low": 0, "high": 1}}', "high 1, low 0, value 'a': no numbers"),
        ('{"share": {"value": [[1]], "low": 0, "high": 1}}', "value [[1]]: no numbers"),
        (100_000 * "[", "recursion"),
        ("", "Expecting value"),
        (b'{"a": \xc3}', "decode"),
        (None, "a pipe that nobody writes to"),
    ],
)
def test_numbers_that_no_run_writes_are_refused_in_one_line(fake, odd, named):
    kept, _ = fake
    path = kept / "reproduction" / "fake" / "numbers.json"
    if odd is None:
        path.unlink()
        os.mkfifo(path)
    else:
        path.write_bytes(odd if isinstance(odd, bytes) else odd.encode())
    told = refused("reproduce", "fake", "--check", kept)
    assert "numbers.json: " in told
    assert named in told


@pytest.mark.parametrize(
    "odd", ['"a"', "[[1, 2]]", "1" + 30 * "0", "null", '{"value": "a", "low": 0, "high": 1}']
)
def test_criteria_that_no_run_writes_are_refused_in_one_line(fake, odd):
    kept, _ = fake
    path = kept / "reproduction" / "fake" / "claims.json"
    text = path.read_text()
    for name in ("measured", "threshold"):
        other = re.sub(f'"{name}": [0-9.]+', lambda _, name=name: f'"{name}": {odd}', text, count=1)
        assert other != text
        path.write_text(other)
        assert "claims.json: claim 1: " in refused("reproduce", "fake", "--check", kept)


def test_text_and_lists_in_place_of_numbers_are_off(fake):
    kept, _ = fake
    path = kept / "reproduction" / "fake" / "numbers.json"
    path.write_text('{"length": "a", "faces": [[40], 60]}')
    status, lines = check(kept)
    assert status == 1
    assert lines[0].startswith("fake: 0 of 1 verdicts change, 2 of ")


def alike(there, here, **how):
    (one,) = compared("here", there, here, exact=False, **how)
    return one.agrees, one.reason


def test_each_kind_of_number_has_its_own_tolerance():
    estimate = {"value": 0.5, "low": 0.4, "high": 0.6, "count": 100}
    assert alike(estimate, {**estimate, "value": 0.59}) == (True, ESTIMATE)
    assert alike(estimate, {**estimate, "value": 0.61, "high": 0.7}) == (False, ESTIMATE)
    assert alike(estimate, {"value": 0.55, "low": 0.54, "high": 0.56}) == (False, ESTIMATE)
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
    assert [one.agrees for one in compared("", [100.0, 1e-9], [100.0, 0.09], exact=False)] == [True, True]
    assert [one.reason for one in compared("", [100.0, 1e-9], [100.0, 0.2], exact=False)] == [PRINTED, BESIDE]
    assert [one.agrees for one in compared("", [100.0, 1e-9], [100.0, 0.2], exact=False)] == [True, False]


NUMBERS = st.integers(-200, 200) | st.floats(-200, 200)
ESTIMATES = st.tuples(*3 * [st.floats(0, 1)]).map(
    lambda ends: dict(zip(("low", "value", "high"), sorted(ends), strict=True))
)
VALUES = st.recursive(
    NUMBERS | ESTIMATES | st.sampled_from([None, "so", True]),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.sampled_from("ab"), inner),
)


@given(there=VALUES, here=VALUES, small=st.sampled_from([0.0, 1.0]))
@example(there=0, here=1, small=0.0)
@example(there=[1.0], here=[1000.0], small=0.0)
def test_two_runs_agree_alike_whichever_is_the_earlier(there, here, small):
    def kinds(*runs):
        found = compared("here", *runs, exact=False, small=small)
        return sorted((one.place, one.agrees, one.reason) for one in found)

    assert kinds(there, here) == kinds(here, there)


def test_criteria_of_other_thresholds_agree_alike_whichever_is_the_earlier(fake):
    kept, write = fake
    (kept / "reproduction" / "fake" / "provenance.json").unlink()
    write('LENGTH, "<", 1.0,', 'LENGTH + 0.05, "<", 10.0,')
    assert any("off: it is short: length: 0.123456 there" in line for line in check(kept)[1])


def test_shares_of_no_trials_agree():
    none = {"value": math.nan, "low": 0.0, "high": 1.0, "count": 0}
    for exact in (True, False):
        assert all(one.agrees for one in compared("", none, dict(none), exact=exact))
        assert not all(one.agrees for one in compared("", none, {**none, "value": 0.5}, exact=exact))


def test_what_is_missing_on_either_side_is_off():
    assert [one.agrees for one in compared("", {"a": 1}, {"b": 1}, exact=False)] == [False, False]
    assert [one.agrees for one in compared("", [1, 2], [1], exact=True)] == [False, True]
    assert [one.agrees for one in compared("", None, 1.0, exact=False)] == [False]


def test_other_versions_and_machines_are_told_in_words(monkeypatch, tmp_path):
    one = provenance.provenance(tmp_path, quick=False)
    assert provenance.unlike(one, one) == ""
    monkeypatch.setattr("platform.machine", lambda: "generic")
    other = provenance.provenance(tmp_path, quick=False)
    assert provenance.unlike(one, other).endswith("there, generic here")
    assert provenance.unlike({**one, "sources": "0"}, one) == "other sources"
    assert json.loads(json.dumps(one)) == one
