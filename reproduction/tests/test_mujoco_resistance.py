"""The study of MuJoCo's torsional and rolling friction: its closed forms, and its claims."""

import pytest

from cointoss_reproduction.studies.mujoco_resistance.study import REPRODUCTION
from saved import missed, unseen


@pytest.mark.slow
def test_friction_stops_bodies_as_is_claimed():
    cells = REPRODUCTION.make(unseen).data
    by_moments = cells[cells["by"] == "explicit moments"]
    assert by_moments["motion"].tolist() == ["rolls", "turns"]
    assert by_moments["error"].abs().max() < 1e-3
    assert missed("mujoco-resistance", cells) == ()
