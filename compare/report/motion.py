"""The motion of a report's tosses, as the scripts of its page draw it."""

from operator import itemgetter
from typing import Any

import numpy as np

from cointoss.compare.engines import label_of
from cointoss.compare.film.filmed import Filmed
from cointoss.compare.output.style import Look, looks_of
from cointoss.compare.report.compared_tosses import PARTED, Against, ComparedTosses
from cointoss.compare.web.playable import path_of, playable, rounded
from cointoss.models.records import Array

SAMPLES = 2000
"""Samples of a path."""
MOST_TOUCHES = 2000
"""Impacts that are marked in the plots."""
ROUNDING = 1e-16
"""Zero has no place on a logarithmic axis; a difference of rounding is drawn as this."""


def motion_of(comparison: ComparedTosses) -> dict[str, Any]:
    """Return the motion of the tosses, for JSON.

    Returns:
        `tosses`; `apart`, how the difference of each other engine from the analytic one grows; `parted` and
        `rounding`, levels of that; and `bars`, the times of the last impacts whose faces must be shared where
        others follow [s], in the order of time.
    """
    looks = looks_of(toss.engine for toss in comparison.tosses)
    others = list(zip(comparison.against, looks[1:], strict=True))
    return {
        "tosses": [_played(each, look) for each, look in zip(comparison.filmed, looks, strict=True)],
        "apart": [_apart(pair, look) for pair, look in others],
        "parted": PARTED,
        "rounding": ROUNDING,
        "bars": sorted(
            (
                {"time": pair.common_horizon_time, "engine": look.kind}
                for pair, look in others
                if pair.common_horizon_time
            ),
            key=itemgetter("time"),
        ),
    }


def _played(filmed: Filmed, look: Look) -> dict[str, Any]:
    toss = filmed.toss
    return {
        **playable(toss, 2, MOST_TOUCHES),
        "later_times": rounded(filmed.later_times[:MOST_TOUCHES], 7),
        "engine": look.kind,
        "label": label_of(toss.engine),
        "heights": rounded(toss.impacts.position[:MOST_TOUCHES, 2], 5),
        "path": path_of(filmed.longest, SAMPLES, with_spin=True),
    }


def _apart(pair: Against, look: Look) -> dict[str, Any]:
    together, radius = pair.together, pair.measure.scenario.coin.radius
    return {
        "engine": look.kind,
        "label": label_of(pair.toss.engine),
        "time": rounded(together.time, 7),
        "distance": _above_rounding(together.distance / radius),
        "angle": _above_rounding(together.attitude_angle),
    }


def _above_rounding(differences: Array) -> list[float]:
    return rounded(np.maximum(differences, ROUNDING), 4)
