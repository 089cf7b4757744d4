"""Whole tosses of a planar thin coin, by the engine and, in air, by two integrators of general use.

The coin falls on a smooth floor, χ = 0.6, from heights of 0.2 to 0.6 m with spins of 20 to 60 rad/s.
`make bench` prints how many each makes in a second; `make test` makes a few, to see that they are the same.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.flight.flying import fly
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.rows import row_of
from cointoss.models.scenario import Scenario
from tests.benchmarks import scipy_toss
from tests.benchmarks.one_coin import OneCoin, mechanics
from tests.benchmarks.rates import numbers_for_heyoka, report
from tests.helpers.draws import AIR, THIN, scenario

fly = by_numba(fly)
MANY, FEW = 8192, 8
BY_HEYOKA = "planar, by_heyoka"


def family(n: int, air: dict[str, float]) -> list[Scenario]:
    """Draw tosses of the coin."""
    rng = np.random.default_rng(8)
    return [
        scenario(
            coin=THIN,
            air=air,
            floor={"restitution": 0.6},
            release={
                "position": [0, 0, rng.uniform(0.2, 0.6)],
                "angular_velocity": [0, rng.uniform(20, 60), 0],
            },
        )
        for _ in range(n)
    ]


IN_AIR = family(FEW, AIR)


@cache
def coin() -> OneCoin:
    return mechanics(IN_AIR[0])


def by_heyoka() -> list[tuple[list[float], list[int]]]:
    numbers = [numbers_for_heyoka(case) for case in IN_AIR]
    from tests.benchmarks import heyoka_toss

    return [heyoka_toss.toss(one, coin(), 10.0) for one in numbers]


def by_scipy() -> list[tuple[list[float], list[int]]]:
    return [scipy_toss.toss(case, coin()) for case in IN_AIR]


@pytest.mark.slow
@pytest.mark.parametrize("toss", [by_heyoka, by_scipy])
def test_other_integrators_make_the_same_tosses(benchmark, capsys, toss: Callable[[], list[Any]]):
    for (times, faces), case in zip(toss(), IN_AIR, strict=True):
        rows = run(case.body, case.rules, state_at_release(case.release)).rows[:3]
        # Three impacts multiply what tolerances differ by by less than 1e4.
        assert times[:3] == pytest.approx(rows["time"], abs=1e-7)
        assert faces[:3] == rows["face"].tolist()
    benchmark(toss)
    report(capsys, benchmark, f"planar, {toss.__name__}", FEW, toss, heyoka=BY_HEYOKA)


@pytest.mark.parametrize("air", [AIR, {}])
@pytest.mark.parametrize("cores", ["one", "all"])
def test_many_tosses(benchmark, capsys, monkeypatch, air, cores):
    # As many as are worth timing only where they are timed.
    cases = family(FEW if benchmark.disabled else MANY, air)
    rows = np.array([row_of(case) for case in cases])
    outcomes = analytic.toss_rows(rows)
    for i in range(FEW):
        tossed = run(cases[i].body, cases[i].rules, state_at_release(cases[i].release))
        assert outcomes.end_time[i] == tossed.end_time
    if cores == "one":
        monkeypatch.setenv("COINTOSS_THREADS", "1")

    def toss():
        return analytic.toss_rows(rows)

    benchmark(toss)
    name = f"planar, analytic.toss_rows, {'in air' if air else 'in vacuum'}, cores: {cores}"
    report(capsys, benchmark, name, len(cases), toss, heyoka=BY_HEYOKA)


@pytest.mark.parametrize(("air", "most"), [({}, 8), (AIR, 10)])
def test_few_gap_evaluations_find_a_touch(capsys, air, most):
    evaluations, flights = 0, 0
    for case in family(40, air):
        for start in run(case.body, case.rules, state_at_release(case.release)).started.states[:-1]:
            evaluations += fly(case.body, start.copy(), 10.0, False).evaluations
            flights += 1
    assert evaluations < most * flights
    with capsys.disabled():
        where = "in air" if air else "in vacuum"
        print(f"\n{evaluations / flights:.1f} gap evaluations for an impact {where}", end="")
