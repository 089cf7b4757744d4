"""The likely causes of what a card misses, each named only where what was found has its pattern."""

import tomllib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import resources
from typing import NamedTuple

import numpy as np

from cointoss.study import Array
from cointoss_yardstick.suite.case import HEIGHT, kind_of
from cointoss_yardstick.suite.running import Result

LEFT, OF_HEIGHT = 0.1, 0.2
"""The parts of what is missed, and of a height that one step makes uncertain, that a cause may leave."""


@dataclass(frozen=True, kw_only=True)
class Cause:
    """A fault, and the values of an engine that is right but for it; the fields are those of causes.toml."""

    words: str
    """What the fault is; {} is its size, {1} its amount, {2} late or early."""
    pattern: dict[str, list[list[float]]]
    """The values of cases, and how they grow with the size, (1 + k, n) each."""


class Value(NamedTuple):
    """A value over its scale, whether it is missed, and the error that a cause may leave."""

    found: Array
    scale: float
    is_missed: bool
    most_left: float


_FILE = resources.files("cointoss_yardstick.suite") / "causes.toml"
CAUSES = tuple(Cause(**table) for table in tomllib.loads(_FILE.read_text(encoding="utf-8"))["cause"])


def hints(results: Sequence[Result]) -> list[str]:
    """Return the likely causes of what an engine misses; none where the pattern is that of no cause.

    Args:
        results: of an engine; a cause is named only where all cases of its pattern were run.
    """
    values = {name: value for each in results if each.own.found for name, value in _values(each)}
    return [
        told
        for cause in CAUSES
        if values.keys() >= cause.pattern.keys()
        for told in _fitting(cause, [values[name] for name in cause.pattern])
    ]


def _values(result: Result) -> Iterator[tuple[str, Value]]:
    """Yield the value of a case, its limit, and its height with the finest step, by their names."""
    case, own, radius = result.case, result.own, result.case.scenario.coin.radius
    coarse, fine = [own, own, *(run for run in result.runs if run.found)][-2:]
    right, unit = np.array(case.right), case.scale or 1.0
    limit = (
        2 * np.array(fine.found) - coarse.found if case.scale else right
    )  # each step is half the one before
    off = float(np.linalg.norm(limit - right))
    height, allowed = abs(fine.height) / radius, HEIGHT[kind_of(own.dt)]
    for name, found, scale, error, most, part in (
        (case.name, own.found, unit, own.error, result.tolerance, LEFT),
        (f"limit of {case.name}", limit, unit, off / unit, case.tolerance["event_driven"], LEFT),
        (f"height of {case.name}", [fine.lowest], radius, height, allowed, OF_HEIGHT),
    ):
        size = min(error, float(np.linalg.norm(found)) / scale)
        left = part * size if error > most else most
        yield name, Value(np.array(found) / scale, scale, error > most, left)


def _fitting(cause: Cause, values: Sequence[Value]) -> Iterator[str]:
    """Yield the words of a cause that explains the miss of each value, with the size that explains most."""
    rows = [np.array(row) / value.scale for row, value in zip(cause.pattern.values(), values, strict=True)]
    right, *slopes = np.hstack(rows)
    growth = np.reshape(slopes, (-1, len(right)))
    off = np.hstack([value.found for value in values]) - right
    size = np.linalg.lstsq(growth.T, off, rcond=None)[0]
    left = np.split(off - size @ growth, np.cumsum([len(value.found) for value in values]))
    explained = all(np.linalg.norm(part) <= each.most_left for part, each in zip(left, values, strict=False))
    if explained and any(value.is_missed for value in values):
        told = size[0] if len(size) == 1 else np.linalg.norm(size)
        yield cause.words.format(told, abs(told), "late" if told > 0 else "early")
