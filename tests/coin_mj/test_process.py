"""What MuJoCo keeps for a whole process is its user's: tosses read none of it and change none of it."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import ctypes
import sys
import threading

import mujoco
import numpy as np
import pytest

from cointoss import coin_mj
from cointoss.coin_mj import MANY
from cointoss.coin_mj.model.library import PATH
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.toss import impacts_of, run
from cointoss.models.batch import rows_of
from cointoss.models.records import UnusableEngineError
from cointoss.models.stages import at_work
from tests.helpers.draws import AIR, IMPERFECT, draw_release, scenario

FOREIGN = """<mujoco><option gravity="0 0 0"/>
<custom><numeric name="air" data="1 2 3 4 5"/></custom><worldbody>
<body pos="0 0 5"><freejoint/><geom size="0.1 0.2 0.3" type="box"/></body>
<body pos="3 0 5"><joint axis="0 1 0"/><geom pos="0.4 0 0" size="0.1"/></body></worldbody></mujoco>"""
HELD = [ctypes.c_void_p.in_dll(ctypes.CDLL(PATH), name) for name in ("mjcb_passive", "mjcb_time")]


@pytest.fixture
def restored():
    """Put MuJoCo's callbacks back after a test."""
    yield
    mujoco.set_mjcb_passive(None)
    mujoco.set_mjcb_contactfilter(None)


def in_air():
    """A coin in air with b > 0."""
    return scenario(
        coin=IMPERFECT,
        air={**AIR, "exponent": 0.5},
        release=draw_release(np.random.default_rng(1)),
        ending={"max_impacts": 3},
    )


class Foreign(threading.Thread):
    """A thread that steps a model of somebody else's, with five custom numbers, until it is told to stop."""

    def __init__(self):
        super().__init__()
        self.model = mujoco.MjModel.from_xml_string(FOREIGN)
        self.data = mujoco.MjData(self.model)
        self.data.qvel[:] = 1.0
        self.steps, self.most, self.stopped, self.held = 0, None, False, set()

    def run(self):
        while not self.stopped and self.steps != self.most:
            mujoco.mj_step(self.model, self.data)
            self.held.add(tuple(pointer.value for pointer in HELD))
            self.steps += 1

    def state(self):
        return np.concatenate([self.data.qpos, self.data.qvel])


@pytest.mark.slow
@pytest.mark.usefixtures("restored")
@pytest.mark.parametrize("has_callback", [False, True])
def test_a_model_that_another_thread_steps_meanwhile_is_left_alone_and_so_is_the_coin(has_callback):
    """Also where its user's callback acts on it."""
    expected, seen = impacts_of(in_air(), settings=MANY), set()

    def users(model, data):
        seen.add(model.nbody)
        data.qfrc_passive[0] = 7.0

    beside, alone = Foreign(), Foreign()
    mujoco.set_mjcb_passive(users if has_callback else None)
    held = tuple(pointer.value for pointer in HELD)
    beside.start()
    try:
        found = impacts_of(in_air(), settings=MANY)
    finally:
        beside.stopped = True
        beside.join()
    alone.most = beside.steps
    alone.run()
    assert alone.steps > 100
    assert np.array_equal(found.impulse, expected.impulse)
    assert np.array_equal(beside.state(), alone.state())
    assert beside.held == alone.held == {held}
    assert mujoco.get_mjcb_passive() is (users if has_callback else None)
    assert seen == ({beside.model.nbody} if has_callback else set())
    # MuJoCo's timers run on.
    assert beside.data.timer[mujoco.mjtTimer.mjTIMER_STEP].duration > 0


@pytest.mark.usefixtures("restored")
@pytest.mark.parametrize(
    "make",
    [
        lambda case: impacts_of(case, settings=MANY),
        lambda case: coin_mj.toss_rows(rows_of(case, 2)),
    ],
)
def test_where_the_user_filters_contacts_no_coin_is_tossed(make):
    """MuJoCo asks the filter about the coin's contacts, too: one that leaves them out drops it for ever."""
    described = scenario(ending={"max_impacts": 1})
    mujoco.set_mjcb_contactfilter(lambda _model, _data, _one, _two: 1)
    with pytest.raises(UnusableEngineError, match="mjcb_contactfilter is set"):
        make(described)
    mujoco.set_mjcb_contactfilter(None)
    make(described)


@pytest.mark.usefixtures("restored")
def test_a_toss_sets_the_time_of_mujoco_tells_those_who_wait_and_keeps_a_callback_set_meanwhile(monkeypatch):
    described, told = scenario(ending={"max_impacts": 3}), []
    machine, module = machine_of(described, MANY), sys.modules["cointoss.coin_mj.toss"]
    toss_coin = module.toss_coin

    def users(_model, _data):
        pass

    def told_after(*arguments):
        result = toss_coin(*arguments)
        told.append(at_work[-1].detail())
        mujoco.set_mjcb_passive(users)
        return result

    monkeypatch.setattr(module, "toss_coin", told_after)
    end_time = run(machine, described.rules).end_time
    assert machine.data.time == end_time > 0
    assert told == [f"3 impacts in {end_time:.3g} s of the coin's time"]
    assert mujoco.get_mjcb_passive() is users
