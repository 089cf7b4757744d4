"""How fast a film runs: slowly around the impacts, and on when no coin can turn over."""

from collections.abc import Sequence

import numpy as np
from scipy.spatial import KDTree

from cointoss.compare.film.encodings import LONGEST
from cointoss.compare.film.filmed import Filmed
from cointoss.models.barriers import barrier
from cointoss.models.certificate import energies
from cointoss.models.records import Array, Ending

FAST, SLOW, SETTLED = 1 / 4, 1 / 60, 1.0
"""Speed of the film far from an impact, at one, and when no face can change, relative to the clock."""
SPEEDS_UP_FOR = 0.1
"""How long after the last coin can turn over the film speeds up [s]."""
SLOW_FOR = 0.02
"""How long before and after an impact the film is slowed down [s]."""
WEAK = 0.1
"""The film is not slowed down for an impulse below this part of its toss's largest."""
_AROUND = SLOW_FOR * np.linspace(-1, 1, 41)


def film_times(
    shown: Sequence[Filmed], frames_per_second: int, longest: float = LONGEST
) -> tuple[Array, Array]:
    """Choose the times that a film of some tosses, shown at once, consists of.

    Args:
        shown: the tosses, to the end of the longest motion.
        frames_per_second: of the film.
        longest: how long it may take [s].

    Returns:
        times: of the frames, increasing from 0 to the end, (n,) [s].
        speeds: of the film at these times, relative to the clock, (n,).
    """
    end = max(each.motion.end_time for each in shown)
    settled = max(_settled(each) for each in shown)
    slow = np.concatenate([_slow_times(each) for each in shown])
    # Film time is the integral of 1/speed, here on a grid that is fine where the speed changes.
    changes = np.append(slow[:, None] + _AROUND, settled + SPEEDS_UP_FOR * np.linspace(0, 1, 41))
    grid = np.unique(np.clip(np.append(changes, np.linspace(0, end, 1001)), 0, end))
    to_nearest, _ = KDTree(slow[:, None]).query(grid[:, None], p=1)
    speed = SLOW + (FAST - SLOW) * _smooth(to_nearest / SLOW_FOR)
    speed += (SETTLED - speed) * _smooth((grid - settled) / SPEEDS_UP_FOR)
    film = np.append(0.0, np.cumsum(np.diff(grid) * (1 / speed[1:] + 1 / speed[:-1]) / 2))
    stretch = max(1.0, film[-1] / longest)
    count = max(2, round(film[-1] / stretch * frames_per_second))
    times = np.interp(np.linspace(0, film[-1], count), film, grid)
    return times, np.interp(times, grid, speed) * stretch


def _smooth(part: Array) -> Array:
    """Return a step from 0 to 1 that begins and ends level."""
    part = np.clip(part, 0, 1)
    return part * part * (3 - 2 * part)


def _settled(filmed: Filmed) -> float:
    """Return from when on a coin has too little energy to turn over, at the latest its toss's end [s]."""
    toss, body = filmed.toss, filmed.toss.scenario.body
    if toss.ending == Ending.CAUGHT:
        return toss.end_time
    times = np.linspace(0, toss.end_time, 1001)
    turns = energies(body, toss.sample(times)) > min(barrier(body, side) for side in (1.0, -1.0))
    return float(times[np.flatnonzero(turns).max(initial=-1) + 1 :].min(initial=toss.end_time))


def _slow_times(filmed: Filmed) -> Array:
    """Return the times of what slows the film of a toss down: strong impacts, and a catch, (n,) [s]."""
    toss, impacts = filmed.toss, filmed.toss.impacts
    size = np.linalg.norm(impacts.impulse, axis=1)
    strong = impacts.time[size >= WEAK * size.max(initial=0.0)]
    return np.append(strong, toss.end_time) if toss.ending == Ending.CAUGHT else strong
