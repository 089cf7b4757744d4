"""The bounce by the MuJoCo of another Python, here the same one, and what it differs in."""

import json
import sys
from dataclasses import asdict
from functools import partial
from pathlib import Path

import mujoco
import numpy as np

from cointoss_bounce import bounce, elsewhere
from tests.helpers.command_line import mj_bounce
from two_geoms import FLOOR, ball, model


def test_the_same_mujoco_prints_and_finds_the_same():
    file = Path(__file__).parent / "golden/files/model.xml"
    asked = ("bounce", file, "0", "1", "--against", sys.executable)
    same = f"\nMuJoCo {mujoco.__version__}: the same\n"
    assert mj_bounce(*asked).stdout == mj_bounce(*asked[:4]).stdout + same
    there = json.loads(mj_bounce(*asked, "--json").stdout)
    assert there.pop("against")["found"].items() <= there.items()


def test_what_another_version_prints_otherwise_stands_beside_it():
    here, there = {"mujoco": "4.0", "lines": ["a 1", "b 2"]}, {"mujoco": "3.3", "lines": ["a 1", "b 3"]}
    assert elsewhere.beside(here, there).splitlines() == [
        "--- MuJoCo 4.0",
        "+++ MuJoCo 3.3",
        " a 1",
        "-b 2",
        "+b 3",
    ]


def test_a_mujoco_that_copies_into_no_state_measures_the_same(monkeypatch):
    measured = partial(bounce, model(FLOOR + ball("")), "a", "b", speeds=[1.0])
    right = asdict(measured())
    monkeypatch.delattr(mujoco, "mj_copyData")
    np.testing.assert_equal(asdict(measured()), right)
