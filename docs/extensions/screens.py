"""Take docs/lab.png and docs/report.png, of the pages that `make report` writes; `make screens` calls it."""

import tempfile
from pathlib import Path

from tests.helpers.browser import READY, Page, browser
from tests.helpers.lab import TOSSED, WHOLE
from tests.helpers.pages import TOP

PAGES = {"lab": ("lab.html", 860, f"{WHOLE} && {TOSSED}"), "report": ("table/report.html", 1440, READY)}
"""The name of each picture: its page in out/, its height, and what is true when it is ready."""


def take(name: str) -> None:
    """Take the picture of a page."""
    place, height, ready = PAGES[name]
    with tempfile.TemporaryDirectory() as profile, browser(Path(profile)) as chromium, Page(chromium) as page:
        page.open((TOP / "out" / place).as_uri(), height=height)
        page.wait_for(ready)
        page.screenshot(TOP / "docs" / f"{name}.png")


if __name__ == "__main__":
    for name in PAGES:
        take(name)
