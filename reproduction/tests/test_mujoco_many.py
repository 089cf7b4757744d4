"""The study of many tosses in MuJoCo: a loop of fixed steps, and a small run."""

import numpy as np
import pytest

from cointoss.coin_mj import MujocoSettings, Realisation
from cointoss_reproduction.setups.mujoco_impacts import draw_touches
from cointoss_reproduction.studies.mujoco_many.fixed_steps import restitutions_of_coins
from cointoss_reproduction.studies.mujoco_many.study import REPRODUCTION
from saved import missed, result_of, unseen


@pytest.mark.parametrize(("realisation", "dt"), [("one_step", 1e-4), ("spring", 5e-8)])
def test_shorter_fixed_steps_make_a_coins_restitution_better(realisation, dt):
    cases = draw_touches(np.random.default_rng(4), 32, (0.2, 1.0))
    chi = np.array([case.floor.restitution for case in cases])
    # A spring so stiff that the coin hardly turns in its contact.
    settings = MujocoSettings(contact=Realisation(realisation), stiffness=1e13)
    errors = [np.abs(restitutions_of_coins(cases, settings, dt / part) - chi) for part in (1, 2, 4)]
    a, b, c = np.mean(errors, axis=1)
    # A touch falls anywhere within a step: first order.
    assert [b / a, c / b] == pytest.approx([0.5, 0.5], abs=0.1)
    assert 1e-4 < np.max(errors) < 0.1


def test_a_small_study_is_made():
    cells = REPRODUCTION.make(unseen, tosses=3, touches=3, seed=1).data
    assert missed("mujoco-many", cells) == ()
    none = cells.assign(own_step=None, own_per_second=0.0, own_times=np.inf, restitution_worst=2e-3)
    assert "| spring | 2e-03 |  | 0 | inf |" in result_of("mujoco-many", none).tables
