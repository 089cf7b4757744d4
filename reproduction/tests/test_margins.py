"""The study of margins: its shares at what it found, its measures on made margins, and its cells."""

import numpy as np

from cointoss_reproduction.frame.cells import Cells, column, read_table, table_of
from cointoss_reproduction.frame.files import TABLE
from cointoss_reproduction.studies.margins.study import (
    ACCURACIES,
    HAND,
    HEIGHT,
    PLANAR_HEIGHT,
    PROOFS,
    found,
    general,
    of_planar,
    parts_proved,
    shares_within,
    sizes_of,
)
from saved import missed, saved, unseen

FOUND = read_table(saved("margins") / TABLE)


def test_a_margin_is_at_most_what_is_found_and_at_least_what_is_proved():
    parts = parts_proved(FOUND)
    assert len(parts) == PROOFS
    assert ((parts >= 0) & (parts <= 1)).all()
    known = FOUND.query("proved.notna()")
    for accuracy in ACCURACIES:
        least, most, uncertain = shares_within(known, accuracy)
        assert least.count == most.count == PROOFS
        # A change by ε is one of those that are tried.
        assert uncertain.value <= least.value <= most.value


def test_a_toss_without_a_margin_is_below_none():
    small = (FOUND["margin"] <= HAND) & FOUND["proved"].isna()
    cells = FOUND.assign(margin=FOUND["margin"].mask(small))
    assert (
        np.isinf(sizes_of(cells, PLANAR_HEIGHT)).sum() == small[FOUND["quantity"] == PLANAR_HEIGHT].sum() > 0
    )
    assert found(cells)["coins"]["the paper's zloty in air, χ = 0.8"]["small"].value == 0
    assert len(missed("margins", cells)) == 2
    assert missed("margins", FOUND) == ()


def test_a_few_tosses_of_both_coins_have_margins_found_and_proved():
    parts = [
        Cells(general, {"quantity": {HEIGHT.name: HEIGHT}}),
        Cells(of_planar, {"quantity": {PLANAR_HEIGHT: HEIGHT}}),
    ]
    cells = table_of(parts, unseen, {"count": 1, "planar": 20, "proofs": 2})
    assert cells["quantity"].value_counts().to_dict() == {PLANAR_HEIGHT: 20, HEIGHT.name: 1}
    assert 0 < np.median(sizes_of(cells, PLANAR_HEIGHT)) < 10
    proved = column(cells, "proved")
    assert len(proved) == 2
    assert 0 < proved[0] < sizes_of(cells, PLANAR_HEIGHT)[0]
    least, most, uncertain = shares_within(cells, ACCURACIES[0])
    assert (least.count, most.count, uncertain.count) == (20, 2, 20)
