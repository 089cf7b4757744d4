"""Pages of the built site in a browser: no complaint, no request, and nothing wider than the window."""

from pathlib import Path

import pytest

from tests.helpers.browser import Page

SITE = Path(__file__).parents[2] / "out" / "site"
COMPLETE = "document.readyState === 'complete' && location.href !== 'about:blank'"
CUT = """(() => {
  const rolls = (e) => ["auto", "scroll"].includes(getComputedStyle(e).overflowX);
  const scrolls = (e) => e && (rolls(e) || scrolls(e.parentElement));
  const wide = (e) => e.getBoundingClientRect().right > document.documentElement.clientWidth + 1;
  const cut = [...document.querySelectorAll("article *")].filter((e) => wide(e) && !scrolls(e));
  return cut.map((e) => e.outerHTML.slice(0, 200));
})()"""
"""What reaches beyond the window and cannot be scrolled to."""
PAGES = (
    "index.html",
    "TUTORIAL.html",
    "GALLERY.html",
    "MUJOCO.html",
    "REPRODUCTION.html",
    "examples/two_engines_part.html",
    "api/cointoss.html",
)


def foreign(page):
    return [
        address for address in page.asked() if not address.startswith(("file:", "data:", "blob:", "about:"))
    ]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_quiet_and_fits_its_window(chromium, name):
    for width, scheme in ((1280, "light"), (420, "dark")):
        with Page(chromium) as page:
            page.open((SITE / name).as_uri(), width=width, scheme=scheme, ready=COMPLETE)
            assert page.value("document.documentElement.scrollWidth") <= width
            assert page.value(CUT) == []
            assert page.complaints() == []
            assert foreign(page) == []


def test_the_search_finds_a_page(page):
    page.open(f"{(SITE / 'search.html').as_uri()}?q=restitution", ready=COMPLETE)
    page.wait_for("document.querySelectorAll('#search-results li a').length > 5")
    assert foreign(page) == []


def test_the_map_of_the_site_can_be_explored(page):
    page.open((SITE / "explorer.html").as_uri())
    assert foreign(page) == []
