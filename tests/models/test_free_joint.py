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
    """Where B is and how it moves is checked in `test_conventions.py`."""
    states = analytic.toss(COIN).sample(np.linspace(0, 0.3, 7))
    back = as_array(coin_mj.release_fields(*states.to_mujoco(COIN), COIN))
    np.testing.assert_allclose(back, np.hstack([getattr(states, name) for name in PARTS]), atol=1e-13)


QPOS, QVEL = random_joint(1)
TWO, BELOW = np.vstack([QVEL, QVEL]), QPOS * [1, 1, -1, 1, 1, 1, 1]


@pytest.mark.parametrize(
    ("qpos", "qvel", "error", "said"),
    [
        *(
            (bad, QVEL, ValueError, r"^qpos: .*, accepted: numbers, \(7,\) or \(n, 7\)")
            for bad in ("abc", [[0.0, 1.0], [2.0]], {"a": 1})
        ),
        (QPOS, QPOS, ValueError, r"^qvel: shape \(1, 7\), accepted: numbers, \(6,\) or \(n, 6\)"),
        (QPOS, TWO, ValueError, r"^qvel: shape \(2, 6\), accepted: \(1, 6\)"),
        *(
            (
                np.vstack([QPOS, wrong * QPOS]),
                TWO,
                ValueError,
                r"^qpos: row 1: Euler .*norm 1 within",
            )
            for wrong in (2.0, np.nan)
        ),
        (
            np.vstack([QPOS, QPOS * [1, 1, -1, 1, 1, 1, 1]]),
            TWO,
            ScenarioError,
            r"above the floor.* \(row 1\)$",
        ),
        (QPOS, QVEL * [np.inf, 1, 1, 1, 1, 1], ScenarioError, r"release\.velocity"),
    ],
    ids=range(9),
)
def test_what_is_no_state_of_the_joint_is_refused(qpos, qvel, error, said):
    with pytest.raises(error, match=said):
        coin_mj.release_fields(qpos, qvel, COIN)


def test_one_state_is_one_release():
    assert as_array(coin_mj.release_fields(QPOS[0], QVEL[0], "fig24a")).shape == (1, 13)


def test_euler_parameters_are_brought_to_norm_1_as_those_of_one_release():
    qpos, qvel = random_joint(50)
    qpos[:, 3:] *= 1 + np.random.default_rng(1).uniform(-9e-4, 9e-4, 50)[:, None]
    found = as_array(coin_mj.release_fields(qpos, qvel, "fig24a"))[:, 6:10]
    for e, given in zip(found.tolist(), qpos[:, 3:].tolist(), strict=True):
        assert tuple(e) == Release(position=(0.0, 0.0, 1.0), quaternion=tuple(given)).attitude
