"""Classes of tosses on one core, by the engines and by heyoka, as users toss many."""

import pytest

from cointoss import toss_many
from tests.benchmarks.classes import CLASSES, HEYOKA


@pytest.mark.parametrize("name", CLASSES)
def test_tosses(benchmark, name):
    case = CLASSES[name]
    if case.engine.startswith("heyoka"):
        by = pytest.importorskip("tests.benchmarks.heyoka_toss", reason=HEYOKA)
        benchmark(by.prepared(case.scenarios(), in_lanes=case.engine == "heyoka in batch mode"))
    else:
        how = {"engine": case.engine, "trust": case.trust, "workers": 1}
        benchmark(toss_many, case.scenario, case.varied(case.tosses), **how)
