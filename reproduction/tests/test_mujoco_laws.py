"""Impacts by MuJoCo's contacts against the laws: closed forms, convergence, and the study of laws."""

import re

import numpy as np
import pytest

from cointoss import ContactLaw
from cointoss.coin_mj import FINE, Friction, MujocoSettings, Realisation
from cointoss_reproduction.setups.mujoco_impacts import (
    by_law,
    by_mujoco,
    draw_touches,
    first,
    impulse_errors,
    on_floor,
    relative_errors,
    touch,
)
from cointoss_reproduction.studies.mujoco_laws.study import REPRODUCTION, nearest
from saved import DOCS, missed, unseen

NATIVE = MujocoSettings(friction=Friction.NATIVE)


def rubbed(seed, count, friction=(0.3, 0.3)):
    rng = np.random.default_rng(seed)
    cases = draw_touches(rng, count, (0.2, 1.0))
    return [on_floor(case, ContactLaw.COULOMB, rng.uniform(*friction)) for case in cases]


def test_touches_are_touches():
    law = by_law(draw_touches(np.random.default_rng(1), 8, (0.2, 1.0)))
    assert first(law, "time").max() < 1e-8
    assert first(law, "contact_velocity_before")[:, 2].max() < -0.3


def test_impacts_converge_with_the_root_of_the_stiffness_and_few_steps_resolve_them():
    cases = rubbed(2, 6)
    S = first(by_law(cases), "impulse")

    def impulse(**settings):
        return first(by_mujoco(cases, MujocoSettings(**settings)), "impulse")

    soft, hard, hardest = (np.median(relative_errors(S, impulse(stiffness=k))) for k in (1e8, 1e10, 1e12))
    assert np.log10([soft / hard, hard / hardest]) == pytest.approx([1, 1], abs=0.1)
    limit = 2 * impulse(stiffness=1e10) - impulse(stiffness=0.25e10)
    assert np.median(relative_errors(S, limit)) < 0.05 * hard
    resolved = impulse(steps=640)
    assert all(np.median(relative_errors(resolved, impulse(steps=n))) < 5e-6 for n in (10, 40))


def test_where_slip_stops_a_spring_meets_the_law_and_mujocos_own_friction_does_not():
    drawn = rubbed(3, 40, (0.0, 1.0))
    cases = [case for case in drawn if np.abs(by_law([case])[0].contact_velocity_after[0, :2]).max() < 1e-9]
    assert 5 < len(cases) < 40
    assert np.median(impulse_errors(cases, FINE)) < 1e-4 < np.median(impulse_errors(cases, NATIVE))


def test_the_native_cone_keeps_a_restitution_only_without_friction():
    half = np.radians(20) / 2
    tilted = {"quaternion": [np.cos(half), np.sin(half), 0, 0]}
    cases = [
        on_floor(touch({**tilted, "velocity": [0, slip, -1]}, 0.5), ContactLaw.COULOMB, friction)
        for slip, friction in ((0, 0), (2, 0), (2, 1))
    ]
    after = first(by_mujoco(cases, NATIVE), "contact_velocity_after")[:, 2]
    assert after[:2] == pytest.approx([0.5, 0.5], abs=1e-4)
    assert after[2] > 0.6


def test_one_step_with_the_native_cone_is_moreaus_law():
    """v_n' = χ |v_n| + μ |v_t' + χ v_t|, and the energy changes by (1 - χ) S · v_A/2, never a gain.

    In a sliding contact the acceleration exceeds the reference along the edge of the dual cone,
    a_n - a_n* = μ |a_t - a_t*|, at a right angle to the force; with the damping (1 + χ)/dt along the floor
    too S · (v_A' + χ v_A) = 0.
    """
    cases = rubbed(4, 30, (0.05, 1.0))
    mu, chi = np.array([(case.floor.friction, case.floor.restitution) for case in cases]).T
    found = by_mujoco(cases, MujocoSettings(contact=Realisation.ONE_STEP, friction=Friction.NATIVE))
    before, after = first(found, "contact_velocity_before"), first(found, "contact_velocity_after")
    speed = -chi * before[:, 2] + mu * np.linalg.norm((after + chi[:, None] * before)[:, :2], axis=1)
    assert after[:, 2] / -before[:, 2] == pytest.approx(speed / -before[:, 2], abs=2e-3)
    assert (after[:, 2] / (-chi * before[:, 2])).max() > 1.05
    gained = first(found, "energy_change")
    work = (1 - chi) * np.sum(first(found, "impulse") * before, axis=1) / 2
    energy = first(found, "energy") - gained
    assert gained / energy == pytest.approx(work / energy, abs=2e-3)
    assert (gained / energy).max() < 1e-5


@pytest.mark.slow
def test_a_small_study_of_laws_bears_out_its_claims():
    cells = REPRODUCTION.make(unseen, count=10, seed=5).data
    assert missed("mujoco-laws", cells) == ()
    assert nearest(cells)["(d) slip_preserving"]["contact"] == "native cone, μ = 100, slip undamped"
    rough = dict(zip(cells["friction"], cells["median"], strict=True))
    assert rough[1000.0] < 1e-3 < rough[0.1]
    assert len(REPRODUCTION.draw["impulses"](cells).axes) == 8


def test_the_example_of_the_docs_rebounds_as_it_says(capsys):
    page = (DOCS / "MUJOCO_MEASURED.md").read_text(encoding="utf-8")
    (example,) = (code for code in re.findall(r"```python\n(.*?)```", page, re.DOTALL) if "mj_jac" in code)
    exec(example, {})
    assert float(capsys.readouterr().out) == pytest.approx(0.8, abs=1e-5)
