"""What all tests share: signals that processes heed, reproducible Hypothesis, and fixtures."""

import gc
import signal
from importlib import import_module
from itertools import pairwise

import pytest
from hypothesis import HealthCheck, settings

from cointoss.analytic.horizon.certainty import Certainty
from cointoss.compare.film.back_end import drawing_problem
from cointoss.models.records import Outcome
from tests.helpers.basin_runs import SCENARIO
from tests.helpers.browser import Page, browser
from tests.helpers.engine_page import engine_page
from tests.helpers.explored import serving, small_map

# Runs in the background ignore Ctrl-C, and what they start would too.
signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP"):
    signal.signal(signal.SIGHUP, signal.SIG_DFL)

# On a busy machine examples may be slow to draw.
settings.register_profile(
    "cointoss",
    deadline=None,
    derandomize=True,
    max_examples=100,
    suppress_health_check=[HealthCheck.too_slow],
)
settings.load_profile("cointoss")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items):
    """Mark tests that are `slow_after_first` but the first and `long` cases, before any is left out."""
    for before, item in pairwise(items):
        if (
            "slow_after_first" in item.keywords
            and "long" not in item.keywords
            and before.function is item.function
        ):
            item.add_marker("slow")


def pytest_collection_finish():
    """Leave what was imported and collected, which stays, out of Python's search for garbage."""
    gc.collect()
    gc.freeze()


@pytest.fixture
def without_horizon(monkeypatch):
    """Let no toss find out whether its outcome is certain, which takes longer than the toss."""
    unknown = Certainty(False, Outcome.UNDECIDED, 0, 0.0)
    monkeypatch.setattr(import_module("cointoss.analytic.toss"), "certainty_of", lambda *_: unknown)
    monkeypatch.setattr(import_module("cointoss.coin_mj.toss"), "SOFTER", ())


@pytest.fixture
def fresh_back_end():
    """Let a test find out anew whether MuJoCo can draw."""
    drawing_problem.cache_clear()
    yield
    drawing_problem.cache_clear()


@pytest.fixture(scope="module")
def chromium(tmp_path_factory):
    """A browser for the tests of a module."""
    with browser(tmp_path_factory.mktemp("profile")) as started:
        yield started


@pytest.fixture
def tab(chromium):
    """A tab of the browser."""
    with Page(chromium) as opened:
        yield opened


@pytest.fixture
def page(tab):
    """A tab whose pages give the browser nothing to complain of."""
    yield tab
    assert tab.complaints() == []


@pytest.fixture(scope="module")
def loaded(chromium, tmp_path_factory):
    """A page of one file that has loaded the engine."""
    file = tmp_path_factory.mktemp("engine") / "page.html"
    file.write_text(engine_page())
    with Page(chromium) as page:
        page.open(file.as_uri())
        yield page
        assert page.complaints() == []


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The folder of a test, which is the working directory meanwhile."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def coin(tmp_path):
    """The file of a scenario of which maps are made."""
    (tmp_path / "coin.toml").write_text(SCENARIO)
    return tmp_path / "coin.toml"


@pytest.fixture(scope="module")
def map_path(tmp_path_factory):
    """A small map to explore."""
    return small_map(tmp_path_factory.mktemp("map"))


@pytest.fixture(scope="module")
def server(map_path):
    """The lab's server of that map."""
    with serving(map_path) as lab:
        yield lab
