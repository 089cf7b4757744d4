"""The notebooks for Jupyter are those of the pages, which the site runs."""

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[2] / "docs"
PAGES = sorted((DOCS / "examples").glob("*.md"))
sys.path.append(str(DOCS / "extensions"))
notebook_of = import_module("written").notebook_of


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_notebook_is_that_of_its_page(page):
    """`make pages` writes it."""
    assert page.with_suffix(".ipynb").read_text(encoding="utf-8") == notebook_of(page)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_site_offers_a_notebook_beside_its_page(page):
    shown = (DOCS.parent / "out" / "site" / "examples" / f"{page.stem}.html").read_text(encoding="utf-8")
    assert len(re.findall(rf'href="\.\./_downloads/\w+/{page.stem}\.ipynb"', shown)) == 1
