"""Its table of entries: values of every kind, an error, and musl's functions."""

import math
from enum import IntEnum
from typing import NamedTuple

import numpy as np

from cointoss.models.kernel.arrays import Flags, Row, Table
from cointoss.models.kernel.compiled import compiled
from cointoss.models.kernel.library import Library
from cointoss.models.kernel.manifest import CUDA
from cointoss.models.kernel.vectors import Vector, add

engine = Library(__name__)


class Side(IntEnum):
    LEFT = -1
    RIGHT = 1


class Law(NamedTuple):
    exponent: float | None
    scale: float


class Found(NamedTuple):
    numbers: Row
    side: Side
    is_whole: bool
    place: Vector


@compiled
def power(x, exponent):
    return x if exponent is None else x**exponent


@engine.entry
@compiled
def powers(law: Law, given: Row, rows: Table, times: int) -> Found:
    """Return powers of numbers, and write their multiples into the rows."""
    if times < 0:
        raise ValueError("fewer than none")
    found = np.empty(len(given))
    for i in range(len(given)):
        found[i] = law.scale * power(given[i], law.exponent)
        for k in range(len(rows)):
            rows[k, i] = k * found[i]
    place = add((1.0, 2.0, 3.0), (found[0], 0.0, -0.0))
    return Found(found, Side.RIGHT if times > 0 else Side.LEFT, times == 1, place)


@engine.entry
@compiled
def turned(angles: Row) -> tuple[Row, Flags]:
    """Return sines, and whether they are positive."""
    sines = np.empty(len(angles))
    signs = np.empty(len(angles), np.bool_)
    for i in range(len(angles)):
        sines[i] = math.sin(angles[i])
        signs[i] = sines[i] > 0
    return sines, signs


@compiled
def sums(rows: Table, answers: Table, scale: float) -> None:
    """Write the sum of each row's squares, times a factor, made in so many arrays as it begins with."""
    for i in range(len(rows)):
        if rows[i, 0] < 0:
            raise ValueError("fewer than none")
        total, spaces = 0.0, int(rows[i, 0])
        held = np.zeros(spaces)
        for k in range(spaces):
            room = np.empty(32 + 8 * k)
            for j in range(rows.shape[1]):
                room[j] = rows[i, j]
                total += room[j] * room[j]
        held[:] = total
        answers[i, 0] = scale * held[0] if spaces > 0 else 0.0


sums_on_cards = engine.entry(sums, CUDA)
