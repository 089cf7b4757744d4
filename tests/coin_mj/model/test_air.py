"""MuJoCo's air with b > 0: its force against the paper's mechanics, and that each coin feels its own."""

import math
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from cointoss.analytic.entries import force_and_moment
from cointoss.coin_mj.entries import air_force, forward
from cointoss.coin_mj.model.air import PowerLaw
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import MujocoSettings
from cointoss.coin_mj.steps import free_step as steps
from cointoss.models.kernel.compiled import by_numba
from tests.helpers.draws import AIR, IMPERFECT, ZLOTY, draw_release, scenario
from tests.helpers.tuples import vector

free_step = by_numba(steps.free_step)

R, H = ZLOTY["radius"], ZLOTY["thickness"]
LN, LT = AIR["normal"], AIR["tangential"]


def by_both(b, h, v, w):
    """Force and moment about B over r by both engines, (6,) each, in units of λ (|v| + r |ω|)^(1+b) π r²."""
    body = scenario(coin={"thickness": h}, air={**AIR, "exponent": b}).body
    pairs = (
        air_force(R, h, PowerLaw(LN, LT, b), vector(v), vector(w)),
        force_and_moment(body, vector(v), vector(w)),
    )
    speed = np.linalg.norm(v) + R * np.linalg.norm(w)
    size = (LN + LT) * speed ** (1 + b) * np.pi * R**2 * (1 + h / R)
    return [np.array([*f, *(x / R for x in m)]) / size for f, m in pairs]


def at_rest_somewhere(rng, h):
    """Draw a motion for which a point or a line of the surface is at rest, or nearly."""
    v, w = rng.normal(size=3), rng.normal(size=3) * 10.0 ** rng.uniform(-1, 3)
    near = 1 + rng.choice([0, 1e-12, 1e-8, -1e-8, 1e-4, -1e-4])
    match rng.integers(6):
        case 0:
            v[2] = R * math.hypot(w[0], w[1]) * near
        case 1:
            v[:2] = R * w[2] * near, 0
        case 2:
            w[:2] *= rng.choice([0, 1e-9, 1e-4])
        case 3:
            v[:] *= rng.choice([0, 1e-9, 1e-4])
        case 4:
            w[:] *= rng.choice([0, 1e-9, 1e-4])
        case 5:
            theta, z = rng.uniform(0, 2 * np.pi), rng.uniform(-h / 2, h / 2) * near
            v = -np.cross(w, [R * np.cos(theta), R * np.sin(theta), z])
            v += rng.choice([0, 1e-12, 1e-6]) * rng.normal(size=3)
    return v, w


@pytest.mark.slow_after_first
@pytest.mark.parametrize("b", [1e-3, 0.1, 0.5, 0.9, 1.0])
@pytest.mark.parametrize("h", [0.0, H, 0.6 * R, 4 * R])
def test_two_quadratures_give_one_force(b, h):
    rng = np.random.default_rng([int(1000 * b), int(1e4 * h)])
    motions = [(rng.normal(size=3), rng.normal(size=3) * 60) for _ in range(40)]
    motions += [at_rest_somewhere(rng, h) for _ in range(40)]
    for v, w in motions:
        mine, other = by_both(b, h, v, w)
        # On a rod the nodes of the paper's mechanics are good to 1e-11, as its own tests say.
        assert np.abs(mine - other).max() < (1e-12 if h < R else 1e-11)
        assert np.abs(other).max() > 0.01, "the unit should be that of the force"


def test_a_spin_whose_square_underflows_is_none():
    force = {spin: by_both(0.3, H, (0.0, 1.0, 0.0), (0.0, spin, 0.0))[0] for spin in (0.0, 1e-160)}
    assert np.abs(force[1e-160] - force[0.0]).max() < 1e-15, "but for rounding"
    assert force[0.0][1] < -0.1


def test_a_coin_at_rest_feels_no_air():
    assert air_force(R, H, PowerLaw(LN, LT, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)) == ((0, 0, 0), (0, 0, 0))


def coin_in_air(b, normal=LN, tangential=LT):
    case = scenario(
        coin=IMPERFECT,
        air={"normal": normal, "tangential": tangential, "exponent": b},
        release=draw_release(np.random.default_rng(1)),
    )
    return machine_of(case, MujocoSettings())


@pytest.mark.parametrize("b", [0.5, 1.0])
def test_a_coin_feels_the_force_at_B_in_mujocos_frames(b):
    machine = coin_in_air(b)
    forward(machine.coin)
    data = machine.data
    rotation = data.body("coin").xmat.reshape(3, 3)
    f, m = air_force(R, H, PowerLaw(LN, LT, b), vector(rotation.T @ data.qvel[:3]), vector(data.qvel[3:]))
    assert np.linalg.norm(f) > 1e-6, "there should be drag"
    assert data.qfrc_passive == pytest.approx([*(rotation @ f), *m], rel=1e-12, abs=1e-20)
    assert np.all(data.qfrc_actuator == 0)


@pytest.mark.parametrize("air", [{"b": 0.5, "normal": 0.0, "tangential": 0.0}, {"b": 0.0}])
def test_linear_air_drags_and_vacuum_does_not(air):
    machine = coin_in_air(**air)
    forward(machine.coin)
    vacuum = air.get("normal") == 0
    assert np.all(machine.data.qfrc_passive == 0) == vacuum


def flown(machine, steps=20):
    """The states of a coin on its way, (steps, 13)."""
    return np.array([fly_a_step(machine) for _ in range(steps)])


def fly_a_step(machine):
    free_step(machine.coin, 1e-3)
    return np.concatenate([machine.data.qpos, machine.data.qvel])


@pytest.mark.slow
def test_interleaved_coins_each_feel_their_own_air():
    cases = [{"b": 0.5}, {"b": 1.0, "normal": 3.0}, {"b": 0.0}, {"b": 0.5, "normal": 0.0, "tangential": 0.0}]
    alone = [flown(coin_in_air(**case)) for case in cases]
    machines = [coin_in_air(**case) for case in cases]
    rows = [[fly_a_step(machine) for machine in machines] for _ in range(20)]
    together = np.array(rows).transpose(1, 0, 2)
    assert np.array_equal(together, np.array(alone))
    ends = np.array(alone)[:, -1, 7:]
    assert all(np.abs(ends[i] - ends[j]).max() > 1e-3 for i in range(4) for j in range(i))


@pytest.mark.slow
def test_coins_on_several_threads_each_feel_their_own_air():
    exponents = [0.3, 0.5, 0.8, 1.0]
    alone = [flown(coin_in_air(b), 100) for b in exponents]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(lambda b: flown(coin_in_air(b), 100), exponents))
    assert np.array_equal(together, alone)
