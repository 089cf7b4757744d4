"""Threads of a card take rows from a queue, each with its work space: shown by those of a processor."""

import numpy as np
import pytest

from tests.helpers.queues import work
from tests.helpers.small import entries


def given(columns):
    return entries.sums_on_cards.numbers_of(np.zeros((1, columns)), np.zeros((1, 2)), 2.0)


def rows_of(spaces, columns=3):
    rows = np.random.default_rng(1).uniform(size=(len(spaces), columns))
    rows[:, 0] = spaces
    return rows


def wanted(rows):
    answers = np.full((len(rows), 2), np.nan)
    entries.sums(rows, answers, 2.0)
    return answers


@pytest.mark.slow_after_first
@pytest.mark.parametrize("threads", [1, 3])
def test_each_row_is_worked_on_once_and_as_by_itself(queue, threads):
    rows, answers = rows_of(np.arange(2000) % 7), np.empty((2000, 2))
    assert work(queue, given(3), rows, answers, space=1 << 14, threads=threads) == 2000 + threads
    assert np.array_equal(answers, wanted(rows), equal_nan=True)


def test_memory_that_is_given_back_is_used_again(queue):
    """A thousand rows of twenty arrays each would need a thousand times the space of one row."""
    rows, answers = rows_of(np.full(1000, 20)), np.empty((1000, 2))
    work(queue, given(3), rows, answers, space=1 << 13, threads=1)
    assert np.array_equal(answers, wanted(rows), equal_nan=True)


def test_what_needs_more_than_the_space_is_left_and_the_next_row_has_all_of_it(queue):
    spaces = np.where(np.arange(60) % 3 == 1, 200, 12)
    rows, answers = rows_of(spaces), np.empty((60, 2))
    work(queue, given(3), rows, answers, space=1 << 13, threads=2)
    is_left = np.isnan(answers[:, 0])
    assert np.array_equal(is_left, spaces == 200)
    assert np.array_equal(answers[~is_left], wanted(rows[~is_left]), equal_nan=True)


def test_an_error_leaves_the_row(queue):
    rows, answers = rows_of([2, -1, 2]), np.empty((3, 2))
    work(queue, given(3), rows, answers, space=1 << 13)
    assert np.isnan(answers[:, 0]).tolist() == [False, True, False]


def test_a_space_that_is_closed_leaves_all_rows(queue):
    rows, answers = rows_of(np.full(9, 2)), np.empty((9, 2))
    assert work(queue, given(3), rows, answers, space=1 << 13, closes_after=-1) == 11
    assert np.isnan(answers).all()


@pytest.mark.slow
def test_a_card_has_the_same_code_assembled_without_a_fused_product(queue, tmp_path):
    assert ".entry queue(" in queue.ptx
    assert ".target sm_75" in queue.ptx
    assert "mul.rn.f64" in queue.ptx
    assert "fma.rn.f64" not in queue.ptx
    assert "Compiling entry function 'queue' for 'sm_90'" in queue.assembled(tmp_path)
