"""Figs 27 and 32: the rim points that a lossless coin touches with, and the exponents of their series."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from cointoss import Air, Scenario, load
from cointoss.coin_mj import impacts_of
from cointoss.study import Array, run, share, state_at_release
from cointoss_reproduction.frame.cells import Cells, Rows, column
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import mean
from cointoss_reproduction.setups.planar_maps import MEDIA
from cointoss_reproduction.studies.fig27.lyapunov import divergence, growth_by_tangent

PRINTED = {"air": 0.024, "vacuum": 0.08}
"""The paper's exponents."""
IMPACTS = 316
"""The paper's number of collisions in air."""
FIRST = 100
"""Impacts of the first part of the transient."""
SEED = 27
FOLLOWED = 10
"""Most tosses with other spins whose growth is followed, the vacuum's through `FOLLOWED_IMPACTS`."""
FOLLOWED_IMPACTS = 150
LONGEST = 60
"""Most steps of the series to which a line is fitted."""
FITTED = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 60)
"""The numbers of steps for which slopes are drawn."""
NUMBERED = 6
"""How many of the first impacts have their numbers drawn."""
LEAST = 20
"""The fewest neighbours whose quartiles are drawn."""
LONG = 20_000
"""Impacts of the toss in which near neighbours are sought."""
APART = 10.0 ** np.arange(-7, 1)
"""Bounds of the distances of neighbours [rad]."""
FUNCTION = 0.1
"""If φ(n + 1) is a function of φ(n), points nearer than `CLOSE` have images nearer than this [rad]."""
CLOSE = FUNCTION / 100
QUARTILES = (0.75, 0.5, 0.25)
OTHER_SPINS = "tosses of other spins"


def touch(medium: str, impacts_mujoco: int = 350) -> Iterator[Rows]:
    """Yield the angles of the rim points that touch [rad], and what MuJoCo's coin does, in words."""
    scenario = _case(medium)
    yield pd.DataFrame({"angle": _angles(scenario)})
    points = impacts_of(scenario.replace("ending.max_impacts", impacts_mujoco)).point
    slope = _slopes(divergence(_angle(points), 1, 12))[-1]
    told = f"{len(points)} impacts; a line through 13 points of its series rises by {slope:.2f}"
    yield {"mujoco": told}


def follow(medium: str, toss: int, followed: int = FOLLOWED) -> Iterator[Rows]:
    """Yield how the series of a toss grows; toss 0 is that of the figure, others have other spins.

    Yields:
        Its exponent per impact, also of the first impacts alone, not of toss 0; over how many steps a line
        has the printed slope; slopes.
    """
    if toss > followed:
        return
    scenario, grown = _case(medium), {}
    if toss:
        scenario = scenario.replace("release.angular_velocity", _spins(toss)[-1])
        shorter = scenario if medium == "air" else scenario.replace("ending.max_impacts", FOLLOWED_IMPACTS)
        growth = growth_by_tangent(shorter)
        grown = {"exponent": growth.mean(), "of_first": growth[:FIRST].mean()}
    slopes = _slopes(divergence(_angles(scenario), 1, LONGEST))
    yield {**grown, "as_printed": _steps_of(slopes, PRINTED[medium])}
    yield pd.DataFrame({"steps": FITTED, "slope": [slopes[steps - 1] for steps in FITTED]})


def count(others: int = 200) -> pd.DataFrame:
    """Return how many impacts tosses in air with other spins have."""
    cases = [_case("air").replace("release.angular_velocity", spin) for spin in _spins(others)]
    return pd.DataFrame({"impacts": [len(_angles(case)) for case in cases]})


def compare_neighbours() -> Iterator[Rows]:
    """Yield how far the φ(n + 1) of neighbours are apart in a long toss: of near ones, and quartiles."""
    near, images = _neighbours(_angles(_case("vacuum").replace("ending.max_impacts", LONG)))
    closest = images[near < CLOSE]
    close = share(closest < FUNCTION, "pairs of neighbours")
    yield {"closest": closest.size, "median_image": np.median(closest), "near_images": close}
    bins = np.digitize(near, APART)
    for number in range(1, len(APART)):
        within = images[bins == number]
        if within.size > LEAST:
            middle = np.sqrt(APART[number - 1] * APART[number])
            yield pd.DataFrame(
                {"quantile": QUARTILES, "distance": middle, "image": np.quantile(within, QUARTILES)}
            )


def _case(medium: str) -> Scenario:
    scenario = load("fig27")
    return scenario if medium == "air" else scenario.replace("air", Air())


def _spins(count: int) -> Array:
    return np.random.default_rng(SEED).uniform(-40, 40, (count, 3))


def _angles(scenario: Scenario) -> Array:
    """Return where on the rim the coin touches, (n,) [rad]."""
    return _angle(run(scenario.body, scenario.rules, state_at_release(scenario.release)).rows["point"])


def _angle(points: Array) -> Array:
    return np.arctan2(points[:, 1], points[:, 0])


def _neighbours(angles: Array) -> tuple[Array, Array]:
    """Return how far neighbours among the φ(n) are apart, and their φ(n + 1), (n - 2,) [rad]."""
    order = np.argsort(angles[:-1])
    after = np.diff(angles[1:][order])
    return np.diff(angles[:-1][order]), np.abs((after + np.pi) % (2 * np.pi) - np.pi)


def _slopes(curve: Array) -> Array:
    """Return the slopes of lines fitted to the first 1, 2, ... steps of a curve."""
    steps = np.arange(len(curve))
    return np.array([np.polyfit(steps[: k + 1], curve[: k + 1], 1)[0] for k in steps[1:]])


def _steps_of(slopes: Array, printed: float) -> int:
    """Return over how many steps a fitted slope is the printed one."""
    return int(np.argmin(np.abs(slopes - printed))) + 1


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    of = {medium: f"medium == '{medium}'" for medium in MEDIA}
    exponent = {medium: mean(column(cells, "exponent", where), OTHER_SPINS) for medium, where in of.items()}
    first, all_impacts = (column(cells, name, of["air"]) for name in ("of_first", "exponent"))
    counts = column(cells, "impacts")
    rare = np.abs(counts - counts.mean()) >= abs(IMPACTS - counts.mean())
    mujoco = {medium: column(cells, "mujoco", where).item() for medium, where in of.items()}
    return {
        "exponent": exponent,
        "fading": mean(first - all_impacts, OTHER_SPINS),
        "times_printed": {medium: one.value / PRINTED[medium] for medium, one in exponent.items()},
        "impacts": len(column(cells, "angle", of["air"])),
        "counts": counts,
        "as_far": share(rare, OTHER_SPINS),
        "mujoco": mujoco,
        "impacts_mujoco": mujoco["air"].split(";")[0],
    }


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(7, 6))
    grid = picture.add_gridspec(2, 2)
    for row, (medium, color) in enumerate(MEDIA.items()):
        angles = column(cells, "angle", f"medium == '{medium}'")
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
    return picture


MEDIUM = {"medium": tuple(MEDIA)}
REPRODUCTION = study(
    __name__,
    Cells(touch, MEDIUM),
    Cells(follow, {**MEDIUM, "toss": range(FOLLOWED + 1)}),
    Cells(count, {}),
    Cells(compare_neighbours, {}),
    found=_found,
    draw={"figure": _draw},
)
