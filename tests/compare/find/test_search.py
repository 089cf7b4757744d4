"""The search of a window, by formulas in place of tosses: the middle of what shows it, and what is rare."""

from typing import Any

import numpy as np
import pytest

from cointoss.compare.find.find import _rooms
from cointoss.compare.find.search import Hit, _centred, _scanned, search
from cointoss.compare.sweep.axes import Span
from cointoss.compare.sweep.window import Window
from cointoss.models.reading import load
from cointoss.models.records import Outcome


class Formula:
    """A target that so many steps of are shown as a formula of points says, -1 where there is no toss."""

    in_words = "it"

    def __init__(self, steps, formula, outcome=None) -> None:
        self.steps, self.formula, self.outcome = steps, formula, outcome

    def shown(self, _window, points, steps=None):
        return np.minimum(self.formula(*points.T), self.steps if steps is None else steps)


def window(count, ends=(10.0, 20.0)):
    fields = ("release.position.z", "release.velocity.z")[:count]
    spans = tuple(Span(field=field, unit="", start=ends[0], stop=ends[1]) for field in fields)
    return Window(scenario=load("fig24a"), spans=spans)


def searched(target: Any, fields, tosses, seed=0, *tell):
    return search(window(fields), target, tosses, seed, *tell)


def common_half(x):
    return np.where(x < 0.5, 1, 0)


def rectangle(x, y):
    return np.where((0.2 < x) & (x < 0.6) & (0.1 < y) & (y < 0.9), 1, 0)


def stripe(x, y):
    return np.where(np.abs(x - y + 0.1) < 0.05, 1, 0)


def of_stripe(x, y):
    left, right = x - y + 0.15, y - x - 0.05
    return [[left, right], [right, left]]


def none_beyond(x, y):
    """What is not accepted ends the search, and shows nothing else."""
    return np.where(x > 0.6, -1, rectangle(x, y))


@pytest.mark.parametrize(
    ("formula", "margins", "least"),
    [
        (rectangle, lambda x, y: [[x - 0.2, 0.6 - x], [y - 0.1, 0.9 - y]], 0.97 * 0.2),
        (stripe, of_stripe, 0.9 * 0.05),
        (none_beyond, lambda x, y: [[x - 0.2, np.inf], [y - 0.1, 0.9 - y]], 0.97 * 0.2),
    ],
)
def test_a_hit_is_in_the_middle_and_its_margins_end_where_something_else_is_shown(formula, margins, least):
    hits = searched(Formula(1, formula), 2, 64).hits
    assert [hit.margin for hit in hits] == sorted([hit.margin for hit in hits], reverse=True)
    for hit in hits:
        assert hit.margins == pytest.approx(np.array(margins(*hit.point)), rel=1e-5, abs=1e-7)
    assert hits[0].margin > least


def test_a_hit_near_a_corner_is_moved_to_the_middle():
    target: Any = Formula(1, rectangle)
    found = _centred(window(2), target, Hit(np.array([0.25, 0.2]), np.full((2, 2), 1.0)))
    assert found.margin == pytest.approx(0.2, rel=0.03)


def test_a_slit_between_two_rungs_of_the_ladder_is_scanned():
    """From 0.12 to 0.15 away, where the rungs are at 0.1 and 0.178."""
    target: Any = Formula(1, lambda x: np.where((0.52 < x) & (x < 0.55), 0, 1))
    (down, up), *_ = _scanned(window(1), target, np.array([0.4])).margins
    assert np.isinf(down)
    assert 0.12 <= up < 0.13


@pytest.mark.parametrize(
    ("margins", "least"), [([[0.3, np.inf], [0.2, 0.1]], 0.1), ([[np.inf, np.inf], [np.inf, 2.0]], 1.0)]
)
def test_the_margin_of_a_hit_is_the_smallest_of_all_and_of_the_window(margins, least):
    assert Hit(np.zeros(2), np.array(margins)).margin == least


def test_of_two_regions_the_wider_one_is_found():
    two_regions = Formula(1, lambda x: np.where(((0.05 < x) & (x < 0.3)) | ((0.5 < x) & (x < 0.9)), 1, 0))
    found = searched(two_regions, 1, 64)
    assert found.hits[0].point[0] == pytest.approx(0.7, abs=1e-3)
    assert found.hits[0].margins == pytest.approx(np.array([[0.2, 0.2]]), rel=0.01)


def test_what_is_too_rare_for_the_window_is_found_in_ever_smaller_boxes():
    """Each step is shown by a tenth of what shows the step before."""

    def nested(x, y):
        apart = np.maximum(np.abs(x - 0.3), np.abs(y - 0.8))
        return np.sum(apart[:, None] < 10.0 ** -np.arange(1, 9), axis=1)

    found = searched(Formula(8, nested), 2, 256)
    assert found.longest == 8
    assert np.abs(found.hits[0].point - [0.3, 0.8]).max() < 1e-8
    assert found.hits[0].margin == pytest.approx(1e-8, rel=0.05)


@pytest.mark.parametrize(
    ("formula", "tosses", "refused", "longest"),
    [
        # Of Sobol's first 256 points a quarter is in each quarter.
        (lambda x: np.where(x < 0.25, -1, 0), 192, 64, 0),
        (lambda x: np.full(len(x), -1), 0, 256, -1),
        (lambda x: np.where(x < 0.5, 0, 2), 256, 0, 2),
    ],
)
def test_points_that_are_no_tosses_are_counted_as_such(formula, tosses, refused, longest):
    found = searched(Formula(3, formula), 1, 256)
    assert (found.tosses, found.refused, found.longest, found.hits) == (tosses, refused, longest, ())


def test_a_search_ends_where_enough_is_found_and_depends_on_its_seed():
    common, said = [searched(Formula(1, common_half), 1, 1 << 20, seed) for seed in (1, 1, 2)], []
    assert [one.tosses for one in common] == [4096] * 3
    assert common[0].hits[0].point == common[1].hits[0].point != common[2].hits[0].point
    whole = searched(Formula(1, common_half, outcome=Outcome.HEADS), 1, 1 << 20, 0, said.append)
    assert (whole.tosses, len(whole.hits), said[0].split(";")[0]) == (128, 1, "64 tosses show it")


@pytest.mark.parametrize(
    ("ends", "value", "down", "up"), [((10.0, 20.0), 12.5, 1.0, 2.0), ((20.0, 10.0), 17.5, 2.0, 1.0)]
)
def test_a_room_is_in_the_units_of_its_field_whichever_way_the_span_runs(ends, value, down, up):
    (found,) = _rooms(window(1, ends), Hit(np.array([0.25]), np.array([[0.1, 0.2]])))
    assert (found.value, found.down, found.up) == (value, down, up)
