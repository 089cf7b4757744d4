"""A claim's verdict follows from measured quantities and thresholds, which are printed beside it."""

import json
import math
from functools import partial

import numpy as np
import pytest
from matplotlib.figure import Figure

from cointoss.compare.metrics.estimates import share_of
from cointoss_reproduction.frame import gallery, runner
from cointoss_reproduction.frame.claim import (
    Claim,
    Criterion,
    Estimate,
    criteria_of,
    needed_of,
    read_claims,
    to_json,
    unexpected,
)
from cointoss_reproduction.frame.result import Reproduction, Result
from saved import DOCS, unseen

KNOWN = Claim(
    claim="two and two are four", analytic="4", mujoco="4", criteria=(Criterion("sum", 4, "=", 4, "no more"),)
)
REFUTED = Claim(
    claim="two and two are five",
    analytic="4",
    criteria=(Criterion("sum", 4, "=", 5, "as printed"), Criterion("error [1]", 1e-20, "<", 0.5, "rounding")),
    expected=False,
)


@pytest.mark.parametrize(
    ("relation", "met"),
    [("<", (1, 0, 0)), ("≤", (1, 1, 0)), ("=", (0, 1, 0)), ("≥", (0, 1, 1)), (">", (0, 0, 1))],
)
def test_a_criterion_is_met_on_the_right_side_of_its_threshold(relation, met):
    found = [Criterion("x", value, relation, 2.0, "") for value in (1.0, 2.0, 3.0)]
    assert [each.is_met for each in found] == [bool(one) for one in met]
    assert not Criterion("x", math.nan, relation, 2.0, "").is_met


def test_a_claim_holds_where_all_its_criteria_are_met():
    assert (KNOWN.holds, REFUTED.holds) == (True, False)
    assert (KNOWN.verdict, REFUTED.verdict) == ("holds", "does not hold")
    with pytest.raises(ValueError, match="accepted: one or more"):
        Claim(claim="so it is", criteria=[])


def test_a_share_of_no_trials_decides_nothing():
    claim = Claim(claim="often", criteria=[Criterion("x", share_of(0, 0, "spins"), ">", 0.5, "")])
    assert claim.holds is None
    assert claim.verdict == "cannot be tested: there were no spins"


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(2.1, 3.1, True), (1.0, 1.9, False), (1.9, 3.0, None), (2.0, 3.0, None), (1.0, 2.0, None)],
)
def test_an_estimate_decides_where_its_interval_leaves_the_threshold_out(low, high, verdict):
    criterion = Criterion("x", Estimate((low + high) / 2, low, high, 400), ">", 2.0, "")
    assert criterion.is_met is verdict
    assert Claim(claim="more than two", criteria=[criterion]).holds is verdict


@pytest.mark.parametrize(
    ("low", "high", "verdict"),
    [(-0.5, 0.5, True), (1.1, 1.9, False), (-3.0, -1.2, False), (0.5, 1.5, None), (-2.0, 2.0, None)],
)
def test_a_difference_is_within_a_threshold_on_both_sides(low, high, verdict):
    criterion = Criterion("x", Estimate((low + high) / 2, low, high, 400), "within ±", 1.0, "")
    assert criterion.is_met is verdict
    assert (criterion.wanted == "") is (verdict is not None)


def test_a_claim_that_cannot_be_tested_says_what_would_decide_it():
    close = Criterion("x", Estimate(0.52, 0.46, 0.58, 400), ">", 0.5, "chance")
    claim = Claim(
        claim="more than half",
        criteria=[
            *KNOWN.criteria,
            Criterion("y", Estimate(0.5, 0.495, 0.505, 9), ">", 0.4, "less"),
            close,
        ],
        expected=None,
    )
    # Nine times the tosses have a third of the interval.
    assert claim.verdict == "cannot be tested: about 3,600 tosses would decide it (there were 400)"
    assert criteria_of(claim) == (
        "sum: 4 (= 4); y: 0.5000 [0.4950, 0.5050] (> 0.4); x: 0.520 [0.460, 0.580] (> 0.5)"
    )
    assert Claim(claim="x", criteria=[close, REFUTED.criteria[0]]).holds is False
    even = Criterion("x", Estimate(0.5, 0.46, 0.54, 400), ">", 0.5, "chance")
    assert even.wanted == "no number of tosses would decide it"
    unsaid = Claim(claim="as printed", missing="the paper names no coin", criteria=REFUTED.criteria)
    assert unsaid.verdict == "cannot be tested: the paper names no coin"
    assert unexpected((claim, unsaid)) == ("as printed",)
    assert unexpected((claim, unsaid), quick=True) == ()


@pytest.mark.parametrize("threshold", [4, 5])
def test_a_verdict_that_is_not_the_known_one_is_unexpected(threshold):
    criteria = [Criterion("sum", 4, "=", threshold, "")]
    other = Claim(claim="it rains", criteria=criteria, expected=threshold != 4)
    assert unexpected((KNOWN, other, REFUTED)) == ("it rains",)


def test_claims_are_read_as_they_were_written_and_judged_anew(tmp_path):
    numbers = Claim(
        claim="n",
        criteria=(
            Criterion("n", np.arange(4).max(), "<", np.float64(4), ""),
            Criterion("share", Estimate(0.5, np.float64(0.4), 0.6, 9), "<", 0.55, ""),
        ),
        expected=None,
    )
    path = tmp_path / "claims.json"
    path.write_text(to_json((KNOWN, REFUTED, numbers)), encoding="utf-8")
    assert read_claims(path) == (KNOWN, REFUTED, numbers)
    listed = json.loads(path.read_text(encoding="utf-8"))
    assert [one["holds"] for one in listed] == [True, False, None]
    listed[0]["criteria"][0]["measured"] = 5
    path.write_text(json.dumps(listed), encoding="utf-8")
    assert not read_claims(path)[0].holds


def test_a_run_leaves_its_claims_its_data_and_its_pictures(tmp_path, monkeypatch):
    def make(progress, size=4.0):
        progress(1, 1)
        return Result(claims=(KNOWN, REFUTED), data={"sum": np.array([size])})

    found = Reproduction(
        title="a sum",
        seconds=1,
        make=make,
        draw={"figure": lambda data: Figure(figsize=(data["sum"][0], 3))},
        quick=partial(make, size=1.0),
        paper="Fig. 0",
    )
    monkeypatch.setattr(runner, "find", lambda _: found)
    assert runner.reproduce("sum", tmp_path, unseen).claims == (KNOWN, REFUTED)
    folder = tmp_path / "reproduction" / "sum"
    written = sorted(path.name for path in folder.iterdir())
    assert written == ["claims.json", "data.npz", "figure.png", "index.md", "provenance.json"]
    assert read_claims(folder / "claims.json") == (KNOWN, REFUTED)
    assert np.load(folder / "data.npz")["sum"] == [4.0]
    assert runner.reproduce("sum", tmp_path, unseen, quick=True).data["sum"] == [1.0]


def seconds(name: str) -> float:
    found = runner.find(name)
    return found.quick_seconds or found.seconds


@pytest.mark.slow_after_first
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.long if seconds(name) >= 10 else ())
        for name in gallery.of_paper()
    ],
)
def test_the_papers_claims_are_those_saved_and_come_out_as_known(name, tmp_path):
    result = runner.reproduce(name, tmp_path, unseen, quick=True)
    assert unexpected(result.claims, quick=True) == ()
    folder = runner.folder_of(name, tmp_path)
    assert (folder / "figure.png").stat().st_size < 150_000
    saved = read_claims(runner.folder_of(name, DOCS) / "claims.json")
    assert [claim.claim for claim in result.claims] == [claim.claim for claim in saved]
    assert [claim.expected for claim in result.claims] == [claim.expected for claim in saved]


@pytest.mark.parametrize(
    ("threshold", "needed"),
    [
        (0.45, 400),  # 100 (0.1 / 0.05)²
        (0.6, 400),  # 100 (0.2 / 0.1)²
        (0.53, 4500),  # 100 (0.2 / 0.03)², to two digits upwards
        (0.7, 100),
        (0.9, 25),
        (0.5, None),
        (0.5 + 1e-6, None),
    ],
)
def test_as_many_are_needed_as_shrink_the_interval_to_the_threshold(threshold, needed):
    assert needed_of(Estimate(0.5, 0.4, 0.7, 100), threshold) == needed
    assert needed_of(share_of(0, 0), threshold) is None
