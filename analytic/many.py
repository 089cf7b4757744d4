"""Many tosses by the analytic engine, on all cores."""

import numpy as np
from numpy.typing import NDArray

from cointoss.analytic.by_rows import CERTAIN, NO_TRUST, TRUST
from cointoss.analytic.entries import rest_each
from cointoss.analytic.entries import toss_rows as toss_some
from cointoss.analytic.impact.own_law import OwnLaw, require_floor
from cointoss.analytic.on_device import toss_on_device
from cointoss.analytic.settings import COARSEST, MANY, AnalyticSettings, ContactLimits, contact_limits
from cointoss.models.answers import ANSWER, NOT_TOSSED, Answers, Trust, unanswered
from cointoss.models.batch import PLACE, checked_table, scenario_of_row
from cointoss.models.body import NO_CODE
from cointoss.models.devices import Device
from cointoss.models.errors import require_type
from cointoss.models.fields import FIELDS
from cointoss.models.kernel.arrays import Array
from cointoss.models.kernel.cuda import CardError, GraphicsCard
from cointoss.models.making import MOST_LOSSLESS
from cointoss.models.processor import Processor
from cointoss.models.records import UnsupportedError
from cointoss.models.rests import with_errors
from cointoss.models.rows import has_linear_air
from cointoss.models.scenario import MOST_KEPT, keeping_all
from cointoss.models.tiles import in_tiles

TILE, SLOW_TILE = 512, 8
"""The most tosses that a thread makes at a time; the second number holds for air with b > 0."""
NEAR, COARSER = 1e-14, 10.0
"""By which a neighbour of a toss is released faster and higher, relative, as ten steps of flight may err; and
the factor of the error allowed in its steps of contact."""
_WANTED = {None: NO_TRUST, "impacts": TRUST, "certain": CERTAIN}


def require_rows(
    rows: Array,
    *,
    settings: AnalyticSettings = MANY,
    law: OwnLaw | None = None,
    trust: Trust | None = None,
    device: Processor | Device | str | None = None,
) -> None:
    """Refuse rows that this engine can't toss so.

    Raises:
        ScenarioError: for more impacts than can be kept, where trust is asked for.
        UnsupportedError: for a floor that a law of one's own can't be used with, and for a law of one's own
            or air with b > 0 on a card.
        DeviceError: for the device "cuda" without a card that can be used.
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
    if (processor := Processor.of(device)).device is Device.CUDA:
        _require_for_card(rows, law)
        processor.card_for(len(rows))


def _require_for_card(rows: Array, law: OwnLaw | None) -> None:
    if law is not None:
        raise UnsupportedError("law: given, accepted: none with `device` cuda; cpu and auto take one")
    if len(airs := _slow_airs(rows)):
        b = airs[0][PLACE["air.exponent"]]
        raise UnsupportedError(
            f"air.exponent = {b:g}: accepted with `device` cuda: 0; cpu and auto take up to 1"
        )


def _slow_airs(rows: Array) -> list[Array]:
    """Return a row of each air that is not linear in the velocity."""
    airs = rows[:, _AIR]
    if len(rows) > 1 and (airs == airs[0]).all():
        rows, airs = rows[:1], airs[:1]
    firsts = rows[np.unique(airs, axis=0, return_index=True)[1]]
    return [row for row in firsts if not has_linear_air(row)]


def _all_homogeneous(rows: Array) -> bool:
    """Return whether all coins are homogeneous: a card takes longer than some cores for others' flights."""
    return not rows[:, _CENTER].any() and bool(np.isnan(rows[:, _INERTIA]).all())


def toss_rows(
    rows: Array,
    *,
    settings: AnalyticSettings = MANY,
    trust: Trust | None = None,
    law: OwnLaw | None = None,
    workers: int | None = None,
    answers: Array | None = None,
    device: Processor | Device | str | None = None,
) -> Answers:
    """Toss many scenarios by the event loop of `toss`: each toss is the same to the bit.

    Args:
        rows: of the scenarios, in the order of `models.fields.FIELDS`, (n, m). Each must be a scenario's:
            `cointoss.models.batch.refused` finds those that are none.
        settings: of the engine.
        trust: "impacts" also counts the impacts of each toss that can be trusted, as `toss` does, in two to
            three times the time; "certain" also finds whether each outcome is certain, in two to seven.
        law: a contact law of one's own, in place of the scenarios'.
        workers: number of threads, by default one for each core.
        answers: where the results are written as they come, (n, 7), see `models.answers.ANSWER`; tosses that
            an interruption prevents are `NOT_TOSSED`.
        device: "cpu", "cuda" or "auto"; or a `Processor` of one, which counts what a card hands over to the
            CPU. By default the CPU.

    Returns:
        How each toss ended. The paths are not kept.

    Raises:
        ScenarioError, UnsupportedError, DeviceError: see `require_rows`; and `DeviceError` for a card that
            fails meanwhile, with the device "cuda".

    Warns:
        DeviceWarning: for a card that fails meanwhile, with the device "auto".
    """
    rows, processor = checked_table("rows", rows, len(FIELDS)), Processor.of(device)
    require_rows(rows, settings=settings, law=law, trust=trust, device=processor)
    if law is not None:
        rows = rows.copy()
        most = rows[:, PLACE["ending.max_impacts"]]
        most[np.isnan(most)] = MOST_LOSSLESS
    found = unanswered(len(rows), answers)
    own, limits, wanted = NO_CODE if law is None else law.code, contact_limits(settings), _WANTED[trust]
    tile = SLOW_TILE if (is_slow := bool(_slow_airs(rows))) else TILE
    is_for_card = law is None and not is_slow
    if processor.device is Device.AUTO:
        is_for_card = is_for_card and _all_homogeneous(rows)

    def toss_here(rows: Array, found: Array) -> None:
        def work(part: slice) -> None:
            toss_some(rows[part], own, limits, wanted, found[part])

        in_tiles(len(rows), tile, work, workers)

    if is_for_card and (card := processor.card_for(len(rows))) is not None:
        left = _tossed_on(card, processor, rows, limits, wanted, found)
        made = unanswered(len(left))
        try:
            toss_here(rows[left], made)
        finally:
            found[left] = made
    else:
        toss_here(rows, found)
    return Answers.of_table(found, trust)


def rest_rows(
    rows: Array, *, settings: AnalyticSettings = MANY, law: OwnLaw | None = None, workers: int | None = None
) -> Array:
    """Return where the coins of many scenarios come to rest, by the columns of `REST`, (n, 7).

    Each toss is made and followed twice: the second time, for an estimate of the error, with release and
    contact changed by `NEAR` and `COARSER`.

    Args:
        rows: as of `toss_rows`, which the CPU tosses again.
        settings: of the engine.
        law: a contact law of one's own, in place of the scenarios'.
        workers: number of threads, by default one for each core.
    """
    own, limits = NO_CODE if law is None else law.code, contact_limits(settings)
    coarser = limits._replace(tolerance=min(COARSER * limits.tolerance, COARSEST))

    def follow(rows: Array, rests: Array, is_near: bool) -> None:
        chosen = coarser if is_near else limits
        in_tiles(len(rows), SLOW_TILE, lambda part: rest_each(rows[part], own, chosen, rests[part]), workers)

    return with_errors(rows, follow, NEAR)


def _tossed_on(
    card: GraphicsCard, processor: Processor, rows: Array, limits: ContactLimits, wanted: int, found: Array
) -> NDArray[np.intp]:
    """Toss rows on a card, and return the numbers of those that it hands over."""
    try:
        toss_on_device(card, rows, limits, wanted, found)
    except CardError as error:
        processor.lose(error)
    left = np.flatnonzero(found[:, ANSWER.index("outcome")] == NOT_TOSSED)
    processor.count(card, len(rows), len(left))
    return left


_FLOOR, _AIR, _CENTER, _INERTIA = (
    [i for field, i in PLACE.items() if field.startswith(f"{table}.")]
    for table in ("floor", "air", "coin.center_of_mass", "coin.inertia")
)
"""The fields of the tables by their places in a row."""
