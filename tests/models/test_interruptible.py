"""Work on another thread: its answers, errors, warnings and settings are those of the thread that asks."""

import threading
import traceback
import warnings

import numpy as np
import pytest

from cointoss.models.interruptible import begun, interruptible
from cointoss.models.tiles import in_tiles


def test_the_main_thread_waits_for_another_which_does_nested_work_itself():
    main, inner, nested = interruptible(
        lambda: (
            threading.main_thread() is threading.current_thread(),
            threading.current_thread(),
            interruptible(threading.current_thread),
        )
    )
    assert not main
    assert inner is nested
    assert inner.daemon


def test_an_error_comes_with_its_traceback():
    def failing():
        raise LookupError("inside")

    with pytest.raises(LookupError, match="inside") as caught:
        interruptible(failing)
    assert "failing" in [frame.name for frame in traceback.extract_tb(caught.tb)]


def test_warnings_and_numpy_errors_are_treated_as_the_caller_asks():
    with pytest.raises(UserWarning, match="here"):  # the tests make warnings errors
        interruptible(lambda: warnings.warn("here", stacklevel=1))
    with np.errstate(divide="raise"), pytest.raises(FloatingPointError):
        interruptible(lambda: np.float64(1) / np.float64(0))
    with np.errstate(divide="ignore"):
        assert begun(lambda: np.float64(1) / np.float64(0)).result() == np.inf


@pytest.mark.parametrize(("n", "size"), [(0, 5), (1, 1), (4, 1), (15, 1), (24, 3), (1000, 5), (1003, 5)])
def test_every_tile_is_made_once_and_each_thread_has_some(n, size, monkeypatch):
    monkeypatch.setenv("COINTOSS_THREADS", "2")
    times, sizes = np.zeros(n, dtype=int), np.zeros(n, dtype=int)

    def number(part):
        times[part] += 1
        sizes[part] = part.stop - part.start

    in_tiles(n, 5, number)
    assert times.tolist() == [1] * n
    assert sizes.tolist() == [size] * (n - n % size) + [n % size] * (n % size)


def test_a_tile_that_fails_keeps_those_not_begun_from_being_made():
    made = []

    def failing(part):
        made.append(part)
        raise LookupError("a tile")

    with pytest.raises(LookupError, match="a tile"):
        in_tiles(1000, 1, failing)
    assert 1 <= len(made) <= threading.active_count() + 64
