"""One toss, from release to its ending, by the engine and by heyoka; warm."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.models.reading import load
from tests.benchmarks.classes import HEYOKA

FIG24A = load("fig24a")
TOSSES = {
    # The whole answer, horizon of trust and all.
    "by_the_engine": lambda: analytic.toss(FIG24A),
    "by_its_event_loop": lambda: run(FIG24A.body, FIG24A.rules, state_at_release(FIG24A.release)),
}


@pytest.mark.parametrize("toss", TOSSES)
def test_fig24a(benchmark, toss):
    benchmark(TOSSES[toss])


def test_fig24a_by_heyoka(benchmark):
    """The same toss: after eight impacts rounding decides how it goes on."""
    by = pytest.importorskip("tests.benchmarks.heyoka_toss", reason=HEYOKA)
    ((times, faces),) = benchmark(by.prepared([FIG24A]))
    impacts = analytic.toss(FIG24A).impacts[:8]
    assert np.abs(times[:8] - impacts.time).max() < 1e-9
    assert faces[:8] == impacts.face.tolist()
