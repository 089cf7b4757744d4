"""Many tosses by the analytic engine, on all cores."""

import numpy as np

from cointoss.analytic.by_rows import CERTAIN, NO_TRUST, TRUST
from cointoss.analytic.entries import toss_rows as toss_some
from cointoss.analytic.impact.own_law import OwnLaw, require_floor
from cointoss.analytic.settings import MANY, AnalyticSettings, contact_limits
from cointoss.models.answers import Answers, Trust, unanswered
from cointoss.models.batch import PLACE, checked_table, scenario_of_row
from cointoss.models.body import NO_CODE
from cointoss.models.errors import require_type
from cointoss.models.fields import FIELDS
from cointoss.models.kernel.arrays import Array
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.rows import has_linear_air
from cointoss.models.scenario import MOST_KEPT, keeping_all
from cointoss.models.tiles import in_tiles

TILE, SLOW_TILE = 512, 8
"""Most tosses that a thread makes at a time, in air with b > 0 the second."""
_WANTED = {None: NO_TRUST, "impacts": TRUST, "certain": CERTAIN}


def require_rows(
    rows: Array, *, settings: AnalyticSettings = MANY, law: OwnLaw | None = None, trust: Trust | None = None
) -> None:
    """Refuse rows that this engine can't toss so.

    Raises:
        ScenarioError: for more impacts than can be kept, where trust is asked for.
        UnsupportedError: for a floor that a law of one's own can't be used with.
    """
    require_type("settings", settings, AnalyticSettings, "analytic.AnalyticSettings, such as analytic.MANY")
    if law is not None:
        require_type("law", law, OwnLaw, "a cointoss.OwnLaw; a named law is the scenario's floor.contact")
        for row in rows[np.unique(rows[:, _FLOOR], axis=0, return_index=True)[1]]:
            require_floor(law, scenario_of_row(row))
    most = rows[:, PLACE["ending.max_impacts"]]
    if trust is not None and np.nanmax(most, initial=0) > MOST_KEPT:
        described = scenario_of_row(rows[np.nanargmax(most)])
        keeping_all(described.rules, described)


def toss_rows(
    rows: Array,
    *,
    settings: AnalyticSettings = MANY,
    trust: Trust | None = None,
    law: OwnLaw | None = None,
    workers: int | None = None,
    answers: Array | None = None,
) -> Answers:
    """Toss many scenarios by the event loop of `toss`: each toss is the same to the bit.

    Args:
        rows: of the scenarios, in the order of `models.fields.FIELDS`, (n, 46). Each must be a scenario's:
            `cointoss.models.batch.refused` finds those that are none.
        settings: of the engine.
        trust: "impacts" finds how many impacts of each toss can be trusted, as `toss` does, in two to three
            times the time; "certain" finds that, and whether the outcome of each is certain, in two to seven.
        law: a contact law of one's own, in place of the scenarios'.
        workers: number of threads, by default one for each core.
        answers: where the answers are written as they come, (n, 7), see `models.answers.ANSWER`; what an
            interruption leaves undone is `NOT_TOSSED`.

    Returns:
        How each toss ended. The paths are not kept.

    Raises:
        ScenarioError, UnsupportedError: see `require_rows`.
    """
    rows = checked_table("rows", rows, len(FIELDS))
    require_rows(rows, settings=settings, law=law, trust=trust)
    if law is not None:
        rows = rows.copy()
        most = rows[:, PLACE["ending.max_impacts"]]
        most[np.isnan(most)] = MOST_LOSSLESS
    found = unanswered(len(rows), answers)
    own, limits, wanted = NO_CODE if law is None else law.code, contact_limits(settings), _WANTED[trust]
    is_fast = all(has_linear_air(row) for row in rows[np.unique(rows[:, _AIR], axis=0, return_index=True)[1]])

    def work(part: slice) -> None:
        toss_some(rows[part], own, limits, wanted, found[part])

    in_tiles(len(rows), TILE if is_fast else SLOW_TILE, work, workers)
    return Answers.of_table(found, trust)


_FLOOR, _AIR = (
    [i for field, i in PLACE.items() if field.startswith(f"{table}.")] for table in ("floor", "air")
)
