"""Many tosses cut into tiles, made on all cores."""

import threading
import warnings
from collections import deque
from collections.abc import Callable, Collection
from concurrent.futures import wait
from dataclasses import fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cointoss.models.cores import cores_used
from cointoss.models.interruptible import begun
from cointoss.models.kernel.arrays import Codes, Counts, Flags, Row, Table
from cointoss.models.outcomes import Outcomes
from cointoss.models.releases import Releases, states_of

PARTS = 4
"""Tiles that each thread has at least, where there are tosses enough: all end at about the same time."""


class Tile(NamedTuple):
    """Some tosses, a row each: where they start, and room for how they end."""

    states: Table
    """At time 0, (k, 13)."""
    outcome: Codes
    ending: Codes
    last_face: Codes
    impacts: Counts
    end_time: Row
    trusted_impacts: Counts
    outcome_certain: Flags


def toss_in_tiles(
    releases: Releases,
    most: int,
    toss_tile: Callable[[Tile], None],
    progress: Callable[[int, int], None],
    *,
    also: Collection[str] = (),
    partial: bool = False,
) -> Outcomes:
    """Make tosses, tile by tile, on the cores of `cores_used`.

    Args:
        releases: the states at time 0.
        most: tosses that a thread makes at a time, at most; Ctrl-C leaves them to their thread.
        toss_tile: makes some tosses, and writes how they end. It should not hold Python's lock.
        progress: called after each tile with the number of tosses so far and of all, on any thread.
        also: the optional columns of `Outcomes` that it writes.
        partial: whether Ctrl-C returns what is done, with a warning, instead of raising KeyboardInterrupt.

    Returns:
        How each toss ended, in the order of `releases`.
    """
    n = len(releases)
    found: dict[str, NDArray[Any]] = {
        item.name: np.zeros(n, item.metadata["kind"]) for item in fields(Outcomes)
    }
    columns = Tile(states_of(releases), **found)

    cores = cores_used()
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
                toss_tile(Tile._make(column[first : first + tile] for column in columns))
            except BaseException:
                left.clear()
                raise
            with counting:
                done += min(tile, n - first)
                progress(done, n)

    tossing = [begun(toss_what_is_left) for _ in range(min(len(left), cores))]
    try:
        wait(tossing)
    except KeyboardInterrupt:
        if not partial:
            raise
        left.clear()
        wait(tossing)  # for the tiles under way, unless Ctrl-C comes again
        warnings.warn(
            f"interrupted: {done:,} of {n:,} tosses were made; the others have the ending none", stacklevel=3
        )
    finally:
        left.clear()  # a signal's handler may have raised
    for each in tossing:
        each.result()
    for item in fields(Outcomes):
        if item.default is None and item.name not in also:
            del found[item.name]
    return Outcomes(**found)
