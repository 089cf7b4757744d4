"""What pages show of results: claims unfold, long tables fold, with CSV beside; docs/ shows what was kept."""

import re

import pytest

from cointoss.compare.output.tables import OPEN, table
from cointoss_reproduction.frame import pages, runner
from cointoss_reproduction.frame.claim import Claim, Criterion, unexpected
from cointoss_reproduction.frame.result import Result
from saved import DOCS, pictures, saved

WRITTEN = {
    name
    for page in DOCS.glob("*.md")
    for name in re.findall(
        r"^<!-- written by: cointoss reproduce ([\w-]+) -->", page.read_text(encoding="utf-8"), re.MULTILINE
    )
}
KEPT = [name for name in runner.names() if runner.is_whole(name, DOCS)]


def test_results_are_written_into_the_pages_that_have_a_place_for_them(tmp_path):
    place = "# A\n\n<!-- written by: cointoss reproduce {} -->\n\n{}\n\n<!-- end -->\n\nB\n"
    (tmp_path / "a.md").write_text(place.format("one", "old\n\nold") + place.format("two", "old"))
    claim = Claim(claim="1 < 2", criteria=[Criterion("one [m]", 1, "<", 2, "it <is> so")])
    long = table(["coin", "tosses"], [["thin", f"{n}"] for n in range(OPEN + 1)])
    result = Result(claims=[claim], data={}, tables=long)
    pages.write_blocks(tmp_path, "one", result)
    block = pages.block_of("one", result)
    assert (tmp_path / "a.md").read_text() == place.format("one", block) + place.format("two", "old")
    assert "](reproduction/one/table-1.csv)" in block
    assert "1 &lt; 2" in block


def test_every_study_that_was_kept_has_a_place_on_a_page_and_only_those():
    of_project = {name for name in KEPT if not runner.find(name).paper}
    # ENGINES has a table of its own of what mujoco-laws finds; edge, of the paper, has a page of its own.
    assert WRITTEN == of_project - {"mujoco-laws"} | {"edge"}


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
