"""MuJoCo's impacts against Newton's, at the default settings and as the contact stiffens."""

import numpy as np
import pytest

from cointoss import analytic
from cointoss.coin_mj.entries import forward
from cointoss.coin_mj.model import state
from cointoss.coin_mj.model.machine import machine_of
from cointoss.coin_mj.model.settings import MujocoSettings
from cointoss.coin_mj.path import MOTION, STEP, TIME
from cointoss.coin_mj.toss import impacts_of, run, toss
from cointoss.compare.metrics.impulses import match
from cointoss.models.kernel.compiled import by_numba
from cointoss.models.records import UnsupportedError
from tests.helpers.draws import THIN, draw_release, scenario
from tests.helpers.impacts import DOUBLE, draw_single_impact

set_motion = by_numba(state.set_motion)


def first_impact(case, **settings):
    return impacts_of(case, settings=MujocoSettings(**settings))


def test_a_thin_coin_that_comes_slowly_and_spins_fast_meets_newtons_impulse():
    """The slower the approach, the more the made-up thickness of the shape shifts the touch."""
    rng = np.random.default_rng(44)
    errors = []
    while len(errors) < 40:
        case = scenario(
            coin=THIN,
            release={
                **draw_release(rng, spin=100),
                "position": [0, 0, rng.uniform(0.013, 0.03)],
                "velocity": [0, 0, 0],
            },
            ending={"max_impacts": 2},
        )
        newton = analytic.toss(case).impacts
        if newton.contact_velocity_before[0, 2] > -0.1 or np.any(np.diff(newton.time) < DOUBLE):
            continue
        errors.append(match(newton, first_impact(case)).impulse[0])
    assert max(errors) < 1e-3


def force_at(coin, knot):
    set_motion(coin, knot[MOTION])
    return forward(coin)


def test_the_impulse_is_the_integral_of_the_contact_force():
    case, _ = draw_single_impact(np.random.default_rng(43), least=0.2)
    machine = machine_of(case, MujocoSettings(steps=160))
    answer = run(machine, case.rules)
    assert len(answer.rows) == 1
    pressed = answer.knots[answer.knots[:, STEP] > 0]
    forces = [force_at(machine.coin, knot) for knot in pressed]
    assert len(forces) > 100
    integral = np.trapezoid([*forces, 0.0], [*pressed[:, TIME], answer.end_time])
    impulse = answer.rows["impulse"][0]
    # The trapezoidal rule over half a sine in 160 steps is good to 3e-5.
    assert impulse[2] == pytest.approx(integral, rel=2e-4)
    assert np.abs(impulse[:2]).max() < 1e-12 * impulse[2]


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        (
            {"floor": {"contact": "knurled"}},
            ['floor.contact = "knurled"', '"perfectly_rough", "smooth", "coul'],
        ),
        (
            {"floor": {"contact": "coulomb", "restitution_kind": "energetic"}},
            ['floor.restitution_kind = "energetic"', '"kinematic"'],
        ),
    ],
)
def test_what_is_not_realised_is_refused_by_name(parts, words):
    with pytest.raises(UnsupportedError) as caught:
        toss(scenario(**parts))
    assert all(word in str(caught.value) for word in words)
