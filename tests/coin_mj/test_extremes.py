"""Tosses far from a coin's: any size, weight, gravity, thickness, restitution, resistance and air.

The energy and the depth are measured by a log of their own, from qpos and qvel in plain numpy.
"""

from time import process_time
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss.coin_mj import FINE, MANY
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import resolved
from cointoss.coin_mj.path import MOTION, STEP
from cointoss.coin_mj.steps.knots import StepKind
from cointoss.coin_mj.toss import run
from cointoss.models.records import Ending
from cointoss.models.scenario import Scenario
from tests.helpers.draws import draw_quaternion, scenario

QUICK = 6
LAWS = ("smooth", "coulomb", "perfectly_rough")


def extreme(seed: int) -> Scenario:
    """A random toss; drag and resistance are drawn against √(g/r), so that they matter at every size."""
    rng = np.random.default_rng([40, seed])
    r, g, m = 10 ** rng.uniform(-3, 0), 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(-9, 1)
    h = r * rng.choice([0.0, 10 ** rng.uniform(-3, 0), 10 ** rng.uniform(0, 2.3)])
    size, law = np.hypot(r, h / 2), LAWS[rng.integers(3)]
    air, b = {}, rng.choice([0.0, rng.uniform(0.2, 1)])
    if rng.integers(3):
        drag = (
            m * (g / r) ** 0.5 / (r + h) ** 2 / (1 + h / r) * (g * r) ** (-b / 2) * 10 ** rng.uniform(-4, -1)
        )
        air = {"normal": drag, "tangential": drag / 4, "exponent": b}
    floor = {
        "contact": law,
        "friction": rng.uniform(0.02, 1),
        "restitution": rng.choice([0, 1, *rng.random(6)]),
    }
    for name in ("rolling_friction", "pivoting_friction"):
        floor[name] = rng.choice([0, r * 10 ** rng.uniform(-4, -1)])
    off = rng.integers(2) * rng.uniform(-0.15, 0.15, 3) * [r, r, min(r, h)]
    release: dict[str, Any] = {
        "position": [0, 0, size * rng.uniform(1.5, 8)],
        "velocity": ((g * size) ** 0.5 * rng.uniform(-1, 1, 3)).tolist(),
        "quaternion": draw_quaternion(rng),
        "angular_velocity": ((g / size) ** 0.5 * rng.uniform(-4, 4, 3)).tolist(),
    }
    coin = {"mass": m, "radius": r, "thickness": h, "center_of_mass": off.tolist()}
    return scenario(coin=coin, air=air, floor=floor, gravity=g, release=release, ending={"max_impacts": 300})


def logged(case: Scenario, settings: Any) -> tuple[Any, np.ndarray, np.ndarray]:
    """A toss, its energies before all steps but those of impacts, and its depths in sustained contact [r]."""
    machine = machine_of(case, settings)
    answer = run(machine, case.rules)
    q, v = answer.knots[:, MOTION][:, :7], answer.knots[:, MOTION][:, 7:]
    R = Rotation.from_quat(q[:, 3:], scalar_first=True).as_matrix()
    up = R[:, 2]
    body, c = case.body, np.array(case.coin.center_of_mass)
    turning = np.cross(v[:, 3:], c)
    v_C = v[:, :3] + np.einsum("nij,nj->ni", R, turning)
    spin = np.einsum("ni,ij,nj->n", v[:, 3:], np.array(body.inertia), v[:, 3:])
    energy = body.mass * (np.sum(v_C**2, axis=1) / 2 + body.gravity * (q[:, 2] + up @ c)) + spin / 2
    depth = body.thickness / 2 * np.abs(up[:, 2]) + body.radius * np.hypot(up[:, 0], up[:, 1]) - q[:, 2]
    step = answer.knots[:, STEP]
    return answer, energy[step != StepKind.IMPACT], depth[step == StepKind.CONTACT] / body.radius


def check(case: Scenario) -> None:
    """The toss answers in time; it sinks by less than 1e-3 r; on a smooth floor it gains less than 1e-3.

    In air with b > 0 each force on a wall is a quadrature of up to some ms: there the steps are bounded.
    The steps of sustained contact err by up to 1e-3 of the energy in each 100,000.
    """
    start = process_time()
    answer, energy, depth = logged(case, MANY)
    if case.body.air.exponent is None or case.coin.thickness == 0:
        assert process_time() - start < 30
    else:
        assert np.sum(answer.knots[:, STEP] != StepKind.IMPACT) < 10_100
    assert answer.ending != Ending.NONE
    assert depth.max(initial=0) < 1e-3
    if case.floor.contact == "smooth":
        # Friction with kinematic restitution may add energy, as the law has it.
        gain = (energy - np.minimum.accumulate(energy)).max()
        assert gain < 1e-3 * max(1, len(depth) / 100_000) * energy[0]


@pytest.mark.parametrize("seed", range(QUICK))
def test_a_few_extreme_tosses_answer_and_gain_no_energy(seed):
    check(extreme(seed).replace("air.exponent", 0.0, "ending.max_impacts", 60))


@pytest.mark.long
@pytest.mark.parametrize("seed", range(200))
def test_extreme_tosses_answer_and_gain_no_energy(seed):
    check(extreme(seed))


@pytest.mark.parametrize("radius", [0.0016, 0.0125])
@pytest.mark.parametrize("settings", [FINE, MANY])
def test_an_elastic_coin_keeps_its_energy_at_every_size(radius, settings):
    case = scenario(
        coin={"radius": radius, "thickness": 0.16 * radius, "mass": 2e-3},
        floor={"restitution": 1.0},
        release={"position": [0, 0, 4 * radius], "angles": [0.3, 1.0, 0], "angular_velocity": [30, -20, 10]},
        ending={"max_impacts": 200},
    )
    answer, energy, _ = logged(case, settings)
    assert len(answer.rows) == 200
    assert np.abs(energy - energy[0]).max() < 5e-4 * energy[0]


def test_a_rod_lands_in_few_steps():
    case = scenario(
        coin={"thickness": 2.5},
        release={"position": [0, 0, 2], "quaternion": [0.8, 0.1, 0.5, 0.316], "angular_velocity": [2, 4, -6]},
        ending={"max_impacts": 2},
    )
    answer, _, _ = logged(case, MANY)
    assert len(answer.rows) >= 1
    assert len(answer.knots) < 300


def test_the_mass_cancels_however_small_it_is():
    """Without air a coin's motion does not know its mass; impulses are in proportion to it."""
    light, heavy = (
        run(machine_of(case, MANY), case.rules)
        for case in (
            scenario(
                coin={"mass": mass, "radius": 1e-3, "thickness": 1e-4},
                ending={"max_impacts": 5},
                release={"position": [0, 0, 0.01], "angles": [0, 0.4, 0], "angular_velocity": [5, 9, 3]},
            )
            for mass in (2.0**-29, 2.0**-4)
        )
    )
    # MuJoCo's own tolerances are absolute; they leave a few parts in 1e9.
    for name, unit in (
        ("velocity_after", 1),
        ("impulse", 2.0**25),
        ("energy", 2.0**25),
        ("energy_change", 2.0**25),
    ):
        size = np.abs(heavy.rows[name]).max()
        assert np.abs(unit * light.rows[name] - heavy.rows[name]).max() < 1e-6 * size, name
    assert np.all(heavy.rows["impulse"][:, 2] > 0)


def test_ordinary_settings_are_kept():
    assert resolved(MANY, 0.8, 28.0) == MANY
    assert resolved(FINE, 0.95, 28.0) == FINE
