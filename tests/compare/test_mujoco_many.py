"""The study of many tosses in MuJoCo: its page, and that its check can fail."""

import json
from dataclasses import asdict, replace
from typing import Any

from compare.figures.mujoco_many import Speed, Study, check, compute, text
from compare.mujoco_study import Spread
from tests.compare.pages import printed, saved_numbers


def read(saved: str) -> Study:
    numbers: dict[str, Any] = json.loads(saved)
    speeds = {name: _speed(**speed) for name, speed in numbers.pop("speeds").items()}
    return Study(speeds=speeds, **numbers)


def _speed(restitution: Any, smooth: Any, coulomb: Any, **rest: float) -> Speed:
    return Speed(restitution=Spread(*restitution), smooth=Spread(*smooth), coulomb=Spread(*coulomb), **rest)


SAVED = read(saved_numbers("mujoco-many"))


def test_the_page_shows_the_saved_numbers():
    assert printed("MUJOCO.md", "mujoco-many") == text(SAVED)


def test_every_claim_holds():
    assert check(SAVED) == ()


def test_a_claim_that_the_numbers_do_not_bear_out_is_told():
    spring = replace(SAVED.speeds["spring"], restitution=Spread(0.0, 0.02, 1))
    worse = replace(SAVED, speeds={**SAVED.speeds, "spring": spring})
    assert check(worse) == ("restitution errs by at most 1e-2",)
    assert len(check(replace(SAVED, loop_tosses_per_second=1e3))) == 1


def test_a_small_study_is_made():
    told = []
    study = compute(3, 3, 1, lambda done, whole: told.append((done, whole)))
    assert told == [(1, 2), (2, 2)]
    assert read(json.dumps(asdict(study))) == study
    assert all(speed.restitution.number == 3 for speed in study.speeds.values())
