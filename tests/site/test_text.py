"""The words of the site's pages: those of their sources, all and in order; no two pages have one title."""

import re
from collections import Counter
from html import unescape

import pytest

from tests.helpers.pages import DOCS, TOP
from tests.helpers.site import SITE

SOURCES = sorted(
    path
    for path in DOCS.rglob("*.md")
    if path.name != "OVERVIEW.md" and path.parent.name not in ("made", "paper")
)
MARKUP = re.compile(
    r"""
    \A---\n.*?\n---\n                      # what a notebook says of itself
    | <!--.*?-->                           # comments
    | ^```\{(?:toctree|eval-rst)\}.*?^```  # the contents, and what docstrings fill
    | ^[`:]{3,}\{code-cell\}\n(?:---\n.*?\n---\n)?
    | ^[`:]{3,}.*?$                        # fences
    | ^:[\w-]+:.*?$                        # their options
    | ^\|(?:\s:?-+:?\s\|)+$                # the rule of a table
    | !\[[^\]]*\]\([^)]*\)                 # pictures
    | (?<=\])\([^)\s]*\)                   # where a link leads
    | </?\w[^>\n]*>                        # HTML
    | ^\d+\.\s                             # numbers of a list
    """,
    re.VERBOSE | re.MULTILINE | re.DOTALL,
)


def text_of(page, element):
    """Return the text of the first such element of a page of the site."""
    found = re.search(rf"<{element}\b.*?</{element}>", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return unescape(re.sub(r"<[^>]*>", "", found[0])) if found else ""


def plain(source):
    """Return the words of Markdown that a reader sees."""
    return words(unescape(MARKUP.sub(" ", source.read_text(encoding="utf-8"))))


def words(text):
    return re.findall(r"\w+", text)


def first_missing(source, page):
    """Return the first word of the source that does not follow in the page, with those before it."""
    place = 0
    for number, word in enumerate(source):
        try:
            place = page.index(word, place) + 1
        except ValueError:
            return " ".join(source[max(number - 8, 0) : number + 1])
    return None


@pytest.mark.parametrize("source", SOURCES, ids=lambda path: path.relative_to(DOCS).as_posix())
def test_a_page_has_every_word_of_its_source_in_order(source):
    page = SITE / source.relative_to(DOCS).with_suffix(".html")
    assert len(plain(source)) > 10
    assert first_missing(plain(source), words(text_of(page, "article"))) is None


def test_the_readme_is_the_overview():
    _, *text = plain(TOP / "README.md")
    assert first_missing(text, words(text_of(SITE / "OVERVIEW.html", "article"))) is None


def test_a_line_that_is_lost_is_seen(tmp_path):
    (tmp_path / "a.md").write_text("It *holds* for\n% 99 of [them](a.md) <!-- here -->, or more.")
    text = plain(tmp_path / "a.md")
    assert text == ["It", "holds", "for", "99", "of", "them", "or", "more"]
    assert first_missing(text, ["It", "holds", "for"]) == "It holds for 99"
    assert first_missing(text, ["And", *text, "then"]) is None


def test_no_two_pages_have_one_title():
    titles = Counter(text_of(page, "title") for page in SITE.rglob("*.html"))
    assert "" not in titles
    assert [title for title, count in titles.items() if count > 1] == []
