"""What `make bench` keeps of a commit, and what it says of a slower one."""

import pytest

from tests.benchmarks import keeping
from tests.benchmarks.classes import CLASSES
from tests.benchmarks.keeping import COLUMNS, TABLE, compared, kept, pendulum, read_table, rows_of

COMMIT = {"id": "0123456789abcdef", "time": "2026-11-26T06:00:00+00:00"}
FIVE = [0.006, 0.004, 0.005, 0.007, 0.008]


def timed(name, data, **extra):
    return {"name": name, "stats": {"data": data}, "extra_info": {"reference": 0.002, **extra}}


@pytest.mark.parametrize(
    ("found", "kept_of_it"),
    [
        (timed("test_a[b]", FIVE), [["a[b]", "0.004", "0.0015", 5, "0.002", "2"]]),
        # Times of processes, which pytest-benchmark cannot take.
        (timed("test_a", [1e-7] * 5, times=[0.5, 0.6, 0.7]), [["a", "0.5", "0.1", 3, "0.002", "250"]]),
        (timed("test_once", [1e-7]), []),
    ],
)
def test_a_benchmark_stands_beside_the_reference_of_its_run(found, kept_of_it):
    rows = rows_of([found], COMMIT, "a machine")
    where = ["0123456789", COMMIT["time"], "a machine"]
    assert [list(each.values()) for each in rows] == [where + numbers for numbers in kept_of_it]


def row(commit, ratio, machine="here", benchmark="b"):
    """Return a row of a commit made on the day of its name, whose times are within a tenth."""
    times = {"seconds": "2", "spread": "0.2", "ratio": ratio}
    where = {"commit": f"{commit}000", "date": f"2026-01-0{commit}", "machine": machine}
    return {**where, "benchmark": benchmark, **times}


def test_a_commit_timed_again_on_a_machine_has_its_new_times_alone(tmp_path, monkeypatch):
    found = kept([row(2, "1"), row(3, "2")], [row(3, "3"), row(3, "4", "there"), row(1, "0")])
    assert [each["ratio"] for each in found] == ["0", "1", "3", "4"]
    monkeypatch.setattr(keeping, "TABLE", tmp_path / "benchmarks.csv")
    monkeypatch.setattr(keeping, "machine", lambda: "a machine")
    for name in ("b", "a"):
        keeping.pytest_benchmark_update_json({"benchmarks": [timed(name, FIVE)], "commit_info": COMMIT})
    assert [each["benchmark"] for each in read_table(keeping.TABLE)] == ["a", "b"]
    assert [path.name for path in tmp_path.iterdir()] == ["benchmarks.csv"]


@pytest.mark.parametrize(
    ("ratio", "said"),
    [
        # 0.1 of the time is √2 in the quotient of two.
        ("12.4", "12.4 of the reference, 1.24 [1.06, 1.42] of that of 2000: slower by 24 %"),
        ("11.9", "11.9 of the reference, 1.19 [1.02, 1.36] of that of 2000"),
        ("8.1", "8.1 of the reference, 0.81 [0.70, 0.92] of that of 2000"),
        ("7.9", "7.9 of the reference, 0.79 [0.68, 0.90] of that of 2000: faster by 21 %"),
    ],
)
def test_a_class_that_got_slower_by_a_fifth_is_named(ratio, said):
    """Than the last other commit on this machine, in whatever order the table stands."""
    table = [
        row(2, "10"), row(1, "1"), row(3, "20"), row(2, "30", machine="there"), row(2, "40", benchmark="c")
    ]  # fmt: skip
    assert compared(row(3, ratio), table) == f"b: {said}"
    assert compared(row(3, ratio, machine="new"), table).endswith("reference, the first on this machine")


def test_the_reference_is_a_pendulum(monkeypatch):
    """From one radian at rest it comes back after K(sin 1/2) 4 = 6.69998 units of time, in steps of 0.01."""
    assert [pendulum(steps) for steps in (670, 335)] == pytest.approx([1, -1], abs=1e-5)
    assert keeping.STEPS == 50_000, "the rows of the table are of this reference"
    clock = (-(k**2) for k in range(20, 0, -1))
    monkeypatch.setattr(keeping, "process_time", lambda: next(clock))
    assert keeping.reference() == 2**2 - 1, "the best of ten"


def test_a_class_is_a_grid_of_spins_and_heights_with_what_is_changed_in_it():
    by_heyoka = CLASSES["the same by heyoka"].scenarios()
    assert len(by_heyoka) == 64
    made = [(one.release.angular_velocity[1], one.release.position[2]) for one in by_heyoka]
    assert (made[0], made[-1]) == ((20, 0.2), (60, 0.6))
    assert {one.ending.max_impacts for one in by_heyoka} == {4}


def test_each_row_has_the_ratio_of_its_times():
    rows = read_table(TABLE)
    assert tuple(rows[0]) == COLUMNS
    for each in rows:
        ratio = float(each["seconds"]) / float(each["reference"])
        assert ratio == pytest.approx(float(each["ratio"]), rel=2e-3)
    named = [(each["commit"], each["machine"], each["benchmark"]) for each in rows]
    assert len(set(named)) == len(named)
