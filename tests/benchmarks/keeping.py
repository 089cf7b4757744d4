"""A plugin of pytest that keeps what benchmarks took in docs/benchmarks.csv, as `make bench KEEP=1` asks.

A machine is slower when others work on it. So each benchmark stands beside a reference, a computation that
no commit changes, timed just before and after it; their ratio is compared between commits.
"""

import csv
import platform
from collections.abc import Iterable, Mapping
from importlib.metadata import version
from math import hypot, sin
from pathlib import Path
from statistics import quantiles
from time import process_time
from typing import Any

import numba
import pytest
from pytest_benchmark.utils import get_commit_info

TABLE = Path(__file__).parents[2] / "docs" / "benchmarks.csv"
COLUMNS: tuple[str, ...] = (
    "commit", "date", "machine", "benchmark", "seconds", "spread", "rounds", "reference", "ratio"
)  # fmt: skip
"""Seconds of processor time: the best round, half the middle half of all, and the best of the reference."""
STEPS = 50_000
"""Of the reference: some milliseconds."""
SLOWER = 0.2
"""Part of its time by which a benchmark must differ from the last one kept to be called slower or faster."""


@numba.njit
def pendulum(steps: int) -> float:
    """Return where a pendulum is after steps of Runge and Kutta: sines, products and sums, as in a toss."""
    dt, angle, rate = 0.01, 1.0, 0.0
    for _ in range(steps):
        a1, b1 = rate, -sin(angle)
        a2, b2 = rate + dt / 2 * b1, -sin(angle + dt / 2 * a1)
        a3, b3 = rate + dt / 2 * b2, -sin(angle + dt / 2 * a2)
        a4, b4 = rate + dt * b3, -sin(angle + dt * a3)
        angle += dt / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
        rate += dt / 6 * (b1 + 2 * b2 + 2 * b3 + b4)
    return angle


def reference() -> float:
    """Return the best processor time of ten runs of the reference [s]."""
    times = []
    for _ in range(10):
        begun = process_time()
        pendulum(STEPS)
        times.append(process_time() - begun)
    return min(times)


def machine() -> str:
    """Return what the times depend on beside the commit."""
    from cpuinfo import get_cpu_info  # its import and the call take a second

    name = get_cpu_info().get("brand_raw", platform.machine())
    return f"{name}; Python {platform.python_version()}, numba {version('numba')}"


def rows_of(
    benchmarks: Iterable[Mapping[str, Any]], commit: Mapping[str, Any], where: str
) -> list[dict[str, Any]]:
    """Return a row of the table for each benchmark.

    Args:
        benchmarks: as pytest-benchmark saves them, with the time of the reference, and perhaps times of their
            own, in `extra_info`.
        commit: as pytest-benchmark names it.
        where: the machine.
    """
    rows = []
    for each in benchmarks:
        extra = each["extra_info"]
        times = extra.get("times", each["stats"]["data"])
        if len(times) < 2:  # a round without a spread says nothing
            continue
        low, _, high = quantiles(times, n=4)
        best, beside = min(times), extra["reference"]
        values = (
            f"{best:.4g}",
            f"{(high - low) / 2:.2g}",
            len(times),
            f"{beside:.4g}",
            f"{best / beside:.4g}",
        )
        name = each["name"].removeprefix("test_")
        rows.append(
            dict(zip(COLUMNS, (commit["id"][:10], commit["time"], where, name, *values), strict=True))
        )
    return rows


def kept(rows: Iterable[dict[str, Any]], new: Iterable[dict[str, Any]]) -> list[dict[str, Any]]:
    """Return a table with new rows in it, by date; a benchmark of one commit and machine has one row."""
    by_key = {(row["commit"], row["machine"], row["benchmark"]): row for row in (*rows, *new)}
    return sorted(by_key.values(), key=lambda row: (row["date"], row["machine"], row["benchmark"]))


def read_table(path: Path) -> list[dict[str, str]]:
    """Return the rows of the table, none where there is no file."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def write_table(path: Path, rows: Iterable[Mapping[str, Any]]) -> None:
    """Write the table, whole or not at all."""
    aside = path.with_suffix(".partial")
    with aside.open("w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    aside.replace(path)


def compared(row: Mapping[str, Any], table: Iterable[Mapping[str, Any]]) -> str:
    """Return a benchmark's ratio to the reference, and how it compares with the last one kept, in a line.

    That is the last of another commit on the same machine. The interval is of the spread of both.
    """
    line = f"{row['benchmark']}: {float(row['ratio']):.4g} of the reference"
    earlier = [
        old
        for old in table
        if old["benchmark"] == row["benchmark"]
        and old["machine"] == row["machine"]
        and old["commit"] != row["commit"]
    ]
    if not earlier:
        return f"{line}, the first on this machine"
    last = max(earlier, key=lambda old: old["date"])
    times = float(row["ratio"]) / float(last["ratio"])
    error = times * hypot(*(float(each["spread"]) / float(each["seconds"]) for each in (row, last)))
    line += f", {times:.2f} [{times - error:.2f}, {times + error:.2f}] of that of {last['commit'][:7]}"
    if times > 1 + SLOWER:
        return f"{line}: slower by {100 * (times - 1):.0f} %"
    return f"{line}: faster by {100 * (1 - times):.0f} %" if times < 1 - SLOWER else line


def pytest_sessionstart() -> None:
    """Refuse a tree that is no commit's."""
    if get_commit_info()["dirty"]:
        raise pytest.UsageError("make bench KEEP=1: the tree is no commit's; accepted: commit first")


def pytest_benchmark_update_json(output_json: dict[str, Any]) -> None:
    """Write the table with what was timed."""
    rows = rows_of(output_json["benchmarks"], output_json["commit_info"], machine())
    write_table(TABLE, kept(read_table(TABLE), rows))
