"""A batch is tossed in pieces of a second, and what is tossed when Ctrl-C comes is kept."""

from types import SimpleNamespace

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.engines import Engine
from cointoss.compare.sweep import pieces as module
from cointoss.compare.sweep.batch import batch_of
from cointoss.compare.sweep.pieces import FIRST, MOST, SECOND, How, pieces, whole
from cointoss.models.answers import Answers

HOW = How(engine=Engine.ANALYTIC, settings=analytic.MANY)


@pytest.mark.parametrize(("cost", "most"), [(1e-6, MOST), (4e-3, 250), (3.0, FIRST)])
def test_a_piece_takes_a_second(monkeypatch, cost, most):
    now, sizes = [0.0], []

    def toss(_batch, _how, piece):
        now[0] += cost * len(piece)
        sizes.append(len(piece))
        yield Answers.of_table(np.zeros((len(piece), 7)))

    monkeypatch.setattr(module, "_tossed", toss)
    monkeypatch.setattr(module, "time", SimpleNamespace(perf_counter=lambda: now[0]))
    batch = batch_of("fig24a", {"height": "0.2:0.6:1000", "spin": "20:60:400"})
    count = len(batch) if cost < 1e-3 else 2000
    numbers = np.concatenate([tosses for tosses, _ in pieces(batch, HOW, [np.arange(count)])])
    assert np.array_equal(numbers, np.arange(count))
    assert max(sizes) <= most
    # None takes much longer than a second, once the cost is known; and cheap tosses have few pieces.
    assert all(size * cost <= SECOND * 1.01 or size == 1 for size in sizes[1:])
    assert cost > 1e-4 or len(sizes) <= 9


def test_the_numbers_of_a_large_batch_are_never_all_in_memory():
    parts = whole(10**12)
    assert (next(parts)[-1], next(parts)[0]) == (MOST - 1, MOST)
