"""Section 4: how often a face that the paper's stop tests name is left again, by coin, floor and air."""

from collections.abc import Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cointoss import Ending, EndingTest, Outcome
from cointoss.analytic import AnalyticSettings
from cointoss.study import Array, Body, Rules, in_vacuum, run
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.frame.threads import all_cores
from cointoss_reproduction.setups.general_coins import CoinClass

TESTS = {
    "E < m g r": (EndingTest.PAPER, Ending.PAPER),
    "eq. (20)": (EndingTest.PAPER_SMOOTH, Ending.PAPER_SMOOTH),
}
"""The paper's stop tests, each with the ending by which it names a face."""
SETTINGS = {True: AnalyticSettings(contact_steps=5000), False: AnalyticSettings(contact_steps=500)}
"""In air and in vacuum, where coins that never rest are not followed for ever."""
COUNTED = ("named", "left", "edges", "unknown")
"""Faces that a test names, that are left, left for the edge, or maybe left."""
AXES = {
    "balance": {"ideal": False, "imperfect": True},
    "floor": {"smooth": False, "coulomb": True},
    "medium": {"vacuum": False, "air": True},
    "thickness": {"thin": False, "thick": True},
}


def stopped(
    balance: bool, floor: bool, medium: bool, thickness: bool, ideals: int = 40_000, others: int = 16_000
) -> Iterator[dict[str, Any]]:
    """Toss `ideals` ideal coins or `others` until their face is proved; look where the tests had stopped."""
    kind = CoinClass(thick=thickness, imperfect=balance, air=medium, coulomb=floor)
    count = others if balance else ideals
    with all_cores() as pool:
        tossed = list(pool.map(partial(stops, kind.scenario.body, kind.scenario.rules), kind.starts(count)))
    for test, counts in zip(TESTS, np.sum(tossed, axis=0), strict=True):
        yield {"test": test, **dict(zip(COUNTED, counts, strict=True)), "tosses": count}


def stops(body: Body, rules: Rules, start: Array) -> NDArray[np.int64]:
    """Return for each of `TESTS` what is `COUNTED` of one toss, each 0 or 1, (tests, 4).

    The tests look at the coin after each impact and each step of a sustained contact, and stop the toss. It
    is tossed again, until its face is proved to stay. The named face is left where a touch after the stop
    shows the other one, or the toss ends on that or on the edge; it is not known where the toss ends nowhere.
    """
    settings = SETTINGS[not in_vacuum(body)]
    whole = run(body, rules, start, settings)
    counts = np.zeros((len(TESTS), len(COUNTED)), dtype=np.int64)
    for count, (test, named) in zip(counts, TESTS.values(), strict=True):
        stopped = run(body, rules._replace(test=test), start, settings)
        if stopped.ending == named:
            later = whole.rows["face"][whole.rows["time"] > stopped.end_time]
            others = {*later.tolist(), int(whole.outcome)} - {int(stopped.outcome)}
            left = bool(others - {int(Outcome.PERPETUAL), int(Outcome.TRANSIENT), int(Outcome.UNDECIDED)})
            count[:] = True, left, Outcome.EDGE in others, bool(others) and not left
    return counts


REPRODUCTION = study(__name__, Cells(stopped, AXES))
