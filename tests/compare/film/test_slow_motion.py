"""When a film is slow, and how long it is."""

import numpy as np
import pytest

from cointoss.compare.film.play import WEAKEST, play_of
from cointoss.compare.film.slow_motion import FAST, LONGEST, SLOW, SLOW_FOR, WEAK, film_times
from tests.helpers.films import MadePath, made, shown


def test_the_film_runs_from_release_to_the_last_end_and_slows_down_at_impacts():
    path = MadePath(position=(0, 0, 0.1))
    tosses = [made(path, impacts=[(0.3, 1e-3)]), made(path, impacts=[(0.7, 1e-3)], end=1.5)]
    times, speeds = film_times([shown(toss) for toss in tosses], 60)
    assert (times[0], times[-1]) == (0, 1.5)
    assert np.all(np.diff(times) > 0)
    for impact in (0.3, 0.7):
        assert speeds[np.abs(times - impact).argmin()] == pytest.approx(SLOW, rel=0.05)
    far = np.abs(times[:, None] - [0.3, 0.7]).min(axis=1) > SLOW_FOR
    assert speeds[far] == pytest.approx(FAST, rel=1e-12)
    # One frame further the clock goes by the film's speed over the frames' rate.
    mean = (speeds[1:] + speeds[:-1]) / 2
    assert np.diff(times) * 60 / mean == pytest.approx(1, abs=0.1)


def test_the_film_is_not_slowed_down_for_weak_impacts_which_show_no_arrow():
    path = MadePath(position=(0, 0, 0.1))
    toss = made(path, impacts=[(0.3, 1e-3), (0.6, 0.99 * WEAK * 1e-3), (0.8, 0.99 * WEAKEST * 1e-3)])
    times, speeds = film_times([shown(toss)], 60)
    assert min(speeds[times > 0.5]) == pytest.approx(FAST, rel=1e-12)
    assert [len(play_of(shown(toss), np.array([t])).impulses(0)) for t in (0.301, 0.601, 0.801)] == [1, 1, 0]


@pytest.mark.parametrize("impacts", [0, 2000])
def test_the_longest_toss_has_no_more_frames_than_fit(impacts):
    path = MadePath(position=(0, 0, 0.1))
    end = 5000.0
    toss = made(path, impacts=[(t, 1e-3) for t in np.linspace(1, end, impacts)], end=end)
    times, speeds = film_times([shown(toss)], 60)
    assert (len(times), times[0], times[-1]) == (LONGEST * 60, 0, end)
    assert np.mean(speeds) == pytest.approx(end / LONGEST, rel=0.1)
    assert len(film_times([shown(toss)], 60, longest=5.0)[0]) == 300
