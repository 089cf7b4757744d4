"""Classes of tosses on one core, by the engines and by heyoka, as users toss many."""

from collections.abc import Callable
from typing import Any

import pytest

from cointoss import toss_many
from tests.benchmarks.classes import CLASSES, TossClass


def by_heyoka(case: TossClass) -> Callable[[], Any]:
    """Return what makes the tosses by heyoka; skip the benchmark where there is none."""
    pytest.importorskip("heyoka", reason="heyoka has wheels for Linux on x86-64 only")
    from tests.benchmarks import heyoka_toss

    return heyoka_toss.prepared(case.scenarios(), in_lanes=case.engine == "heyoka in batch mode")


@pytest.mark.parametrize("name", CLASSES)
def test_tosses(benchmark, name):
    case = CLASSES[name]
    if case.engine.startswith("heyoka"):
        benchmark(by_heyoka(case))
        return
    how = {"engine": case.engine, "trust": case.trust, "workers": 1}
    benchmark(toss_many, case.scenario, case.varied(case.tosses), **how)
