"""MuJoCo's free joint and the records: MuJoCo itself says where C is and how it moves, and back again."""

from typing import Any

import mujoco
import numpy as np
import pytest

from cointoss import Releases, analytic, load
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import FINE

MJ: Any = mujoco
COIN = load("fig24b").replace("coin.center_of_mass", [0.001, -0.002, 0.0003])


def random_joint(n, seed=0):
    rng = np.random.default_rng(seed)
    e = rng.normal(size=(n, 4))
    e /= np.linalg.norm(e, axis=1, keepdims=True)
    return np.hstack([rng.uniform(0.1, 1, (n, 3)), e]), rng.normal(size=(n, 6)) * [1, 1, 1, 20, 20, 20]


def test_the_mass_centre_is_where_mujoco_has_it_and_moves_so():
    qpos, qvel = random_joint(5)
    releases = Releases.from_mujoco(qpos, qvel, COIN)
    machine = machine_of(COIN, FINE)
    model, data = machine.model, machine.data
    body = model.body(model.jnt_bodyid[0]).id
    for i in range(5):
        data.qpos[:], data.qvel[:] = qpos[i], qvel[i]
        MJ.mj_forward(model, data)
        np.testing.assert_allclose(releases.position[i], data.xipos[body], atol=1e-15)
        jacobian = np.zeros((3, model.nv))
        MJ.mj_jacBodyCom(model, data, jacobian, None, body)
        np.testing.assert_allclose(releases.velocity[i], jacobian @ qvel[i], atol=1e-14)


def test_states_go_to_mujoco_and_back():
    toss = analytic.toss(COIN)
    states = toss.sample(np.linspace(0, 0.3, 7))
    qpos, qvel = states.to_mujoco(COIN)
    assert (qpos.shape, qvel.shape) == ((7, 7), (7, 6))
    assert np.linalg.norm(qpos[:, :3] - states.position, axis=1) == pytest.approx(
        np.linalg.norm(COIN.coin.center_of_mass)
    )
    back = Releases.from_mujoco(qpos, qvel, COIN)
    for name in ("position", "velocity", "quaternion", "angular_velocity"):
        np.testing.assert_allclose(getattr(back, name), getattr(states, name), atol=1e-13)


def test_one_state_is_one_release_and_other_shapes_are_refused():
    qpos, qvel = random_joint(1)
    assert len(Releases.from_mujoco(qpos[0], qvel[0], "fig24a")) == 1
    for bad in ("abc", [[0.0, 1.0], [2.0]], {"a": 1}):
        with pytest.raises(ValueError, match=r"from_mujoco: qpos: .*, accepted: numbers, \(7,\) or \(n, 7\)"):
            Releases.from_mujoco(bad, qvel, COIN)  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match=r"from_mujoco: qvel: shape \(1, 7\), accepted: \(1, 6\)"):
        Releases.from_mujoco(qpos, qpos, COIN)
    with pytest.raises(ValueError, match="norm 1 within"):
        Releases.from_mujoco(2 * qpos, qvel, COIN)
    with pytest.raises(ValueError, match="above the floor"):
        Releases.from_mujoco(qpos * [1, 1, -1, 1, 1, 1, 1], qvel, COIN)
