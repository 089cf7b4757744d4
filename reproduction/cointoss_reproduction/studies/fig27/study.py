"""Figs 27 and 32: the rim points that a lossless coin touches with, and the exponents of their series."""

import itertools

import numpy as np
from matplotlib.figure import Figure

from cointoss import Air, Scenario, load
from cointoss.coin_mj import impacts_of
from cointoss.study import (
    GREY,
    VERMILION,
    Array,
    Progress,
    divergence,
    growth_by_tangent,
    mean,
    run,
    share,
    state_at_release,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import MEDIA

PRINTED = {"air": 0.024, "vacuum": 0.08}
"""The paper's exponents."""
IMPACTS = 316
"""The paper's number of collisions in air."""
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
CLOSE = FUNCTION / 100


def make(
    progress: Progress, others: int = OTHERS, followed: int = FOLLOWED, impacts_mujoco: int = 350
) -> Findings:
    """Follow the coin in air and in vacuum, with other spins too, and MuJoCo's coin."""
    with_air = load("fig27")
    cases = {"air": with_air, "vacuum": with_air.replace("air", Air())}
    spins = np.random.default_rng(SEED).uniform(-40, 40, (others, 3))
    data: Data = {}
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
    return _findings(data, mujoco)


def _findings(data: Data, mujoco: dict[str, str]) -> Findings:
    tosses = "tosses of other spins"
    exponent = {medium: mean(data[f"{medium}, growth"][:, 0], tosses) for medium in MEDIA}
    of_first = data["air, growth"][:, 1] - data["air, growth"][:, 0]
    counts, near = data["impacts with other spins"], data["neighbours"]
    closest = data["images"][near < CLOSE]
    rare = np.abs(counts - counts.mean()) >= abs(IMPACTS - counts.mean())
    steps = {medium: _steps_of(data[f"{medium}, slopes"], PRINTED[medium]) for medium in MEDIA}
    return Findings(
        data=data,
        mujoco=mujoco,
        exponent=exponent,
        fading=mean(of_first, tosses),
        closest=closest,
        median_image=np.median(closest),
        near_images=share(closest < FUNCTION, "pairs of neighbours"),
        times_printed={medium: exponent[medium].value / PRINTED[medium] for medium in MEDIA},
        steps=steps,
        impacts=len(data["air, angle"]),
        counts=counts,
        impacts_mujoco=mujoco["air"].split(";")[0],
        as_far=share(rare, tosses),
    )


def _points(scenario: Scenario) -> Array:
    """Return the rim points that touch, (n, 3) [m]."""
    return run(scenario.body, scenario.rules, state_at_release(scenario.release)).rows["point"]


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


def _draw(data: Data) -> Figure:
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
        slope.axhline(PRINTED[medium], color=color, linestyle=":")
        slope.annotate(f"printed: {PRINTED[medium]}", (1.1, 1.1 * PRINTED[medium]), color=color)
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
