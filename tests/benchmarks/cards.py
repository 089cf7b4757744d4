"""Rates of a card beside all cores of its machine, and whether the answers are the same, as a page's table.

`python -m tests.benchmarks.cards` prints it within some three minutes.
"""

import time

import numpy as np

from cointoss import analytic
from cointoss.analytic.by_rows import CERTAIN, NO_TRUST
from cointoss.analytic.on_device import toss_on_device
from cointoss.analytic.settings import MANY, contact_limits
from cointoss.models.answers import NOT_TOSSED, unanswered
from cointoss.models.batch import rows_of
from cointoss.models.cores import cores_used
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.cuda import GraphicsCard, card
from cointoss.models.reading import load
from tests.benchmarks.classes import CLASSES, TossClass

SECONDS = 4.0
"""About how long the cores work on a case [s]."""


def rows_by(case: TossClass, n: int) -> Array:
    """Return about n tosses as rows."""
    return rows_of(load(case.scenario), int(n**0.5) ** 2, case.varied(n))


def measured(what: str, on: GraphicsCard) -> list[str]:
    """Toss a class on a card and on all cores; return a row of the table.

    A card's rate is from rows in memory to answers there.
    """
    case = CLASSES[what]
    timed(case, on, rows_by(case, min(case.card // 20, 4000)))  # what is done once is done
    rows = rows_by(case, case.card)
    found, seconds = timed(case, on, rows)
    few = np.ascontiguousarray(rows[:: max(1, len(rows) // 1000)])
    begun = time.perf_counter()
    analytic.toss_rows(few, trust=case.trust)
    rate = len(few) / (time.perf_counter() - begun)
    step = max(1, int(len(rows) / (SECONDS * rate)))
    some, wanted = np.ascontiguousarray(rows[::step]), unanswered(len(rows[::step]))
    begun = time.perf_counter()
    analytic.toss_rows(some, trust=case.trust, answers=wanted)
    by_card, by_cores = len(rows) / seconds, len(some) / (time.perf_counter() - begun)
    is_tossed = found[:, 0] != NOT_TOSSED
    same = (found[::step].view(np.int64) == wanted.view(np.int64)).all(1)[is_tossed[::step]]
    rates = [f"{rate:.2g}" for rate in (by_card, by_cores, by_card / by_cores)]
    counts = [f"{count:,d}" for count in ((~is_tossed).sum(), len(same), same.sum())]
    return [what, f"{len(rows):,d}", *rates, *counts]


def timed(case: TossClass, on: GraphicsCard, rows: Array) -> tuple[Array, float]:
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
    for what in (name for name, case in CLASSES.items() if case.card):
        print("|", " | ".join(measured(what, on)), "|", flush=True)


if __name__ == "__main__":
    main()
