"""What `make bench KEEP=1` keeps: a row for each benchmark of a commit on a machine."""

import pytest

from tests.benchmarks import keeping
from tests.benchmarks.keeping import COLUMNS, STEPS, kept, pendulum, read_table, reference, rows_of

COMMIT = {"id": "0123456789abcdef", "time": "2026-11-26T06:00:00+00:00"}


def timed(name, data, **extra):
    return {"name": name, "stats": {"data": data}, "extra_info": {"reference": 0.002, **extra}}


def test_a_benchmark_stands_beside_the_reference_of_its_run():
    (row,) = rows_of([timed("test_a[b]", [0.006, 0.004, 0.005, 0.007, 0.008])], COMMIT, "a machine")
    assert tuple(row) == COLUMNS
    assert list(row.values()) == [
        "0123456789", COMMIT["time"], "a machine", "a[b]", "0.004", "0.0015", 5, "0.002", "2"
    ]  # fmt: skip


def test_times_that_a_benchmark_took_itself_are_taken():
    """Those of processes: pytest-benchmark times this one's."""
    (row,) = rows_of([timed("test_start", [1e-7] * 5, times=[0.5, 0.6, 0.7])], COMMIT, "a machine")
    assert (row["seconds"], row["rounds"], row["ratio"]) == ("0.5", 3, "250")
    assert rows_of([timed("test_once", [1e-7])], COMMIT, "a machine") == []


def test_a_commit_timed_again_on_a_machine_has_its_new_times_alone(tmp_path):
    def row(commit, date, ratio, machine="a"):
        return {"commit": commit, "date": date, "machine": machine, "benchmark": "b", "ratio": ratio}

    old = [row("one", "2026-01", "1"), row("two", "2026-02", "2")]
    found = kept(
        old, [row("two", "2026-02", "3"), row("two", "2026-02", "4", "b"), row("zero", "2025-12", "0")]
    )
    assert [each["ratio"] for each in found] == ["0", "1", "3", "4"]
    assert read_table(tmp_path / "none.csv") == []


def test_what_is_kept_is_added_to_the_table(tmp_path, monkeypatch):
    monkeypatch.setattr(keeping, "TABLE", tmp_path / "benchmarks.csv")
    monkeypatch.setattr(keeping, "machine", lambda: "a machine")
    for name in ("b", "a"):
        found = {"benchmarks": [timed(name, [0.004, 0.006])], "commit_info": COMMIT}
        keeping.pytest_benchmark_update_json(found)
    assert [row["benchmark"] for row in read_table(tmp_path / "benchmarks.csv")] == ["a", "b"]
    assert [path.name for path in tmp_path.iterdir()] == ["benchmarks.csv"]


def test_the_reference_is_a_pendulum(monkeypatch):
    """From one radian at rest it comes back after K(sin 1/2) 4 = 6.69998 units of time, in steps of 0.01."""
    assert pendulum(670) == pytest.approx(1, abs=1e-5)
    assert pendulum(335) == pytest.approx(-1, abs=1e-5)
    assert STEPS == 50_000, "the rows of the table are of this reference"
    clock = (-(k**2) for k in range(20, 0, -1))
    monkeypatch.setattr(keeping, "process_time", lambda: next(clock))
    assert reference() == 2**2 - 1, "the best of ten"
