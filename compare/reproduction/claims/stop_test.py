"""Section 4: how often a face that the paper's stop tests name is left again, by coin, floor and air."""

from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from itertools import product
from os import cpu_count
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss.analytic.events import run
from cointoss.analytic.settings import Settings
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import share
from cointoss.compare.reproduction.parts import Part, kept
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.general_coins import CoinClass
from cointoss.models.body import Body, Rules, in_vacuum
from cointoss.models.kernel.sources import source_hash
from cointoss.models.records import Array, Outcome

TESTS = {"E < m g r": BLUE, "eq. (20)": VERMILION}
COUNT, PART = 100_000, 2000
"""Tosses of each class, and of a part that is kept."""
SETTINGS = {True: Settings(contact_steps=5000), False: Settings(contact_steps=500)}
"""In air and in vacuum, where coins that never rest are not followed for ever."""
NAMED, LEFT, OPEN, TOSSES = range(4)
"""Of a count: tosses whose face a test names, which leave it, of which that is not known; and all tosses."""
NEVER = 1e-4
"""A share of the tosses that is nearly none: `COUNT` tosses without one have an interval below it."""
CLASSES = tuple(
    CoinClass(thick=thick, imperfect=imperfect, air=air, coulomb=coulomb)
    for imperfect, coulomb, air, thick in product((False, True), repeat=4)
)


def make(progress: Progress, parts: Path, count: int = COUNT) -> Result:
    """Toss coins of every class until their face is proved, and look where the tests would have stopped."""
    size = min(PART, count)
    whole = len(CLASSES) * count
    done, found = 0, {}
    for kind in CLASSES:
        counts = np.zeros((len(TESTS), 3), dtype=np.int64)
        states = kind.starts(count)
        for first in range(0, count, size):
            name = f"{source_hash('cointoss.analytic.events')}-{kind.name.replace(', ', '-')}-{count}-{first}"
            counts += kept(parts, name, partial(_part, kind, states[first : first + size]))["counts"]
            progress(done := done + min(size, count - first), whole)
        found[kind.name] = np.column_stack([counts, np.full(len(TESTS), count)])
    return Result(claims=_claims(found), data=found)


def _part(kind: CoinClass, states: Array) -> Part:
    """Count the named faces of some tosses of a class, and those left, (tests, 3)."""
    body, rules = kind.scenario.body, kind.scenario.rules
    pool = ThreadPoolExecutor(cpu_count())
    try:
        tossed = list(pool.map(partial(stops, body, rules), states))
    finally:
        # An interruption does not wait for the tosses not yet begun.
        pool.shutdown(cancel_futures=True)
    return {"counts": np.sum(tossed, axis=0)}


def stops(body: Body, rules: Rules, start: Array) -> NDArray[np.int64]:
    """Return for each of `TESTS` whether it names a face, which is left, or that is not known, (tests, 3).

    The tests look at the coin after each impact. A face is left where a later touch shows the other one, or
    the toss ends on that or on the edge; it is not known where the toss ends nowhere.
    """
    tossed = run(body, rules, start, SETTINGS[not in_vacuum(body)])
    rows, mgr = tossed.rows, body.mass * body.gravity * body.radius
    v, w = rows["velocity_after"], rows["angular_velocity_after"]
    of_spin = body.mass * (v[:, 0] ** 2 + v[:, 1] ** 2) / 2 + body.inertia[2][2] * w[:, 2] ** 2 / 2
    counts = np.zeros((len(TESTS), 3), dtype=np.int64)
    for count, energy in zip(counts, (rows["energy"], rows["energy"] - of_spin), strict=True):
        below = np.flatnonzero(energy < mgr)
        if len(below):
            face = rows["face"][below[0]]
            others = {*rows["face"][below[0] + 1 :].tolist(), int(tossed.outcome)} - {int(face)}
            open_ends = {int(Outcome.PERPETUAL), int(Outcome.UNDECIDED)}
            count[NAMED] = 1
            count[LEFT] = bool(others - open_ends)
            count[OPEN] = bool(others) and not count[LEFT]
    return counts


def _claims(found: Mapping[str, NDArray[np.int64]]) -> tuple[Claim, ...]:
    ideal = [kind for kind in CLASSES if not kind.imperfect]
    smooth = [kind for kind in ideal if not kind.coulomb]
    rough = [kind for kind in ideal if kind.coulomb]
    imperfect = [kind for kind in CLASSES if kind.imperfect]
    return (
        _claim("E < m g r disables a change of the face: ideal coins, smooth floor", found, smooth, 0),
        _claim("E < m g r disables a change of the face: ideal coins, rough floor", found, rough, 0),
        _claim(
            "E < m g r disables a change of the face: imperfect coins", found, imperfect, 0, expected=False
        ),
        _claim(
            "so does eq. (20), for a symmetric coin on a smooth floor: in vacuum",
            found,
            [kind for kind in smooth if not kind.air],
            1,
        ),
        _claim(
            "so does eq. (20), for a symmetric coin on a smooth floor: in air",
            found,
            [kind for kind in smooth if kind.air],
            1,
        ),
        _claim("eq. (20) ends tosses of real coins (section 5.3)", found, imperfect, 1, expected=False),
    )


def _claim(
    claim: str,
    found: Mapping[str, NDArray[np.int64]],
    kinds: list[CoinClass],
    test: int,
    *,
    expected: bool | None = True,
) -> Claim:
    """Return the claim that the coins of some classes never leave the face that a test names."""
    counts = {kind.name: found[kind.name][test] for kind in kinds}
    open_ends = sum(int(count[OPEN]) for count in counts.values())
    named = ", ".join(f"{count[NAMED] / count[TOSSES]:.0%} ({name})" for name, count in counts.items())
    return Claim(
        claim=claim,
        analytic=f"names a face in {named}; whether it is left is not known of {open_ends:,d} tosses",
        criteria=[
            Criterion(f"share that leaves it ({name})", _left(count), "<", NEVER, "nearly none")
            for name, count in counts.items()
        ],
        expected=expected,
    )


def _left(count: NDArray[np.int64]) -> Estimate:
    return share(np.arange(count[TOSSES]) < count[LEFT])


def _draw(data: Mapping[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(9, 5))
    axes = picture.subplots()
    names = list(data)
    for test, (label, color) in enumerate(TESTS.items()):
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
REPRODUCTION = Reproduction(
    paper="Section 4, the stop test",
    title="how often the face that E < m g r or eq. (20) names is left again",
    assumed=(
        "The paper's coin of 2 mm and a thin one, ideal and with c = (-1, -1, -0.2) mm; χ = 0.6; smooth, or "
        "rough with Coulomb's friction, μ = 0.2 and kinematic restitution; vacuum, or the paper's air; "
        "released from 0.2 to 0.6 m in any attitude, with 20 to 60 rad/s about one diameter and about "
        "10 rad/s about the other axes. The tests look at the coin after each impact, as in section 4, and "
        "the toss goes on until its face is proved to stay. An interrupted run goes on where it was."
    ),
    seconds=3600,
    make=make,
    resumes=True,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=40),
)
