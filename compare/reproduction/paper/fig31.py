"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.compare.basins.picture import draw_panel
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import GREY, INK, PALE, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import ratio_of_shares, share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.planar_maps import (
    HEIGHT,
    HEIGHTS,
    MEDIA,
    SPIN,
    SPINS,
    case,
    faces_after,
    releases,
    touched_faces,
    whole_grid,
)
from cointoss.models.parts import EndingCriteria
from cointoss.models.records import Array, Outcome
from cointoss.models.scenario import Scenario

SHOWN = (0, 2, 5, 9)
TOUCHES = 10
"""Faces are compared after 0 to so many impacts, less one."""
RESOLUTIONS = 10.0 ** -np.arange(2, 11)
"""ε, distances of nearby tosses [m]."""
PARTS, PARTS_BEYOND = {0: 1 / 8, 1: 1 / 2, 2: 1.0}, 1 / 8
"""Of the tosses that are made, by the number of impacts; two are the most at which all are counted."""
FEWEST = 150
"""Twins that must differ for a number of boundaries to be taken."""
CONVERGED = 0.5
"""Part by which ten times finer twins may count more boundaries where all of them are counted."""
FEW_TWINS = "too few twins differ to count boundaries at two resolutions"
ELASTIC_TOUCHES = 31
"""Faces are compared so often where no impact loses energy."""
ELASTIC_STEPS = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
"""Distances of twins there [m]."""
MOST = 100
"""Impacts within which a toss that loses energy ends."""
LENGTH = HEIGHTS[1] - HEIGHTS[0]
SEED = 31


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
) -> Result:
    """Map the face after each number of impacts, and count twins, tosses ε apart, that differ."""
    grid = whole_grid(points)
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    data: dict[str, NDArray[Any]] = {"resolution": RESOLUTIONS}
    found: dict[str, list[Boundaries]] = {}
    done, whole = 0, len(MEDIA) * (TOUCHES + 1) + 2
    same = _same_by_mujoco(case(air=True), heights[:tosses_mujoco], spins[:tosses_mujoco])
    progress(done := done + 1, whole)
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        for n in SHOWN:
            data[f"{medium}, map {n}"] = faces_after(scenario, grid.releases, n).reshape(grid.shape)
        progress(done := done + 1, whole)
        differ = []
        for n in range(TOUCHES):
            few = slice(round(PARTS.get(n, PARTS_BEYOND) * tosses))
            differ.append(_differing(scenario, heights[few], spins[few], n))
            progress(done := done + 1, whole)
        found[medium] = [_boundaries(one) for one in differ]
        data |= {
            f"{medium}, boundaries": (LENGTH / RESOLUTIONS)[:, None]
            * np.array([one.mean(axis=1) for one in differ]).T,
            f"{medium}, counted": np.array(
                [(one.count.value, one.count.low, one.count.high) for one in found[medium]]
            ),
            f"{medium}, converged": np.array([one.is_converged for one in found[medium]]),
        }
    few = slice(round(PARTS_BEYOND * tosses))
    last, narrow = (
        faces_after(case(air=True), releases(heights[few] + step, spins[few]), TOUCHES - 1)
        for step in (0.0, NARROW)
    )
    lasting = analytic.toss_many(case(air=True), releases(heights, spins)).impacts
    data["elastic"] = shares = _elastic_shares(heights[:elastic], spins[:elastic])
    progress(whole, whole)
    claims = [claim for medium, one in found.items() for claim in _claims(medium, one, same)]
    claims += [
        Claim(
            claim="the end of the toss stops the multiplication",
            analytic=(
                f"half of the tosses make {np.median(lasting):.0f} impacts or fewer, "
                f"{np.mean(lasting > 9):.0%} more than the 9 of the last map; N at a fixed ε stops growing "
                "long before, where twins differ as often as any two tosses"
            ),
            criteria=[
                Criterion(
                    f"share with more than {MOST} impacts",
                    share(lasting > MOST),
                    "<",
                    1e-3,
                    "after that nothing changes",
                )
            ],
        ),
        Claim(
            claim="stripes become narrower than any hand is accurate (section 5.3)",
            analytic=f"{TOUCHES - 1} impacts; twins {NARROW:.0e} m apart",
            criteria=[
                Criterion(
                    "mean width at most [m]",
                    _inverse(share(narrow != last), NARROW),
                    "<",
                    1e-6,
                    "a hand errs by more than 1 µm",
                )
            ],
        ),
        *_elastic_claims(shares, elastic, heights, spins),
    ]
    return Result(claims=claims, data=data)


NARROW = 1e-9
"""At which stripes are looked for that are narrower than a hand is accurate [m]."""


def _inverse(estimate: Estimate, factor: float) -> Estimate:
    """Return the estimate of a factor over what was estimated."""
    return replace(
        estimate,
        value=factor / max(estimate.value, np.finfo(float).tiny),
        low=factor / estimate.high,
        high=factor / max(estimate.low, np.finfo(float).tiny),
    )


def _differing(scenario: Scenario, heights: Array, spins: Array, n: int) -> NDArray[np.bool_]:
    """Return which twins differ after n impacts at each of `RESOLUTIONS`, (ε, tosses).

    Where fewer than `FEWEST` do, finer twins are not made: none of them is taken to differ.
    """
    faces = faces_after(scenario, releases(heights, spins), n)
    differ = np.zeros((len(RESOLUTIONS), len(heights)), dtype=np.bool_)
    for row, step in zip(differ, RESOLUTIONS, strict=True):
        row[:] = faces_after(scenario, releases(heights + step, spins), n) != faces
        if row.sum() < FEWEST:
            break
    return differ


def _boundaries(differ: NDArray[np.bool_]) -> Boundaries:
    """Return the number of boundaries from which twins differ at each of `RESOLUTIONS`, (ε, n).

    Between twins lies one boundary at most where ε is small: of N on a length L a part N ε/L does.
    """
    enough = np.flatnonzero(differ.sum(axis=1) >= FEWEST)
    finest = int(enough.max(initial=1))
    part, scale = share(differ[finest], "twins"), LENGTH / RESOLUTIONS[finest]
    return Boundaries(
        count=replace(part, value=scale * part.value, low=scale * part.low, high=scale * part.high),
        resolution=float(RESOLUTIONS[finest]),
        growth=ratio_of_shares(differ[finest], differ[finest - 1], 10.0, "twins"),
    )


def _claims(medium: str, found: Sequence[Boundaries], same: str) -> list[Claim]:
    """Return the claims on how the number of boundaries grows, as far as it is counted."""
    known = next((n for n, one in enumerate(found) if not one.is_converged), len(found))
    steps = [_over(found[n + 1].count, found[n].count) for n in range(known - 1)]
    numbers = ", ".join(f"{float(f'{one.count.value:.2g}'):,.0f}" for one in found[:known])
    beyond = f"; after {known} at least {found[known].count.low:.1g}" if known < len(found) else ""
    return [
        Claim(
            claim=f"the more impacts, the more boundaries (in {medium})",
            analytic=(
                f"a line through the map crosses {numbers} after 0 to {known - 1} impacts, where twins at "
                f"two resolutions count alike{beyond}"
                if steps
                else "-"
            ),
            mujoco=same if medium == "air" else "-",
            criteria=[
                Criterion(f"N({n + 1}) over N({n})", step, ">", 1, "more") for n, step in enumerate(steps)
            ],
            missing="" if steps else FEW_TWINS,
        ),
        Claim(
            claim=f"their number grows faster than exponentially (in {medium})",
            analytic=(
                f"seen as far as N({known - 1}); an exponential has the same growth at each impact, and "
                "what is faster a larger one"
                if steps
                else "-"
            ),
            criteria=[
                Criterion(
                    f"growth at impact {n + 2} over that at impact {n + 1}",
                    _over(later, earlier),
                    ">",
                    1,
                    "faster than before",
                )
                for n, (earlier, later) in enumerate(pairwise(steps))
            ],
            missing="" if len(steps) > 1 else FEW_TWINS,
            expected=False,
        ),
    ]


def _over(first: Estimate, second: Estimate) -> Estimate:
    """Return one positive quantity over another, with the interval that both of theirs allow."""
    value = first.value / second.value
    errors = [np.log(np.array([one.low, one.high]) / one.value) for one in (first, second)]
    below, above = np.hypot(errors[0][0], errors[1][1]), np.hypot(errors[0][1], errors[1][0])
    count = min(first.count, second.count)
    return Estimate(value, float(value * np.exp(-below)), float(value * np.exp(above)), count, first.counted)


def _elastic_shares(heights: Array, spins: Array) -> Array:
    """Return the shares of twins with different faces where impacts lose nothing, in vacuum, (ε, touches)."""
    scenario = case(air=False, restitution=1.0)
    faces = touched_faces(scenario, heights, spins, ELASTIC_TOUCHES)
    return np.array(
        [
            np.mean(touched_faces(scenario, heights + step, spins, ELASTIC_TOUCHES) != faces, axis=0)
            for step in ELASTIC_STEPS
        ]
    )


def _elastic_claims(shares: Array, count: int, heights: Array, spins: Array) -> tuple[Claim, Claim]:
    """Return what becomes of "intermingled" where no impact loses energy."""
    scenario = case(air=False, restitution=1.0, max_impacts=MOST)
    outcome = analytic.toss_many(scenario, releases(heights[:count], spins[:count])).outcome
    ended = int(np.sum((outcome == Outcome.HEADS) | (outcome == Outcome.TAILS)))
    halves = [int(np.argmax(row > HALF)) if np.any(row > HALF) else -1 for row in shares]
    mixed = ", ".join(
        f"{step:.0e} m after {n}" for step, n in zip(ELASTIC_STEPS, halves, strict=True) if n >= 0
    )
    return (
        Claim(
            claim="with χ = 1 and no air the basins of heads and tails are intermingled",
            analytic=f"{ended} of {count} tosses end within {MOST} impacts",
            missing="no toss ends, so there are no basins; after n impacts each face has stripes",
            expected=None,
        ),
        Claim(
            claim="(instead) after enough impacts the faces of twins are independent, however near they are",
            analytic=f"{HALF:.0%} of the twins differ from impacts on that grow with ln(1/ε): {mixed}",
            criteria=[
                Criterion(
                    f"share that differs after {ELASTIC_TOUCHES - 1} impacts, ε = {step:.0e} m, less 1/2",
                    _less_half(share(np.arange(count) < round(row[-1] * count), "twins")),
                    "within ±",
                    0.1,
                    "1/2 is chance",
                )
                for step, row in zip(ELASTIC_STEPS, shares, strict=True)
            ],
        ),
    )


HALF = 0.4
"""A share of twins that differ: nearly chance."""


def _less_half(one: Estimate) -> Estimate:
    return replace(one, value=one.value - 1 / 2, low=one.low - 1 / 2, high=one.high - 1 / 2)


def _same_by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Return how many faces agree with MuJoCo's after each of `SHOWN` impacts, in words."""
    faces, start = touched_faces(scenario, heights, spins, TOUCHES), releases(heights, spins)
    same = []
    for n in SHOWN:
        once_more = scenario.replace("ending", EndingCriteria(max_impacts=n + 1))
        same.append(
            np.sum(coin_mj.toss_many(once_more, start, settings=coin_mj.FINE).after(n) == faces[:, n])
        )
    impacts = ", ".join(map(str, SHOWN))
    return f"{', '.join(map(str, same))} of {len(heights)} faces alike after {impacts} impacts"


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Fig. 31, section 5.3",
    title="the face after 0, 2, 5 and 9 impacts; boundaries against the number of impacts",
    assumed=(
        "Axes and the line are unsaid; here the ranges of Fig. 29, and all lines of constant spin through "
        "them. After two impacts no grid is fine enough to count on. So random tosses have twins ε higher: "
        "of N boundaries on a line of length L a part N ε/L lies between the two, while ε is below the width "
        "of the stripes. Twins at ε can show L/2ε boundaries and no more; N(n) is taken as counted where ten "
        "times finer twins count no more, and else as a lower bound."
    ),
    seconds=120,
    make=make,
    draw={"figure": _draw},
    quick_seconds=5,
    quick=partial(make, points=24, tosses=10_000, elastic=100, tosses_mujoco=10),
)
