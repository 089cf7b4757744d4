"""Each benchmark is timed in processor time beside the reference, and compared with what was kept last."""

from collections.abc import Generator
from functools import cache
from time import process_time
from typing import Any

import pytest
from pytest_benchmark.utils import get_commit_info

from tests.benchmarks.keeping import TABLE, compared, machine, read_table, reference, rows_of

SECONDS = 0.5
"""At least so long a benchmark runs [s]."""
LINES: list[str] = []


@cache
def here() -> tuple[Any, str]:
    """Return the commit and the machine."""
    return get_commit_info(), machine()


def pytest_itemcollected(item: pytest.Item) -> None:
    """Have short rounds, in processor time."""
    item.add_marker(pytest.mark.benchmark(timer=process_time, max_time=SECONDS, min_rounds=5))


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: Any) -> Generator[None, Any, Any]:
    """Time the reference before and after each benchmark, and compare their ratio with the last one kept."""
    before = reference()
    result = yield
    benchmark = item.funcargs.get("benchmark")
    if benchmark is not None and benchmark.stats:
        benchmark.extra_info["reference"] = min(before, reference())
        timed = {"name": item.name, "extra_info": benchmark.extra_info}
        timed["stats"] = {"data": benchmark.stats.stats.data}
        LINES.extend(compared(row, read_table(TABLE)) for row in rows_of([timed], *here()))
    return result


def pytest_terminal_summary(terminalreporter: Any) -> None:
    """Print a line for each benchmark."""
    terminalreporter.section("beside the reference, and what was kept last")
    for line in LINES:
        terminalreporter.write_line(line)
