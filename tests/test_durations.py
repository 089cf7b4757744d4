"""Functions that take long are named, and fail no run."""

from types import SimpleNamespace

from tests.conftest import pytest_collection_modifyitems
from tests.helpers.command_line import python

PATCHED = """
from tests.helpers import durations

durations.REPORTED = 0.1
"""
TESTS = """
import subprocess, sys, time
import pytest

BUSY = "import time\\nwhile time.process_time() < 0.4: pass"

def busy(seconds):
    end = time.process_time() + seconds
    while time.process_time() < end:
        pass

@pytest.mark.parametrize("case", "ab")
def test_both_cases(case):
    busy(0.08)

@pytest.mark.slow
def test_marked():
    busy(0.35)

def test_child():
    subprocess.run([sys.executable, "-c", BUSY])

@pytest.fixture(scope="module", autouse=True)
def what_all_share():
    yield
    busy(0.35)

def test_last():
    pass
"""


def test_what_takes_long_is_named_and_fails_no_run(tmp_path):
    (tmp_path / "conftest.py").write_text(PATCHED)
    (tmp_path / "test_long.py").write_text(TESTS)
    run = python("-m", "pytest", "-p", "tests.helpers.durations", "-p", "no:cacheprovider", folder=tmp_path)
    assert [line.split()[-1] for line in run.stdout.splitlines() if " s test_long.py" in line] == [
        "test_long.py::test_child", "test_long.py::test_both_cases"
    ]  # fmt: skip
    assert "5 passed" in run.stdout
    assert run.returncode == 0


def test_cases_after_the_first_are_slow_but_long_ones():
    """Of the functions a, which is plain, and b, which is `slow_after_first`."""
    marked, later = [], "slow_after_first"
    cases = [
        SimpleNamespace(function=name[0], keywords=words, add_marker=lambda _, name=name: marked.append(name))
        for name, words in (("a1", {}), ("a2", {}), ("b1", {later}), ("b2", {later, "long"}), ("b3", {later}))
    ]
    pytest_collection_modifyitems(cases)
    assert marked == ["b3"]
