"""A card's threads toss as a processor does, to the bit: shown by the same code, built for a processor."""

import re
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import on_device
from cointoss.analytic.by_rows import CERTAIN, NO_TRUST
from cointoss.analytic.entries import toss_apart
from cointoss.analytic.on_device import SPACE, SPACE_OF_TRUST
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.models.answers import NOT_TOSSED, unanswered
from cointoss.models.kernel import cuda
from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.cuda import STACK, CardError, GraphicsCard
from cointoss.models.rows import has_linear_air, row_of
from tests.helpers.bits import cases
from tests.helpers.driver import Driver
from tests.helpers.queues import queue_of

ROWS = np.array([row for row in map(row_of, cases().values()) if has_linear_air(row)])
LIMITS = contact_limits(MANY)
SPACES = {NO_TRUST: SPACE, CERTAIN: SPACE_OF_TRUST}


class ByLibrary:
    """A card that has the engine's library toss what it is given, and leaves each third row."""

    def work(self, _file, numbers, rows, answers, space):
        wanted = int(numbers[-1])
        assert space == SPACES[wanted]
        toss_apart(rows, answers, LIMITS, wanted)
        answers[::3] = np.nan


def assert_tossed(card: Any, wanted):
    """Toss all rows on a card, see that they are as by the processor, and return which the card left."""
    found, due = unanswered(len(ROWS)), unanswered(len(ROWS))
    on_device.toss_on_device(card, ROWS, LIMITS, wanted, found)
    analytic.toss_rows(ROWS, trust=None if wanted == NO_TRUST else "certain", answers=due)
    is_left = found[:, 0] == NOT_TOSSED
    assert np.array_equal(found[~is_left].view(np.int64), due[~is_left].view(np.int64))
    return is_left


@pytest.mark.parametrize("wanted", SPACES)
def test_what_a_card_leaves_is_handed_over(monkeypatch, wanted):
    monkeypatch.setattr(on_device, "library_file", lambda *_: None)
    assert np.flatnonzero(assert_tossed(ByLibrary(), wanted)).tolist() == [*range(0, len(ROWS), 3)]


@pytest.fixture(scope="module")
def queue(tmp_path_factory):
    return queue_of(toss_apart.library.module, tmp_path_factory.mktemp("queue"))


@pytest.mark.long
@pytest.mark.parametrize(
    ("wanted", "space", "most"), [(NO_TRUST, SPACE, 0.1), (CERTAIN, SPACE_OF_TRUST, 0.5)]
)
def test_tosses_of_every_kind_are_the_same_to_the_bit(monkeypatch, queue, wanted, space, most):
    """Few need more than the work space; with an eighth of it more do, and are handed over."""
    monkeypatch.setattr(cuda, "_driver", lambda: Driver(queue))
    monkeypatch.setattr(on_device, "library_file", lambda *_: queue.library)
    left = assert_tossed(GraphicsCard(), wanted).sum()
    assert left < most * len(ROWS)
    for name in ("SPACE", "SPACE_OF_TRUST"):
        monkeypatch.setattr(on_device, name, space // 8)
    assert left < assert_tossed(GraphicsCard(), wanted).sum() < len(ROWS)


def test_without_code_for_cards_the_card_can_not_be_used(monkeypatch):
    def missing(*_):
        raise EngineMissingError("no analytic engine for cuda")

    monkeypatch.setattr(on_device, "library_file", missing)
    with pytest.raises(CardError, match=r"^no analytic engine for cuda$"):
        assert_tossed(None, NO_TRUST)


@pytest.mark.long
def test_a_card_has_the_engine_without_a_fused_product_and_on_a_stack_of_known_size(queue, tmp_path):
    assert "fma.rn.f64" not in queue.ptx
    said = queue.assembled(tmp_path)
    frames = [int(size) for size in re.findall(r"(\d+) bytes stack frame", said)]
    assert 0 < sum(sorted(frames)[-6:]) <= STACK
    assert re.search(r"Used 128 registers", said)
