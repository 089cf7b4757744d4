"""The study of MuJoCo's torsional and rolling friction: its closed forms, and its check."""

import pytest

from cointoss_reproduction.studies.mujoco_resistance.study import REPRODUCTION
from saved import missed, unseen


@pytest.mark.slow
def test_friction_stops_bodies_as_is_claimed_and_one_that_stops_both_motions_at_once_is_seen():
    cells = REPRODUCTION.make(unseen).data
    by_moments = cells[cells["by"] == "explicit moments"]
    assert by_moments["motion"].tolist() == ["rolls", "turns"]
    assert by_moments["error"].abs().max() < 1e-3
    assert missed("mujoco-resistance", cells) == ()
    both = (cells["start"] == "ball does both") & (cells["by"] == "elliptic, solimp 0.9999")
    (wrong,) = missed("mujoco-resistance", cells.assign(error=cells["error"].mask(both, 0.0)))
    assert "share one bound" in wrong
