"""One toss, from release to its ending, by the engine and by heyoka; warm."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.models.reading import load

FIG24A = load("fig24a")


def by_the_engine():
    """Return the whole answer, horizon of trust and all."""
    return analytic.toss(FIG24A)


def by_its_event_loop():
    return run(FIG24A.body, FIG24A.rules, state_at_release(FIG24A.release))


def by_heyoka():
    pytest.importorskip("heyoka", reason="heyoka has wheels for Linux on x86-64 only")
    from tests.benchmarks import heyoka_toss

    return heyoka_toss.prepared([FIG24A])


@pytest.mark.parametrize("toss", [by_the_engine, by_its_event_loop])
def test_fig24a(benchmark, toss):
    benchmark(toss)


def test_fig24a_by_heyoka(benchmark):
    """The same toss: after eight impacts rounding decides how it goes on."""
    ((times, faces),) = benchmark(by_heyoka())
    impacts = analytic.toss(FIG24A).impacts[:8]
    assert np.abs(times[:8] - impacts.time).max() < 1e-9
    assert faces[:8] == impacts.face.tolist()
