"""Section 4: how often a face that the paper's stop tests name is left again, by coin, floor and air."""

from collections.abc import Iterator
from functools import partial
from multiprocessing.pool import ThreadPool
from typing import Any

import numpy as np

from cointoss import Ending, Outcome
from cointoss.analytic import AnalyticSettings, toss_rows
from cointoss.study import (
    AT_REST,
    Array,
    Body,
    FloorFriction,
    Mode,
    Pieces,
    Rules,
    energy,
    rows_from_states,
    run,
)
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.general_coins import CoinClass

TESTS = {"paper": ("E < m g r", Ending.PAPER), "paper_smooth": ("eq. (20)", Ending.PAPER_SMOOTH)}
"""The paper's stop tests, each with its name and the ending by which it names a face."""
SETTINGS = AnalyticSettings(contact_steps=20_000)
"""Settings for tosses that never rest, and so are not followed for ever."""
STEP = 1e-3
"""The time between two samples of a thin coin in contact [s]: in half of it the coin turns less than a
thousandth of a radian beyond its edge, and back."""
LONGEST = 3.0
"""How long a toss that ends nowhere is followed after the stop [s]."""
SIGNS = {int(Outcome.HEADS): 1, int(Outcome.TAILS): -1}
"""The sign of n_z where a face is up."""
ENDS = (*SIGNS, Outcome.EDGE)
"""How a toss ends that is decided."""
AXES = {
    "balance": {"ideal": False, "imperfect": True},
    "floor": {"smooth": False, "coulomb": True},
    "medium": {"vacuum": False, "air": True},
    "thickness": {"thin": False, "thick": True},
}


def stopped(
    balance: bool, floor: bool, medium: bool, thickness: bool, ideals: int = 40_000, others: int = 8_000
) -> Iterator[dict[str, Any]]:
    """Toss `ideals` ideal coins or `others` until their face is decided; compare with the tests' stops.

    The tests look at the coin after each impact and each step of a sustained contact, and stop the toss. A
    toss leaves the named face if after the stop the other face is up at a touch or in contact, or if the toss
    ends on the other face or on the edge; a toss that ends nowhere may leave it.
    """
    kind = CoinClass(thick=thickness, imperfect=balance, air=medium, coulomb=floor)
    starts = kind.starts(others if balance else ideals)
    turned = partial(turns_over, kind.scenario.body, kind.scenario.rules)
    whole, *tests = (
        toss_rows(rows_from_states(kind.scenario.replace("ending.test", test), starts), settings=SETTINGS)
        for test in ("rigorous", *TESTS)
    )
    for (name, ending), stop in zip(TESTS.values(), tests, strict=True):
        at = np.flatnonzero(stop.ending == ending)
        faces, times, outcomes = stop.outcome[at], stop.end_time[at], whole.outcome[at]
        decided = np.isin(outcomes, ENDS)
        left = decided & (outcomes != faces)
        until = np.where(decided, whole.end_time[at], times + LONGEST)
        seen = ~left & (until > times)
        with ThreadPool() as pool:
            asked = zip(starts[at[seen]], faces[seen], times[seen], until[seen], strict=True)
            left[seen] = pool.starmap(turned, asked, chunksize=1)
        counts = {"left": left, "maybe": left | ~decided, "edges": outcomes == Outcome.EDGE}
        yield {
            "test": name,
            "tosses": len(starts),
            "named": len(at),
            **{what: int(np.sum(those)) for what, those in counts.items()},
        }


def unasked(floor: bool, others: int = 8_000) -> dict[str, int]:
    """Return how many thick imperfect coins in air end on the edge, and come below m g r there.

    E < m g r has not named their face, and is not asked while a coin stands on both rims. They are followed
    until they are at rest.
    """
    kind = CoinClass(thick=True, imperfect=True, air=True, coulomb=floor)
    starts, body, rules = kind.starts(others), kind.scenario.body, kind.scenario.rules
    stopped, whole = (
        toss_rows(rows_from_states(kind.scenario.replace("ending.test", test), starts), settings=SETTINGS)
        for test in ("paper", "rigorous")
    )
    standing = starts[(whole.outcome == Outcome.EDGE) & (stopped.ending != Ending.PAPER)]
    paths = (run(body, rules, start, SETTINGS, AT_REST).path for start in standing)
    ends = [path.states[-1] for path in paths if path.modes[-2] == Mode.UPRIGHT]
    below = sum(
        energy(body, y[2], tuple(y[3:6]), tuple(y[10:])) < body.mass * body.gravity * body.radius
        for y in ends
    )
    return {"of": others, "standing": len(standing), "below": below}


def turns_over(body: Body, rules: Rules, start: Array, named: int, time: float, until: float) -> bool:
    """Return whether a toss shows another face than the named one on the floor between two times [s].

    A contact of a thick coin ends where it comes upon its edge, so that its face is that of its start.
    """
    toss = run(body, rules._replace(max_time=float(until)), start, SETTINGS)
    if np.any(toss.rows["face"][toss.rows["time"] > time] != named):
        return True
    path = Pieces(
        body=body,
        friction=FloorFriction(rules.friction),
        contact_tolerance=SETTINGS.contact_tolerance,
        started=toss.started,
    )
    starts = toss.started.times[toss.started.times > time]
    at = starts if body.thickness > 0 else np.union1d(starts, np.arange(time, toss.end_time, STEP))
    modes = toss.started.modes[np.searchsorted(toss.started.times, at, side="right") - 1]
    normals = path.sample(at[~np.isin(modes, (Mode.FLIGHT, Mode.UPRIGHT, Mode.ENDED))]).normal
    return bool(np.any(SIGNS[named] * normals[:, 2] < 0))


REPRODUCTION = study(__name__, Cells(stopped, AXES), Cells(unasked, {"floor": AXES["floor"]}))
