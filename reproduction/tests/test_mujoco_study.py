"""The studies of MuJoCo's contacts, at a small size: what they claim holds."""

import re
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest

from cointoss.coin_mj import MujocoSettings, Realisation
from cointoss.coin_mj.bounces.contact import one_step_solref, spring_solref
from cointoss.coin_mj.bounces.drops import restitutions_of_a_ball
from cointoss.models.laws import ContactLaw
from cointoss_reproduction.frame import runner
from cointoss_reproduction.frame.claim import unexpected
from cointoss_reproduction.setups.mujoco_impacts import (
    by_law,
    draw_touches,
    first,
    on_floor,
    velocity_at_touch,
)
from cointoss_reproduction.setups.mujoco_study import (
    IMPULSE,
    LIMIT,
    cone_formula,
    native_cone,
    order,
    over_kinds,
    over_steps,
    over_stiffness,
    tilted_touch,
)
from cointoss_reproduction.studies.mujoco_laws import study as mujoco_laws
from cointoss_reproduction.studies.mujoco_many.fixed_steps import restitutions_of_coins
from saved import unseen


def test_touches_are_touches():
    cases = draw_touches(np.random.default_rng(1), 8, (0.2, 1.0))
    law = by_law(cases)
    assert first(law, "time").max() < 1e-8
    before = first(law, "contact_velocity_before")
    assert before == pytest.approx(np.array([velocity_at_touch(case) for case in cases]), abs=1e-6)
    assert before[:, 2].max() < -0.3


def test_a_tilted_touch_slips_across_the_rim():
    case = tilted_touch(30, np.array([0.7, 0.0]), 0.5)
    impacts = by_law([on_floor(case, ContactLaw.SHARP_EDGE, 0.0)])[0]
    assert impacts.contact_velocity_before[0] == pytest.approx([0, 0.7, -1], abs=1e-6)
    assert impacts.contact_velocity_after[0] == pytest.approx([0, 0, 0.5], abs=1e-6)


def test_the_order_of_a_power_law_is_its_power():
    sizes = [10.0, 20.0, 40.0]
    assert order(sizes, [3 * size**-1.7 for size in sizes]) == pytest.approx(1.7, rel=1e-12)


def test_impacts_converge_with_the_root_of_the_stiffness_and_few_steps_resolve_them():
    cases = draw_touches(np.random.default_rng(2), 6, (0.3, 1.0))
    rubbed = [on_floor(case, ContactLaw.COULOMB, 0.3) for case in cases]
    stiffness = over_stiffness(rubbed, [1e8, 1e10, 1e12])
    assert 0.45 < stiffness.order < 0.55
    assert stiffness.errors[LIMIT][1] < 0.05 * stiffness.errors[IMPULSE][1]
    assert max(over_steps(rubbed, [10, 40], 640).values()) < 5e-6


def test_kinds_of_impact_are_told_apart():
    kinds = over_kinds(40, np.random.default_rng(3))
    assert kinds["spring"]["frictionless"].number == 40
    assert sum(kinds["spring"][kind].number for kind in ("sticking", "sliding", "turning")) == 40
    assert kinds["spring"]["sticking"].median < 1e-4 < kinds["spring, native cone"]["sticking"].median


def test_the_native_cone_keeps_a_restitution_only_without_friction():
    found = native_cone(0.5, [20.0], [0.0, 1.0], [0.0, 2.0])
    assert found.obtained[0, :, 0] == pytest.approx([0.5, 0.5], abs=1e-4)
    assert found.obtained[0, 1, 1] > 0.6


def test_one_step_with_the_native_cone_is_moreaus_law():
    formula = cone_formula(30, np.random.default_rng(4))
    assert formula.normal_speed.worst < 2e-3
    assert formula.energy.worst < 2e-3
    assert formula.pushed > 1.05
    assert formula.gains["one step, native cone"][0] == 0


def test_the_native_cone_with_its_slip_undamped_preserves_slip():
    result = mujoco_laws.REPRODUCTION.make(unseen, count=10, seed=5)
    found = result.data
    assert unexpected(result.claims) == ()
    assert found.best("(d) slip_preserving") == "native cone, μ = 100, slip undamped"
    assert found.growing[1000.0].median < 1e-3 < found.growing[0.1].median
    assert "| (e) smooth | **" in result.tables


@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_one_step_of_mj_step_is_newtons_law(e):
    for integrator in ("Euler", "implicitfast"):
        assert restitutions_of_a_ball(one_step_solref(e, 1e-3), 1e-3, integrator) == pytest.approx(
            e, abs=1e-9
        )


def test_more_steps_make_a_springs_restitution_better():
    errors = [
        np.abs(restitutions_of_a_ball(spring_solref(0.5, 1e-4, n), 1e-4, "RK4") - 0.5).max()
        for n in (20, 40, 80)
    ]
    # A touch falls anywhere within a step: first order.
    assert errors[1] / errors[0] == pytest.approx(0.5, abs=0.1)
    assert errors[2] / errors[1] == pytest.approx(0.5, abs=0.1)


@pytest.mark.parametrize(("realisation", "dt"), [("one_step", 1e-4), ("spring", 5e-8)])
def test_shorter_fixed_steps_make_a_coins_restitution_better(realisation, dt):
    cases = draw_touches(np.random.default_rng(4), 32, (0.2, 1.0))
    chi = np.array([case.floor.restitution for case in cases])
    # A spring so stiff that the coin hardly turns in its contact.
    settings = MujocoSettings(contact=Realisation(realisation), stiffness=1e13)
    errors = [np.abs(restitutions_of_coins(cases, settings, dt / part) - chi) for part in (1, 2, 4)]
    # A touch falls anywhere within a step: first order.
    for coarse, fine in pairwise(errors):
        assert np.mean(fine) / np.mean(coarse) == pytest.approx(0.5, abs=0.1)
    assert 1e-4 < np.max(errors) < 0.1


def test_the_example_of_the_docs_rebounds_as_it_says(capsys):
    page = (Path(__file__).parents[4] / "docs" / "MUJOCO.md").read_text(encoding="utf-8")
    (example,) = (code for code in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "mj_step" in code)
    exec(example, {})
    assert float(capsys.readouterr().out) == pytest.approx(0.8, abs=1e-5)


@pytest.mark.slow
def test_the_whole_study_bears_out_its_claims(tmp_path):
    for name, pictures in (("mujoco-limit", {"convergence", "native-cone"}), ("mujoco-laws", {"impulses"})):
        result = runner.reproduce(name, tmp_path, unseen)
        assert unexpected(result.claims) == ()
        left = {path.stem for path in runner.folder_of(name, tmp_path).iterdir()}
        assert {name for name in left if not name.startswith("table-")} == {
            "claims",
            "numbers",
            "provenance",
            *pictures,
        }
