"""Frames of two tosses side by side, one at a time, and the file they are written to."""

from unittest.mock import patch

import numpy as np
import pytest

from cointoss import analytic
from cointoss.compare.film.drawing import (
    MARGIN,
    Camera,
    Drawer,
)
from cointoss.compare.film.encodings import Format
from cointoss.compare.film.slow_motion import film_times
from cointoss.compare.film.video import HELD, _told, frames, poster_number
from tests.helpers.draws import ZLOTY
from tests.helpers.films import (
    MadePath,
    center,
    golden,
    made,
    shown,
)

TINY = Format(64, 48, 4)


R = ZLOTY["radius"]


def test_two_tosses_stand_side_by_side_and_differ_where_their_paths_do():
    path = MadePath(position=(0, 0, 0.1))
    parting = MadePath(position=(0, 0, 0.1), velocity=(0.1, 0, 0), start=0.5)
    tosses = [shown(made(path)), shown(made(parting))]
    film = list(frames(tosses, Camera.TOP, Format(256, 128, 2)))
    times, _ = film_times(tosses, 2)
    scale = 128 / (MARGIN * (0.05 + 4 * R))
    for i, part in ((0, 0.0), (len(times) - 1, 0.1 * 0.5)):
        below = film[i][60:].astype(int)  # the captions
        left, right = center(golden(below[:, :126])), center(golden(below[:, 130:]))
        assert right - left == pytest.approx([0, part * scale - 2], abs=0.7)


def test_the_frame_that_stands_for_films_shows_a_face_before_the_first_impact_of_all():
    toss, later = analytic.toss("fig24a"), made(MadePath(position=(0, 0, 0.1)), impacts=[(0.9, 1e-3)])
    form, first = Format(64, 48, 24), toss.impacts.time[0]
    shown_ = [shown(toss), shown(later)]
    times, _ = film_times(shown_, form.frames_per_second, form.longest)
    time = times[poster_number(shown_, times) - 1]
    assert first / 2 <= time <= first
    assert abs(toss.sample(np.array([time])).normal[0, 2]) > 0.9


@pytest.mark.parametrize(
    ("speed", "told"),
    [
        (1 / 60, "1/60 of real speed"),
        (0.25, "1/4 of real speed"),
        (0.96, "real speed"),
        (1.04, "real speed"),
        (2.5, "2.5 times real speed"),
    ],
)
def test_the_speed_is_told_as_a_part_of_the_real_one(speed, told):
    assert _told(speed) == told


def test_frames_are_drawn_one_at_a_time_and_the_last_one_stays():
    toss = made(MadePath(position=(0, 0, 0.1), velocity=(0, 0, 0.2)), end=0.5)
    with patch.object(Drawer, "draw", autospec=True, side_effect=Drawer.draw) as draw:
        film = frames([shown(toss)], Camera.OVERVIEW, TINY)
        next(film)
        assert [call.args[1] for call in draw.call_args_list] == [0]
        rest = list(film)
    held = round(HELD * TINY.frames_per_second)
    assert draw.call_count + held == 1 + len(rest)
    assert all(np.array_equal(frame, rest[-1]) for frame in rest[-held - 1 :])
    assert not np.array_equal(rest[-held - 2], rest[-1])


def test_the_time_is_written_into_the_frame():
    """A still coin's frames differ in the line below alone."""
    form = Format(320, 240, 8)
    toss = made(MadePath(position=(0, 0, 0.1)))
    film = frames([shown(toss)], Camera.CLOSE_UP, form)
    first, second = next(film), next(film)
    rows = np.flatnonzero((first != second).any(axis=(1, 2)))
    assert len(rows) > 3
    assert min(rows) > 0.9 * 240


def test_of_more_than_two_tosses_each_has_half_a_picture():
    tosses = [
        shown(made(MadePath(position=(0, 0, 0.1)), engine=name)) for name in ("analytic", "mujoco", "off")
    ]
    frame = next(frames(tosses, Camera.TOP, TINY))
    assert frame.shape == (TINY.height, 3 * TINY.width // 2, 3)
    for panel in np.array_split(frame[20:].astype(int), 3, axis=1):
        assert golden(panel).any()
