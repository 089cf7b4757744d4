"""The MuJoCo model is the scenario's coin, and its state is the release's."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import mujoco
import numpy as np
import pytest

from cointoss.coin_mj.model.scene import build, shape_thickness
from cointoss.coin_mj.model.settings import MujocoSettings, rebound_of
from tests.helpers.draws import ZLOTY, scenario


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
