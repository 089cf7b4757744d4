"""The pages over all reproduced figures: their order, what they show, and that docs/ has the saved one."""

import csv
import re

import numpy as np
import pytest
from matplotlib.figure import Figure

from cointoss_reproduction.frame import gallery, runner
from cointoss_reproduction.frame.claim import Claim, Criterion, unexpected
from cointoss_reproduction.frame.result import Reproduction, Result
from saved import DOCS
from tests.helpers.command_line import cointoss


def test_figures_stand_in_the_papers_order():
    places = [runner.find(name).paper for name in gallery.of_paper()]
    numbers = [int(re.findall(r"\d+", place)[0]) for place in places if place.startswith("Fig")]
    assert numbers == sorted(numbers)
    kinds = [place.split()[0].rstrip("s.") for place in places]
    assert kinds == sorted(kinds, key=("Table", "Fig", "Section", "Claim").index)


def test_no_figure_of_the_paper_is_missing():
    places = [*(runner.find(name).paper for name in gallery.of_paper()), *gallery.SKETCHES]
    found = []
    for place in places:
        if place.startswith("Fig"):
            numbers = [int(number) for number in re.findall(r"\d+", place.split(", section")[0])]
            found += range(numbers[0], numbers[1] + 1) if "-" in place else numbers
    assert sorted(found) == list(range(1, 33))
    assert "Table 1" in places


@pytest.fixture
def made(tmp_path, monkeypatch):
    """Put two small figures in the place of the paper's and run `cointoss reproduce all`."""
    figures = {
        name: Reproduction(
            paper=place,
            title=f"a <sum> of {place}",
            assumed="that it rains",
            seconds=1,
            make=lambda progress, holds=holds: result(progress, holds),
            draw={"figure": lambda _: Figure()},
        )
        for name, place, holds in (
            ("second", "Fig. 10", False),
            ("first", "Fig. 9", True),
            ("third", "Fig. 11", None),
        )
    }
    monkeypatch.setattr(runner, "names", lambda: sorted(figures))
    monkeypatch.setattr(runner, "find", figures.__getitem__)
    monkeypatch.setattr(runner, "told", lambda name: {"paper": figures[name].paper})
    sources = (("missing", "figure.png"), ("first", "figure.png"))
    monkeypatch.setattr(gallery, "MAIN", (gallery.MainClaim(says="two is more", sources=sources),))
    answered = cointoss("reproduce", "all", "--quick", "--out", tmp_path)
    assert answered.exit_code == 0
    return tmp_path


def result(progress, holds):
    progress(1, 1)
    criterion = Criterion("one", 1, "<", 2 if holds else 0, "it <is> so")
    missing = "the paper has no two" if holds is None else ""
    claim = Claim(
        claim="1 < 2",
        headline="So it is.",
        analytic="so it is",
        criteria=[criterion],
        missing=missing,
        expected=holds,
    )
    kept = Claim(claim="0 < 1", criteria=[Criterion("nought", 0, "<", 1, "so")], regression=True)
    return Result(claims=(kept, claim), data={"one": np.ones(1)})


@pytest.mark.slow
def test_all_makes_a_table_of_verdicts_and_a_gallery(made):
    page = (made / "REPRODUCTION.md").read_text(encoding="utf-8")
    rows = [
        "| the paper | what it shows | its claims |",
        "| Fig. 9 | [a <sum> of Fig. 9](reproduction/first/index.md) | 1 holds |",
        "| Fig. 10 | [a <sum> of Fig. 10](reproduction/second/index.md) | 1 does not hold |",
        "| Fig. 11 | [a <sum> of Fig. 11](reproduction/third/index.md) | 1 cannot be tested |",
    ]
    assert sorted(rows, key=page.index) == rows
    assert "Of 3 claims of the paper" in page
    assert "it cites, 1 holds, 1 does not hold and 1 cannot be tested." in " ".join(page.split())
    assert "- **two is more** So it is.\n\n![two is more](reproduction/first/figure.png)" in page
    assert "cointoss reproduce all --quick --out docs" in page
    assert "definition: Fig. 1, Keller's coin" in page
    head, *rows = csv.reader((made / "claims.csv").read_text(encoding="utf-8").splitlines())
    assert [row[head.index("claimed")] for row in rows] == 3 * ["no", "yes"]
    first = (made / "reproduction" / "first" / "index.md").read_text(encoding="utf-8")
    parts = ("# Fig. 9: 1 &lt; 2\n", "**Claims:** 1 holds.", "## holds: 1 &lt; 2\n", "**Regression tests:**")
    parts += ("## holds: 0 &lt; 1\n",)
    assert sorted(map(first.index, parts)) == [first.index(part) for part in parts]
    for name in ("first", "second", "third"):
        assert "cointoss reproduce" in (made / "reproduction" / name / "index.md").read_text(encoding="utf-8")
    shown = (made / "gallery.html").read_text(encoding="utf-8")
    assert "a &lt;sum&gt; of Fig. 9" in shown
    assert "(&lt; 2: it &lt;is&gt; so)" in shown
    assert shown.count("data:image/png;base64,") == 4
    for kind, verdict in (("holds", "holds"), ("fails", "does not hold"), ("open", "cannot be tested: the")):
        assert f'class="{kind}">{verdict}' in shown


def test_a_page_in_the_way_is_refused_before_any_work(made, tmp_path):
    (tmp_path / "gallery.html").unlink()
    (tmp_path / "gallery.html").mkdir()
    answered = cointoss("reproduce", "all", "--out", made)
    assert (answered.exit_code, answered.stdout) == (2, "")
    assert "gallery.html" in answered.stderr


def test_the_page_in_docs_shows_the_saved_findings():
    shown = gallery.entries(DOCS, gallery.of_paper())
    table, sheet = ((DOCS / page).read_text(encoding="utf-8") for page in gallery.PAGES[:2])
    assert table == gallery.markdown(DOCS, shown, quick=False)
    assert sheet == gallery.claims_sheet(shown)
    for entry in shown:
        assert entry.picture.stat().st_size < 150_000
        assert unexpected(entry.claims) == ()
