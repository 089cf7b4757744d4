"""Reproduced figures of the paper: what they leave, and that a claim that turns out otherwise is told."""

import json
from functools import partial

import numpy as np
import pytest
from matplotlib.figure import Figure as Picture

from compare.reproduction import gallery, runner
from compare.reproduction.findings import FILES, Finding, Result, failed, paper_figure, read_findings, table


def unseen(done: int, whole: int) -> None:
    assert done <= whole


KNOWN = Finding(claim="two and two are four", ours="4", mujoco="4", holds=True)
REFUTED = Finding(claim="two and two are five", ours="4", holds=False, expected=False)


def test_a_figure_leaves_its_findings_its_numbers_and_its_picture(tmp_path):
    made = []

    def make(progress, size="full"):
        progress(1, 1)
        made.append(size)
        return result

    result = Result(findings=(KNOWN, REFUTED), draw=Picture, data={"sum": np.array([4.0])})
    figure = paper_figure(
        paper="Fig. 0",
        title="a sum",
        assumed="",
        seconds=1,
        make=make,
        quick=partial(make, size="quick"),
    )
    answer = figure.run(tmp_path, unseen)
    assert answer.text == table((KNOWN, REFUTED))
    assert answer.failed == ()
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(FILES)
    assert read_findings(tmp_path) == (KNOWN, REFUTED)
    assert np.load(tmp_path / "data.npz")["sum"] == [4.0]
    assert figure.quick is not None
    figure.quick(tmp_path, unseen)
    assert made == ["full", "quick"]


def test_the_table_says_what_holds():
    assert table((KNOWN, REFUTED)).splitlines()[2:] == [
        "| two and two are four | 4 | 4 | holds |",
        "| two and two are five | 4 | - | does not hold |",
    ]


@pytest.mark.parametrize("holds", [True, False])
def test_a_claim_that_does_not_come_out_as_known_fails(holds):
    other = Finding(claim="it rains", ours="", holds=holds, expected=not holds)
    assert failed((KNOWN, other, REFUTED)) == ("it rains",)


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow if runner.find(name).quick_seconds >= 10 else ())
        for name in gallery.of_paper()
    ],
)
def test_the_papers_claims_come_out_as_known(name, tmp_path):
    quick = runner.find(name).quick
    assert quick is not None
    made = quick(tmp_path, unseen)
    assert made.failed == ()
    assert (tmp_path / "figure.png").stat().st_size < 150_000
    listed = json.loads((tmp_path / "findings.json").read_text(encoding="utf-8"))
    assert len(listed) == made.text.count("\n") - 1
