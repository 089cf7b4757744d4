"""The coin that is drawn: its shadow, its mass."""

import mujoco
import numpy as np
import pytest

from cointoss.compare.film.shadow import add_shadow
from cointoss.compare.film.visual_model import build_visual_model
from tests.helpers.draws import ZLOTY, scenario
from tests.helpers.films import FLAT, UPRIGHT

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false


def test_a_shadow_is_what_the_coin_hides_of_the_light_from_above():
    case, rng = scenario(coin={"center_of_mass": [1e-3, -2e-3, 2e-4]}), np.random.default_rng(1)
    model = build_visual_model(case, extent=1.0, tile=0.1)
    data, scene = mujoco.MjData(model), mujoco.MjvScene(model, maxgeom=1)
    turns = np.linspace(0, 2 * np.pi, 721)
    R_, H = ZLOTY["radius"], ZLOTY["thickness"]
    rims = [[R_ * np.cos(a), R_ * np.sin(a), z] for a in turns for z in (-H / 2, H / 2)]
    for quaternion in (FLAT, UPRIGHT, *rng.normal(size=(5, 4))):
        data.qpos[:] = [0.3, -0.2, 0.5, *np.array(quaternion) / np.linalg.norm(quaternion)]
        mujoco.mj_forward(model, data)
        scene.ngeom = 0
        add_shadow(scene, data, case.coin)
        shadow = scene.geoms[0]
        assert shadow.pos == pytest.approx([0.3, -0.2, 0])
        axes = shadow.mat[:2, :2]
        below = (rims @ data.body("coin").xmat.reshape(3, 3).T)[:, :2] @ axes
        assert np.abs(below).max(axis=0) == pytest.approx(shadow.size[:2], rel=1e-4)


def test_the_visual_coin_has_no_contacts_and_the_same_mass():
    case = scenario(coin={"center_of_mass": [-1e-3, -1e-3, -2e-4]})
    model = build_visual_model(case, extent=1.0, tile=0.1)
    data = mujoco.MjData(model)
    data.qpos[2] = 0
    mujoco.mj_forward(model, data)
    assert (data.ncon, model.body("coin").mass[0]) == (0, case.coin.mass)
    assert model.body("coin").ipos == pytest.approx(case.coin.center_of_mass)
