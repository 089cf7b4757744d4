"""How many tosses end how."""

from collections import Counter
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from cointoss import Ending, Hand, Outcome, Scenario, shares
from cointoss.study import Answers, Estimate, Plan, chance_alike, counting, share_of

SEVERAL = {"edge": "edges"}
"""Columns whose names would be those of axes."""
Ends = dict[str, int]
"""Numbers of tosses by outcome, as in "edge", or by outcome and ending, as in "edge, paper"."""


def counted(ended: Answers, which: NDArray[np.bool_] | slice = slice(None)) -> Ends:
    """Return how many tosses, or how many of some of them, ended how."""
    codes = zip(ended.outcome[which], ended.ending[which], strict=True)
    return dict(sorted(Counter(f"{Outcome(outcome)}, {Ending(ending)}" for outcome, ending in codes).items()))


def by_outcome(plan: Plan) -> Ends:
    """Toss a plan of one setting and one engine as `cointoss shares` does, and count the outcomes."""
    *_, counts = counting(plan)
    return {str(outcome): int(counts[0][outcome]) for outcome in Outcome if counts[0][outcome]}


def ends_of(
    scenario: Scenario, hand: Hand, count: int, *, engine: str = "analytic", seed: int
) -> dict[str, int]:
    """Toss a coin by a hand, and return how often it ends how: a row of a study's table.

    Raises:
        KeyboardInterrupt: where one has left the count short.
    """
    found = shares(scenario, hand=hand, engine=engine, tosses=count, seed=seed)
    if not found.attrs["complete"]:
        raise KeyboardInterrupt
    counts = {str(name): int(number) for name, number in found["count"].to_series().items()}
    return {
        **{SEVERAL.get(name, name): number for name, number in counts.items()},
        "faces": counts["heads"] + counts["tails"],
        "tosses": sum(counts.values()),
    }


def together(several: Iterable[Ends]) -> Ends:
    """Return how several groups of tosses end as one."""
    return dict(sorted(sum(map(Counter, several), Counter[str]()).items()))


def tosses(ends: Ends) -> int:
    """Return how many tosses there are."""
    return sum(ends.values())


def ended_as(ends: Ends, outcome: Outcome) -> int:
    """Return how many tosses have an outcome."""
    return sum(number for name, number in ends.items() if name.partition(", ")[0] == outcome)


def on_edge(ends: Ends) -> Estimate:
    """Return the share of tosses that end on edge."""
    return share_of(ended_as(ends, Outcome.EDGE), tosses(ends))


def alike(by_engine: Iterable[Ends]) -> float:
    """Return the probability by chance of outcomes that differ so much between the engines, by a χ² test."""
    return chance_alike([[ended_as(ends, outcome) for outcome in Outcome] for ends in by_engine])
