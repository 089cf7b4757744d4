"""A card gets rows, has its threads work on them and gives the answers back, or says in a line why not."""

from contextlib import nullcontext
from types import SimpleNamespace

import numpy as np
import pytest

from cointoss.models.kernel import cuda
from cointoss.models.kernel.cuda import CardError, GraphicsCard
from tests.helpers.driver import Driver, Result
from tests.helpers.small import entries

SPACE = 1 << 13
"""Bytes of a thread's work space: those of some 100 arrays, of which a row takes as many as it says."""


@pytest.fixture
def made(monkeypatch, queue):
    """Makes a card of a stand-in for the driver."""

    def card(**how):
        driver = Driver(queue, **how)
        monkeypatch.setattr(cuda, "_driver", lambda: driver)
        return GraphicsCard(), driver

    return card


def worked(card, queue, spaces):
    """Return the answers to rows, and those due: of a row that is left, not a number."""
    rows = np.random.default_rng(2).uniform(size=(len(spaces), 3))
    rows[:, 0] = spaces
    answers, wanted = np.zeros((len(spaces), 2)), np.full((len(spaces), 2), np.nan)
    numbers = entries.sums_on_cards.numbers_of(rows[:1], answers[:1], 2.0)
    card.work(queue.library, numbers, rows, answers, SPACE)
    for i in np.flatnonzero((rows[:, 0] >= 0) & (rows[:, 0] < 100)):
        entries.sums(rows[i : i + 1], wanted[i : i + 1], 2.0)
    return answers, wanted


ROWS = {
    "in one part": (np.arange(700) % 5, {}, 1),
    "in parts": (np.arange(700) % 5, {"MOST_ROWS": 300}, 3),
    "with memory that is given back and used again": (np.full(5000, 20), {}, 1),
    "what needs more than the space and then less": (np.where(np.arange(600) % 3 == 1, 200, 12), {}, 1),
    "with an error": (np.array([2, -1, 2]), {}, 1),
    "on a card that is not watched": (np.full(9, 2), {"SHORT": (0.5, -1e-3)}, 1),
}
"""Arrays that a row takes, what is changed, and how often threads are launched."""


@pytest.mark.parametrize("name", ROWS)
def test_each_row_is_worked_on_once_and_as_by_itself_or_left(made, queue, monkeypatch, name):
    spaces, changed, launches = ROWS[name]
    for constant, value in changed.items():
        monkeypatch.setattr(cuda, constant, value)
    card, driver = made()
    answers, wanted = worked(card, queue, spaces)
    assert np.array_equal(answers, wanted, equal_nan=True)
    assert (driver.launches, driver.memory, len(driver.loaded)) == (launches, {}, 1)


def test_where_a_display_s_watchdog_waits_spaces_are_closed_early(made, queue, monkeypatch):
    monkeypatch.setattr(cuda, "SHORT", (0.5, -1e-3))
    card, _ = made(watched=1)
    assert np.isnan(worked(card, queue, np.full(9, 2))[0]).all()


def test_rows_that_are_left_when_the_threads_end_are_taken_by_the_next(made, queue, monkeypatch):
    """The threads of a first launch take none, as where the time for that is over."""
    card, driver = made()
    launches = iter([lambda *_: (Result.CUDA_SUCCESS,), driver.cuLaunchKernel])
    monkeypatch.setattr(driver, "cuLaunchKernel", lambda *given: next(launches)(*given))
    answers, wanted = worked(card, queue, np.full(50, 3))
    assert np.array_equal(answers, wanted, equal_nan=True)
    assert driver.launches == 1


def test_a_card_that_fails_says_so_in_a_line_and_gives_its_memory_back(made, queue):
    """Half of the free memory is used, and one block of threads at least."""
    card, driver = made(free=2 * 128 * SPACE)
    worked(card, queue, np.full(10, 1))
    driver.free -= 1
    with pytest.raises(CardError, match=r"^NVIDIA Stand-in: too little memory is free, 1 MiB$"):
        worked(card, queue, np.full(10, 1))
    driver.free, driver.fails = 1 << 34, Result.CUDA_ERROR_ILLEGAL_ADDRESS
    with pytest.raises(CardError, match=r"^its threads: CUDA_ERROR_ILLEGAL_ADDRESS$"):
        worked(card, queue, np.full(10, 1))
    assert driver.memory == {}


@pytest.mark.parametrize("capability", [9, 8])
def test_a_driver_that_compiles_is_told_of(made, queue, capability, monkeypatch):
    told = []
    monkeypatch.setattr(cuda, "stage", lambda name, **_: told.append(name) or nullcontext())
    card, driver = made(capability=capability)
    worked(card, queue, np.full(10, 1))
    due = ["NVIDIA's driver compiles the engine for NVIDIA Stand-in, once"]
    assert told == (due if capability == 8 else [])
    assert driver.loaded[0][1:] == (1, [0], [cuda.REGISTERS])


def test_without_a_card_or_a_driver_there_is_none(made, monkeypatch):
    with pytest.raises(CardError, match=r"^CUDA shows no card$"):
        made(cards=0)
    monkeypatch.undo()

    def missing(_):
        raise RuntimeError("libcuda.so.1: cannot open")

    monkeypatch.setattr(cuda, "import_module", lambda _: SimpleNamespace(cuInit=missing))
    with pytest.raises(CardError, match=r"^there is no driver of NVIDIA's$"):
        GraphicsCard()


@pytest.mark.slow
def test_a_card_has_the_same_code_assembled_without_a_fused_product(queue, tmp_path):
    assert ".entry queue(" in queue.ptx
    assert ".target sm_75" in queue.ptx
    assert "mul.rn.f64" in queue.ptx
    assert "fma.rn.f64" not in queue.ptx
    assert "Compiling entry function 'queue' for 'sm_90'" in queue.assembled(tmp_path)
