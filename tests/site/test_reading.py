"""The site on a phone: the pages for users are at most eight screens long, and no page is too wide."""

from pathlib import Path

import pytest

SITE = Path(__file__).parents[2] / "out" / "site"
USERS = ("OVERVIEW", "TUTORIAL", "lab", "COMMANDS", "SCENARIO", "PYTHON", "MUJOCO", "PREDICTABILITY")
WIDTH, SCREEN = 420, 900
LOADED = "document.readyState === 'complete'"
PICTURES = (
    "Promise.all([...document.images].map(i => { i.loading = 'eager'; return i.decode().catch(() => 0) }))"
)
"""Pictures below the screen are loaded late."""
SIDEWAYS = """
    [document.documentElement, ...document.querySelectorAll('.content')]
      .some(element => element.scrollWidth > element.clientWidth)
"""
"""The theme lets the content of a page scroll, not the window."""


@pytest.mark.parametrize("name", USERS)
def test_a_page_for_users_is_at_most_eight_screens_long(page, name):
    """Its folds are closed."""
    page.open((SITE / f"{name}.html").as_uri(), width=WIDTH, height=SCREEN, ready=LOADED)
    page.value(f"{PICTURES}.then(() => 0)")
    assert page.value("document.documentElement.scrollHeight") <= 8 * SCREEN


def test_no_page_scrolls_sideways(page):
    """Wide tables and code scroll by themselves; the lab is made for wider windows."""
    wide = []
    for path in sorted(set(SITE.rglob("*.html")) - {SITE / "lab.html"}):
        page.open(path.as_uri(), width=WIDTH, height=SCREEN, ready=LOADED)
        wide += [path.relative_to(SITE).as_posix()] if page.value(SIDEWAYS) else []
    assert wide == []


def test_a_page_that_scrolls_sideways_is_seen(page):
    page.open((SITE / "OVERVIEW.html").as_uri(), width=WIDTH, height=SCREEN, ready=LOADED)
    page.value("document.querySelector('article').style.width = '600px'")
    assert page.value(SIDEWAYS)
