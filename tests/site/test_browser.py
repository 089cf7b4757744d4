"""Pages of the built site in a browser: quiet, not wider than the window, and not long."""

import pytest

from tests.helpers.site import SITE

WIDTH, SCREEN = 420, 900
WINDOWS = ("index.html", "[A-Z]*.html", "examples/two_engines_part.html", "api/cointoss.html")
USERS = ("OVERVIEW", "TUTORIAL", "lab", "COMMANDS", "SCENARIO", "PYTHON", "MUJOCO", "PREDICTABILITY")
COMPLETE = "document.readyState === 'complete' && location.href !== 'about:blank'"
PICTURES = (
    "Promise.all([...document.images].map(i => { i.loading = 'eager'; return i.decode().catch(() => 0) }))"
)
"""Pictures below the screen are loaded late."""
SIDEWAYS = """
    [document.documentElement, ...document.querySelectorAll('.content')]
      .some(element => element.scrollWidth > element.clientWidth)
"""
"""The theme lets the content of a page scroll, not the window."""
CUT = """[...document.querySelectorAll("article *")].some((one) => {
  const rolls = (e) => ["auto", "scroll"].includes(getComputedStyle(e).overflowX);
  const scrolls = (e) => e && (rolls(e) || scrolls(e.parentElement));
  return one.getBoundingClientRect().right > document.documentElement.clientWidth + 1 && !scrolls(one);
})"""
"""Whether something reaches beyond the window and cannot be scrolled to."""


def foreign(page):
    return [
        address for address in page.asked() if not address.startswith(("file:", "data:", "blob:", "about:"))
    ]


@pytest.mark.parametrize(
    ("width", "scheme", "names"),
    [(1280, "light", WINDOWS), (WIDTH, "dark", ["**/*.html"])],
    ids=["window", "telephone"],
)
def test_every_page_is_quiet_and_fits_its_window(page, width, scheme, names):
    """Wide tables and code scroll by themselves; the lab is made for wider windows."""
    wide = []
    for path in sorted({path for name in names for path in SITE.glob(name)} - {SITE / "lab.html"}):
        page.open(path.as_uri(), width=width, height=SCREEN, scheme=scheme, ready=COMPLETE)
        wide += [path.relative_to(SITE).as_posix()] if page.value(f"{SIDEWAYS} || {CUT}") else []
    assert (wide, foreign(page)) == ([], [])


@pytest.mark.parametrize("name", USERS)
def test_a_page_for_users_is_at_most_eight_screens_long(page, name):
    """Its folds are closed."""
    page.open((SITE / f"{name}.html").as_uri(), width=WIDTH, height=SCREEN, ready=COMPLETE)
    page.value(f"{PICTURES}.then(() => 0)")
    assert page.value("document.documentElement.scrollHeight") <= 8 * SCREEN


def test_a_page_that_scrolls_sideways_is_seen(page):
    page.open((SITE / "OVERVIEW.html").as_uri(), width=WIDTH, ready=COMPLETE)
    page.value("document.querySelector('article').style.width = '600px'")
    assert page.value(SIDEWAYS)


def test_the_search_finds_a_page(page):
    page.open(f"{(SITE / 'search.html').as_uri()}?q=restitution", ready=COMPLETE)
    page.wait_for("document.querySelectorAll('#search-results li a').length > 5")
    assert foreign(page) == []
