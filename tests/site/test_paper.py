"""The article and the JOSS paper are set as PDF, without LaTeX, fonts of the system or the network."""

from importlib import import_module

import pytest

from tests.helpers.pages import TOP

# `make lint` runs where the packages of the site need not be installed.
papers, typst = import_module("papers"), import_module("typst")


@pytest.mark.parametrize(("name", "fewest", "most"), [("article", 5, 7), ("joss", 2, 3)])
def test_a_paper_is_set_on_its_pages(name, fewest, most):
    pdfs = {pdf.stem: pdf for pdf in papers.write(TOP / "out" / "paper")}
    assert pdfs[name].read_bytes().startswith(b"%PDF")
    assert (pdfs[name].parent / "references.bib").is_file()
    pages = typst.compile(
        pdfs[name].with_suffix(".typ"), format="png", ppi=20, root=TOP, ignore_system_fonts=True
    )
    assert fewest <= len(pages) <= most


def test_the_preview_of_the_joss_paper_has_its_words_and_citations():
    papers.write(TOP / "out" / "paper")
    made = (TOP / "out" / "paper" / "joss.typ").read_text(encoding="utf-8")
    assert 'title: "cointoss: two engines for the dynamics of a tossed coin"' in made
    assert "MuJoCo @todorov2012" in made
    assert '#cite(<strzalko2008>, form: "prose")' in made
