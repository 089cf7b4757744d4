"""Many tosses in MuJoCo, on all cores."""

import numpy as np

from cointoss.coin_mj.entries import toss_rows as toss_some
from cointoss.coin_mj.model.settings import MANY, MujocoSettings
from cointoss.coin_mj.on_machines import on_machines
from cointoss.coin_mj.toss import require_supported, warn_of_approximation
from cointoss.models.answers import Answers, Trust, unanswered
from cointoss.models.batch import PLACE, checked_table, scenario_of_row
from cointoss.models.devices import Device
from cointoss.models.errors import require_type
from cointoss.models.fields import FIELDS
from cointoss.models.kernel.arrays import Array
from cointoss.models.processor import Processor
from cointoss.models.records import UnsupportedError

_FLOOR = [i for field, i in PLACE.items() if field.startswith("floor.")]


def require_rows(
    rows: Array,
    *,
    settings: MujocoSettings = MANY,
    law: object = None,
    trust: Trust | None = None,
    device: Processor | Device | str | None = None,
) -> None:
    """Refuse rows that this engine can't toss so.

    Raises:
        UnsupportedError: for floors that `toss` refuses, for a law of one's own, for trust, and for a card.

    Warns:
        ApproximationWarning: as `toss`.
    """
    if law is not None:
        raise UnsupportedError(
            'law: given, accepted: none with the engine mujoco; engine = "analytic" takes one'
        )
    if trust is not None:
        raise UnsupportedError(f'trust = "{trust}": accepted by the MuJoCo engine: None')
    Processor.of(device).require_cpu("by the MuJoCo engine")
    for row in rows[np.unique(rows[:, _FLOOR], axis=0, return_index=True)[1]]:
        described = scenario_of_row(row)
        require_supported(described, settings=settings)
        warn_of_approximation(described)


def toss_rows(
    rows: Array,
    *,
    settings: MujocoSettings = MANY,
    trust: Trust | None = None,
    law: object = None,
    workers: int | None = None,
    answers: Array | None = None,
    device: Processor | Device | str | None = None,
) -> Answers:
    """Toss many scenarios by the event loop of `toss`.

    Each toss is the same, to the bit, as by `toss` with the same settings. The default settings are coarser
    than those of `toss`: docs/MUJOCO.md states their error.

    Args:
        rows: of the scenarios, in the order of `models.fields.FIELDS`, (n, m). Each must be a scenario's:
            `cointoss.models.batch.refused` finds those that are none.
        settings: how MuJoCo realises the floor, and how finely it steps.
        trust: None; this engine finds trust only for a single `toss`.
        law: None; this engine has no contact laws of one's own.
        workers: number of threads, by default one for each core.
        answers: where the answers are written as they come, (n, 7), see `models.answers.ANSWER`; what an
            interruption leaves undone is `NOT_TOSSED`.
        device: the CPU tosses: "cpu" or "auto".

    Returns:
        How each toss ended. The paths are not kept.

    Raises:
        UnsupportedError: see `require_rows`.
    """
    require_type("settings", settings, MujocoSettings, "coin_mj.MujocoSettings, such as coin_mj.MANY")
    rows = checked_table("rows", rows, len(FIELDS))
    require_rows(rows, settings=settings, law=law, trust=trust, device=device)
    found = unanswered(len(rows), answers)
    on_machines(rows, settings, workers, found, toss_some)
    return Answers.of_table(found)
