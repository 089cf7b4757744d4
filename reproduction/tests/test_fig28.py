"""The two kinds of impacts that change the face, on sequences that are known."""

import numpy as np
import pytest

from cointoss_reproduction.setups.face_changes import changes


@pytest.mark.parametrize(
    ("sequence", "after_row", "after_one"),
    [
        ("HHHT", [2], []),
        ("HTTH", [2], [0]),
        ("HTHT", [], [0, 1, 2]),
        ("HHTHH", [1], [2]),
        ("TTTT", [], []),
    ],
)
def test_changes_are_told_apart_by_the_row_before(sequence, after_row, after_one):
    faces = np.array([1 if face == "H" else 2 for face in sequence], dtype=np.int8)
    row, one = changes(faces)
    assert row.tolist() == after_row
    assert one.tolist() == after_one
