"""The MuJoCo model is the scenario's coin, and its state is the release's."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj.model.scene import build, shape_thickness
from cointoss.coin_mj.model.settings import MujocoSettings, rebound_of
from cointoss.coin_mj.model.state import of_release
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_release, scenario


def built(case):
    return build(case, rebound_of(case.floor.restitution, MujocoSettings()), 0.0, shape_thickness(case))


def test_mass_and_inertia_are_the_scenarios():
    offset = [-1e-3, -4e-4, -2e-4]  # each product of inertia is another
    case = scenario(coin={**ZLOTY, "center_of_mass": offset}, gravity=1.6)
    model = built(case)
    assert model.body("coin").mass[0] == 2e-3
    assert model.body("coin").ipos == pytest.approx(offset, rel=1e-15)
    turn = np.zeros(9)
    mujoco.mju_quat2Mat(turn, model.body("coin").iquat)
    R = turn.reshape(3, 3)
    J = R @ np.diag(model.body("coin").inertia) @ R.T
    assert pytest.approx(case.coin.inertia_about_C, abs=1e-11 * 1.6e-7) == J
    assert model.opt.gravity == pytest.approx([0, 0, -1.6])


def test_every_thin_coin_compiles():
    """A thin coin's inertia stands on the triangle equality, where rounding decides."""
    rng = np.random.default_rng(1)
    for _ in range(100):
        c = [*rng.uniform(-4e-3, 4e-3, 2), 0]
        model = built(scenario(coin={**ZLOTY, "thickness": 0.0, "center_of_mass": c}))
        assert model.geom("coin").size[1] == pytest.approx(0.5e-6 * 1.25e-2, rel=1e-12)


@pytest.mark.parametrize("thickness", [0.0, 2e-3])
def test_a_flat_coin_lies_on_mujocos_floor_where_it_lies_on_the_scenarios(thickness):
    """A frame less than a micrometre off must be kept apart."""
    model = built(scenario(coin={**ZLOTY, "thickness": thickness}))
    data = mujoco.MjData(model)
    data.qpos[2] = thickness / 2
    mujoco.mj_forward(model, data)
    lowest = data.geom("coin").xpos[2] - model.geom("coin").size[1]
    assert lowest - data.geom("floor").xpos[2] == pytest.approx(0, abs=1e-16)
    assert bool(data.geom("floor").xpos[2] < 0) is (thickness == 0)


def test_a_mass_center_less_than_a_micrometre_off_is_kept():
    """A rod's inertia is in MuJoCo's order already, so nothing else parts the two frames."""
    model = built(scenario(coin={**ZLOTY, "thickness": 5e-2, "center_of_mass": [0, 0, 5e-7]}))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.body("coin").xipos[2] - data.body("coin").xpos[2] == pytest.approx(5e-7, abs=1e-15)


def test_mujoco_agrees_about_the_velocity_of_the_mass_center():
    case = scenario(coin=IMPERFECT, release=draw_release(np.random.default_rng(3)))
    model = built(case)
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(case.body, case.release)
    mujoco.mj_forward(model, data)
    assert data.body("coin").xipos == pytest.approx(case.release.position, abs=1e-16)
    velocity = np.zeros(6)
    mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, model.body("coin").id, velocity, 1)
    R = data.body("coin").ximat.reshape(3, 3)
    # mjOBJ_BODY is the inertial frame, at C; the last argument turns the answer into its axes.
    assert R @ velocity[3:] == pytest.approx(case.release.velocity, abs=1e-14)


def test_damping_and_actuator_are_the_closed_form_drag():
    case = scenario(coin=IMPERFECT, air=AIR, release=draw_release(np.random.default_rng(4)))
    model, body = built(case), case.body
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = of_release(body, case.release)
    mujoco.mj_forward(model, data)
    R = data.body("coin").xmat.reshape(3, 3)
    d = body.drag
    v_B, w = R.T @ data.qvel[:3], data.qvel[3:]
    force = -R @ (np.array([d.force_tangential, d.force_tangential, d.force_normal]) * v_B)
    moment = -np.array([d.moment_tangential, d.moment_tangential, d.moment_normal]) * w
    assert np.linalg.norm(force) > 1e-6, "there should be drag"
    assert data.qfrc_actuator + data.qfrc_passive == pytest.approx([*force, *moment], rel=1e-12, abs=1e-20)
