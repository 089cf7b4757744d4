"""What `make pages` writes: blocks that pages include, and the notebooks of the site's pages."""

import re
from copy import deepcopy
from importlib import import_module

import nbformat
import pytest
from jupyter_cache import get_cache

from tests.helpers.pages import DOCS, departures
from tests.helpers.site import SITE

written = import_module("written")
PAGES = sorted((DOCS / "examples").glob("*.md"))


def test_every_block_that_is_written_is_included_by_one_page(tmp_path):
    included = re.findall(
        r"^```\{include\} made/(\w+)\.md$",
        "".join(page.read_text(encoding="utf-8") for page in DOCS.glob("*.md")),
        re.MULTILINE,
    )
    assert sorted(included) == sorted(path.stem for path in (DOCS / "made").glob("*.md"))
    written.write_blocks(tmp_path / "made", {"laws": "a", "ports": "b"})
    assert (tmp_path / "made" / "ports.md").read_text(encoding="utf-8") == "b\n"


def test_the_picture_of_the_modes_is_of_this_tree():
    assert written.pictures.automaton() == (DOCS / "automaton.svg").read_text(encoding="utf-8")


def told(notebook):
    """Return the texts that a notebook's cells show."""
    shown = [output for cell in notebook.cells for output in cell.get("outputs", ())]
    return "".join(output.get("text") or output.data["text/plain"] + "\n" for output in shown)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_notebook_is_that_of_its_page_with_what_its_cells_show(page):
    """`make pages` writes the one, `make results` the other; `make docs` has run it for the site."""
    kept = nbformat.read(page.with_suffix(".ipynb"), as_version=4)
    assert kept == written.notebook_of(page)
    _, ran = get_cache(DOCS.parent / "out" / "docs" / "notebooks").merge_match_into_notebook(kept)
    assert departures(told(kept).splitlines(), told(ran)) == []


def test_a_notebook_keeps_texts_and_pictures_of_cells_that_did_not_change(tmp_path):
    page, text = tmp_path / "page.md", PAGES[0].read_text(encoding="utf-8")
    page.write_text(text.replace("\ntoss.play()\n", "\nprint(1)\n"), encoding="utf-8")
    kept = nbformat.read(PAGES[0].with_suffix(".ipynb"), as_version=4)
    ran = deepcopy(kept)
    ran.cells[2].outputs[0].data["text/html"] = "<b>a page</b>"
    nbformat.write(ran, page.with_suffix(".ipynb"))
    lost = [cell for cell in written.notebook_of(page).cells if cell not in kept.cells]
    assert [(cell.source, cell.outputs) for cell in lost] == [("print(1)", [])]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_site_offers_a_notebook_beside_its_page(page):
    shown = (SITE / "examples" / f"{page.stem}.html").read_text(encoding="utf-8")
    assert len(re.findall(rf'href="\.\./_downloads/\w+/{page.stem}\.ipynb"', shown)) == 1
