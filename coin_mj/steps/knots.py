"""Knots of the path of MuJoCo's coin: the states before its steps."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from cointoss.coin_mj.model.addresses import numbers_at
from cointoss.coin_mj.model.mujoco_coin import MujocoCoin
from cointoss.coin_mj.model.state import motion_of
from cointoss.models.kernel.arrays import Array, copy_into, doubled
from cointoss.models.kernel.compiled import compiled

KNOT = 15
"""Numbers of a knot: time [s], the `StepKind` that starts there, qpos and qvel."""
_FIRST_ROOM = 256


class StepKind(IntEnum):
    """What kind of step starts at a knot."""

    FLIGHT = 0
    IMPACT = 1
    CONTACT = 2
    """A step of a sustained contact."""
    LANDING = 3
    """The plastic impact of the other rim in a sustained contact; the next knot has the state after it."""


class RecordedPath(NamedTuple):
    """The path so far."""

    table: Array
    """Knots, with room for more, (m, 15); (0, 15) where the path is not kept."""
    size: int
    """The number of the knots."""


@compiled
def nothing_recorded(keep: bool) -> RecordedPath:
    """Return a path without knots, which is kept or not."""
    return RecordedPath(np.empty((_FIRST_ROOM if keep else 0, KNOT)), 0)


@compiled
def add_knot(coin: MujocoCoin, time: float, step: StepKind, path: RecordedPath) -> RecordedPath:
    """Return the path with the present state, and set MuJoCo's time.

    Args:
        coin: MuJoCo's.
        time: now [s].
        step: the `StepKind` that starts there.
        path: so far.
    """
    numbers_at(coin.address.time, (1,))[0] = time
    table, n = path
    if len(table) == 0:
        return path
    if n == len(table):
        table = doubled(table)
    table[n, 0], table[n, 1] = time, step.value
    copy_into(table[n, 2:], motion_of(coin))
    return RecordedPath(table, n + 1)
