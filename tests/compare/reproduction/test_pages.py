"""What pages show of results: claims unfold, long tables fold, with CSV beside; docs/ shows what was kept."""

import re

import pytest
from matplotlib.figure import Figure

from cointoss.compare.output.tables import OPEN, folded, sheets, table
from cointoss.compare.reproduction import pages, runner
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate, unexpected
from cointoss.compare.reproduction.result import Reproduction, Result
from tests.helpers.pages import DOCS, pictures, saved

WRITTEN = {
    name
    for page in DOCS.glob("*.md")
    for name in re.findall(
        r"<!-- written by: cointoss reproduce ([\w-]+) -->", page.read_text(encoding="utf-8")
    )
}
KEPT = [name for name in runner.names() if (runner.folder_of(name, DOCS) / "claims.json").exists()]
ROWS = [[f"`h` & {n}", f"{n}.5 % [{n}, {1000 * n:,d}]", f"{1000 * n:,d}"] for n in range(1, OPEN + 2)]
LONG = table(["coin `a|b`", "share", "tosses"], ROWS)
SHORT = table(["coin", "share"], [["a", "1"]] * OPEN)


def test_a_long_table_is_folded_with_its_file_beside_it_and_a_short_one_is_not():
    summary = f"<summary>coin <code>a|b</code>: {OPEN + 1} rows</summary>"
    unfolding = f"<details>\n{summary}\n\n{LONG}\n\n[As CSV](here/table-1.csv)\n\n</details>"
    assert folded(f"A:\n\n{SHORT}\n\n{LONG}\n\nB.", "here") == f"A:\n\n{SHORT}\n\n{unfolding}\n\nB."


def test_the_file_of_a_long_table_has_an_estimate_in_three_columns_and_plain_numbers():
    (name, text), *others = sheets(f"{SHORT}\n\n{LONG}").items()
    assert (name, others) == ("table-1.csv", [])
    assert text.splitlines()[:2] == [
        'coin `a|b`,share [%],"share, low [%]","share, high [%]",tosses',
        "`h` & 1,1.5,1,1000,1000",
    ]
    assert len(text.splitlines()) == OPEN + 2


CLAIMS = (
    Claim(claim="1 < 2", analytic="so it is", criteria=[Criterion("one [m]", 1, "<", 2, "it <is> so")]),
    Claim(claim="2 < 1", criteria=[Criterion("two", 2, "<", 1, "no"), Criterion("one", 1, "<", 2, "yes")]),
    Claim(claim="heads", criteria=[Criterion("share", Estimate(0.4, 0.3, 0.5, 100), "<", 0.45, "less")]),
    Claim(claim="tails", mujoco="one (of it; all); two", missing="a coin"),
)


def test_a_claim_unfolds_to_what_decides_it():
    text = pages.claims_of(CLAIMS)
    assert text.startswith("**Claims:** 1 holds, 1 does not hold and 2 cannot be tested.\n\n<details>\n")
    head = "| measured | found | threshold | its reason |\n| --- | --- | --- | --- |\n"
    assert (
        "<summary><b>holds:</b> 1 &lt; 2</summary>\n\n- Analytic: so it is\n\n"
        f"{head}| one [m] | 1 | < 2 | it <is> so |\n\n</details>"
    ) in text
    assert f"2 &lt; 1</summary>\n\n{head}| two | 2 | < 1 | no |\n| one | 1 | < 2 | yes |" in text
    assert "- Open: about 400 tosses would tell, not 100\n\n" in text
    assert text.endswith(
        "tails</summary>\n\n- MuJoCo:\n  - one (of it; all)\n  - two\n- Open: a coin\n\n</details>"
    )


def test_results_are_written_into_the_pages_that_have_a_place_for_them(tmp_path):
    place = "# A\n\n<!-- written by: cointoss reproduce {} -->\n\n{}\n\n<!-- end -->\n\nB\n"
    (tmp_path / "a.md").write_text(place.format("one", "old\n\nold") + place.format("two", "old"))
    result = Result(claims=CLAIMS[:1], data={}, tables=LONG)
    pages.write_blocks(tmp_path, "one", result)
    block = pages.block_of("one", result)
    assert (tmp_path / "a.md").read_text() == place.format("one", block) + place.format("two", "old")
    assert "](reproduction/one/table-1.csv)" in block


def made(paper, result):
    return Reproduction(
        paper=paper,
        title="a sum",
        assumed="rain",
        seconds=1,
        make=lambda _: result,
        draw={"a": lambda _: Figure()},
    )


def test_a_figure_of_the_paper_has_a_page_and_a_study_has_none(tmp_path):
    result = Result(claims=CLAIMS, data={}, tables=LONG)
    pages.write(tmp_path, "fig1", made("Fig. 1", result), result, quick=True)
    page = (tmp_path / "index.md").read_text(encoding="utf-8")
    assert page.startswith("# Fig. 1\n\n*A sum.*\n\n![a sum](a.png)\n\n**Assumed.** rain\n\n**Claims:** ")
    assert "\n    cointoss reproduce fig1 --quick --out docs\n" in page
    assert (tmp_path / "table-1.csv").read_text() == sheets(LONG)["table-1.csv"]
    (tmp_path / "index.md").unlink()
    pages.write(tmp_path, "sum", made("", result), result)
    assert [path.name for path in tmp_path.iterdir()] == ["table-1.csv"]


def test_every_study_that_was_kept_has_a_place_on_a_page_and_only_those():
    assert WRITTEN == {name for name in KEPT if runner.find(name).read}
    assert len(WRITTEN) == 12


@pytest.mark.parametrize("name", sorted(WRITTEN))
def test_the_verdicts_of_a_kept_study_are_the_known_ones_and_a_page_shows_its_pictures(name):
    assert unexpected(runner.kept(name, DOCS).claims) == ()
    drawn = {f"{picture}.png" for picture in runner.find(name).draw}
    assert drawn in [pictures(page.name, name) for page in DOCS.glob("*.md")]
    assert all((saved(name) / picture).stat().st_size < 150_000 for picture in drawn)


@pytest.mark.parametrize("name", KEPT)
def test_docs_shows_what_was_kept(name, tmp_path):
    """`make pages` writes it."""
    result = runner.kept(name, DOCS)
    pages.write(tmp_path, name, runner.find(name), result)
    there = runner.folder_of(name, DOCS)
    assert {path.name for path in there.glob("table-*.csv")} == {
        path.name for path in tmp_path.glob("table-*.csv")
    }
    for path in tmp_path.iterdir():
        assert (there / path.name).read_text(encoding="utf-8") == path.read_text(encoding="utf-8")
    if name in WRITTEN:
        texts = [page.read_text(encoding="utf-8") for page in DOCS.glob("*.md")]
        block = f"reproduce {name} -->\n\n{pages.block_of(name, result)}\n\n<!-- end -->\n"
        assert sum(text.count(block) for text in texts) == 1
