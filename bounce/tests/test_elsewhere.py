"""The bounce by the MuJoCo of another Python, here the same one, and what it differs in."""

import json
import sys
from dataclasses import asdict
from pathlib import Path

import mujoco
import numpy as np

from cointoss_bounce import bounce, elsewhere
from tests.helpers.command_line import mj_bounce
from two_geoms import FLOOR, ball, model


def test_the_same_mujoco_prints_and_finds_the_same():
    model, same = Path(__file__).parent / "golden/files/model.xml", f"MuJoCo {mujoco.__version__}: the same"
    asked = ("bounce", model, "0", "1", "--against", sys.executable)
    assert mj_bounce(*asked).stdout == f"{mj_bounce(*asked[:4]).stdout}\n{same}\n"
    found = json.loads(mj_bounce(*asked, "--json").stdout)
    assert found["against"]["found"].items() <= found.items()


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
    given = model(FLOOR + ball(""))
    right = asdict(bounce(given, "a", "b", speeds=[1.0]))
    monkeypatch.delattr(mujoco, "mj_copyData")
    np.testing.assert_equal(asdict(bounce(given, "a", "b", speeds=[1.0])), right)
