"""MuJoCo's free joint and the records: MuJoCo itself says where C is and how it moves, and back again."""

from typing import Any

import mujoco
import numpy as np
import pytest

from cointoss import analytic, coin_mj, load
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import FINE
from cointoss.models.batch import STATE
from cointoss.models.errors import ScenarioError
from cointoss.models.parts import Release
from tests.helpers.many import PARTS

MJ: Any = mujoco
COIN = load("fig24b").replace("coin.center_of_mass", [0.001, -0.002, 0.0003])


def as_array(fields):
    """Return the fields of releases as states, (n, 13)."""
    assert list(fields) == list(STATE)
    return np.stack(list(fields.values()), axis=1)


def random_joint(n, seed=0):
    rng = np.random.default_rng(seed)
    e = rng.normal(size=(n, 4))
    e /= np.linalg.norm(e, axis=1, keepdims=True)
    return np.hstack([rng.uniform(0.1, 1, (n, 3)), e]), rng.normal(size=(n, 6)) * [1, 1, 1, 20, 20, 20]


def test_the_mass_centre_is_where_mujoco_has_it_and_moves_so():
    qpos, qvel = random_joint(5)
    states = as_array(coin_mj.release_fields(qpos, qvel, COIN))
    machine = machine_of(COIN, FINE)
    model, data = machine.model, machine.data
    body = model.body(model.jnt_bodyid[0]).id
    for i in range(5):
        data.qpos[:], data.qvel[:] = qpos[i], qvel[i]
        MJ.mj_forward(model, data)
        np.testing.assert_allclose(states[i, :3], data.xipos[body], atol=1e-15)
        jacobian = np.zeros((3, model.nv))
        MJ.mj_jacBodyCom(model, data, jacobian, None, body)
        np.testing.assert_allclose(states[i, 3:6], jacobian @ qvel[i], atol=1e-14)


def test_states_go_to_mujoco_and_back():
    toss = analytic.toss(COIN)
    states = toss.sample(np.linspace(0, 0.3, 7))
    qpos, qvel = states.to_mujoco(COIN)
    assert (qpos.shape, qvel.shape) == ((7, 7), (7, 6))
    assert np.linalg.norm(qpos[:, :3] - states.position, axis=1) == pytest.approx(
        np.linalg.norm(COIN.coin.center_of_mass)
    )
    parts = np.split(as_array(coin_mj.release_fields(qpos, qvel, COIN)), [3, 6, 10], axis=1)
    for name, back in zip(PARTS, parts, strict=True):
        np.testing.assert_allclose(back, getattr(states, name), atol=1e-13)


def test_one_state_is_one_release_and_other_shapes_are_refused():
    qpos, qvel = random_joint(1)
    assert as_array(coin_mj.release_fields(qpos[0], qvel[0], "fig24a")).shape == (1, 13)
    for bad in ("abc", [[0.0, 1.0], [2.0]], {"a": 1}):
        with pytest.raises(ValueError, match=r"^qpos: .*, accepted: numbers, \(7,\) or \(n, 7\)"):
            coin_mj.release_fields(bad, qvel, COIN)  # pyright: ignore[reportArgumentType]
    with pytest.raises(ValueError, match=r"^qvel: shape \(1, 7\), accepted: numbers, \(6,\) or \(n, 6\)"):
        coin_mj.release_fields(qpos, qpos, COIN)
    with pytest.raises(ValueError, match=r"^qvel: shape \(2, 6\), accepted: \(1, 6\)"):
        coin_mj.release_fields(qpos, np.vstack([qvel, qvel]), COIN)
    for wrong in (2.0, np.nan):
        with pytest.raises(ValueError, match=r"^qpos: row 1: Euler parameters \[.*norm 1 within"):
            coin_mj.release_fields(np.vstack([qpos, wrong * qpos]), np.vstack([qvel, qvel]), COIN)
    below = qpos * [1, 1, -1, 1, 1, 1, 1]
    with pytest.raises(ScenarioError, match=r"above the floor.* \(row 1\)$"):
        coin_mj.release_fields(np.vstack([qpos, below]), np.vstack([qvel, qvel]), COIN)
    with pytest.raises(ScenarioError, match=r"release\.velocity"):
        coin_mj.release_fields(qpos, qvel * [np.inf, 1, 1, 1, 1, 1], COIN)


def test_euler_parameters_are_brought_to_norm_1_as_those_of_one_release():
    qpos, qvel = random_joint(50)
    qpos[:, 3:] *= 1 + np.random.default_rng(1).uniform(-9e-4, 9e-4, 50)[:, None]
    found = as_array(coin_mj.release_fields(qpos, qvel, "fig24a"))[:, 6:10]
    for e, given in zip(found.tolist(), qpos[:, 3:].tolist(), strict=True):
        assert tuple(e) == Release(position=(0.0, 0.0, 1.0), quaternion=tuple(given)).attitude
