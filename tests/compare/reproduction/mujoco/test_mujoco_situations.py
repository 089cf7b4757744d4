"""Situations of MuJoCo's users: closed forms of what is measured, the study's page and its check."""

from dataclasses import replace

import pytest

from cointoss.coin_mj.bounces.recipe import recipe_of
from cointoss.coin_mj.bounces.rest import Rest
from cointoss.compare.reproduction.mujoco.mujoco_situations import Situations
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.mujoco_situations import (
    RADIUS,
    RECIPE,
    ball,
    falling_balls,
    hits,
    rod,
    sliding,
)
from tests.helpers.pages import saved
from tests.helpers.studies import missed

SAVED = read_numbers(saved("mujoco-situations"), Situations)
CONTACT = recipe_of(0.8, 1e-3)


def test_a_ball_on_a_ball_and_on_a_hinged_rod_part_by_newtons_law():
    """v' = ((1 - e)/2, (1 + e)/2); v' = 1 - (1 + e) M/(1 + M), M = 10/3 the rod's mass at its end."""
    assert hits(CONTACT, ball(0, CONTACT) + ball(3 * RADIUS, CONTACT)) == pytest.approx([0.1, 0.9], abs=3e-4)
    assert hits(CONTACT, ball(0, CONTACT) + rod(CONTACT))[0] == pytest.approx(-5 / 13, abs=5e-4)


def test_the_recipe_of_friction_is_coulombs_law_for_a_ball_to_first_order():
    coarse, fine = (max(sliding(recipe_of(0.8, dt), 0.3, 5.0, RECIPE)) for dt in (2e-3, 5e-4))
    assert coarse / fine == pytest.approx(4, rel=0.3)
    assert max(sliding(CONTACT, 0.3, 5.0, 'cone="elliptic"')) > 0.1


def test_falling_balls_keep_their_energy_only_where_e_is_1():
    assert abs(falling_balls(recipe_of(1.0, 1e-2), 2.0)) < 1e-2
    assert falling_balls(recipe_of(0.8, 1e-2), 2.0) < -0.5


def test_a_body_that_does_not_rest_is_seen():
    moving = {**SAVED.rest, "spring": Rest(depth=2.5e-4, hop=1e-5, sinking=0.0)}
    assert missed("mujoco-situations", replace(SAVED, rest=moving)) == (
        "with the recommended settings a body at rest lies still",
    )
