"""How fast a film runs: slowly around the impacts."""

from collections.abc import Sequence

import numpy as np

from models.records import Array, Toss

FAST, SLOW = 1 / 4, 1 / 60
"""Speed of the film far from an impact and at one, relative to the clock."""
SLOW_FOR = 0.02
"""How long before and after an impact the film is slowed down [s]."""
WEAK = 0.1
"""The film is not slowed down for an impulse below this part of its toss's largest."""
LONGEST = 30.0
"""A longer film is sped up to this length, if no other is asked for [s]."""
_AROUND = SLOW_FOR * np.linspace(-1, 1, 41)


def film_times(
    tosses: Sequence[Toss], frames_per_second: int, longest: float = LONGEST
) -> tuple[Array, Array]:
    """Choose the times that a film of some tosses, shown at once, consists of.

    Args:
        tosses: what to show, to the end of the longest.
        frames_per_second: of the film.
        longest: how long it may take [s].

    Returns:
        times: of the frames, increasing from 0 to the end, (n,) [s].
        speeds: of the film at these times, relative to the clock, (n,).
    """
    end = max(toss.end_time for toss in tosses)
    slow = np.sort(np.concatenate([_strong_impacts(toss) for toss in tosses]))
    # Film time is the integral of 1/speed, here on a grid that is fine where the speed changes.
    grid = np.unique(np.clip(np.append(slow[:, None] + _AROUND, np.linspace(0, end, 1001)), 0, end))
    part = np.clip(_distance_to(slow, grid) / SLOW_FOR, 0, 1)
    speed = SLOW + (FAST - SLOW) * part * part * (3 - 2 * part)
    film = np.append(0.0, np.cumsum(np.diff(grid) * (1 / speed[1:] + 1 / speed[:-1]) / 2))
    stretch = max(1.0, film[-1] / longest)
    count = max(2, round(film[-1] / stretch * frames_per_second))
    times = np.interp(np.linspace(0, film[-1], count), film, grid)
    return times, np.interp(times, grid, speed) * stretch


def _strong_impacts(toss: Toss) -> Array:
    size = np.linalg.norm(toss.impacts.impulse, axis=1)
    return toss.impacts.time[size >= WEAK * size.max(initial=0.0)]


def _distance_to(places: Array, x: Array) -> Array:
    """Return the distance from each x to the nearest of the sorted places."""
    fenced = np.concatenate([[-np.inf], places, [np.inf]])
    after = np.searchsorted(fenced, x)
    return np.minimum(x - fenced[after - 1], fenced[after] - x)
