"""The site's first screen and the lab in Firefox: their map is tossed and drawn."""

import time

import pytest

from tests.helpers.firefox import firefox
from tests.helpers.processes import HANGS
from tests.helpers.site import SITE, shows_a_map


@pytest.mark.parametrize("name", ["index.html", "lab.html"])
def test_the_map_is_coloured(name, tmp_path):
    with firefox(tmp_path) as browser:
        browser.call("WebDriver:Navigate", url="about:blank")
        assert not shows_a_map(browser.screenshot())
        browser.call("WebDriver:Navigate", url=(SITE / name).as_uri())
        deadline = time.monotonic() + HANGS
        while not shows_a_map(browser.screenshot()):
            assert time.monotonic() < deadline, "no map"
            time.sleep(0.5)
