"""The toss of a scenario by MuJoCo, as the lab's page plays it."""

import warnings
from dataclasses import replace
from typing import Any

from cointoss.compare.engines import Engine
from cointoss.compare.film.back_end import BackEndError, require_mujoco
from cointoss.compare.film.filmed import followed
from cointoss.compare.web.playable import MOST_SYMBOLS, SAMPLES, path_of, playable, rounded
from cointoss.models.records import ApproximationWarning, UnsupportedError, UnusableEngineError
from cointoss.models.scenario import Scenario

MOST_IMPACTS = 500
"""A toss is followed up to this number of impacts: some seconds of work."""


def toss_by_mujoco(
    scenario: Scenario, contact: str | None, *, samples: int = SAMPLES, most_symbols: int = MOST_SYMBOLS
) -> dict[str, Any]:
    """Return a toss to its end, or why MuJoCo makes none.

    Args:
        scenario: of the toss.
        contact: among MuJoCo's settings; by default that of one toss.
        samples: of the path.
        most_symbols: of the sequence.
    """
    most, settings = scenario.rules.max_impacts, Engine.MUJOCO.package.FINE
    settings = replace(settings, contact=contact or settings.contact)
    limited = scenario.replace("ending.max_impacts", min(MOST_IMPACTS, most))
    with warnings.catch_warnings(record=True, action="always", category=ApproximationWarning) as raised:
        try:
            require_mujoco(Engine.MUJOCO)
            toss = Engine.MUJOCO.package.toss(limited, settings=settings)
            shown = followed(toss, settings)
            played = playable(toss, 2, most_symbols)
        except (UnsupportedError, UnusableEngineError, BackEndError, FloatingPointError) as error:
            return {"engine": Engine.MUJOCO.value, "problem": str(error)}
    notes = [str(one.message) for one in raised if issubclass(one.category, ApproximationWarning)]
    is_cut = len(toss.impacts) == MOST_IMPACTS < most
    return {
        **played,
        "later_times": rounded(shown.later_times[:most_symbols], 7),
        "path": path_of(shown.longest, samples),
        **({"ending": f"It is shown up to impact {MOST_IMPACTS}."} if is_cut else {}),
        "notes": notes,
    }
