"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from cointoss import EndingCriteria, Outcome, Scenario, analytic
from cointoss.study import Array, Estimate, share, share_of
from cointoss_reproduction.frame.cells import Cells, Rows, column, estimate
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import quotient
from cointoss_reproduction.setups.planar_maps import (
    HEIGHTS,
    MEDIA,
    SPINS,
    case,
    draw_titled,
    faces_after,
    lines_of,
    map_of,
    planar_rows,
    toss_rows_by_mujoco,
    touched_faces,
    whole_grid,
)

SHOWN = (0, 2, 5, 9)
TOUCHES = 10
"""The number of touches whose faces are compared: after 0, 1, ... impacts, to one less than this."""
RESOLUTIONS = 10.0 ** -np.arange(2, 13)
"""ε, distances of nearby tosses [m]."""
MOST_RUNS = 10
"""Most runs of twins at one ε over the tosses of the maps."""
PART = 1 / 8
"""The number of twins at 1 nm over the number of tosses."""
FEWEST = 250
"""The fewest twins that must differ for a count of boundaries."""
BLOCK = 1 << 10
"""The number of runs that are tossed together."""
FINER = 10
"""Pairs of twins in a run, whose first and last toss are twins at this many times ε."""
CONVERGED = 1.25
"""All boundaries count as found when there are fewer than this many times those at ten times ε."""
FEW_TWINS = "too few twins differ to count boundaries at two resolutions"
ELASTIC = 30
"""Impacts through which faces are compared where none loses energy."""
ELASTIC_STEPS = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
"""Distances of twins where none loses energy [m]."""
MOST = 100
"""Impacts within which a toss that loses energy ends."""
LENGTH = HEIGHTS[1] - HEIGHTS[0]
SEED = 31
NARROW = 1e-9
"""The distance at which stripes narrower than a hand's accuracy are sought [m]."""
HALF = 0.4
"""A share of twins that differ: nearly chance."""
COUNTED, AT_LEAST = "counted", "at least"
"""Whether ten times finer twins hardly count more boundaries."""


def map_faces(medium: str, impacts: int, points: int = 64) -> pd.DataFrame:
    """Return the lines of a map of the face after some impacts."""
    grid = whole_grid(points)
    faces = faces_after(grid.rows(_case(medium)), impacts)
    return pd.DataFrame({"faces": lines_of(faces.reshape(grid.shape))})


def count_twins(medium: str, impacts: int, tosses: int = 240_000) -> Iterator[dict[str, Any]]:
    """Yield how many boundaries there are on a line, and how many twins see at each of `RESOLUTIONS`.

    They are counted where the last step has hardly added more: then there are at most as many more as it has
    added. So it is where each step adds at most half of what the one before has.
    """
    rng = np.random.default_rng([SEED, impacts])
    found = list(_boundaries(_case(medium), rng, MOST_RUNS * tosses, impacts))
    _, seen, growth = found[-1]
    counted, more = (COUNTED, growth.high) if growth.high < CONVERGED else (AT_LEAST, 1.0)
    yield {"boundaries": replace(seen, high=seen.high * more), "growth": growth, "counted": counted}
    for resolution, number, _ in found:
        yield {"resolution": resolution, "seen": number, "counted": counted}


def compare_engines(tosses: int = 240_000, tosses_mujoco: int = 100) -> dict[str, str]:
    """Return how many faces agree with MuJoCo's after each of `SHOWN` impacts, in words."""
    scenario, (heights, spins) = _case("air"), _random(tosses, tosses_mujoco)
    faces = touched_faces(scenario, heights, spins, TOUCHES)
    rows = planar_rows(scenario.replace("ending", EndingCriteria()), heights, spins)
    same = [int(np.sum(faces_after(rows, n, toss_rows_by_mujoco) == faces[:, n])) for n in SHOWN]
    impacts = ", ".join(map(str, SHOWN))
    return {"mujoco": f"{', '.join(map(str, same))} of {len(rows)} faces alike after {impacts} impacts"}


def end(tosses: int = 240_000) -> dict[str, Any]:
    """Return how long tosses in air last, and how wide stripes are after the last of the touches [m]."""
    scenario, (heights, spins) = _case("air"), _random(tosses)
    few = slice(round(PART * tosses))
    last, narrow = (
        faces_after(planar_rows(scenario, heights[few] + step, spins[few]), TOUCHES - 1)
        for step in (0.0, NARROW)
    )
    lasting = analytic.toss_rows(planar_rows(scenario, heights, spins)).impacts
    return {
        "median": np.median(lasting),
        "more": np.mean(lasting > SHOWN[-1]),
        "beyond": share(lasting > MOST),
        "width": _inverse(share(narrow != last), NARROW),
    }


def lose_nothing(tosses: int = 240_000, elastic: int = 1000) -> Iterator[Rows]:
    """Yield how many twins have different faces where impacts lose nothing, in vacuum, and how many end."""
    heights, spins = _random(tosses, elastic)
    scenario = case(air=False, restitution=1.0, max_impacts=MOST)
    outcome = analytic.toss_rows(planar_rows(scenario, heights, spins)).outcome
    yield {"ended": int(np.sum((outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)))}
    faces = touched_faces(scenario, heights, spins, ELASTIC + 1)
    for step in ELASTIC_STEPS:
        differ = np.sum(touched_faces(scenario, heights + step, spins, ELASTIC + 1) != faces, axis=0)
        after = np.arange(len(differ))
        yield pd.DataFrame({"apart": f"{step:.0e} m", "after": after, "differ": differ, "twins": elastic})


def _case(medium: str) -> Scenario:
    return case(air=medium == "air")


def _random(tosses: int, first: int | None = None) -> tuple[Array, Array]:
    """Return heights [m] and spins [rad/s] in the ranges of the maps, of all or of the first."""
    rng = np.random.default_rng(SEED)
    return rng.uniform(*HEIGHTS, tosses)[:first], rng.uniform(*SPINS, tosses)[:first]


def _inverse(estimate: Estimate, factor: float) -> Estimate:
    """Return the estimate of a factor over what was estimated."""
    value, low, high = factor / np.maximum(estimate.ends, np.finfo(float).tiny)
    return replace(estimate, value=float(value), low=float(high), high=float(low))


def _boundaries(
    scenario: Scenario, rng: np.random.Generator, most: int, n: int
) -> Iterator[tuple[float, Estimate, Estimate]]:
    """Yield what twins see after n impacts at each of `RESOLUTIONS`, until all boundaries are counted.

    Each result has ε, the number of boundaries, and this number over that at ten times ε.

    Where ε is small, at most one boundary lies between twins. With N boundaries on a length L, a part N ε/L
    of the twins has one between them. At each ε runs are tossed, in which each toss is the twin of the next,
    until `FEWEST` twins differ; if fewer differ in the most runs, no finer ε follows. The two ends of a run
    differ where an odd number of boundaries lies between them.

    Args:
        scenario: of the tosses.
        rng: the source of chance.
        most: runs at one ε.
        n: impacts.
    """
    for step in RESOLUTIONS.tolist():
        differ = np.zeros(0, dtype=np.int64)
        while differ.sum() < FEWEST and len(differ) < most:
            z, spins = rng.uniform(*HEIGHTS, BLOCK), rng.uniform(*SPINS, BLOCK)
            run = z[:, None] + step * np.arange(FINER + 1)
            faces = faces_after(planar_rows(scenario, run.ravel(), np.repeat(spins, FINER + 1)), n)
            differ = np.append(differ, np.sum(np.diff(faces.reshape(run.shape)) != 0, axis=1))
        count = int(differ.sum())
        if count < FEWEST and step < RESOLUTIONS[0]:
            return
        growth = _inverse(share_of(int(np.sum(differ % 2)), count, "twins"), 1.0)
        yield step, share_of(count, FINER * len(differ), "twins") * (LENGTH / step), growth
        if growth.high < CONVERGED:
            return


def _growth(counts: Sequence[Estimate], known: int) -> dict[str, Any]:
    """Return how the number of boundaries grows, as far as it is counted, by the names of the claims.

    N(0) is set by the range of the heights, so that the growth is compared from the second impact on, and
    only that of impacts which have no number in common.

    Args:
        counts: boundaries after 0, 1, ... impacts.
        known: how many of these are more than lower bounds.
    """
    steps = {n: quotient(counts[n], counts[n - 1]) for n in range(1, known)}
    numbers = ", ".join("{} [{}, {}]".format(*map(_rounded, one.ends)) for one in counts[:known])
    beyond = [f"; at least {_rounded(one.low)} after {n}" for n, one in enumerate(counts) if known <= n <= 6]
    told = (
        f"a line through the map crosses {numbers} after 0 to {known - 1} impacts{''.join(beyond)}",
        f"seen as far as N({known - 1}); an exponential has the same growth at each impact, and what is "
        "faster a larger one",
    )
    return {
        "told": told if steps else ("-", "-"),
        "steps": {f"N({n}) over N({n - 1})": step for n, step in steps.items()},
        "faster": {
            f"growth at impact {later} over that at impact {earlier}": quotient(steps[later], steps[earlier])
            for earlier, later in combinations(range(2, known), 2)
            if later > earlier + 1
        },
        "missing": ["" if known > least else FEW_TWINS for least in (1, 4)],
    }


def _rounded(number: float) -> str:
    return f"{float(f'{number:.2g}'):,.9g}"


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    media: dict[str, dict[str, Any]] = {}
    for medium, told, expected in (("air", column(cells, "mujoco").item(), None), ("vacuum", "-", False)):
        rows = cells.query(f"medium == '{medium}' and boundaries.notna()", engine="python")
        counts = [estimate(row, "boundaries") for row in rows.to_dict("records")]
        known = int(np.cumprod(column(rows, "counted") == COUNTED).sum())
        media[medium] = _growth(counts, known) | {"mujoco": told, "expected": expected}
    half = cells.query(f"differ > {HALF} * twins", engine="python").drop_duplicates("apart")
    mixed = [f"{step} after {n}" for step, n in half[["apart", "after"]].itertuples(index=False)]
    return {"media": media, "mixed": ", ".join(mixed)}


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(11, 5))
    panels = picture.subplots(2, len(SHOWN), sharex=True, sharey=True).flat
    for axes, (medium, n) in zip(panels, product(MEDIA, SHOWN), strict=True):
        lines = column(cells, "faces", f"medium == '{medium}' and impacts == {n}")
        draw_titled(axes, map_of(lines), f"n = {n}, in {medium}")
        axes.label_outer()
    return picture


MEDIUM = {"medium": tuple(MEDIA)}
REPRODUCTION = study(
    __name__,
    Cells(map_faces, {**MEDIUM, "impacts": SHOWN}),
    Cells(count_twins, {**MEDIUM, "impacts": range(TOUCHES)}),
    Cells(compare_engines, {}),
    Cells(end, {}),
    Cells(lose_nothing, {}),
    found=_found,
    draw={"figure": _draw},
)
