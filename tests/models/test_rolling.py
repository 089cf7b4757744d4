"""A release that rolls: one scenario by a file, by changes and by rows."""

import re

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cointoss.models.attitude import rotation_matrix
from cointoss.models.batch import rows_from_states, rows_of, scenario_of_row, states_of
from cointoss.models.reading import parse
from tests.helpers.draws import IMPERFECT, PAPER_OFFSET, draw_quaternion, scenario

ROLLS = {"position": [0.3, -0.2, 0.0], "rolls": True, "angular_velocity": [5.0, -30.0, 8.0]}
HERE = scenario(coin=IMPERFECT, release={**ROLLS, "angles": [0.1, 0.4, 0.2]})


@given(st.integers(0, 2**32 - 1))
def test_the_lowest_point_of_a_coin_that_rolls_is_on_the_floor_and_at_rest(seed):
    e = draw_quaternion(np.random.default_rng(seed))
    release = scenario(coin=IMPERFECT, release={**ROLLS, "quaternion": e}).release
    turn = np.array(rotation_matrix(release.attitude))
    rim = -1.25e-2 * turn[2, :2] / np.hypot(*turn[2, :2])
    arm = turn @ ([*rim, -1e-3 * np.sign(turn[2, 2])] - np.array(PAPER_OFFSET))
    assert release.position == (0.3, -0.2, pytest.approx(-arm[2], rel=1e-12))
    assert np.abs(release.velocity + np.cross(turn @ release.angular_velocity, arm)).max() < 1e-15


def test_changed_it_rolls_as_changed():
    assert parse(HERE.to_toml(), "its file") == HERE
    changed = {"release.angles.theta": 0.7, "coin.thickness": 3e-3, "release.angular_velocity.zeta": -4.0}
    due = HERE
    for field, value in changed.items():
        due = due.replace(field, value)
    assert due.release.velocity != HERE.release.velocity
    found = scenario_of_row(rows_of(HERE, 2, changed)[1])
    assert found.release.model_dump(exclude={"rolls"}) == due.release.model_dump(exclude={"rolls"})
    assert HERE.replace("release.rolls", False).release.velocity == HERE.release.velocity
    thrown = np.array([[0, 0, 1, 0, 0, 2, 1, 0, 0, 0, 0, 3, 0.0]])
    assert states_of(rows_from_states(HERE, thrown)).tolist() == thrown.tolist()


def test_a_coin_that_rolls_and_has_no_position_starts_above_the_origin():
    here = HERE.replace("release.position", [0, 0, 0])
    assert parse(re.sub(r"\bposition = .*", "", here.to_toml()), "its file") == here
