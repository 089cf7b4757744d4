"""Section 5.2: the probability of heads in a ball about a release, as the ball shrinks."""

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from cointoss import Outcome, Scenario, analytic
from cointoss.study import (
    BLUE,
    GREY,
    VERMILION,
    Answers,
    Array,
    Estimate,
    Progress,
    jackknife,
    mean_share,
    rows_from_states,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.halving import halved
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows, toss_rows_by_mujoco

SEED = 52
RADII = 10.0 ** -np.arange(1, 13)
"""ε, of the balls; lengths are measured by r, speeds by √(g r), angles in rad, spins by √(g/r)."""
MUJOCO_RADIUS = 1e-12
REACH, SAMPLES = 0.1, 200
"""How far up a boundary is sought [m], and at how many heights."""
FEW = 20
"""Tosses from each of many balls."""
KINDS = {"inside a basin": BLUE, "on a boundary": VERMILION}


def make(
    progress: Progress, centers: int = 10, count: int = 150, many: int = 300, tosses_mujoco: int = 100
) -> Findings:
    """Toss from balls about random releases, and about releases on boundaries."""
    found = Findings()
    scenario = case(air=True)
    rng = np.random.default_rng(SEED)
    inside = np.column_stack([rng.uniform(*HEIGHTS, centers), rng.uniform(*SPINS, centers)])
    border = np.array([[boundary_above(scenario, z, w), w] for z, w in inside])
    heads: dict[str, Array] = {}
    for kind, points in zip(KINDS, (inside, border), strict=True):
        rows = []
        for z, w in points:
            balls = [ball_about(scenario, z, w, radius, count, rng) for radius in RADII]
            rows.append(_heads_in(balls))
            progress(len(heads) * centers + len(rows), 2 * centers + 2)
        heads[kind] = np.array(rows)
    z, w = inside[0]
    ball = ball_about(scenario, z, w, MUJOCO_RADIUS, tosses_mujoco, rng)
    found.mujoco = float(_heads_in([ball], toss_rows_by_mujoco)[0])
    progress(2 * centers + 1, 2 * centers + 2)
    others = np.column_stack([rng.uniform(*HEIGHTS, many), rng.uniform(*SPINS, many)])
    alike = {
        radius: _heads_in([ball_about(scenario, z, w, radius, FEW, rng) for z, w in others])
        for radius in (RADII[-1], RADII[0])
    }
    found.pure_ball = share((alike[RADII[-1]] == 0) | (alike[RADII[-1]] == 1), "releases")
    found.by_hand = mean_share(alike[RADII[0]], "releases")
    progress(2 * centers + 2, 2 * centers + 2)
    sure, even = heads.values()
    pure = (sure == 0) | (sure == 1)
    # The largest radius up to which only one side comes up.
    found.first = RADII[[len(RADII) - int(np.argmin([*row[::-1], False])) for row in pure]]
    found.at_border = mean_share(even[:, -1], "boundaries")
    found.sure, found.even = sure, even.T
    found.height_mm, found.by_hand_range = 1e3 * RADII[0] * scenario.coin.radius, sure[:, 0]
    found.scatter = _scatter(alike[RADII[0]])
    found.data = {"radius": RADII, "release": inside, "boundary": border, **heads}
    return found


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
        The tosses, (count, 46).
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


def _heads_in(balls: list[Array], toss_rows: Callable[[Array], Answers] = analytic.toss_rows) -> Array:
    """Return prob(heads) in each of some balls, from the tosses of each, as many in all."""
    outcomes = toss_rows(np.concatenate(balls)).outcome
    return np.mean((outcomes == Outcome.HEADS).reshape(len(balls), -1), axis=1)


def _scatter(heads: Array) -> Estimate:
    """Return the standard deviation of prob(heads) between balls, less what counting adds."""

    def spread(kept: NDArray[np.bool_]) -> float:
        p = heads[kept]
        return float(np.sqrt(max(p.var(ddof=1) - np.mean(p * (1 - p)) / (FEW - 1), 0)))

    return jackknife(spread, len(heads), "releases")


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.4))
    for axes, (kind, color) in zip(picture.subplots(1, 2, sharey=True), KINDS.items(), strict=True):
        axes.semilogx(data["radius"], data[kind].T, ".-", color=color, linewidth=0.7)
        axes.axhline(0.5, color=GREY, linewidth=0.8)
        axes.set(title=f"about a release {kind}", xlabel="radius ε of the ball", ylim=(-0.03, 1.03))
        axes.invert_xaxis()
    picture.axes[0].set_ylabel("prob(heads)")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
