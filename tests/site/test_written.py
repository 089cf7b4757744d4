"""What `make pages` writes: blocks in their places alone, and the notebooks of the site's pages."""

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted((DOCS / "examples").glob("*.md"))
sys.path.append(str(DOCS / "extensions"))
written = import_module("written")


@pytest.mark.parametrize("old", ["\nold\n", ""])
def test_blocks_are_written_into_their_places_alone(tmp_path, old):
    page = tmp_path / "page.md"
    place = "A\n\n<!-- written by: make pages, laws -->\n{}\n<!-- end -->\n\nB\n\n<!-- end -->\n"
    page.write_text(place.format(old))
    written.fill(page, {"laws": "new\\1", "ports": "elsewhere"})
    assert page.read_text() == place.format("\nnew\\1\n")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_notebook_is_that_of_its_page(page):
    """`make pages` writes it."""
    assert page.with_suffix(".ipynb").read_text(encoding="utf-8") == written.notebook_of(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_site_offers_a_notebook_beside_its_page(page):
    shown = (DOCS.parent / "out" / "site" / "examples" / f"{page.stem}.html").read_text(encoding="utf-8")
    assert len(re.findall(rf'href="\.\./_downloads/\w+/{page.stem}\.ipynb"', shown)) == 1
