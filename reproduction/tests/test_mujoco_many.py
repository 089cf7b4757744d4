"""The study of many tosses in MuJoCo: its page, and that its check can fail."""

from dataclasses import replace

from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.setups.mujoco_study import Spread
from cointoss_reproduction.studies.mujoco_many.study import FixedSteps, TossSpeeds, compute
from saved import missed, result_of, saved

SAVED = read_numbers(saved("mujoco-many"), TossSpeeds)


def test_a_claim_that_the_numbers_do_not_bear_out_is_told():
    spring = replace(SAVED.speeds["spring"], restitution=Spread(0.0, 0.02, 1))
    worse = replace(SAVED, speeds={**SAVED.speeds, "spring": spring})
    assert missed("mujoco-many", worse) == ("restitution errs by at most 1e-2",)
    a_fifth = SAVED.speeds["spring"].tosses_per_second / 5
    fast = replace(SAVED.speeds["spring"], loop_enough=FixedSteps(1e-6, a_fifth))
    faster = replace(SAVED, speeds={**SAVED.speeds, "spring": fast})
    assert missed("mujoco-many", faster) == (
        "no loop of fixed steps whose restitution errs by at most 1e-2 is a tenth as fast",
    )


def test_what_no_step_reaches_is_told():
    spring = replace(
        SAVED.speeds["spring"], loop=None, loop_enough=FixedSteps(2e-6, 0.5), tosses_per_second=100.0
    )
    lines = result_of("mujoco-many", replace(SAVED, speeds={"spring": spring})).tables.splitlines()
    assert [line for line in lines if line.startswith("| spring, ")] == [
        "| spring, restitution to 2e-03 | none down to 1e-07 |  |  |",
        "| spring, restitution to 1e-02 | 2.0e-06 | 0.5 | 200 |",
    ]


def test_a_small_study_is_made_and_read_again():
    told = []
    study = compute(lambda done, whole: told.append((done, whole)), 3, 3, 1)
    assert told == [(1, 2), (2, 2)]
    assert result_of("mujoco-many", study).data == study
    assert all(speed.restitution.number == 3 for speed in study.speeds.values())
