"""What is compiled is counted, its end is estimated, and of two processes that compile the same one waits."""

import subprocess

import pytest

from cointoss.models.kernel import code_cache
from cointoss.models.kernel.code_cache import turn
from cointoss.models.kernel.compiling import Compiling
from tests.helpers.command_line import HERE
from tests.helpers.processes import started


class Clock:
    def __init__(self):
        self.now = 100.0

    def __call__(self):
        return self.now


def of_two_engines(clock):
    compiling = Compiling(clock)
    compiling.declared.update(
        {"cointoss.analytic.events": 6, "cointoss.models.body": 4, "cointoss.coin_mj.events": 50}
    )
    return compiling


def none_kept(_):
    return 0


def test_the_functions_of_an_engine_are_counted_and_those_that_both_share():
    compiling = of_two_engines(Clock())
    with (
        compiling.one("cointoss.analytic.events", none_kept),
        compiling.one("cointoss.models.body", none_kept),
    ):
        assert (compiling.what, compiling.begun, compiling.total) == ("the analytic engine", 2, 10)
    with compiling.one("cointoss.models.body", none_kept):
        assert (compiling.what, compiling.begun, compiling.total) == ("the analytic engine", 3, 10)
    with compiling.one(
        "cointoss.coin_mj.events", {"cointoss.models.body": 3, "cointoss.coin_mj.events": 0}.__getitem__
    ):
        assert (compiling.what, compiling.begun, compiling.total) == ("the MuJoCo engine", 4, 54)


def test_what_is_kept_is_not_expected_again():
    compiling = of_two_engines(Clock())
    with compiling.one(
        "cointoss.analytic.events", {"cointoss.analytic.events": 5, "cointoss.models.body": 4}.__getitem__
    ):
        assert (compiling.begun, compiling.total) == (1, 1)
    with compiling.one(
        "cointoss.analytic.events", {"cointoss.analytic.events": 5, "cointoss.models.body": 4}.__getitem__
    ):
        assert (compiling.begun, compiling.total) == (2, 2)


def test_shared_functions_are_those_of_the_one_engine_there_is():
    for modules, what in (
        (["cointoss.models.body"], "functions of both engines"),
        (["cointoss.models.body", "cointoss.coin_mj.events"], "the MuJoCo engine"),
        (
            ["cointoss.models.body", "cointoss.coin_mj.events", "cointoss.analytic.events"],
            "functions of both engines",
        ),
    ):
        compiling = Compiling(Clock())
        compiling.declared.update(modules)
        with compiling.one("cointoss.models.body", none_kept):
            assert compiling.what == what


def test_the_end_is_estimated_from_the_functions_that_are_done_and_the_linking_to_come():
    clock = Clock()
    compiling = of_two_engines(clock)
    for _ in range(4):
        with compiling.one("cointoss.analytic.events", none_kept):
            clock.now += 2.0
    # Six functions of two seconds, and machine code of all ten in half the time of compiling them.
    assert compiling.seconds_left == pytest.approx(6 * 2.0 + 10 * 1.0)
    with compiling.one("cointoss.analytic.events", none_kept), compiling.linking():
        clock.now += 3.0
        each = 8.0 / 5
        assert compiling.seconds_left == pytest.approx(5 * each + 10 * each / 2 - 3.0)
        clock.now += 100.0
        assert compiling.seconds_left == pytest.approx(5 * each)


def test_the_clock_of_work_stands_still_meanwhile():
    clock = Clock()
    compiling = of_two_engines(clock)
    before = compiling.working_time
    with compiling.one("cointoss.analytic.events", none_kept):
        clock.now += 60.0
        assert compiling.working_time == before
        with compiling.waiting():
            clock.now += 60.0
            assert compiling.waits
    assert (compiling.waits, compiling.now, compiling.seconds) == (False, False, 120.0)
    clock.now += 1.0
    assert compiling.working_time == before + 1.0


HOLDING = """
import sys
from cointoss.models.kernel.code_cache import turn
with turn("some function") as waited:
    print(waited, flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setattr(code_cache, "base_folder", lambda: tmp_path)
    return tmp_path


def test_a_process_waits_for_another_that_compiles_the_same_until_that_ends(folder, monkeypatch):
    piped = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
    with started("-c", HOLDING, env={**HERE, "NUMBA_CACHE_DIR": str(folder)}, **piped) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "False\n"
        with turn("another function") as waited:
            assert not waited
        with monkeypatch.context() as patched:
            patched.setattr(code_cache, "PATIENCE", 0.0)
            with turn("some function") as waited:
                assert waited
        slept = []

        def killed_meanwhile(seconds):
            slept.append(seconds)
            other.kill()
            other.wait()

        monkeypatch.setattr(code_cache.time, "sleep", killed_meanwhile)
        with turn("some function") as waited:
            assert waited
        assert len(slept) == 1
        with turn("some function") as waited:
            assert not waited
    assert not list(folder.iterdir())


def test_where_nothing_can_be_locked_nothing_is_waited_for(folder):
    folder.rmdir()
    with turn("some function") as waited:
        assert not waited
