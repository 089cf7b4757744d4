"""The extensions of the site, and the lab in a page."""

import sys

import pytest

from tests.helpers.browser import Page
from tests.helpers.command_line import printed
from tests.helpers.lab import WHOLE
from tests.helpers.pages import DOCS

sys.path.append(str(DOCS / "extensions"))


@pytest.fixture(scope="session")
def lab_path(tmp_path_factory):
    """The lab of a scenario, as `cointoss lab` writes it."""
    target = tmp_path_factory.mktemp("lab") / "lab.html"
    printed("lab", "fig24a", "--out", target)
    return target


@pytest.fixture(scope="module")
def kept(chromium, lab_path):
    """A tab for tests that change its state by addresses."""
    with Page(chromium) as page:
        page.open(lab_path.as_uri(), width=420)
        page.wait_for(WHOLE)
        yield page
        assert page.complaints() == []
