"""Parts of a long study: kept, read again, and made again where damaged."""

import numpy as np

from cointoss_reproduction.frame.parts import kept
from tests.helpers.pickles import Runs


def test_a_part_is_computed_once_and_again_where_its_file_is_damaged(tmp_path):
    made = []

    def compute():
        made.append(1)
        return {"x": np.arange(3)}

    folder = tmp_path / "parts"
    for _ in range(2):
        assert kept(folder, "a-1", compute)["x"].tolist() == [0, 1, 2]
    assert made == [1]
    assert [path.name for path in folder.iterdir()] == ["a-1.npz"]
    (folder / "a-1.npz").write_bytes(b"PK\x03\x04 damaged")
    assert kept(folder, "a-1", compute)["x"].tolist() == [0, 1, 2]
    assert made == [1, 1]


def test_a_part_that_would_run_is_computed_again(tmp_path):
    np.savez(tmp_path / "a-1.npz", x=np.array([Runs(tmp_path / "run")], dtype=object))
    assert kept(tmp_path, "a-1", lambda: {"x": np.arange(3)})["x"].tolist() == [0, 1, 2]
    assert not (tmp_path / "run").exists()
    assert kept(tmp_path, "a-1", dict)["x"].tolist() == [0, 1, 2]
