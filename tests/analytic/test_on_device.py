"""A card's threads toss as a processor does, to the bit: shown by the same code, built for a processor."""

import re
from typing import Any

import numpy as np
import pytest

from cointoss import analytic
from cointoss.analytic import on_device
from cointoss.analytic.by_rows import CERTAIN, NO_TRUST
from cointoss.analytic.entries import toss_apart
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.models.answers import NOT_TOSSED, unanswered
from cointoss.models.batch import rows_of
from cointoss.models.kernel.base_folder import EngineMissingError
from cointoss.models.kernel.cuda import STACK, CardError
from cointoss.models.reading import load
from cointoss.models.rows import has_linear_air
from tests.helpers.bits import cases
from tests.helpers.queues import queue_of, work


@pytest.fixture(scope="module")
def queue(tmp_path_factory):
    return queue_of(toss_apart.library.module, tmp_path_factory.mktemp("queue"))


class OnProcessor:
    """A card whose threads are those of this processor."""

    def __init__(self, queue, space=None):
        self.queue, self.space = queue, space

    def work(self, file, numbers, rows, answers, space):
        assert file is None
        work(self.queue, numbers, rows, answers, space=self.space or space)


class ByLibrary:
    """A card that has the engine's library toss, and leaves each third row."""

    def work(self, _file, _numbers, rows, answers, _space):
        toss_apart(rows, answers, contact_limits(MANY), NO_TRUST)
        answers[::3] = np.nan


@pytest.fixture
def tossed(monkeypatch):
    """Tosses rows on a card, sees that they are as by the processor, and returns which the card left."""
    monkeypatch.setattr(on_device, "library_file", lambda *_: None)

    def both(card: Any, rows, wanted=NO_TRUST):
        found, due = unanswered(len(rows), None), unanswered(len(rows), None)
        on_device.toss_on_device(card, rows, contact_limits(MANY), wanted, found)
        analytic.toss_rows(rows, trust=None if wanted == NO_TRUST else "certain", answers=due)
        is_left = found[:, 0] == NOT_TOSSED
        assert np.array_equal(found[~is_left].view(np.int64), due[~is_left].view(np.int64))
        assert (found[~is_left, 5:] >= 0).all() == (wanted != NO_TRUST)
        return is_left

    return both


def thrown(name, n, **changed):
    """Return releases of a scenario that differ in height and spin."""
    draw = np.random.default_rng(7)
    varied = {
        "release.position.z": draw.uniform(0.2, 0.6, n),
        "release.angular_velocity.eta": draw.uniform(20, 60, n),
    }
    return rows_of(load(name), n, varied | {field.replace("__", "."): to for field, to in changed.items()})


def test_what_a_card_leaves_is_handed_over(tossed):
    assert np.flatnonzero(tossed(ByLibrary(), thrown("fig24a", 7))).tolist() == [0, 3, 6]


@pytest.mark.long
def test_tosses_of_every_kind_are_the_same_to_the_bit(queue, tossed):
    rows = np.concatenate([rows_of(case, 1) for case in cases().values()])
    rows = np.concatenate([rows[list(map(has_linear_air, rows))], thrown("fig24a", 20), thrown("zloty", 5)])
    assert tossed(OnProcessor(queue), rows).mean() < 0.1


@pytest.mark.long
def test_impacts_that_can_be_trusted_and_certainty_are_the_same(queue, tossed):
    rows = np.concatenate([thrown("fig24a", 20), thrown("zloty", 6)])
    is_left = tossed(OnProcessor(queue), rows, CERTAIN)
    assert not is_left[:20].any()
    assert not is_left[20:].all()


@pytest.mark.long
def test_what_needs_more_than_the_work_space_is_handed_over(queue, tossed):
    rows = np.concatenate([thrown("fig24a", 20, ending__max_impacts=1), thrown("zloty", 20)])
    assert 0 < tossed(OnProcessor(queue, 8192), rows).sum() < 40


def test_without_code_for_cards_the_card_can_not_be_used(monkeypatch):
    def missing(*_):
        raise EngineMissingError("no analytic engine for cuda")

    monkeypatch.setattr(on_device, "library_file", missing)
    rows: Any = thrown("fig24a", 1)
    card: Any = None
    with pytest.raises(CardError, match=r"^no analytic engine for cuda$"):
        on_device.toss_on_device(card, rows, contact_limits(MANY), NO_TRUST, unanswered(1))


@pytest.mark.long
def test_a_card_has_the_engine_without_a_fused_product_and_on_a_stack_of_known_size(queue, tmp_path):
    assert "fma.rn.f64" not in queue.ptx
    said = queue.assembled(tmp_path)
    frames = [int(size) for size in re.findall(r"(\d+) bytes stack frame", said)]
    assert 0 < sum(sorted(frames)[-6:]) <= STACK
    assert re.search(r"Used 128 registers", said)
