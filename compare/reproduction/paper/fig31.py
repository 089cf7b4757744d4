"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import coin_mj
from compare.basins.picture import draw_panel
from compare.output.progress import Progress
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.runner import Reproduction, Result
from compare.reproduction.setups.planar_maps import (
    HEIGHT,
    HEIGHTS,
    MEDIA,
    SPIN,
    SPINS,
    case,
    releases,
    touched_faces,
    whole_grid,
)
from models.records import Array
from models.scenario import EndingCriteria, Scenario

SHOWN = (0, 2, 5, 9)
TOUCHES = 10
"""Faces are compared after 0 to so many impacts, less one."""
RESOLUTIONS = 10.0 ** -np.arange(2, 11)
"""ε, distances of nearby tosses [m]."""
FEWEST = 8
"""Nearby tosses that must differ for a number of boundaries."""
LABELLED = 5
"""Numbers of impacts whose lines in the picture are labelled."""
ELASTIC_TOUCHES = 16
"""Faces are compared so often where no impact loses energy."""
LENGTH = HEIGHTS[1] - HEIGHTS[0]
SEED = 31


def make(
    progress: Progress, points: int = 64, tosses: int = 6000, elastic: int = 1000, tosses_mujoco: int = 100
) -> Result:
    """Map the face after each number of impacts, and count nearby tosses that differ."""
    grid = whole_grid(points)
    z, w = (part.ravel() for part in np.meshgrid(grid.heights, grid.spins))
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    data: dict[str, NDArray[Any]] = {"resolution": RESOLUTIONS}
    claims: list[Claim] = []
    done, whole = 0, len(MEDIA) * (len(RESOLUTIONS) + 1) + 2
    same = _same_by_mujoco(case(air=True), heights[:tosses_mujoco], spins[:tosses_mujoco])
    progress(done := done + 1, whole)
    for medium in MEDIA:
        scenario = case(air=medium == "air")
        maps = touched_faces(scenario, z, w, TOUCHES)
        for n in SHOWN:
            data[f"{medium}, map {n}"] = maps[:, n].reshape(grid.shape)
        progress(done := done + 1, whole)
        faces = touched_faces(scenario, heights, spins, TOUCHES)
        differ = []
        for step in RESOLUTIONS:
            differ.append(np.sum(touched_faces(scenario, heights + step, spins, TOUCHES) != faces, axis=0))
            progress(done := done + 1, whole)
        # Between two nearby tosses one boundary lies at most, where ε is small: N = (L/ε) P.
        N = np.array(differ) / tosses * (LENGTH / RESOLUTIONS)[:, None]
        best = [int(np.flatnonzero(column >= FEWEST).max(initial=0)) for column in np.array(differ).T]
        counted = np.array([N[i, n] for n, i in enumerate(best)])
        early, late = counted[2] / counted[0], counted[4] / counted[2]
        data |= {f"{medium}, boundaries": N, f"{medium}, best": counted}
        claims += [
            Claim(
                claim=f"the more impacts, the more boundaries (in {medium})",
                analytic=f"a line through the map crosses {_numbers(counted[:6])} after 0 to 5 impacts",
                mujoco=f"{same} of {tosses_mujoco} faces alike after {', '.join(map(str, SHOWN))} impacts"
                if medium == "air"
                else "-",
                criteria=[
                    Criterion(
                        "least growth from one impact to the next",
                        (counted[1:6] / counted[:5]).min(),
                        ">",
                        1,
                        "their number grows",
                    )
                ],
            ),
            Claim(
                claim=f"their number grows faster than exponentially (in {medium})",
                analytic=(
                    f"{early:.0f}-fold over the first two impacts, {late:.0f}-fold over the next two; were "
                    "it exponential, both would be alike"
                ),
                criteria=[
                    Criterion(
                        "growth over the third and fourth impact",
                        late,
                        ">",
                        early,
                        "that over the first two, as an exponential has it",
                    )
                ],
                expected=False,
            ),
        ]
    air = data["air, boundaries"]
    claims += [
        Claim(
            claim="the end of the toss stops the multiplication",
            analytic=(
                f"with air N seen at {RESOLUTIONS[4]:.0e} m is {air[4, 6]:.3g}, {air[4, 7]:.3g}, "
                f"{air[4, 8]:.3g}, {air[4, 9]:.3g} after 6 to 9 impacts"
            ),
            criteria=[
                Criterion(
                    "change of N from 7 to 9 impacts", abs(air[4, 9] / air[4, 7] - 1), "<", 0.1, "it stopped"
                )
            ],
        ),
        Claim(
            claim="stripes become narrower than any hand is accurate (section 5.3)",
            analytic=f"{LENGTH / air[-2, -1]:.0e} m wide on average, or less, after {TOUCHES - 1} impacts",
            criteria=[
                Criterion("mean width [m]", LENGTH / air[-2, -1], "<", 1e-6, "a hand errs by more than 1 µm")
            ],
        ),
        _elastic(heights[:elastic], spins[:elastic]),
    ]
    progress(whole, whole)
    return Result(claims=claims, data=data)


def _numbers(values: Array) -> str:
    return ", ".join(f"{float(f'{value:.1g}'):,.0f}" for value in values)


def _elastic(heights: Array, spins: Array) -> Claim:
    """Follow nearby tosses at the finest resolution where impacts lose nothing, and without air."""
    scenario, finest = case(air=False, restitution=1.0), float(RESOLUTIONS[-1])
    faces, nearby = (touched_faces(scenario, heights + step, spins, ELASTIC_TOUCHES) for step in (0, finest))
    shares = np.mean(faces != nearby, axis=0)
    return Claim(
        claim="with χ = 1 and no air heads and tails are intermingled in the limit of many impacts",
        analytic=(
            f"of tosses {finest:.0e} m apart {shares[4]:.1%}, {shares[9]:.0%} and {shares[-1]:.0%} show "
            f"different faces after 4, 9 and {ELASTIC_TOUCHES - 1} impacts"
        ),
        criteria=[
            Criterion("share at last", shares[-1], ">", 0.4, "1/2 where heads and tails are intermingled")
        ],
    )


def _same_by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Return how many faces agree with MuJoCo's after each of `SHOWN` impacts, in words."""
    faces, start = touched_faces(scenario, heights, spins, TOUCHES), releases(heights, spins)
    same = []
    for n in SHOWN:
        once_more = scenario.replace("ending", EndingCriteria(max_impacts=n + 1))
        same.append(
            np.sum(coin_mj.toss_many(once_more, start, settings=coin_mj.FINE).after(n) == faces[:, n])
        )
    return ", ".join(map(str, same))


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(10, 7.5))
    halves = picture.add_gridspec(2, 1, height_ratios=(2, 1.1))
    maps, numbers = (picture.add_subfigure(half) for half in halves)
    for row, medium in zip(maps.subplots(2, len(SHOWN), sharex=True, sharey=True), MEDIA, strict=True):
        for axes, n in zip(row, SHOWN, strict=True):
            draw_panel(axes, data[f"{medium}, map {n}"], x=HEIGHT, y=SPIN)
            axes.set_title(f"n = {n}, in {medium}")
            axes.grid(visible=False)
            axes.label_outer()
    seen, growth = numbers.subplots(1, 2)
    for n in range(TOUCHES):
        N = np.where(data["air, boundaries"][:, n] > 0, data["air, boundaries"][:, n], np.nan)
        seen.loglog(data["resolution"], N, ".-", color=MEDIA["air"], linewidth=0.9)
        if n < LABELLED:
            finest = np.flatnonzero(N > 0)[-1]
            at = (data["resolution"][finest], N[finest])
            seen.annotate(f"n = {n}", at, (-4, 0), textcoords="offset points", ha="right", va="center")
    seen.set(title="as seen with a resolution ε, in air", xlabel="ε [m]", ylabel="boundaries N on a line")
    seen.set_xlim(RESOLUTIONS[-1] / 10, None)
    for medium, color in MEDIA.items():
        growth.semilogy(data[f"{medium}, best"], "o-", color=color, label=medium)
    growth.set(title="as seen with the finest ε", xlabel="impacts n", ylabel="boundaries N on a line")
    growth.legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Fig. 31, section 5.3",
    title="the face after 0, 2, 5 and 9 impacts; boundaries against the number of impacts",
    assumed=(
        "Axes and the line are unsaid; here the ranges of Fig. 29, and all lines of constant spin through "
        "them. After two impacts no grid is fine enough to count on. So random tosses are made again ε "
        "higher: of N boundaries on a line of length L a part N ε/L lies between the two, while "
        "ε is below the width of the stripes. Where N still grows with falling ε, as from n = 4 on, it is a "
        "lower bound."
    ),
    seconds=40,
    make=make,
    draw={"figure": _draw},
    quick_seconds=9,
    quick=partial(make, points=40, tosses=500, elastic=100, tosses_mujoco=10),
)
