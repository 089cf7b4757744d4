"""Bodies of other mass and shape on MuJoCo's contacts: what is measured, and the study's check."""

from dataclasses import replace

import pytest

from cointoss_reproduction.studies.mujoco_bodies import bodies
from cointoss_reproduction.studies.mujoco_bodies.bodies import SHAPES, rebounds, resting_depth
from cointoss_reproduction.studies.mujoco_bodies.study import (
    REPRODUCTION,
    RESTITUTION,
    STEP,
    touch_of,
)
from saved import missed, unseen


def test_two_geoms_of_one_priority_mix_their_solimp_and_take_the_smaller_solref():
    mixed = touch_of("one step", STEP, body="")
    mean = replace(mixed, body='priority="1"', solimp="0.94995 0.97495 0.001 0.5 2")
    both = [rebounds(SHAPES["ball"], touch).restitutions for touch in (mixed, mean)]
    assert both[0] == pytest.approx(both[1], abs=1e-9)
    assert both[0].mean() < RESTITUTION - 0.01


def test_a_ball_at_rest_sinks_by_the_same_depth_whatever_its_mass():
    """(1 - d) g/k, d the impedance."""
    touch = replace(touch_of("one step", STEP), solref=(-1e4, -50.0), solimp="0.9 0.9 0.001 0.5 2")
    depths = [resting_depth(replace(touch, mass=mass)) for mass in (1e-2, 1e2)]
    assert depths == pytest.approx([0.1 * 9.81 / 1e4] * 2, rel=1e-6)


@pytest.mark.slow
def test_fewer_touches_bear_out_the_claims(monkeypatch):
    monkeypatch.setattr(bodies, "PHASES", 3)
    cells = REPRODUCTION.make(unseen).data
    assert missed("mujoco-bodies", cells) == ()
    turning = cells.query("contact == 'one step' and fine_error > 1e-3")
    assert (turning["error"] / turning["fine_error"]).tolist() == pytest.approx([10] * 4, rel=0.05)
    flat = cells.query("flat == 'box flat' and contact == 'one step' and solimp == 'hardest'")
    assert flat["error"].max() < 2e-4
    assert flat["unevenness"].max() < 1e-12
