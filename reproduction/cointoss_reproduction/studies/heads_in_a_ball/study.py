"""Section 5.2: the probability of heads in a ball about a release, as the ball shrinks."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from cointoss import Outcome, Scenario, analytic
from cointoss.study import Answers, Array, Estimate, rows_from_states, share
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import jackknife, mean_share
from cointoss_reproduction.setups.halving import halved
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows, toss_rows_by_mujoco

SEED = 52
RADII = 10.0 ** -np.arange(1, 13)
"""ε, of the balls; lengths are measured by r, speeds by √(g r), angles in rad, spins by √(g/r)."""
MUJOCO_RADIUS = 1e-12
REACH, SAMPLES = 0.1, 200
"""How far up a boundary is sought [m], and at how many heights."""
FEW = 20
"""The number of tosses from each of many balls."""
INSIDE, BORDER, MANY = "inside a basin", "on a boundary", "of many"
"""The names of the releases in the middles of the balls."""


def tossed(centers: int = 10, count: int = 150, many: int = 300, tosses_mujoco: int = 100) -> Iterator[Rows]:
    """Toss from balls about random releases, and about releases on boundaries."""
    scenario, rng = case(air=True), np.random.default_rng(SEED)

    def heads_in(point: Array, radius: float, tosses: int, toss_rows: _Tossing = analytic.toss_rows) -> float:
        outcome = toss_rows(ball_about(scenario, point[0], point[1], radius, tosses, rng)).outcome
        return float(np.mean(outcome == Outcome.HEADS))

    inside = _releases(rng, centers)
    border = np.array([[boundary_above(scenario, z, w), w] for z, w in inside])
    for kind, points in ((INSIDE, inside), (BORDER, border)):
        for number, point in enumerate(points):
            heads = [heads_in(point, radius, count) for radius in RADII]
            yield pd.DataFrame({"about": kind, "release": number, "radius": RADII, "heads": heads})
    yield {"by_mujoco": heads_in(inside[0], MUJOCO_RADIUS, tosses_mujoco, toss_rows_by_mujoco)}
    others = _releases(rng, many)
    for radius in (RADII[-1], RADII[0]):
        heads = [heads_in(point, radius, FEW) for point in others]
        yield pd.DataFrame({"about": MANY, "radius": radius, "heads": heads})


_Tossing = Callable[[Array], Answers]


def _releases(rng: np.random.Generator, count: int) -> Array:
    """Draw heights and spins of releases of the map, (n, 2)."""
    return np.column_stack([rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count)])


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name, from prob(heads) in the balls."""
    smallest, largest = (
        {about: rows.heads.to_numpy() for about, rows in cells[cells.radius == radius].groupby("about")}
        for radius in (RADII[-1], RADII[0])
    )
    pure = cells[cells.about == INSIDE].pivot(index="release", columns="radius", values="heads").isin([0, 1])
    return {
        "pure_ball": share(np.isin(smallest[MANY], [0, 1]), "releases"),
        "by_hand": mean_share(largest[MANY], "releases"),
        "scatter": _scatter(largest[MANY]),
        # The largest radius up to which only one side comes up.
        "first": pure.cumprod(axis=1).mul(pure.columns).max(axis=1),
        "at_border": mean_share(smallest[BORDER], "boundaries"),
        "even": smallest[BORDER],
        "sure": smallest[INSIDE][0],
        "by_hand_range": largest[INSIDE],
        "height_mm": 1e3 * RADII[0] * case(air=True).coin.radius,
    }


def boundary_above(scenario: Scenario, height: float, spin: float) -> float:
    """Find a boundary above a release of the map, to rounding.

    Args:
        scenario: of the map.
        height: of the release [m].
        spin: of both, about ξ [rad/s].

    Returns:
        The height of the last double before the outcome changes [m].
    """

    def outcome(z: float) -> int:
        return int(analytic.toss_rows(planar_rows(scenario, np.array([z]), np.array([spin]))).outcome[0])

    line = np.linspace(height, height + REACH, SAMPLES)
    faces = analytic.toss_rows(planar_rows(scenario, line, np.full_like(line, spin))).outcome
    change = int(np.flatnonzero(faces[1:] != faces[:-1])[0])
    return halved(float(line[change]), float(line[change + 1]), outcome)[0]


def ball_about(
    scenario: Scenario, height: float, spin: float, radius: float, count: int, rng: np.random.Generator
) -> Array:
    """Draw tosses, as rows, whose releases are uniform in a ball about one of the map; twelve numbers vary.

    Args:
        scenario: of the map.
        height: of the centre [m].
        spin: of the centre, about ξ [rad/s].
        radius: in the units of `RADII`.
        count: how many.
        rng: the source of chance.

    Returns:
        The tosses, (count, m).
    """
    r, g = scenario.coin.radius, scenario.gravity
    drawn = rng.normal(size=(count, 12))
    drawn *= radius * rng.uniform(0, 1, (count, 1)) ** (1 / 12) / np.linalg.norm(drawn, axis=1, keepdims=True)
    place, speed, turn, spins = np.split(drawn, 4, axis=1)
    parts = (
        np.array([0, 0, height]) + r * place,
        np.sqrt(g * r) * speed,
        Rotation.from_rotvec(turn).as_quat(scalar_first=True),
        np.array([spin, 0, 0]) + np.sqrt(g / r) * spins,
    )
    return rows_from_states(scenario, np.hstack(parts))


def _scatter(heads: Array) -> Estimate:
    """Return the standard deviation of prob(heads) between balls, less what counting adds."""

    def spread(kept: NDArray[np.bool_]) -> float:
        p = heads[kept]
        return float(np.sqrt(max(p.var(ddof=1) - np.mean(p * (1 - p)) / (FEW - 1), 0)))

    return jackknife(spread, len(heads), "releases")


REPRODUCTION = study(__name__, Cells(tossed, {}), found=found)
