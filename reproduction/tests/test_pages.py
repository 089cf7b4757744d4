"""The pages of results: long tables fold, with CSV beside; docs/ shows what was kept."""

import pytest

from cointoss.study import table
from cointoss_reproduction.frame import pages, runner
from cointoss_reproduction.frame.claim import Claim, Criterion, unexpected
from cointoss_reproduction.frame.result import Result
from cointoss_reproduction.frame.tables import OPEN
from saved import DOCS, saved

KEPT = [name for name in runner.names() if runner.is_whole(name, DOCS)]
STUDIES = [name for name in KEPT if not runner.find(name).paper]


def test_the_page_of_a_study_shows_its_tables_and_claims(tmp_path):
    claim = Claim(claim="1 < 2", criteria=[Criterion("one [m]", 1, "<", 2, "it <is> so")])
    long = table(["coin", "tosses"], [["thin", f"{n}"] for n in range(OPEN + 1)])
    found = runner.find("rotor")
    pages.write(tmp_path, "one", found, Result(claims=[claim], data={}, tables=long))
    page = (tmp_path / "index.md").read_text(encoding="utf-8")
    assert page.startswith("# Study one: 1 &lt; 2\n")
    assert "](table-1.csv)" in page
    assert (tmp_path / "table-1.csv").exists()
    assert page.index("| thin |") < page.index("## holds: 1 &lt; 2")


@pytest.mark.parametrize("name", STUDIES)
def test_the_verdicts_of_a_kept_study_are_the_known_ones_and_a_page_leads_to_them(name):
    assert unexpected(runner.kept(name, DOCS).claims) == ()
    texts = [page.read_text(encoding="utf-8") for page in DOCS.glob("*.md")]
    assert any(f"](reproduction/{name}/index.md)" in text for text in texts)
    drawn = [saved(name) / f"{picture}.png" for picture in runner.find(name).draw]
    assert all(picture.stat().st_size < 150_000 for picture in drawn)


@pytest.mark.slow_after_first
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
