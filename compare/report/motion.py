"""The motion of a report's tosses, as the scripts of its page draw it."""

from typing import Any

import numpy as np

from cointoss.compare.report.compared_tosses import PARTED, ComparedTosses
from cointoss.compare.web.playable import coin_of, path_of, rounded
from cointoss.models.records import Array, Toss

SAMPLES = 2000
"""Samples of a path."""
MOST_TOUCHES = 2000
"""Impacts that are marked in the plots."""
ROUNDING = 1e-16
"""Zero has no place on a logarithmic axis; a difference of rounding is drawn as this."""


def motion_of(comparison: ComparedTosses) -> dict[str, Any]:
    """Return the motion of the tosses, for JSON.

    Returns:
        `tosses`; `apart`, how the differences between the engines grow, or None; and `horizon`, the time of
        the last impact whose face must be shared where others follow, or None [s].
    """
    return {
        "tosses": [_played(toss) for toss in comparison.tosses],
        "apart": _apart(comparison) if comparison.mujoco else None,
        "horizon": comparison.horizon_time if comparison.mujoco else None,
    }


def _played(toss: Toss) -> dict[str, Any]:
    impacts = toss.impacts
    return {
        "engine": toss.engine,
        "outcome": str(toss.outcome),
        "end_time": toss.end_time,
        "times": rounded(impacts.time[:MOST_TOUCHES], 7),
        "heights": rounded(impacts.position[:MOST_TOUCHES, 2], 5),
        "coin": coin_of(toss.scenario),
        "path": path_of(toss, SAMPLES, with_spin=True),
    }


def _apart(comparison: ComparedTosses) -> dict[str, Any]:
    together, radius = comparison.together, comparison.scenario.coin.radius
    return {
        "time": rounded(together.time, 7),
        "distance": _above_rounding(together.distance / radius),
        "angle": _above_rounding(together.attitude_angle),
        "parted": PARTED,
        "rounding": ROUNDING,
    }


def _above_rounding(differences: Array) -> list[float]:
    return rounded(np.maximum(differences, ROUNDING), 4)
