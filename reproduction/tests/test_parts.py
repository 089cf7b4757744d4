"""Parts of a long study: kept, read again, made again where damaged, and removed at the end."""

import numpy as np
import pytest
from matplotlib.figure import Figure

from cointoss_reproduction.frame import runner
from cointoss_reproduction.frame.claim import Claim
from cointoss_reproduction.frame.parts import kept
from cointoss_reproduction.frame.result import Reproduction, Result
from saved import unseen
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


def test_an_interrupted_run_goes_on_and_a_finished_one_leaves_no_parts(tmp_path, monkeypatch):
    made = []

    def make(progress, parts):
        progress(0, 2)

        def compute(number):
            if number == 1 and len(made) == 1:
                made.append("interrupted")
                raise KeyboardInterrupt
            made.append(number)
            return {"number": np.array(number)}

        data = {name: kept(parts, name, lambda name=name: compute(int(name)))["number"] for name in "01"}
        return Result(claims=(Claim(claim="so it is", missing="a test"),), data=data)

    found = Reproduction(
        title="two parts", seconds=1, make=make, resumes=True, draw={"figure": lambda _: Figure()}
    )
    monkeypatch.setattr(runner, "find", lambda _: found)
    folder = tmp_path / "reproduction" / "long"
    with pytest.raises(KeyboardInterrupt):
        runner.reproduce("long", tmp_path, unseen)
    assert [path.name for path in folder.iterdir()] == ["parts"]
    runner.reproduce("long", tmp_path, unseen)
    assert made == [0, "interrupted", 1]
    assert sorted(path.name for path in folder.iterdir()) == [
        "claims.json",
        "data.npz",
        "figure.png",
        "provenance.json",
    ]
