"""A plugin of pytest that names the test functions that take long; one that takes far too long fails the run.

It counts the processor time of a function's cases that are neither `slow` nor `long`, with that of children
and of the fixtures that they are the first to ask for, without what these take to end, such as a browser that
all tests of a file share, and without numba's compiling: its code is kept.
"""

import os
from collections import Counter
from collections.abc import Generator, Mapping
from typing import Any

import pytest
from numba.core.event import TimingListener, register

REPORTED, REFUSED = 2.0, 4.0
"""Processor time from which a function is named, and from which it fails the run [s]."""
_BEGUN = pytest.StashKey[float]()
_times: Counter[str] = Counter()
_compiling = TimingListener()
register("numba:compile", _compiling)


def too_long(times: Mapping[str, float], least: float) -> list[str]:
    """Return a line for each function that takes at least so long [s], the dearest first."""
    return [
        f"{seconds:6.1f} s {function}"
        for function, seconds in sorted(times.items(), key=lambda each: -each[1])
        if seconds >= least
    ]


def is_busy(load: float, cores: int, workers: int) -> bool:
    """Return whether others slow down the run: not where all that run have a core, or the workers alone run.

    Args:
        load: how many processes want to run.
        cores: of the machine.
        workers: processes of the run.
    """
    return load >= max(cores, workers + 1)


def _processor_time() -> float:
    return sum(os.times()[:4]) - (_compiling.duration if _compiling.done else 0.0)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_protocol(item: pytest.Item) -> None:
    """Begin to count with the test."""
    item.stash[_BEGUN] = _processor_time()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, Any, Any]:
    """Add what a part of the test took to its report, which a worker sends."""
    report, now = (yield), _processor_time()
    report.processor_time, item.stash[_BEGUN] = now - item.stash[_BEGUN], now
    return report


def pytest_runtest_logreport(report: Any) -> None:
    """Add up the parts of unmarked cases."""
    if report.when != "teardown" and report.keywords.keys().isdisjoint(("slow", "long")):
        _times[report.nodeid.partition("[")[0]] += report.processor_time


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Fail the run where a function takes far too long on a machine that is not busy."""
    workers = session.config.getoption("numprocesses", None) or 1
    if too_long(_times, REFUSED) and not is_busy(max(os.getloadavg()[:2]), os.cpu_count() or 1, workers):
        session.exitstatus = session.exitstatus or pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Name the functions that take long."""
    terminalreporter.section(
        f"{REPORTED:g} s of processor time or more, without slow cases; {REFUSED:g} s fail"
    )
    for line in too_long(_times, REPORTED):
        terminalreporter.line(line)
    terminalreporter.line(f"{sum(_times.values()):6.1f} s all tests")
