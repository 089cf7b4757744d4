"""The article and the JOSS paper are set as PDF, without LaTeX, fonts of the system or the network."""

import sys
from importlib import import_module
from pathlib import Path

import pytest

TOP = Path(__file__).parents[2]
sys.path.append(str(TOP / "docs" / "extensions"))
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


def test_the_preview_of_the_joss_paper_has_its_markdown():
    head = "---\ntitle: A\ntags: [b]\nbibliography: references.bib\n---\n"
    made = papers.joss_in_typst(f"{head}# C\n\n*d* [@e; @f]; @g and `h_i` 10^-3^ [j](k) #\n\n- l\n- m\n")
    assert '\n\n= C\n\n#emph[d] #cite(<e>)#cite(<f>)\\; #cite(<g>, form: "prose") and #raw("h_i") ' in made
    assert '10#super[-3] #link("k")[j] \\#\n\n- l\n\n- m\n' in made


def test_markdown_that_the_preview_does_not_know_is_refused():
    head = "---\ntitle: A\ntags: [b]\nbibliography: references.bib\n---\n"
    with pytest.raises(papers.BindingError, match=r"joss\.md: ordered_list_open is not known here"):
        papers.joss_in_typst(f"{head}1. a\n")
