"""Rates of a card beside all cores of its machine, and whether the answers are the same, as a page's table.

`python -m tests.benchmarks.cards` prints it within some three minutes.
"""

import time
from dataclasses import dataclass

import numpy as np

from cointoss import analytic
from cointoss.analytic.by_rows import CERTAIN, NO_TRUST
from cointoss.analytic.on_device import toss_on_device
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.models.answers import NOT_TOSSED, Trust, unanswered
from cointoss.models.batch import rows_of
from cointoss.models.cores import cores_used
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.cuda import GraphicsCard, card
from cointoss.models.reading import load

SECONDS = 4.0
"""About how long the cores work on a case [s]."""
VACUUM = {"air.normal": 0.0, "air.tangential": 0.0}


@dataclass(frozen=True, kw_only=True)
class Case:
    """Tosses of one kind, on a grid of height and spin."""

    what: str
    scenario: str
    changed: dict[str, float]
    tosses: int
    """By the card."""
    trust: Trust | None = None

    def rows(self, n: int) -> Array:
        """Return about n releases."""
        side = int(n**0.5)
        spin, height = np.meshgrid(np.linspace(20, 60, side), np.linspace(0.2, 0.6, side))
        varied = {"release.angular_velocity.eta": spin.ravel(), "release.position.z": height.ravel()}
        return rows_of(load(self.scenario), side * side, varied | self.changed)


CASES = (
    Case(
        what="planar in vacuum, 10 touches",
        scenario="fig24a",
        changed={**VACUUM, "ending.max_impacts": 10},
        tosses=8_000_000,
    ),
    Case(
        what="planar in air, to the third touch",
        scenario="fig24a",
        changed={"ending.max_impacts": 3},
        tosses=8_000_000,
    ),
    Case(what="planar in air, to the end", scenario="fig24a", changed={}, tosses=2_000_000),
    Case(what="the same with certainty", scenario="fig24a", changed={}, tosses=400_000, trust="certain"),
    Case(what="imperfect coin in air, to the end", scenario="zloty", changed={}, tosses=40_000),
    Case(what="a euro on its table, to the end", scenario="table", changed={}, tosses=1_000),
)


@dataclass(frozen=True)
class Measured:
    """Rates of a case, and how many tosses were compared."""

    what: str
    tosses: int
    by_card: float
    """Tosses in a second, from rows in memory to answers there."""
    by_cores: float
    handed_over: int
    compared: int
    equal: int


def measured(case: Case, on: GraphicsCard) -> Measured:
    """Toss a case on a card and on all cores."""
    timed(case, on, case.rows(min(case.tosses // 20, 4000)))  # what is done once is done
    rows = case.rows(case.tosses)
    found, seconds = timed(case, on, rows)
    few = np.ascontiguousarray(rows[:: max(1, len(rows) // 1000)])
    begun = time.perf_counter()
    analytic.toss_rows(few, trust=case.trust)
    rate = len(few) / (time.perf_counter() - begun)
    step = max(1, int(len(rows) / (SECONDS * rate)))
    some, wanted = np.ascontiguousarray(rows[::step]), unanswered(len(rows[::step]))
    begun = time.perf_counter()
    analytic.toss_rows(some, trust=case.trust, answers=wanted)
    by_cores = len(some) / (time.perf_counter() - begun)
    is_tossed = found[:, 0] != NOT_TOSSED
    same = (found[::step].view(np.int64) == wanted.view(np.int64)).all(1)[is_tossed[::step]]
    return Measured(
        case.what,
        len(rows),
        len(rows) / seconds,
        by_cores,
        int((~is_tossed).sum()),
        len(same),
        int(same.sum()),
    )


def timed(case: Case, on: GraphicsCard, rows: Array) -> tuple[Array, float]:
    """Return the answers of a card, and its time [s]."""
    found = unanswered(len(rows))
    wanted = NO_TRUST if case.trust is None else CERTAIN
    begun = time.perf_counter()
    toss_on_device(on, rows, contact_limits(MANY), wanted, found)
    return found, time.perf_counter() - begun


def main() -> None:
    """Print the table."""
    on = card()
    print(f"{on.name} beside the {cores_used()} cores of its machine:\n")
    heads = ("tosses", "number", "card, 1/s", "cores, 1/s", "ratio", "handed over", "compared", "the same")
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}")
    for case in CASES:
        each = measured(case, on)
        rates = [f"{rate:.2g}" for rate in (each.by_card, each.by_cores, each.by_card / each.by_cores)]
        counts = [f"{count:,d}" for count in (each.handed_over, each.compared, each.equal)]
        print("|", " | ".join([each.what, f"{each.tosses:,d}", *rates, *counts]), "|", flush=True)


if __name__ == "__main__":
    main()
