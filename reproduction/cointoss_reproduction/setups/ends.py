"""How many tosses end in each way, as a row of a study's table."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from cointoss import Hand, Outcome, Scenario, shares

OUTCOMES = tuple("edges" if outcome == Outcome.EDGE else str(outcome) for outcome in Outcome)
"""Columns of the numbers of tosses, by code of `Outcome`; an axis may be named "edge"."""


def counted(numbers: Sequence[int] | NDArray[np.integer]) -> dict[str, int]:
    """Return numbers of tosses, by code of `Outcome`, as a row; with those on a face, and all.

    Raises:
        ValueError: for another number of them.
    """
    row = {name: int(number) for name, number in zip(OUTCOMES, numbers, strict=True)}
    return {**row, "faces": row["heads"] + row["tails"], "tosses": sum(row.values())}


def tally(outcomes: NDArray[np.integer]) -> dict[str, int]:
    """Return how often tosses have each outcome, as a row."""
    return counted(np.bincount(outcomes, minlength=len(OUTCOMES)))


def ends_of(
    scenario: Scenario, hand: Hand, count: int, *, engine: str = "analytic", seed: int
) -> dict[str, int]:
    """Toss a coin by a hand, and return how often it has each outcome, as a row.

    Raises:
        KeyboardInterrupt: where one has left the count short.
    """
    found = shares(scenario, hand=hand, engine=engine, tosses=count, seed=seed)
    if not found.attrs["complete"]:
        raise KeyboardInterrupt
    return counted(found["count"].values)
