"""Section 4: how often a face that the paper's stop tests name is left again, by coin, floor and air."""

from collections.abc import Mapping
from functools import partial
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Ending, EndingTest, Outcome
from cointoss.analytic import AnalyticSettings
from cointoss.study import (
    BLUE,
    VERMILION,
    Array,
    Body,
    Estimate,
    Progress,
    Rules,
    code_digest,
    in_vacuum,
    run,
    share_of,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared, listed
from cointoss_reproduction.frame.parts import Part, kept
from cointoss_reproduction.frame.threads import all_cores
from cointoss_reproduction.setups.general_coins import CoinClass

TESTS = {EndingTest.PAPER: Ending.PAPER, EndingTest.PAPER_SMOOTH: Ending.PAPER_SMOOTH}
"""The paper's stop tests, each with the ending by which it names a face."""
LABELS = {"E < m g r": BLUE, "eq. (20)": VERMILION}
COUNT, FEWER, PART = 40_000, 16_000, 2000
"""Tosses of each class of ideal coins and of imperfect ones, and of a part that is kept."""
SETTINGS = {True: AnalyticSettings(contact_steps=5000), False: AnalyticSettings(contact_steps=500)}
"""In air and in vacuum, where coins that never rest are not followed for ever."""
NAMED, LEFT, EDGE, OPEN, TOSSES = range(5)
"""Of a count: faces that a test names, that are left, left for the edge, or maybe left; and all tosses."""
CLASSES = tuple(
    CoinClass(thick=thick, imperfect=imperfect, air=air, coulomb=coulomb)
    for imperfect, coulomb, air, thick in product((False, True), repeat=4)
)


def make(progress: Progress, parts: Path, ideal: int = COUNT, imperfect: int = FEWER) -> Findings:
    """Toss coins of every class until their face is proved, and look where the tests would have stopped."""
    counted = {kind: imperfect if kind.imperfect else ideal for kind in CLASSES}
    done, whole = 0, sum(counted.values())
    found: dict[str, NDArray[np.int64]] = {}
    for kind, count in counted.items():
        size = min(PART, count)
        counts = np.zeros((len(TESTS), TOSSES), dtype=np.int64)
        states = kind.starts(count)
        for first in range(0, count, size):
            name = f"{code_digest()}-{kind.name.replace(', ', '-')}-{count}-{first}"
            counts += kept(parts, name, partial(_part, kind, states[first : first + size]))["counts"]
            progress(done := done + min(size, count - first), whole)
        found[kind.name] = np.column_stack([counts, np.full(len(TESTS), count)])
    real = [kind for kind in CLASSES if kind.imperfect]
    smooth, rough = (
        [kind for kind in CLASSES if not kind.imperfect and kind.coulomb is flag] for flag in (False, True)
    )
    return Findings(
        data=found,
        smooth=_left_by(found, smooth, 0),
        rough=_left_by(found, rough, 0),
        imperfect=_left_by(found, real, 0),
        vacuum=_left_by(found, [kind for kind in smooth if not kind.air], 1),
        in_air=_left_by(found, [kind for kind in smooth if kind.air], 1),
        real=_left_by(found, real, 1),
    )


def _part(kind: CoinClass, states: Array) -> Part:
    """Count the named faces of some tosses of a class, and those left, (tests, 4)."""
    body, rules = kind.scenario.body, kind.scenario.rules
    with all_cores() as pool:
        tossed = list(pool.map(partial(stops, body, rules), states))
    return {"counts": np.sum(tossed, axis=0)}


def stops(body: Body, rules: Rules, start: Array) -> NDArray[np.int64]:
    """Return for each of `TESTS` the counts of one toss up to `OPEN`, each 0 or 1, (tests, 4).

    The tests look at the coin after each impact and each step of a sustained contact, and stop the toss. It
    is tossed again, until its face is proved to stay. The named face is left where a touch after the stop
    shows the other one, or the toss ends on that or on the edge; it is not known where the toss ends nowhere.
    """
    settings = SETTINGS[not in_vacuum(body)]
    whole = run(body, rules, start, settings)
    counts = np.zeros((len(TESTS), TOSSES), dtype=np.int64)
    for count, (test, named) in zip(counts, TESTS.items(), strict=True):
        stopped = run(body, rules._replace(test=test), start, settings)
        if stopped.ending == named:
            later = whole.rows["face"][whole.rows["time"] > stopped.end_time]
            others = {*later.tolist(), int(whole.outcome)} - {int(stopped.outcome)}
            open_ends = {int(Outcome.PERPETUAL), int(Outcome.TRANSIENT), int(Outcome.UNDECIDED)}
            count[NAMED] = 1
            count[LEFT] = bool(others - open_ends)
            count[EDGE] = Outcome.EDGE in others
            count[OPEN] = bool(others) and not count[LEFT]
    return counts


def _left_by(found: Mapping[str, NDArray[np.int64]], kinds: list[CoinClass], test: int) -> dict[str, Any]:
    """Return how often the coins of some classes leave the face that a test names."""
    counts = {kind.name: found[kind.name][test] for kind in kinds}
    named = {name: count[NAMED] / count[TOSSES] for name, count in counts.items()}
    of_named = {name: count[LEFT] / max(count[NAMED], 1) for name, count in counts.items()}
    return {
        "named": listed(named, ".0%"),
        "of_named": listed(of_named, ".2%"),
        "edges": sum(int(count[EDGE]) for count in counts.values()),
        "left": sum(int(count[LEFT]) for count in counts.values()),
        "unknown": sum(int(count[OPEN]) for count in counts.values()),
        "share": {name: _left(count) for name, count in counts.items()},
        "together": _left(np.sum([*counts.values()], axis=0)),
    }


def _left(count: NDArray[np.int64]) -> Estimate:
    return share_of(int(count[LEFT]), int(count[TOSSES]))


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 5))
    axes = picture.subplots()
    names = list(data)
    for test, (label, color) in enumerate(LABELS.items()):
        at = np.arange(len(names)) + 0.34 * (test - 0.5)
        for y, one in zip(at, (_left(data[name][test]) for name in names), strict=True):
            axes.plot([max(one.low, FLOOR), one.high], [y, y], color=color, linewidth=1)
            if one.value > 0:
                axes.barh(y, one.value - FLOOR, 0.3, left=FLOOR, color=color, alpha=0.5)
        axes.barh([0], [0], color=color, alpha=0.5, label=label)
    axes.set_xscale("log")
    axes.set_xlim(FLOOR, 1)
    axes.set_yticks(range(len(names)), names)
    axes.invert_yaxis()
    axes.set(xlabel="share of the tosses that leave the face named; lines: 99 % intervals", axisbelow=True)
    picture.legend(loc="outside upper right", ncols=2)
    return picture


FLOOR = 1e-5
"""The least share that is drawn."""
REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
