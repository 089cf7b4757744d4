"""Rows of impacts: their room grows, and what is in them stays."""

import numpy as np

from cointoss.models.impact_row import FIRST_ROOM, with_room
from cointoss.models.records import IMPACT_ROW


def test_rows_grow_when_they_are_full_and_keep_what_they_hold():
    rows = np.zeros(FIRST_ROOM, IMPACT_ROW)
    rows["time"] = np.arange(FIRST_ROOM)
    rows["impulse"][:, 2] = np.arange(FIRST_ROOM) + 0.5
    assert with_room(rows, FIRST_ROOM - 1) is rows
    more = with_room(rows, FIRST_ROOM)
    assert len(more) == 2 * FIRST_ROOM
    assert np.all(more[:FIRST_ROOM] == rows)
    assert np.all(more["time"][FIRST_ROOM:] == 0)
