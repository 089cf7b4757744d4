"""The study of margins: its shares at what it found, its measures on made margins, and its cells."""

import numpy as np

from cointoss_reproduction.frame.cells import Cells, read_table, table_of
from cointoss_reproduction.frame.files import TABLE
from cointoss_reproduction.studies.margins.study import (
    ACCURACIES,
    HAND,
    HEIGHT,
    PLANAR_HEIGHT,
    found,
    general,
    of_planar,
    shares_within,
    sizes_of,
)
from saved import missed, saved, unseen

FOUND = read_table(saved("margins") / TABLE)


def test_a_toss_that_an_accuracy_leaves_uncertain_has_a_smaller_margin():
    """A change by ε is one of those that are tried."""
    for accuracy in ACCURACIES:
        least, uncertain = shares_within(FOUND, accuracy)
        assert uncertain.value <= least.value


def test_a_toss_without_a_margin_is_below_none():
    small = FOUND["margin"] <= HAND
    cells = FOUND.assign(margin=FOUND["margin"].mask(small))
    assert (
        np.isinf(sizes_of(cells, PLANAR_HEIGHT)).sum() == small[FOUND["quantity"] == PLANAR_HEIGHT].sum() > 0
    )
    assert found(cells)["coins"]["the paper's zloty in air, χ = 0.8"]["small"].value == 0
    assert len(missed("margins", cells)) == 2


def test_a_few_tosses_of_both_coins_have_margins():
    parts = [
        Cells(general, {"quantity": {HEIGHT.name: HEIGHT}}),
        Cells(of_planar, {"quantity": {PLANAR_HEIGHT: HEIGHT}}),
    ]
    cells = table_of(parts, unseen, {"count": 1, "planar": 20})
    assert cells["quantity"].value_counts().to_dict() == {PLANAR_HEIGHT: 20, HEIGHT.name: 1}
    assert 0 < np.median(sizes_of(cells, PLANAR_HEIGHT)) < 10
    assert [part.count for part in shares_within(cells, ACCURACIES[0])] == [20, 20]
