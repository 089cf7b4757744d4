"""Situations of MuJoCo's users: closed forms of what is measured."""

import pytest

from cointoss_bounce import solref
from cointoss_bounce.recipe import recipe_of
from cointoss_reproduction.studies.mujoco_situations.bodies import (
    RADIUS,
    ball,
    falling_balls,
    hits,
    rod,
    sliding,
)
from cointoss_reproduction.studies.mujoco_situations.failures import creep, cylinder, falls_through
from cointoss_reproduction.studies.mujoco_situations.study import HITS, hit, lain, stacked, went

CONTACT = recipe_of(0.8, 1e-3)


def test_a_ball_on_a_ball_and_on_a_hinged_rod_part_by_newtons_law():
    """v' = ((1 - e)/2, (1 + e)/2); v' = 1 - (1 + e) M/(1 + M), M = 10/3 the rod's mass at its end."""
    assert hits(CONTACT, ball(0, CONTACT) + ball(3 * RADIUS, CONTACT)) == pytest.approx([0.1, 0.9], abs=3e-4)
    assert hits(CONTACT, ball(0, CONTACT) + rod(CONTACT))[0] == pytest.approx(-5 / 13, abs=5e-4)


def test_the_recipe_of_friction_is_coulombs_law_for_a_ball_to_first_order():
    coarse, fine = (max(sliding(recipe_of(0.8, dt), 0.3, 5.0)) for dt in (2e-3, 5e-4))
    assert coarse / fine == pytest.approx(4, rel=0.3)
    assert max(sliding(CONTACT, 0.3, 5.0, 'cone="elliptic"')) > 0.1


def test_falling_balls_keep_their_energy_only_where_e_is_1():
    assert abs(falling_balls(recipe_of(1.0, 1e-2), 2.0)) < 1e-2
    assert falling_balls(recipe_of(0.8, 1e-2), 2.0) < -0.5


def test_a_ball_goes_through_boxes_up_to_its_contacts_depth_and_through_no_plane():
    """At 3 m/s by 40 steps of 2 ms v √(e/k) = 68 mm, less 20 mm of the ball: boxes up to 97 mm."""
    spring = recipe_of(0.8, 2e-3, 40)
    assert [falls_through(spring, thick) for thick in (None, 0.003, 0.03, 0.094, 0.1)] == [0, 10, 10, 10, 0]
    assert falls_through(recipe_of(0.8, 2e-3), 0.003) == 0


def test_a_cylinder_on_a_ball_has_e_on_its_middle_and_beside_it_in_proportion_to_the_step():
    on_middle = cylinder(recipe_of(0.8, 2e-3), 0.0).restitutions.mean(axis=1)
    assert on_middle == pytest.approx(0.8, abs=1e-3)
    coarse, fine = (cylinder(recipe_of(0.8, dt), 0.03).restitutions.mean(axis=1) for dt in (1e-3, 1e-4))
    assert (coarse - 0.8)[:4] / (fine - 0.8)[:4] == pytest.approx(10, rel=0.2)
    assert fine[:5] == pytest.approx(0.8, abs=5e-3)


@pytest.mark.parametrize(("e", "dt"), [(0.5, 1e-3), (0.8, 2e-3)])
def test_what_is_pinched_creeps_as_fast_as_the_damping_lets_it(e, dt):
    """About (1 - d) g/b; an elliptic cone divides it by impratio."""
    contact = recipe_of(e, dt)
    assert creep(contact, "", False) == pytest.approx(solref(e, dt).creep, rel=0.1)
    assert solref(e, dt).creep == pytest.approx(1e-4 * 9.81 * dt / (1 + e), rel=1e-3)
    free, held = (creep(contact, f'cone="elliptic" impratio="{ratio}"', False) or 0 for ratio in (1, 100))
    assert free / held == pytest.approx(100, rel=0.01)


def test_what_is_pinched_by_springs_falls_out_but_for_pairs_that_damp_the_slip():
    spring = recipe_of(0.8, 2e-3, 40)
    assert creep(spring, "", False) is None
    assert 0 < (creep(spring, 'cone="elliptic" impratio="100"', True) or 0) < 1e-5


@pytest.mark.slow
def test_claims_hold_of_what_is_measured():
    assert lain(CONTACT, 0.0)["over"] == pytest.approx(1, abs=2e-3)
    assert went("spring", 3e-3) == {"through": 10, "expected": 10}
    assert stacked(CONTACT, (3, True))["top"] < 5e-3
    ball_alone = hit(HITS["a ball on a hinged rod"])
    assert ball_alone["velocity"].to_list() == pytest.approx(ball_alone["expected"].to_list(), abs=5e-4)
