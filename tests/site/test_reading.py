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


@pytest.mark.parametrize("name", USERS)
def test_a_page_for_users_is_at_most_eight_screens_long(page, name):
    """Its folds are closed."""
    page.open((SITE / f"{name}.html").as_uri(), width=WIDTH, height=SCREEN, ready=LOADED)
    page.value(f"{PICTURES}.then(() => 0)")
    assert page.value("document.documentElement.scrollHeight") <= 8 * SCREEN


def test_no_page_scrolls_sideways(page):
    """Wide tables and code scroll by themselves; the lab is made for wider windows."""
    wide = []
    for path in sorted(SITE.rglob("*.html")):
        page.open(path.as_uri(), width=WIDTH, height=SCREEN, ready=LOADED)
        excess = page.value("document.documentElement.scrollWidth - document.documentElement.clientWidth")
        wide += [(path.relative_to(SITE).as_posix(), excess)] if excess > 0 else []
    assert [name for name, _ in wide if name != "lab.html"] == []
