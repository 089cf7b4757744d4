"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise, product
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import EndingCriteria, Outcome, Scenario, analytic
from cointoss.study import Array, Estimate, draw_panel, quotient, share, share_of
from cointoss_reproduction.frame.cells import Cells, column, estimate
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.planar_maps import (
    HEIGHT,
    HEIGHTS,
    MEDIA,
    SPIN,
    SPINS,
    case,
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
"""Faces are compared after 0 to so many impacts, less one."""
RESOLUTIONS = 10.0 ** -np.arange(2, 12)
"""ε, distances of nearby tosses [m]."""
PARTS, PARTS_BEYOND = {0: 1 / 8, 1: 2.0, 2: 12.0, 3: 12.0, 4: 60.0}, 1 / 8
"""Most twins at one ε over the tosses of the maps, by the number of impacts; four are the most at which all
boundaries are counted."""
FEWEST = 200
"""Twins that must differ for a number of boundaries to be taken."""
BLOCK = 1 << 15
"""Twins that are tossed together."""
CONVERGED = 0.5
"""Part by which ten times finer twins may count more boundaries where all of them are counted."""
FEW_TWINS = "too few twins differ to count boundaries at two resolutions"
ELASTIC = 30
"""Impacts through which faces are compared where none loses energy."""
ELASTIC_STEPS = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
"""Distances of twins there [m]."""
MOST = 100
"""Impacts within which a toss that loses energy ends."""
LENGTH = HEIGHTS[1] - HEIGHTS[0]
SEED = 31
NARROW = 1e-9
"""At which stripes are looked for that are narrower than a hand is accurate [m]."""
HALF = 0.4
"""A share of twins that differ: nearly chance."""
ALIKE, AT_LEAST = "alike", "at least"
"""Whether ten times finer twins count as many boundaries."""


@dataclass(frozen=True, kw_only=True)
class Boundaries:
    """The number of boundaries on a line after so many impacts."""

    count: Estimate
    """As twins count them at the finest resolution at which enough of them differ."""
    resolution: float
    """That resolution [m]."""
    growth: Estimate
    """That number over the one at a ten times coarser resolution."""

    @property
    def is_converged(self) -> bool:
        """Whether finer twins would count as many; else there are at least so many."""
        return self.growth.high < 1 + CONVERGED


def map_faces(medium: str, impacts: int, points: int = 64) -> Iterator[dict[str, str]]:
    """Yield the lines of a map of the face after some impacts."""
    grid = whole_grid(points)
    for line in lines_of(faces_after(grid.rows(_case(medium)), impacts).reshape(grid.shape)):
        yield {"faces": line}


def count_twins(medium: str, impacts: int, tosses: int = 240_000) -> Iterator[dict[str, Any]]:
    """Yield how many boundaries twins count on a line, and how many they see at each of `RESOLUTIONS`."""
    most = round(PARTS.get(impacts, PARTS_BEYOND) * tosses)
    differ, made = twins = _differing(_case(medium), np.random.default_rng([SEED, impacts]), most, impacts)
    found = _boundaries(twins)
    counted = ALIKE if found.is_converged else AT_LEAST
    yield {"boundaries": found.count, "counted": counted}
    for step, number in zip(RESOLUTIONS, LENGTH / RESOLUTIONS * differ / made, strict=True):
        if number > 0:
            yield {"resolution": step, "seen": number, "counted": counted}


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
    few = slice(round(PARTS_BEYOND * tosses))
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


def lose_nothing(tosses: int = 240_000, elastic: int = 1000) -> Iterator[dict[str, Any]]:
    """Yield how many twins have different faces where impacts lose nothing, in vacuum, and how many end."""
    heights, spins = _random(tosses, elastic)
    scenario = case(air=False, restitution=1.0, max_impacts=MOST)
    outcome = analytic.toss_rows(planar_rows(scenario, heights, spins)).outcome
    yield {"ended": int(np.sum((outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)))}
    faces = touched_faces(scenario, heights, spins, ELASTIC + 1)
    for step in ELASTIC_STEPS:
        differ = np.sum(touched_faces(scenario, heights + step, spins, ELASTIC + 1) != faces, axis=0)
        for after, number in enumerate(differ.tolist()):
            yield {"apart": f"{step:.0e} m", "after": after, "differ": number, "twins": elastic}


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


def _differing(scenario: Scenario, rng: np.random.Generator, most: int, n: int) -> NDArray[np.int64]:
    """Return how many twins differ after n impacts at each of `RESOLUTIONS`, and of how many, (2, ε).

    At each they are tossed until `FEWEST` differ. Where fewer of the most do, or where the number of
    boundaries is counted, finer twins are not made: none is taken to differ.

    Args:
        scenario: of the tosses.
        rng: the source of chance.
        most: twins at one ε.
        n: impacts.
    """
    twins = np.zeros((2, len(RESOLUTIONS)), dtype=np.int64)
    differ, made = twins
    made[:] = most
    for i, step in enumerate(RESOLUTIONS):
        made[i] = 0
        while differ[i] < FEWEST and made[i] < most:
            block = min(BLOCK, most - made[i])
            z, spin = rng.uniform(*HEIGHTS, block), rng.uniform(*SPINS, block)
            faces = [faces_after(planar_rows(scenario, at, spin), n) for at in (z, z + step)]
            differ[i] += np.sum(faces[0] != faces[1])
            made[i] += block
        if differ[i] < FEWEST or (i and _boundaries(twins).is_converged):
            break
    return twins


def _boundaries(twins: NDArray[np.int64]) -> Boundaries:
    """Return the number of boundaries from the twins that differ at each of `RESOLUTIONS`, and all, (2, ε).

    Between twins lies one boundary at most where ε is small: of N on a length L a part N ε/L does.
    """
    finest = int(np.flatnonzero(twins[0] >= FEWEST).max(initial=1))
    finer, coarser = (
        share_of(int(twins[0, i]), int(twins[1, i]), "twins") * (LENGTH / float(RESOLUTIONS[i]))
        for i in (finest, finest - 1)
    )
    return Boundaries(count=finer, resolution=float(RESOLUTIONS[finest]), growth=quotient(finer, coarser))


def _growth(counts: Sequence[Estimate], known: int) -> dict[str, Any]:
    """Return how the number of boundaries grows, as far as it is counted, by the names of the claims.

    Args:
        counts: boundaries after 0, 1, ... impacts.
        known: how many of these are more than lower bounds.
    """
    steps = [quotient(later, earlier) for earlier, later in pairwise(counts[:known])]
    numbers = ", ".join(f"{float(f'{one.value:.2g}'):,.0f}" for one in counts[:known])
    beyond = f"; after {known} at least {counts[known].low:.1g}" if known < len(counts) else ""
    told = (
        f"a line through the map crosses {numbers} after 0 to {known - 1} impacts, where twins at two "
        f"resolutions count alike{beyond}",
        f"seen as far as N({known - 1}); an exponential has the same growth at each impact, and what is "
        "faster a larger one",
    )
    return {
        "told": told if steps else ("-", "-"),
        "steps": {f"N({n}) over N({n - 1})": step for n, step in enumerate(steps, start=1)},
        "faster": {
            f"growth at impact {n + 1} over that at impact {n}": quotient(later, earlier)
            for n, (earlier, later) in enumerate(pairwise(steps), start=1)
        },
        "missing": ["" if len(steps) > least else FEW_TWINS for least in (0, 1)],
    }


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    media: dict[str, dict[str, Any]] = {}
    for medium, told in (("air", column(cells, "mujoco").item()), ("vacuum", "-")):
        rows = cells.query(f"medium == '{medium}' and boundaries.notna()", engine="python")
        counts = [estimate(row, "boundaries") for row in rows.to_dict("records")]
        known = int(np.cumprod(column(rows, "counted") == ALIKE).sum())
        media[medium] = _growth(counts, known) | {"mujoco": told}
    half = cells.query(f"differ > {HALF} * twins", engine="python").drop_duplicates("apart")
    mixed = [f"{step} after {n}" for step, n in half[["apart", "after"]].itertuples(index=False)]
    return {"media": media, "mixed": ", ".join(mixed)}


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(11, 5))
    panels = picture.subplots(2, len(SHOWN), sharex=True, sharey=True).flat
    for axes, (medium, n) in zip(panels, product(MEDIA, SHOWN), strict=True):
        lines = column(cells, "faces", f"medium == '{medium}' and impacts == {n}")
        draw_panel(axes, map_of(lines), x=HEIGHT, y=SPIN)
        axes.set_title(f"n = {n}, in {medium}")
        axes.grid(visible=False)
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
