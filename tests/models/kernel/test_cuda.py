"""A card gets rows, has its threads work on them and gives the answers back, or says in a line why not."""

from contextlib import nullcontext
from types import SimpleNamespace

import numpy as np
import pytest

from cointoss.models.kernel import cuda
from cointoss.models.kernel.cuda import CardError, GraphicsCard
from tests.helpers.driver import Driver, Result
from tests.helpers.small import entries

SPACE = 1 << 14


@pytest.fixture
def made(monkeypatch, queue):
    """Makes a card of a stand-in for the driver."""

    def card(**how):
        driver = Driver(queue, **how)
        monkeypatch.setattr(cuda, "_driver", lambda: driver)
        return GraphicsCard(), driver

    return card


def worked(card, queue, spaces):
    rows = np.random.default_rng(2).uniform(size=(len(spaces), 3))
    rows[:, 0] = spaces
    answers, wanted = np.zeros((len(spaces), 2)), np.full((len(spaces), 2), np.nan)
    numbers = entries.sums_on_cards.numbers_of(rows[:1], answers[:1], 2.0)
    card.work(queue.library, numbers, rows, answers, SPACE)
    entries.sums(rows, wanted, 2.0)
    return answers, wanted


@pytest.mark.slow
def test_answers_are_those_of_the_entry_whatever_is_on_the_card_at_a_time(made, queue, monkeypatch):
    card, driver = made()
    answers, wanted = worked(card, queue, np.arange(700) % 5)
    assert np.array_equal(answers, wanted, equal_nan=True)
    assert (driver.launches, driver.memory) == (1, {})
    monkeypatch.setattr(cuda, "MOST_ROWS", 300)
    answers, wanted = worked(card, queue, np.arange(700) % 5)
    assert np.array_equal(answers, wanted, equal_nan=True)
    assert driver.launches == 4
    assert len(driver.loaded) == 1


def test_rows_that_are_left_when_the_threads_end_are_taken_by_the_next(made, queue, monkeypatch):
    card, driver = made()
    launch = driver.cuLaunchKernel

    def at_the_third(*given):
        """Launch threads that take no row, as where the time for that is over."""
        asked.append(given)
        return launch(*given) if len(asked) == 3 else (Result.CUDA_SUCCESS,)

    asked = []
    monkeypatch.setattr(driver, "cuLaunchKernel", at_the_third)
    answers, wanted = worked(card, queue, np.full(50, 3))
    assert np.array_equal(answers, wanted, equal_nan=True)
    assert len(asked) == 3


def test_the_threads_are_as_many_as_the_memory_has_room_for(made, queue):
    card, driver = made(free=2 * 128 * SPACE)
    worked(card, queue, np.full(10, 1))
    driver.free -= 1
    with pytest.raises(CardError, match=r"^NVIDIA Stand-in: too little memory is free, 3 MiB$"):
        worked(card, queue, np.full(10, 1))


def test_a_card_that_fails_says_so_in_a_line_and_gives_its_memory_back(made, queue):
    card, driver = made()
    driver.fails = Result.CUDA_ERROR_ILLEGAL_ADDRESS
    with pytest.raises(CardError, match=r"^its threads: CUDA_ERROR_ILLEGAL_ADDRESS$"):
        worked(card, queue, np.full(10, 1))
    assert driver.memory == {}


def test_a_driver_that_shows_no_card_is_told(made):
    with pytest.raises(CardError, match=r"^CUDA shows no card$"):
        made(cards=0)


@pytest.mark.parametrize("capability", [9, 8])
def test_a_driver_that_compiles_is_told_of(made, queue, capability, monkeypatch):
    told = []
    monkeypatch.setattr(cuda, "stage", lambda name, **_: told.append(name) or nullcontext())
    card, driver = made(capability=capability)
    worked(card, queue, np.full(10, 1))
    due = ["NVIDIA's driver compiles the engine for NVIDIA Stand-in, once"]
    assert told == (due if capability == 8 else [])
    assert driver.loaded[0][1:] == (1, [0], [cuda.REGISTERS])


def test_without_a_driver_there_is_no_card(monkeypatch):
    def missing(_):
        raise RuntimeError("libcuda.so.1: cannot open")

    monkeypatch.setattr(cuda, "import_module", lambda _: SimpleNamespace(cuInit=missing))
    with pytest.raises(CardError, match=r"^there is no driver of NVIDIA's$"):
        GraphicsCard()
