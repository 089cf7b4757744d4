"""The study of many tosses in MuJoCo: its page, and that its check can fail."""

import json
from dataclasses import asdict, replace
from typing import Any

from compare.reproduction.setups.mujoco_study import Spread
from compare.reproduction.studies.mujoco_many import Loop, Speed, Study, check, compute, text
from tests.helpers.pages import printed, saved_numbers


def read(saved: str) -> Study:
    numbers: dict[str, Any] = json.loads(saved)
    speeds = {name: _speed(**speed) for name, speed in numbers.pop("speeds").items()}
    return Study(speeds=speeds, **numbers)


def _speed(**numbers: Any) -> Speed:
    spreads = {name: Spread(*numbers.pop(name)) for name in ("restitution", "smooth", "coulomb")}
    loops = {name: numbers.pop(name) for name in ("loop", "loop_enough")}
    return Speed(**spreads, **{name: loop and Loop(*loop) for name, loop in loops.items()}, **numbers)


SAVED = read(saved_numbers("mujoco-many"))


def test_the_page_shows_the_saved_numbers():
    assert printed("MUJOCO.md", "mujoco-many") == text(SAVED)


def test_every_claim_holds():
    assert check(SAVED) == ()


def test_a_claim_that_the_numbers_do_not_bear_out_is_told():
    spring = replace(SAVED.speeds["spring"], restitution=Spread(0.0, 0.02, 1))
    worse = replace(SAVED, speeds={**SAVED.speeds, "spring": spring})
    assert check(worse) == ("restitution errs by at most 1e-2",)
    fast = replace(SAVED.speeds["spring"], loop=Loop(1e-6, 20.0))
    faster = replace(SAVED, speeds={**SAVED.speeds, "spring": fast})
    assert check(faster) == ("no loop of fixed steps that is as exact is a tenth as fast",)


def test_what_no_step_reaches_is_told():
    spring = replace(SAVED.speeds["spring"], loop=None, loop_enough=Loop(2e-6, 0.5), tosses_per_second=100.0)
    lines = text(replace(SAVED, speeds={"spring": spring})).splitlines()
    assert [line for line in lines if line.startswith("| spring, ")] == [
        "| spring, restitution to 6e-03 | none down to 1e-07 | | |",
        "| spring, restitution to 1e-02 | 2.0e-06 | 0.5 | 200 |",
    ]


def test_a_small_study_is_made():
    told = []
    study = compute(3, 3, 1, lambda done, whole: told.append((done, whole)))
    assert told == [(1, 2), (2, 2)]
    assert read(json.dumps(asdict(study))) == study
    assert all(speed.restitution.number == 3 for speed in study.speeds.values())
