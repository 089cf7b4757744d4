"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import EndingCriteria, Outcome, Scenario, analytic
from cointoss.study import (
    GREY,
    INK,
    PALE,
    VERMILION,
    Array,
    Estimate,
    Progress,
    draw_panel,
    quotient,
    share,
    share_of,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import (
    HEIGHT,
    HEIGHTS,
    MEDIA,
    SPIN,
    SPINS,
    case,
    faces_after,
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


def make(
    progress: Progress, points: int = 64, tosses: int = 240_000, elastic: int = 1000, tosses_mujoco: int = 100
) -> Findings:
    """Map the face after each number of impacts, and count twins, tosses ε apart, that differ."""
    grid = whole_grid(points)
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    data: Data = {"resolution": RESOLUTIONS}
    media: dict[str, dict[str, Any]] = {}
    most = [round(PARTS.get(n, PARTS_BEYOND) * tosses) for n in range(TOUCHES)]
    done, whole = 0, len(MEDIA) * (sum(most) + tosses) + 2 * tosses
    same = _same_by_mujoco(case(air=True), heights[:tosses_mujoco], spins[:tosses_mujoco])
    progress(done := done + tosses, whole)
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        for n in SHOWN:
            data[f"{medium}, map {n}"] = faces_after(grid.rows(scenario), n).reshape(grid.shape)
        progress(done := done + tosses, whole)
        twins = []
        for n, limit in enumerate(most):
            twins.append(_differing(scenario, np.random.default_rng([SEED, n]), limit, n))
            progress(done := done + limit, whole)
        counted = [_boundaries(one) for one in twins]
        media[medium] = _growth(counted) | {"mujoco": same if medium == "air" else "-"}
        data |= {
            f"{medium}, boundaries": (LENGTH / RESOLUTIONS)[:, None]
            * np.array([differ / made for differ, made in twins]).T,
            f"{medium}, counted": np.array([one.count.ends for one in counted]),
            f"{medium}, converged": np.array([one.is_converged for one in counted]),
        }
    few = slice(round(PARTS_BEYOND * tosses))
    last, narrow = (
        faces_after(planar_rows(case(air=True), heights[few] + step, spins[few]), TOUCHES - 1)
        for step in (0.0, NARROW)
    )
    lasting = analytic.toss_rows(planar_rows(case(air=True), heights, spins)).impacts
    data["elastic"] = shares = _elastic_shares(heights[:elastic], spins[:elastic])
    progress(whole, whole)
    return Findings(
        data=data,
        media=media,
        median=np.median(lasting),
        more=np.mean(lasting > SHOWN[-1]),
        beyond=share(lasting > MOST),
        width=_inverse(share(narrow != last), NARROW),
        ended=_ended(heights[:elastic], spins[:elastic]),
        mixed=_mixed(shares),
        elastic_share={
            f"{step:.0e}": share_of(round(row[-1] * elastic), elastic, "twins") - 1 / 2
            for step, row in zip(ELASTIC_STEPS, shares, strict=True)
        },
    )


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
    differ, made = np.zeros((2, len(RESOLUTIONS)), dtype=np.int64)
    made[:] = most
    for i, step in enumerate(RESOLUTIONS):
        made[i] = 0
        while differ[i] < FEWEST and made[i] < most:
            block = min(BLOCK, most - made[i])
            z, spin = rng.uniform(*HEIGHTS, block), rng.uniform(*SPINS, block)
            faces = [faces_after(planar_rows(scenario, at, spin), n) for at in (z, z + step)]
            differ[i] += np.sum(faces[0] != faces[1])
            made[i] += block
        if differ[i] < FEWEST or (i and _boundaries(np.stack([differ, made])).is_converged):
            break
    return np.stack([differ, made])


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


def _growth(found: Sequence[Boundaries]) -> dict[str, Any]:
    """Return how the number of boundaries grows, as far as it is counted, by the names of the claims."""
    known = next((n for n, one in enumerate(found) if not one.is_converged), len(found))
    steps = [quotient(found[n + 1].count, found[n].count) for n in range(known - 1)]
    numbers = ", ".join(f"{float(f'{one.count.value:.2g}'):,.0f}" for one in found[:known])
    beyond = f"; after {known} at least {found[known].count.low:.1g}" if known < len(found) else ""
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


def _elastic_shares(heights: Array, spins: Array) -> Array:
    """Return the shares of twins with different faces where impacts lose nothing, in vacuum, (ε, touches)."""
    scenario = case(air=False, restitution=1.0)
    faces = touched_faces(scenario, heights, spins, ELASTIC + 1)
    return np.array(
        [
            np.mean(touched_faces(scenario, heights + step, spins, ELASTIC + 1) != faces, axis=0)
            for step in ELASTIC_STEPS
        ]
    )


def _ended(heights: Array, spins: Array) -> int:
    """Return how many tosses end within `MOST` impacts where these lose nothing, in vacuum."""
    scenario = case(air=False, restitution=1.0, max_impacts=MOST)
    outcome = analytic.toss_rows(planar_rows(scenario, heights, spins)).outcome
    return int(np.sum((outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)))


def _mixed(shares: Array) -> str:
    """Return after how many impacts `HALF` of the twins differ, in words."""
    halves = [int(np.argmax(row > HALF)) if np.any(row > HALF) else -1 for row in shares]
    mixed = [f"{step:.0e} m after {n}" for step, n in zip(ELASTIC_STEPS, halves, strict=True) if n >= 0]
    return ", ".join(mixed)


def _same_by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Return how many faces agree with MuJoCo's after each of `SHOWN` impacts, in words."""
    faces = touched_faces(scenario, heights, spins, TOUCHES)
    rows = planar_rows(scenario.replace("ending", EndingCriteria()), heights, spins)
    same = [int(np.sum(faces_after(rows, n, toss_rows_by_mujoco) == faces[:, n])) for n in SHOWN]
    impacts = ", ".join(map(str, SHOWN))
    return f"{', '.join(map(str, same))} of {len(heights)} faces alike after {impacts} impacts"


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(11, 7.5))
    halves = picture.add_gridspec(2, 1, height_ratios=(1.9, 1.1))
    maps, numbers = (picture.add_subfigure(half) for half in halves)
    for row, medium in zip(maps.subplots(2, len(SHOWN), sharex=True, sharey=True), MEDIA, strict=True):
        for axes, n in zip(row, SHOWN, strict=True):
            draw_panel(axes, data[f"{medium}, map {n}"], x=HEIGHT, y=SPIN)
            axes.set_title(f"n = {n}, in {medium}")
            axes.grid(visible=False)
            axes.label_outer()
    seen, growth, elastic = numbers.subplots(1, 3)
    resolution = data["resolution"]
    for n in range(TOUCHES):
        N = np.where(data["air, boundaries"][:, n] > 0, data["air, boundaries"][:, n], np.nan)
        solid = bool(data["air, converged"][n])
        color = MEDIA["air"] if solid else PALE
        seen.loglog(resolution, N, ".-", color=color, linewidth=1.2 if solid else 0.7, markersize=4)
        if solid:
            at = int(np.flatnonzero(N > 0)[-1])
            seen.annotate(f"{n}", (resolution[at], N[at]), (-6, 0), textcoords="offset points", va="center")
    seen.loglog(resolution, LENGTH / resolution / 2, ":", color=INK)
    seen.annotate("all that ε can show", (1e-7, LENGTH / 1e-7 / 2), (6, 4), textcoords="offset points")
    seen.set(title="N(n) seen by twins ε apart, in air", xlabel="ε [m]", ylabel="boundaries on a line")
    seen.set_xlim(RESOLUTIONS[-1] / 3, None)
    for medium, color in MEDIA.items():
        value, low, high = data[f"{medium}, counted"].T
        known = data[f"{medium}, converged"]
        n = np.arange(TOUCHES)
        growth.errorbar(
            n[known],
            value[known],
            [(value - low)[known], (high - value)[known]],
            fmt="o-",
            color=color,
            label=medium,
        )
        growth.plot(n[~known], low[~known], "^", color=color, markerfacecolor="none")
    growth.set_yscale("log")
    growth.plot([], [], "^", color=INK, markerfacecolor="none", label="at least")
    growth.set(title="counted alike at two ε", xlabel="impacts n", ylabel="boundaries on a line")
    growth.legend()
    for step, row, shade in zip(ELASTIC_STEPS, data["elastic"], np.linspace(0.3, 1, 5), strict=True):
        elastic.plot(row, color=VERMILION, alpha=shade, label=f"{step:.0e} m")
    elastic.axhline(0.5, color=GREY, linewidth=0.8)
    elastic.set(title="χ = 1 in vacuum", xlabel="impacts n", ylabel="twins that differ", ylim=(0, 0.65))
    elastic.legend(fontsize=7, ncols=2, loc="lower right")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
