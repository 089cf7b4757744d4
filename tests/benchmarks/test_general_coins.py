"""Tosses of general coins: whole ones by the engine, and their first impacts by the engine and by heyoka.

`make bench` prints how many each makes in a second; `make test` makes a few, to see that they are the same.
heyoka has flights and impacts only, so it makes tosses that have no sustained contact so far.
"""

from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.runs import run
from cointoss.models.batch import rows_from_states
from cointoss.models.records import Array, Ending
from cointoss.models.scenario import Scenario
from tests.benchmarks.one_coin import mechanics
from tests.benchmarks.rates import numbers_for_heyoka, report
from tests.helpers.corpus import CLASSES, CoinClass
from tests.helpers.many import as_parts

MANY, FEW = 64, 4
IMPACTS = 4
"""Of a toss that heyoka makes too."""
SHOWN = (
    "thin, ideal, air, smooth",
    "thin, ideal, vacuum, coulomb",
    "thick, imperfect, air, smooth",
    "thick, imperfect, air, coulomb",
)
KINDS = [kind for kind in CLASSES if kind.name in SHOWN]


def number_of_tosses(benchmark: Any) -> int:
    """Return as many as are worth timing only where they are timed."""
    return FEW if benchmark.disabled else MANY


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_whole_tosses(benchmark, capsys, monkeypatch, kind):
    monkeypatch.setenv("COINTOSS_THREADS", "1")
    scenario, number = kind.scenario, number_of_tosses(benchmark)
    rows = kind.rows(number)

    def toss():
        return analytic.toss_rows(rows)

    end_times = toss().end_time[:FEW]
    starts = kind.starts(number)[:FEW]
    assert end_times.tolist() == [run(scenario.body, scenario.rules, start).end_time for start in starts]
    benchmark(toss)
    report(capsys, benchmark, f"{kind.name}, whole: analytic.toss_rows", number, toss)


def bouncing(kind: CoinClass, number: int) -> tuple[Scenario, Array]:
    """Return the scenario with a toss over after `IMPACTS`, and starts that come so far, (number, 13)."""
    scenario = kind.scenario.replace("ending.max_impacts", IMPACTS)
    starts = []
    for start in kind.starts(2 * number):
        log = run(scenario.body, scenario.rules, start)
        if log.ending == Ending.MAX_IMPACTS and len(log.contacts) == 0:
            starts.append(start)
    assert len(starts) >= number
    return scenario, np.array(starts[:number])


@pytest.mark.slow
@pytest.mark.parametrize("batch", [False, True], ids=["one by one", "batch mode"])
@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_first_impacts_by_heyoka(benchmark, capsys, kind, batch):
    scenario, starts = bouncing(kind, number_of_tosses(benchmark))
    coin = mechanics(scenario)
    numbers = [numbers_for_heyoka(scenario.replace("release", as_parts(start))) for start in starts]
    from tests.benchmarks import heyoka_toss

    def toss():
        if batch:
            return heyoka_toss.toss_batch(numbers, coin, IMPACTS)
        return [heyoka_toss.toss(one, coin, 10.0, IMPACTS) for one in numbers]

    for (times, faces), start in zip(benchmark(toss), starts, strict=True):
        rows = run(scenario.body, scenario.rules, start).rows
        # An impact multiplies what tolerances differ by, by less than 100 on average.
        assert times == pytest.approx(rows["time"], abs=1e-6)
        assert faces == rows["face"].tolist()
    by_heyoka = f"{kind.name}, {IMPACTS} impacts: heyoka"
    name = f"{by_heyoka} in batch mode" if batch else by_heyoka
    report(capsys, benchmark, name, len(starts), toss, heyoka=by_heyoka)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_first_impacts_by_the_engine(benchmark, capsys, monkeypatch, kind):
    monkeypatch.setenv("COINTOSS_THREADS", "1")
    scenario, starts = bouncing(kind, number_of_tosses(benchmark))
    rows = rows_from_states(scenario, starts)

    def toss():
        return analytic.toss_rows(rows)

    assert (toss().impacts == IMPACTS).all()
    benchmark(toss)
    name = f"{kind.name}, {IMPACTS} impacts: "
    report(capsys, benchmark, f"{name}analytic.toss_rows", len(starts), toss, heyoka=f"{name}heyoka")
