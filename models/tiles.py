"""Many tosses cut into tiles, made on all cores."""

import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import wait
from typing import Any

import numpy as np
from numba import config

from cointoss.models.interruptible import begun
from cointoss.models.outcomes import Outcomes
from cointoss.models.releases import Releases

PARTS = 4
"""Tiles that each thread has at least, where there are tosses enough: all end at about the same time."""


def toss_in_tiles(
    releases: Releases, most: int, toss_tile: Callable[..., Any], progress: Callable[[int, int], None]
) -> Outcomes:
    """Make tosses, tile by tile, on the cores that this process may use or `NUMBA_NUM_THREADS` sets.

    Args:
        releases: the states at time 0.
        most: tosses that a thread makes at a time, at most; Ctrl-C leaves them to their thread.
        toss_tile: makes some tosses. It is given their states (k, 13), and outcomes, endings, last faces,
            numbers of impacts and end times, (k,) each, to be written. It should not hold Python's lock.
        progress: called after each tile with the number of tosses so far and of all, on any thread.

    Returns:
        How each toss ended, in the order of `releases`.
    """
    n = len(releases)
    states = np.hstack([releases.position, releases.velocity, releases.quaternion, releases.angular_velocity])
    outcome, ending, face = (np.empty(n, dtype=np.int8) for _ in range(3))
    impacts, end_time = np.empty(n, dtype=np.int32), np.empty(n)
    columns = (states, outcome, ending, face, impacts, end_time)

    cores = config.__dict__["NUMBA_NUM_THREADS"]
    tile = min(most, max(1, n // (PARTS * cores)))
    left, done, counting = deque(range(0, n, tile)), 0, threading.Lock()

    def toss_what_is_left() -> None:
        nonlocal done
        while True:
            try:
                first = left.popleft()
            except IndexError:
                return
            try:
                toss_tile(*(column[first : first + tile] for column in columns))
            except BaseException:
                left.clear()
                raise
            with counting:
                done += min(tile, n - first)
                progress(done, n)

    tossing = [begun(toss_what_is_left) for _ in range(min(len(left), cores))]
    try:
        wait(tossing)
    finally:
        left.clear()  # a signal's handler may have raised
    for each in tossing:
        each.result()
    return Outcomes(outcome=outcome, ending=ending, impacts=impacts, last_face=face, end_time=end_time)
