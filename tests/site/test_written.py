"""What `make pages` writes: blocks that pages include, and the notebooks of the site's pages."""

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted((DOCS / "examples").glob("*.md"))
sys.path.append(str(DOCS / "extensions"))
written = import_module("written")


def test_every_block_that_is_written_is_included_by_one_page(tmp_path):
    included = re.findall(
        r"^```\{include\} made/(\w+)\.md$",
        "".join(page.read_text(encoding="utf-8") for page in DOCS.glob("*.md")),
        re.MULTILINE,
    )
    assert sorted(included) == sorted(path.stem for path in (DOCS / "made").glob("*.md"))
    written.write_blocks(tmp_path / "made", {"laws": "a", "ports": "b"})
    assert (tmp_path / "made" / "ports.md").read_text(encoding="utf-8") == "b\n"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_notebook_is_that_of_its_page(page):
    """`make pages` writes it."""
    assert page.with_suffix(".ipynb").read_text(encoding="utf-8") == written.notebook_of(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_site_offers_a_notebook_beside_its_page(page):
    shown = (DOCS.parent / "out" / "site" / "examples" / f"{page.stem}.html").read_text(encoding="utf-8")
    assert len(re.findall(rf'href="\.\./_downloads/\w+/{page.stem}\.ipynb"', shown)) == 1
