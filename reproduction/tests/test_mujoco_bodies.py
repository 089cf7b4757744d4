"""Bodies of other mass and shape on MuJoCo's contacts: what is measured, the study's page and its check."""

from dataclasses import replace

import numpy as np
import pytest

from cointoss.coin_mj.bounces.drops import SPEED
from cointoss_reproduction.frame.saving import read_numbers
from cointoss_reproduction.studies.mujoco_bodies.bodies import SHAPES, SIZE, rebounds, resting_depth
from cointoss_reproduction.studies.mujoco_bodies.study import FINE, RESTITUTION, STEP, Bodies, touch_of
from saved import missed, saved

SAVED = read_numbers(saved("mujoco-bodies"), Bodies)
DEFAULT = "0.9 0.95 0.001 0.5 2"


@pytest.mark.parametrize("contact", ["one step", "spring"])
def test_mass_changes_neither_restitution_nor_depth(contact):
    light, heavy = (
        rebounds(SHAPES["box on a corner"], touch_of(contact, FINE, mass=mass)) for mass in (1e-3, 1e3)
    )
    assert heavy.restitutions == pytest.approx(light.restitutions, abs=1e-8)
    assert heavy.depth == pytest.approx(light.depth, rel=1e-8)
    assert 1e-4 < abs(light.restitutions - RESTITUTION).max() < 0.1


def test_a_body_that_turns_misses_the_restitution_in_proportion_to_the_step():
    coarse, fine = (
        abs(rebounds(SHAPES["cylinder on its rim"], touch_of("one step", dt)).restitutions - RESTITUTION)
        for dt in (FINE, FINE / 2)
    )
    assert coarse.mean() / fine.mean() == pytest.approx(2, rel=0.05)


def test_four_corners_rebound_as_one_point_does_and_evenly():
    found = rebounds(SHAPES["box flat"], touch_of("one step", STEP)).restitutions
    assert found.shape[1] == 4
    assert found == pytest.approx(RESTITUTION, abs=2e-4)
    assert np.ptp(found, axis=1).max() < 1e-12
    soft, softer = (
        abs(rebounds(SHAPES["box flat"], touch_of("one step", STEP, **others)).restitutions - RESTITUTION)
        for others in ({"solimp": DEFAULT, "exact": False}, {"solimp": DEFAULT})
    )
    assert softer.max() > 2 * soft.max() > 0.1


def test_two_geoms_of_one_priority_mix_their_solimp_and_take_the_smaller_solref():
    mixed = touch_of("one step", STEP, body="")
    mean = replace(mixed, body='priority="1"', solimp="0.94995 0.97495 0.001 0.5 2")
    both = [rebounds(SHAPES["ball"], touch).restitutions for touch in (mixed, mean)]
    assert both[0] == pytest.approx(both[1], abs=1e-9)
    assert both[0].mean() < RESTITUTION - 0.01


@pytest.mark.parametrize("way", [1.5, 2.0])
def test_speculative_contacts_keep_the_restitution_of_one_step_and_not_of_a_spring(way):
    """The ball goes further than its radius in a step, and leaves by a spring too."""
    step = way * SIZE / SPEED
    one, spring = (
        rebounds(SHAPES["ball"], touch_of(contact, step, speculative=True)).restitutions
        for contact in ("one step", "spring")
    )
    assert one == pytest.approx(RESTITUTION, abs=1e-9)
    assert 0 < spring.min() <= spring.max() < RESTITUTION - 0.2


def test_a_ball_at_rest_sinks_by_the_same_depth_whatever_its_mass():
    """(1 - d) g/k, d the impedance."""
    touch = replace(touch_of("one step", STEP), solref=(-1e4, -50.0), solimp="0.9 0.9 0.001 0.5 2")
    depths = [resting_depth(replace(touch, mass=mass)) for mass in (1e-2, 1e2)]
    assert depths == pytest.approx([0.1 * 9.81 / 1e4] * 2, rel=1e-6)


def test_a_restitution_that_depends_on_the_mass_is_seen():
    changed = replace(SAVED, by_mass={**SAVED.by_mass, "spring": 1e-3})
    assert missed("mujoco-bodies", changed) == ("neither the restitution nor the depth depends on the mass",)
