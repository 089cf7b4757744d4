"""The forces on MuJoCo's coin but for the floor's, against `mj_forward`."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj import MANY
from cointoss.coin_mj.entries import air_force
from cointoss.coin_mj.model import state
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.steps import constrained_step, free_step
from cointoss.coin_mj.steps.constrained_step import IMPACT
from cointoss.models.attitude import rotation_matrix
from cointoss.models.body import AirLaw
from cointoss.models.kernel.compiled import by_numba
from tests.helpers.draws import AIR, PAPER_OFFSET, ZLOTY, draw_release, scenario
from tests.helpers.tuples import quaternion, vector

set_motion, free_rate = by_numba(state.set_motion), by_numba(free_step.free_rate)
forward = by_numba(constrained_step.forward)
constrained_forward = by_numba(constrained_step.constrained_forward)

AIRS = {"linear": AIR, "vacuum": {}, "b = 0.5": {**AIR, "exponent": 0.5}}
FORCES = ("qfrc_bias", "qfrc_passive", "qfrc_actuator", "qfrc_smooth", "qacc_smooth")


def force_of_the_air(case, data):
    """Force and moment of the air with b > 0, as MuJoCo's generalized forces, (6,)."""
    coin, air, R = case.coin, case.air, np.array(rotation_matrix(quaternion(data.qpos[3:])))
    law = AirLaw(air.exponent, air.normal, air.tangential)
    f, m = air_force(coin.radius, coin.thickness, law, vector(R.T @ data.qvel[:3]), vector(data.qvel[3:]))
    return np.array([*(R @ f), *m])


@pytest.mark.parametrize("center", [PAPER_OFFSET, [0, 0, 0]], ids=["imperfect", "balanced"])
@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS.keys())
def test_forces_and_accelerations_of_flight_are_those_of_mj_forward(center, air):
    rng = np.random.default_rng(8)
    case = scenario(coin={**ZLOTY, "center_of_mass": center}, air=air, release=draw_release(rng))
    machine = machine_of(case, MANY)
    reference = mujoco.MjData(machine.model)
    for _ in range(20):
        # The stages of a step have Euler parameters whose norm is not quite 1.
        e = rng.normal(size=4)
        e *= rng.uniform(0.999, 1.001) / np.linalg.norm(e)
        motion = np.array([0, 0, 1, *e, *rng.uniform(-2, 2, 3), *rng.uniform(-40, 40, 3)])
        set_motion(machine.coin, motion)
        reference.qpos[:], reference.qvel[:] = motion[:7], motion[7:]
        free_rate(machine.coin, np.empty(13), False)
        if case.body.air.exponent is not None:
            reference.qfrc_applied[:] = force_of_the_air(case, reference)
        mujoco.mj_forward(machine.model, reference)
        reference.qfrc_passive[:] += reference.qfrc_applied
        for name in FORCES:
            found, known = getattr(machine.data, name), getattr(reference, name)
            assert found == pytest.approx(known, rel=1e-13, abs=1e-14 * np.abs(known).max()), name
        assert np.any(reference.qfrc_passive != 0) == bool(air)
        assert np.any(reference.qfrc_actuator != 0) == (air == AIR), "the actuator is linear drag's"


@pytest.mark.slow_after_first
@pytest.mark.parametrize("air", AIRS.values(), ids=AIRS.keys())
def test_after_the_touch_of_an_impact_air_with_b_above_0_acts_as_it_did(air):
    """A contact of 1e-5 s knows of no change of the air; its quadrature would be most of the toss's time."""
    case = scenario(coin=ZLOTY, air=air, release=draw_release(np.random.default_rng(8)))
    machine = machine_of(case, MANY)
    drags = []
    for find in (forward, lambda coin: constrained_forward(coin, IMPACT), forward):
        machine.data.qvel[:] *= 1.5
        find(machine.coin)
        drags.append(machine.data.qfrc_passive + machine.data.qfrc_actuator)
    touch, later, anew = drags
    assert (later == touch).all() == (air != AIR)
    assert (anew == later).all() == (not air)
