"""MuJoCo's coin in contacts that last: landings of the other rim, how the toss ends, and what sinks."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from cointoss import analytic, coin_mj
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.path import MOTION, STEP, TIME, Knots
from cointoss.coin_mj.steps.knots import StepKind
from cointoss.coin_mj.toss import run
from cointoss.compare.metrics.estimates import chance_alike
from cointoss.models.attitude import rotation_matrix
from cointoss.models.batch import rows_from_states
from cointoss.models.certificate import GAP
from cointoss.models.records import Ending, Outcome
from tests.helpers.draws import AIR, LONG_TRANSIENT, PAPER_OFFSET, ZLOTY, scenario
from tests.helpers.many import draw_states

pytestmark = pytest.mark.usefixtures("without_horizon")

M, R, G = ZLOTY["mass"], ZLOTY["radius"], 9.81
DECIDED = {Outcome.HEADS, Outcome.TAILS, Outcome.EDGE, Outcome.PERPETUAL}


@pytest.mark.slow_after_first
@pytest.mark.parametrize("spin", [120, 132, 138])
def test_a_thick_coin_that_settles_on_a_face_gains_no_energy(spin):
    """Friction tips it from rim to rim through flat: a long step may let the other rim sink."""
    case = scenario(
        coin={"mass": 7.5e-3, "radius": 11.625e-3, "thickness": 2.33e-3},
        floor={"restitution": 0.5, "contact": "coulomb", "friction": 0.2},
        release={"position": [0, 0, 1.0], "velocity": [0, 0, 2.0], "angular_velocity": [0, spin, 0]},
    )
    tossed = coin_mj.toss(case)
    assert len(tossed.contacts) > 0
    energies = tossed.impacts.energy
    unit = 7.5e-3 * G * 11.625e-3
    assert np.diff(energies).max() < 1e-6 * unit
    gained = next(line.value for line in tossed.certificate if line.name.endswith("largest gain of energy"))
    assert float(gained) < 1e-2


@pytest.mark.parametrize("settings", [coin_mj.FINE, coin_mj.MANY])
def test_a_slow_landing_of_the_other_rim_is_a_plastic_impact(settings):
    """It leaves (1 - k)/(1 + k) of the rate of n_z, k = m h²/(4 J_ξ), and moves nothing."""
    case = scenario(
        floor={"restitution": 0.5},
        release={"position": [0, 0, R + 2e-5], "angles": [0, np.arccos(0.02), 0]},
        ending={"test": "paper", "max_time": 0.08},
    )
    knots = run(machine_of(case, settings), case.rules).knots
    landed = np.flatnonzero(knots[:, STEP] == StepKind.LANDING)
    before, after = knots[landed], knots[landed + 1]
    assert len(landed) > 2
    rates = [
        [np.cross(rotation_matrix(m[3:7])[2], m[10:])[2] for m in part[:, MOTION]] for part in (before, after)
    ]
    k = M * ZLOTY["thickness"] ** 2 / 4 / case.body.inertia[0][0]
    assert np.array(rates[1]) / rates[0] == pytest.approx((1 - k) / (1 + k), abs=2e-3)
    assert np.abs(after[:, MOTION][:, :7] - before[:, MOTION][:, :7]).max() < 2e-5


@pytest.mark.slow_after_first
@pytest.mark.parametrize("realisation", list(coin_mj.Realisation))
@pytest.mark.parametrize("law", ["smooth", "coulomb"])
@pytest.mark.parametrize("air", [{}, AIR])
@pytest.mark.parametrize("thickness", [0.0, 2e-3])
def test_random_tosses_are_decided(realisation, law, air, thickness):
    settings = replace(coin_mj.MANY, contact=realisation)
    rng = np.random.default_rng([len(law), len(air), int(1e4 * thickness)])
    for chi, offset in ((0.15, 0), (0.6, 1), (0.9, 0)):
        center = np.array(PAPER_OFFSET) * offset * [1, 1, thickness > 0]
        case = scenario(
            coin={**ZLOTY, "thickness": thickness, "center_of_mass": center.tolist()},
            floor={"contact": law, "friction": 0.3, "restitution": chi},
            air=air,
        )
        rows = rows_from_states(case, draw_states(rng, 6 if air else 2)[1])
        outcomes = coin_mj.toss_rows(rows, settings=settings)
        assert set(outcomes.outcome.tolist()) <= DECIDED
        if air:
            assert Outcome.PERPETUAL not in outcomes.outcome


@pytest.mark.long
@pytest.mark.parametrize("law", ["smooth", "coulomb"])
def test_outcomes_are_as_frequent_as_those_of_the_other_engine(law):
    case = scenario(floor={"contact": law, "friction": 0.3, "restitution": 0.6}, air=AIR)
    counts = {}
    for seed, (name, engine) in enumerate({"analytic": analytic, "mujoco": coin_mj}.items()):
        states = draw_states(np.random.default_rng([7, seed]), 600)[1]
        outcomes = engine.toss_rows(rows_from_states(case, states))
        counts[name] = [
            int(np.sum(outcomes.outcome == outcome))
            for outcome in (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE)
        ]
    assert all(sum(row) == 600 for row in counts.values())
    assert chance_alike(list(counts.values())) > 1e-3


LOSES_FOR_LONG = {
    **LONG_TRANSIENT,
    "release": {
        "position": [0.0, 0.0, 0.37441609717703833],
        "velocity": [-0.03200196085390527, -0.10979981526988393, -0.1830476274400961],
        "quaternion": [-0.5418881956767218, -0.15356369236780862, -0.8262376892282368, 0.010327471683593022],
        "angular_velocity": [-7.912209261788022, 34.396989938015054, 0.6038303043052566],
    },
}
"""The same coin, from where this engine loses little for long."""


def test_steps_that_are_spent_leave_a_long_transient_or_an_undecided_toss():
    for steps, ending in ((5000, Ending.CONTACT_STEPS), (20_000, Ending.TRANSIENT)):
        settings = replace(coin_mj.MANY, contact_steps=steps)
        tossed = coin_mj.toss(scenario(**LOSES_FOR_LONG), settings=settings)
        assert tossed.ending == ending
        assert tossed.outcome == (Outcome.TRANSIENT if ending == Ending.TRANSIENT else Outcome.UNDECIDED)


def lowest_of(motion, radius, thickness):
    """Height of the coin's lowest point from qpos: over both rims' circles."""
    x, y, z = Rotation.from_quat(motion[3:7], scalar_first=True).as_matrix()[2]
    return motion[2] - radius * np.hypot(x, y) - thickness / 2 * abs(z)


def near_the_edge(seed):
    """A thick coin that drops from near its edge."""
    rng = np.random.default_rng(seed)
    thickness = R * rng.uniform(0.5, 2)
    law = str(rng.choice(["smooth", "coulomb"]))
    return scenario(
        coin={"mass": 1e-2, "thickness": thickness},
        air=AIR if rng.integers(2) else {},
        floor={"contact": law, "restitution": rng.uniform(0.2, 0.7), "friction": 0.3},
        release={
            "position": [0, 0, 1.5 * R + thickness / 2],
            "angles": [0, np.pi / 2 + rng.uniform(-0.3, 0.3), rng.uniform(0, 6)],
            "angular_velocity": rng.uniform(-20, 20, 3).tolist(),
        },
        ending={"max_time": 1.0, "test": "lying"},
    )


@pytest.mark.parametrize("settings", [coin_mj.FINE, coin_mj.MANY])
def test_a_thick_coin_near_its_edge_does_not_sink_and_its_certificate_sees_it(settings):
    crossed = 0
    for seed in range(6):
        case = near_the_edge(seed)
        toss = coin_mj.toss(case, settings=settings)
        path = toss.path
        assert isinstance(path, Knots)
        rows = path.knots[path.knots[:, STEP] == 2]
        depths = [lowest_of(row[MOTION], R, case.coin.thickness) / R for row in rows]
        is_later = path.knots[:, TIME] >= toss.contacts[0, 0]
        touching = path.knots[is_later & (path.knots[:, STEP] != StepKind.IMPACT)]
        normals = [rotation_matrix(row[MOTION][3:7])[2][2] for row in touching]
        crossed += np.sum(np.diff(np.sign(normals)) != 0)
        between = toss.sample(np.linspace(toss.contacts[:, 0], toss.contacts[:, 1], 200).ravel())
        states = np.hstack([between.position, between.quaternion])
        sampled = [lowest_of(state, R, case.coin.thickness) / R for state in states]
        assert min(depths) > -1e-3
        assert min(sampled) > -1e-3
        told = next(float(line.value) for line in toss.certificate if line.name == GAP)
        # It looks between the knots, too.
        assert -1e-3 < told <= min(depths) + 1e-12
        assert told == pytest.approx(min(*depths, *sampled), rel=0.2, abs=1e-5)
    # Each crossing lands the other rim.
    assert crossed > 5
