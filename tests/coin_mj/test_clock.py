"""MuJoCo's clock stands still while coins are tossed, and goes on after."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import pytest

from coin_mj import MANY
from coin_mj.model.clock import clock_stopped
from coin_mj.model.machine import machine_of
from coin_mj.model.scene import shape_thickness
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
