"""The two kinds of impacts that change the face, on sequences that are known."""

import numpy as np
import pytest

from cointoss_reproduction.setups.face_changes import changes, share_after_row


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


def test_the_share_after_a_row_is_that_of_all_changes():
    found = share_after_row(np.array([[3, 1], [0, 0], [6, 2]] * 20))
    assert found.ends == pytest.approx((0.75, 0.75, 0.75))
    assert found.count == 60
