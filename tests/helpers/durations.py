"""A plugin of pytest that names the test functions that take long; it fails none, since machines differ.

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

REPORTED = 2.0
"""Processor time from which a function is named [s]."""
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


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Name the functions that take long."""
    terminalreporter.section(f"{REPORTED:g} s of processor time or more, without slow cases")
    for line in too_long(_times, REPORTED):
        terminalreporter.line(line)
    terminalreporter.line(f"{sum(_times.values()):6.1f} s all tests")
