"""Fig. 23: the mass centres of four models of the coin after collisions, by both engines while trusted."""

import itertools
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from cointoss import Toss, load
from cointoss.study import Array, common_prefix, distance
from cointoss_reproduction.frame.cells import Cells
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

IMPACTS = 6
"""The number of impacts that are followed."""
REAL, SIMPLEST = "3D imperfect", "2D ideal"
SHOWN = {"analytic": 300, "MuJoCo": 60}
"""Samples of a path by each engine."""
LEFT_OUT = 0.5
"""How much of the fall to the first impact the picture leaves out [s]."""


def toss() -> Iterator[dict[str, Any]]:
    """Toss the four coins of Fig. 20 by both engines, for some impacts.

    Yields:
        How far any two are apart before and after the first impact, MuJoCo from the analytic engine while
        both are trusted, and the simplest coin from the real one [m]; then each path.
    """
    pairs = {
        name: by_both(load(file).replace("air", MEDIA["air"], "ending.max_impacts", IMPACTS))
        for name, file in MODELS.items()
    }
    by_analytic = {name: pair["analytic"] for name, pair in pairs.items()}
    horizons = {name: _horizon(pair) for name, pair in pairs.items()}
    first = first_touch(by_analytic)
    shared = min(toss.end_time for toss in by_analytic.values())
    before = _largest_distance(by_analytic, np.linspace(0, first, 200)[:-1])
    times = np.linspace(first, shared, 400)
    real, simplest = by_analytic[REAL], by_analytic[SIMPLEST]
    radius = real.scenario.coin.radius
    yield {
        "before": before,
        "ten_times": 10 * before,
        "after": _largest_distance(by_analytic, times),
        "seconds": shared - first,
        "mujoco": max(
            _largest_distance(pair, np.linspace(0, horizons[name], 600)) for name, pair in pairs.items()
        ),
        "tenth": 0.1 * radius,
        "radius": radius,
        "alike": common_prefix(real.sequence, simplest.sequence),
        "strayed": _largest_distance({name: by_analytic[name] for name in (REAL, SIMPLEST)}, times),
        "faces": ", ".join(toss.sequence for toss in by_analytic.values()),
        "trusted": ", ".join(str(_trusted(pair)) for pair in pairs.values()),
    }
    for name, pair in pairs.items():
        for engine, end in (("analytic", by_analytic[name].end_time), ("MuJoCo", horizons[name])):
            t = np.linspace(LEFT_OUT, end, SHOWN[engine])
            for time, (x, _, z) in zip(t, 100 * pair[engine].sample(t).position, strict=True):
                yield {"model": name, "engine": engine, "time": time, "x": x, "z": z}


def _trusted(pair: Mapping[str, Toss]) -> int:
    return min(toss.trusted_impacts for toss in pair.values())


def _horizon(pair: Mapping[str, Toss]) -> float:
    """Return the time of the first impact that not both engines trust, or of the end [s]."""
    trusted, tosses = _trusted(pair), pair.values()
    return float(min(toss.impacts.time[trusted] if trusted < IMPACTS else toss.end_time for toss in tosses))


def _largest_distance(tosses: Mapping[str, Toss], times: Array) -> float:
    """Return the largest distance of any two mass centres at any of these times [m]."""
    paths = [toss.sample(times) for toss in tosses.values()]
    return float(max(distance(p, q).max() for p, q in itertools.combinations(paths, 2)))


REPRODUCTION = study(__name__, Cells(toss, {}), found=lambda cells: cells.iloc[0].to_dict())
