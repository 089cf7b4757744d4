"""MuJoCo's clock stands still while coins are tossed, and goes on after."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import sys

import mujoco
import pytest

from cointoss.coin_mj import MANY
from cointoss.coin_mj.model.clock import clock_stopped
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.scene import shape_thickness
from cointoss.coin_mj.toss import run
from cointoss.models.stages import stages
from tests.helpers.draws import scenario


def test_the_clock_of_mujoco_stands_still_and_goes_on():
    case = scenario()
    machine = machine_of(case, MANY, shape_thickness(case))
    timer = machine.data.timer[mujoco.mjtTimer.mjTIMER_POSITION]

    def fail() -> None:
        with clock_stopped(), clock_stopped():
            mujoco.mj_forward(machine.model, machine.data)
            assert timer.duration == 0
            raise InterruptedError

    with pytest.raises(InterruptedError):
        fail()
    mujoco.mj_forward(machine.model, machine.data)
    assert timer.duration > 0


def test_a_toss_sets_the_time_of_mujoco_and_says_it_to_those_who_wait(monkeypatch):
    described, told = scenario(ending={"max_impacts": 3}), []
    machine = machine_of(described, MANY, shape_thickness(described))
    toss_coin = sys.modules["cointoss.coin_mj.toss"].toss_coin

    def told_after(*arguments):
        result = toss_coin(*arguments)
        told.append(stages.open[-1].detail())
        return result

    monkeypatch.setattr(sys.modules["cointoss.coin_mj.toss"], "toss_coin", told_after)
    end_time = run(machine, described.rules).end_time
    assert machine.data.time == end_time > 0
    assert told == [f"{end_time:.3g} s of the coin's time"]
