"""Figs 27 and 32: the rim points that a lossless coin touches with, and the exponents of their series."""

import itertools
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss.analytic.events import run
from cointoss.analytic.toss import state_of
from cointoss.coin_mj.toss import impacts_of
from cointoss.compare.metrics.lyapunov import divergence, growth_by_tangent
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import GREY, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.estimates import mean, share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.planar_maps import MEDIA
from cointoss.models.parts import Air
from cointoss.models.reading import load
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

PRINTED = {"air": (0.024, 316), "vacuum": (0.08, 700)}
"""The paper's exponents and numbers of collisions."""
FIRST = 100
"""Impacts of the first part of the transient."""
OTHERS, SEED = 200, 27
"""Tosses with other spins, whose impacts are counted."""
FOLLOWED = 10
"""Of those, tosses whose growth is followed, the vacuum's through `FOLLOWED_IMPACTS`."""
FOLLOWED_IMPACTS = 150
LONGEST = 60
"""Most steps of the series to which a line is fitted."""
NUMBERED = 6
"""First impacts whose numbers are drawn."""
LEAST = 20
"""Neighbours of which quartiles are drawn, or more."""
LONG = 20_000
"""Impacts of the toss in which near neighbours are sought."""
APART = 10.0 ** np.arange(-7, 1)
"""Bounds of the distances of neighbours [rad]."""
FUNCTION = 0.1
"""Where φ(n + 1) is a function of φ(n), points that are so near have images nearer than this [rad]."""


def make(
    progress: Progress, others: int = OTHERS, followed: int = FOLLOWED, impacts_mujoco: int = 350
) -> Result:
    """Follow the coin in air and in vacuum, with other spins too, and MuJoCo's coin."""
    with_air = load("fig27")
    cases = {"air": with_air, "vacuum": with_air.replace("air", Air())}
    spins = np.random.default_rng(SEED).uniform(-40, 40, (others, 3))
    data: dict[str, NDArray[Any]] = {}
    mujoco = {}
    whole, done = len(cases) * (1 + followed) + 2, 0
    for medium, scenario in cases.items():
        data[f"{medium}, angle"] = angles = _angles(_points(scenario))
        by_mujoco = _angles(impacts_of(scenario.replace("ending.max_impacts", impacts_mujoco)).point)
        mujoco[medium] = f"{len(by_mujoco)} impacts; a line through 13 points of its series rises by " + (
            f"{_slopes(divergence(by_mujoco, 1, 12))[-1]:.2f}"
        )
        progress(done := done + 1, whole)
        shorter = scenario if medium == "air" else scenario.replace("ending.max_impacts", FOLLOWED_IMPACTS)
        growths, slopes = [], [_slopes(divergence(angles, 1, LONGEST))]
        for spin in spins[:followed]:
            spun = "release.angular_velocity", spin
            growth = growth_by_tangent(shorter.replace(*spun))
            growths.append((growth.mean(), growth[:FIRST].mean()))
            slopes.append(_slopes(divergence(_angles(_points(scenario.replace(*spun))), 1, LONGEST)))
            progress(done := done + 1, whole)
        data |= {f"{medium}, growth": np.array(growths), f"{medium}, slopes": np.array(slopes)}
    data["impacts with other spins"] = np.array(
        [len(_points(with_air.replace("release.angular_velocity", spin))) for spin in spins]
    )
    progress(done := done + 1, whole)
    near, images = _neighbours(_angles(_points(cases["vacuum"].replace("ending.max_impacts", LONG))))
    data |= {"neighbours": near, "images": images}
    progress(done + 1, whole)
    return Result(claims=_claims(data, mujoco), data=data)


def _claims(data: dict[str, NDArray[Any]], mujoco: dict[str, str]) -> tuple[Claim, ...]:
    tosses = "tosses of other spins"
    exponent = {medium: mean(data[f"{medium}, growth"][:, 0], tosses) for medium in PRINTED}
    of_first = data["air, growth"][:, 1] - data["air, growth"][:, 0]
    counts, images, near = data["impacts with other spins"], data["images"], data["neighbours"]
    closest = images[near < FUNCTION / 100]
    rare = np.abs(counts - counts.mean()) >= abs(PRINTED["air"][1] - counts.mean())
    steps = {medium: _steps_of(data[f"{medium}, slopes"], PRINTED[medium][0]) for medium in PRINTED}
    return (
        Claim(
            claim="without air, with χ = 1, neighbouring tosses part exponentially (Fig. 32)",
            analytic="by the tangent map, over the tosses of other spins",
            mujoco=mujoco["vacuum"],
            criteria=[Criterion("largest exponent per impact", exponent["vacuum"], ">", 0, "chaos")],
        ),
        Claim(
            claim="with air the chaos is transient (Fig. 27)",
            analytic=f"{exponent['air'].value:.2f} per impact until the coin rests",
            mujoco=mujoco["air"],
            criteria=[
                Criterion(
                    f"exponent over the first {FIRST} impacts, less that over all",
                    mean(of_first, tosses),
                    ">",
                    0,
                    "it fades",
                )
            ],
        ),
        Claim(
            claim="U maps the point that hits the floor to the next one: φ(n + 1) is a function of φ(n)",
            analytic=(
                f"of {LONG:,d} impacts {len(closest):,d} have φ(n) within {FUNCTION / 100:g} rad of a "
                f"neighbour's, and half of these φ(n + 1) more than {np.median(closest):.1f} rad from its: "
                "the next point depends on all speeds and spins too"
            ),
            criteria=[
                Criterion(
                    f"share of their φ(n + 1) within {FUNCTION:g} rad",
                    share(closest < FUNCTION, "pairs of neighbours"),
                    ">",
                    0.9,
                    "all, but at jumps of the function",
                )
            ],
            expected=False,
        ),
        Claim(
            claim="the largest exponents are 0.024 with air and 0.08 without (per impact)",
            analytic=" and ".join(
                f"{exponent[medium].value / printed:.0f} times the printed one in {medium}"
                for medium, (printed, _) in PRINTED.items()
            ),
            criteria=[
                Criterion(
                    f"exponent per impact in {medium}", exponent[medium], "=", printed, "the printed one"
                )
                for medium, (printed, _) in PRINTED.items()
            ],
            expected=False,
        ),
        Claim(
            claim="the printed exponents are slopes of the mean distance of neighbours in the series",
            analytic=(
                "neighbours are as far apart as any two points after one or two impacts, so a line through K "
                "steps rises by about 6/K² of that; "
                + ", ".join(
                    f"{printed} in {medium} is the slope over K = {steps[medium][0]:.0f} "
                    f"({steps[medium][1]:.0f} to {steps[medium][2]:.0f})"
                    for medium, (printed, _) in PRINTED.items()
                )
            ),
            missing="the paper does not say how it found the exponents, nor over how many steps",
            expected=None,
        ),
        Claim(
            claim="with air the coin comes to rest after 316 collisions",
            analytic=(
                f"{len(data['air, angle'])} impacts, with other spins {counts.min()} to {counts.max()}: "
                "where the air has taken all energy that could turn the coin over"
            ),
            mujoco=mujoco["air"].split(";")[0],
            criteria=[
                # One count is chaotic: another rounding gives another one.
                Criterion(
                    "share of the spins whose number is as far from their mean",
                    share(rare, tosses),
                    ">",
                    0.05,
                    "one in 20 is",
                )
            ],
        ),
    )


def _points(scenario: Scenario) -> Array:
    """Return the rim points that touch, (n, 3) [m]."""
    return run(scenario.body, scenario.rules, state_of(scenario.release)).rows["point"]


def _slopes(curve: Array) -> Array:
    """Return the slopes of lines fitted to the first 1, 2, ... steps of a curve."""
    steps = np.arange(len(curve))
    return np.array([np.polyfit(steps[: k + 1], curve[: k + 1], 1)[0] for k in steps[1:]])


def _steps_of(slopes: Array, printed: float) -> tuple[float, float, float]:
    """Return over how many steps a fitted slope is the printed one: median, least and most of all tosses."""
    steps = np.argmin(np.abs(slopes - printed), axis=1) + 1
    return float(np.median(steps)), float(steps.min()), float(steps.max())


def _neighbours(angles: Array) -> tuple[Array, Array]:
    """Return how far neighbours among the φ(n) are apart, and their φ(n + 1), (n - 2,) [rad]."""
    order = np.argsort(angles[:-1])
    apart = np.diff(angles[:-1][order])
    after = np.diff(angles[1:][order])
    return apart, np.abs((after + np.pi) % (2 * np.pi) - np.pi)


def _angles(points: Array) -> Array:
    return np.arctan2(points[:, 1], points[:, 0])


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(10, 6))
    grid = picture.add_gridspec(2, 3)
    for row, (medium, color) in enumerate(MEDIA.items()):
        angles = data[f"{medium}, angle"]
        rim = picture.add_subplot(grid[row, 0], projection="polar")
        rim.plot(angles, np.ones_like(angles), ".", color=color, markersize=3)
        for n, angle in enumerate(angles[:NUMBERED], start=1):
            rim.annotate(str(n), (angle, 1.13), ha="center", va="center", fontsize=8)
        rim.set(ylim=(0, 1.2), yticks=[], title=f"in {medium}: {len(angles)} rim points")
        rim.set_xticklabels([])
        back = picture.add_subplot(grid[row, 1])
        turned = np.degrees(angles) % 360
        back.plot(turned[:-1], turned[1:], ".", color=color, markersize=3)
        back.set(xlabel="φ(n) [°]", ylabel="φ(n + 1) [°]", aspect="equal", xlim=(0, 360), ylim=(0, 360))
    slope = picture.add_subplot(grid[0, 2])
    steps = np.arange(1, LONGEST + 1)
    for medium, color in MEDIA.items():
        slopes = data[f"{medium}, slopes"]
        slope.fill_between(steps, slopes.min(axis=0), slopes.max(axis=0), color=color, alpha=0.2, linewidth=0)
        slope.loglog(steps, np.median(slopes, axis=0), color=color, label=f"in {medium}")
        slope.axhline(PRINTED[medium][0], color=color, linestyle=":")
        slope.annotate(f"printed: {PRINTED[medium][0]}", (1.1, 1.1 * PRINTED[medium][0]), color=color)
    slope.set(title="slope of the series", xlabel="steps fitted, K", ylabel="slope per impact")
    slope.legend()
    map_of_circle = picture.add_subplot(grid[1, 2])
    near, images = data["neighbours"], data["images"]
    middles, medians = [], []
    for low, high in itertools.pairwise(APART):
        within = (near >= low) & (near < high)
        if within.sum() > LEAST:
            middles.append(np.sqrt(low * high))
            medians.append(np.quantile(images[within], (0.25, 0.5, 0.75)))
    low, middle, high = np.array(medians).T
    map_of_circle.loglog(middles, middle, "o-", color=VERMILION, label="quartiles found")
    map_of_circle.fill_between(middles, low, high, color=VERMILION, alpha=0.2, linewidth=0)
    map_of_circle.loglog(middles, 20 * np.array(middles), ":", color=GREY, label="a function, slope 20")
    map_of_circle.set(
        title="neighbours in vacuum", xlabel="distance of φ(n) [rad]", ylabel="distance of φ(n + 1) [rad]"
    )
    map_of_circle.legend(loc="lower right")
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 27, 32",
    title="the points of the rim that hit the floor: no map of the circle, and exponents of their series",
    assumed=(
        "Coin, height and spins are unsaid, as is how the exponents were found; here the thin coin of Fig. "
        "24 from 0.4 m with 10, 40.15 and 5 rad/s, and others with up to 40 rad/s about each axis. Intervals "
        "are over those spins. The number of impacts in air hardly depends on the spins, so 316 does not "
        "show which they were."
    ),
    seconds=150,
    make=make,
    draw={"figure": _draw},
    quick_seconds=12,
    quick=partial(make, others=20, followed=2, impacts_mujoco=60),
)
