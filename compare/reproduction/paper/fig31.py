"""Fig. 31, section 5.3: the face after 0, 2, 5 and 9 impacts, and how fast the boundaries multiply."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure as Picture
from numpy.typing import NDArray

import coin_mj
from compare.basins.picture import Axis, draw_panel
from compare.reproduction.findings import Finding, Result, paper_figure
from compare.reproduction.runner import Progress
from compare.reproduction.setups.planar_maps import HEIGHTS, SPINS, case, releases, touched_faces, whole_grid
from models.records import Array
from models.scenario import Ending, Scenario

MEDIA = {"air": "#0072B2", "vacuum": "#D55E00"}
SHOWN = (0, 2, 5, 9)
TOUCHES = 10
"""Faces are compared after 0 to so many impacts, less one."""
RESOLUTIONS = 10.0 ** -np.arange(2, 11)
"""ε, distances of the twins of a toss [m]."""
FEWEST = 8
"""Twins that must differ for a number of boundaries."""
LABELLED = 5
"""Numbers of impacts whose lines in the picture are told apart."""
ELASTIC_TOUCHES = 16
"""Faces are compared so often where no impact loses energy."""
LENGTH = HEIGHTS[1] - HEIGHTS[0]
SEED = 31
HEIGHT_AXIS = Axis(name="height", unit="m", start=HEIGHTS[0], stop=HEIGHTS[1])
SPIN_AXIS = Axis(name="spin", unit="rad/s", start=SPINS[0], stop=SPINS[1])


def make(
    progress: Progress, points: int = 64, tosses: int = 6000, elastic: int = 1000, tosses_mujoco: int = 100
) -> Result:
    """Map the face after each number of impacts, and count differing twins of random tosses."""
    grid = whole_grid(points)
    z, w = (part.ravel() for part in np.meshgrid(grid.heights, grid.spins))
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, tosses), rng.uniform(*SPINS, tosses)
    data: dict[str, NDArray[Any]] = {"resolution": RESOLUTIONS}
    findings = []
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
        # Between a toss and its twin one boundary lies at most, where ε is small: N = (L/ε) P.
        N = np.array(differ) / tosses * (LENGTH / RESOLUTIONS)[:, None]
        best = [int(np.flatnonzero(column >= FEWEST).max(initial=0)) for column in np.array(differ).T]
        counted = np.array([N[i, n] for n, i in enumerate(best)])
        early, late = counted[2] / counted[0], counted[4] / counted[2]
        data |= {f"{medium}, boundaries": N, f"{medium}, best": counted}
        findings += [
            Finding(
                claim=f"the more impacts, the more boundaries (in {medium})",
                ours=f"a line through the map crosses {_numbers(counted[:6])} after 0 to 5 impacts",
                mujoco=f"after {', '.join(map(str, SHOWN))} impacts {same} of {tosses_mujoco} faces as ours"
                if medium == "air"
                else "-",
                holds=np.all(np.diff(counted[:6]) > 0),
            ),
            Finding(
                claim=f"their number grows faster than exponentially (in {medium})",
                ours=(
                    f"{early:.0f}-fold over the first two impacts, {late:.0f}-fold over the next two; were "
                    "it exponential, both would be alike"
                ),
                holds=bool(late > early),
                expected=False,
            ),
        ]
    air = data["air, boundaries"]
    findings += [
        Finding(
            claim="the end of the toss stops the multiplication",
            ours=(
                f"with air N seen at {RESOLUTIONS[4]:.0e} m is {air[4, 6]:.3g}, {air[4, 7]:.3g}, "
                f"{air[4, 8]:.3g}, {air[4, 9]:.3g} after 6 to 9 impacts"
            ),
            holds=bool(abs(air[4, 9] / air[4, 7] - 1) < 0.1),
        ),
        Finding(
            claim="stripes become narrower than any hand is accurate (section 5.3)",
            ours=f"{LENGTH / air[-2, -1]:.0e} m wide on average, or less, after {TOUCHES - 1} impacts",
            holds=bool(LENGTH / air[-2, -1] < 1e-6),
        ),
        _elastic(heights[:elastic], spins[:elastic]),
    ]
    progress(whole, whole)
    return Result(findings=findings, draw=partial(_draw, data), data=data)


def _numbers(values: Array) -> str:
    return ", ".join(f"{float(f'{value:.1g}'):,.0f}" for value in values)


def _elastic(heights: Array, spins: Array) -> Finding:
    """Follow twins at the finest resolution where impacts lose nothing, and without air."""
    scenario, finest = case(air=False, restitution=1.0), float(RESOLUTIONS[-1])
    faces, twins = (touched_faces(scenario, heights + step, spins, ELASTIC_TOUCHES) for step in (0, finest))
    shares = np.mean(faces != twins, axis=0)
    return Finding(
        claim="with χ = 1 and no air heads and tails are intermingled in the limit of many impacts",
        ours=(
            f"of twins {finest:.0e} m apart {shares[4]:.1%}, {shares[9]:.0%} and {shares[-1]:.0%} show "
            f"different faces after 4, 9 and {ELASTIC_TOUCHES - 1} impacts"
        ),
        holds=bool(shares[-1] > 0.4),
    )


def _same_by_mujoco(scenario: Scenario, heights: Array, spins: Array) -> str:
    """Tell how many faces after each of `SHOWN` impacts MuJoCo gives as we do."""
    ours, start = touched_faces(scenario, heights, spins, TOUCHES), releases(heights, spins)
    same = []
    for n in SHOWN:
        once_more = scenario.replace("ending", Ending(max_impacts=n + 1))
        same.append(np.sum(coin_mj.toss_many(once_more, start, settings=coin_mj.FINE).after(n) == ours[:, n]))
    return ", ".join(map(str, same))


def _draw(data: dict[str, NDArray[Any]]) -> Picture:
    picture = Picture(figsize=(10, 7.5))
    halves = picture.add_gridspec(2, 1, height_ratios=(2, 1.1))
    maps, numbers = (picture.add_subfigure(half) for half in halves)
    for row, medium in zip(maps.subplots(2, len(SHOWN), sharex=True, sharey=True), MEDIA, strict=True):
        for axes, n in zip(row, SHOWN, strict=True):
            draw_panel(axes, data[f"{medium}, map {n}"], x=HEIGHT_AXIS, y=SPIN_AXIS)
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


FIGURE = paper_figure(
    paper="Fig. 31, section 5.3",
    title="the face after 0, 2, 5 and 9 impacts; boundaries against the number of impacts",
    assumed=(
        "Axes and the line are unsaid; here the ranges of Fig. 29, and all lines of constant spin through "
        "them. After two impacts no grid is fine enough to count on. So random tosses get twins released ε "
        "higher: of N boundaries on a line of length L a part N ε/L lies between a toss and its twin, while "
        "ε is below the width of the stripes. Where N still grows with falling ε, as from n = 4 on, it is a "
        "lower bound."
    ),
    seconds=40,
    make=make,
    quick_seconds=9,
    quick=partial(make, points=40, tosses=500, elastic=100, tosses_mujoco=10),
)
