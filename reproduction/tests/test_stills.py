"""Stills of a toss, and what is said where none can be drawn."""

import numpy as np
import pytest

from cointoss.compare.film.back_end import ADVICE
from cointoss.models.records import States
from cointoss_reproduction.studies.fig5.stills import stills
from tests.helpers.draws import scenario


def faces(*quaternions):
    n = len(quaternions)
    zeros, e = np.zeros((n, 3)), np.array(quaternions, dtype=float)
    position = np.tile([0, 0, 0.03], (n, 1))
    return States(time=np.zeros(n), position=position, velocity=zeros, quaternion=e, angular_velocity=zeros)


HEADS, TAILS = [1, 0, 0, 0], [0, 1, 0, 0]


def test_each_face_has_its_colour():
    drawn = stills(scenario(), faces(HEADS, TAILS))
    assert not isinstance(drawn, str)
    # Golden and blue pixels, of the floor's grey none.
    red, _, blue = np.moveaxis(drawn.astype(float), 3, 0)
    golden, bluish = (np.sum(difference > 80, axis=(1, 2)) for difference in (red - blue, blue - red))
    assert golden[0] > 100
    assert bluish[0] == 0
    assert golden[1] == 0
    assert bluish[1] > 100


@pytest.mark.usefixtures("fresh_back_end")
def test_a_back_end_that_ends_the_process_is_told_too(monkeypatch):
    monkeypatch.setenv("MUJOCO_GL", "egl")
    dying = "import os, signal; os.kill(os.getpid(), signal.SIGKILL)"
    monkeypatch.setattr("cointoss.compare.film.back_end.DRAW_ONE_FRAME", dying)
    told = stills(scenario(), faces(HEADS))
    assert told == f"{ADVICE} (ended by signal 9)"
