"""The maps of Figs 29 to 31: faces of the planar thin coin over its release height and spin."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.analytic.runs import run
from cointoss.compare.basins.maps import OutcomeCodes
from cointoss.compare.basins.picture import MapAxis
from cointoss.compare.output.style import BLUE, VERMILION
from cointoss.models.outcomes import Outcomes
from cointoss.models.parts import Air
from cointoss.models.reading import load
from cointoss.models.records import Array
from cointoss.models.releases import Releases, states_of
from cointoss.models.scenario import Scenario

HEIGHTS, SPINS = (0.2, 0.6), (20.0, 60.0)
"""Ranges of the axes: release height [m] and spin about ξ [rad/s]."""
HEIGHT = MapAxis(name="height", unit="m", start=HEIGHTS[0], stop=HEIGHTS[1])
SPIN = MapAxis(name="spin", unit="rad/s", start=SPINS[0], stop=SPINS[1])
MEDIA = {"air": BLUE, "vacuum": VERMILION}
LANDINGS = {"soft floor": BLUE, "bouncing": VERMILION}
"""How a toss ends, at its first touch or after its bounces; both with the colours of their curves."""

toss_many_by_mujoco = partial(coin_mj.toss_many, settings=coin_mj.FINE)
"""MuJoCo's tosses where single ones are compared."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Grid:
    """Points of a map: every spin with every height."""

    heights: Array
    """(x) [m]."""
    spins: Array
    """(y) [rad/s]."""

    @property
    def releases(self) -> Releases:
        """All points, row by row, (y x)."""
        z, w = (part.ravel() for part in np.meshgrid(self.heights, self.spins))
        return releases(z, w)

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of a map, (y, x)."""
        return len(self.spins), len(self.heights)


def whole_grid(points: int) -> Grid:
    """Return the grid of a whole map with so many points along each side."""
    return Grid(heights=np.linspace(*HEIGHTS, points), spins=np.linspace(*SPINS, points))


def releases(heights: Array, spins: Array) -> Releases:
    """Return releases of the coin flat, heads up, at rest but for its spin about ξ; both arguments (n,)."""
    zero, one = np.zeros_like(heights), np.ones_like(heights)
    return Releases(
        position=np.stack([zero, zero, heights], axis=1),
        velocity=np.stack([zero, zero, zero], axis=1),
        quaternion=np.stack([one, zero, zero, zero], axis=1),
        angular_velocity=np.stack([spins, zero, zero], axis=1),
    )


def case(*, air: bool, restitution: float = 0.6, max_impacts: int | None = None) -> Scenario:
    """Return the scenario of the maps.

    Args:
        air: whether there is any.
        restitution: χ.
        max_impacts: as many as that end a toss, by default those of the scenario.
    """
    scenario = load("fig29")
    medium, most = scenario.air if air else Air(), max_impacts or scenario.ending.max_impacts
    return scenario.replace("air", medium, "floor.restitution", restitution, "ending.max_impacts", most)


def final_faces(scenario: Scenario, grid: Grid) -> OutcomeCodes:
    """Return the map of the outcomes, (y, x)."""
    return analytic.toss_many(scenario, grid.releases).outcome.reshape(grid.shape)


def faces_after(
    scenario: Scenario,
    points: Releases,
    impacts: int,
    toss_many: Callable[[Scenario, Releases], Outcomes] = analytic.toss_many,
) -> NDArray[np.int8]:
    """Return the face up at the touch after n impacts, the outcome where the toss ended before, (n,)."""
    return toss_many(scenario.replace("ending.max_impacts", impacts + 1), points).after(impacts)


def touched_faces(scenario: Scenario, heights: Array, spins: Array, touches: int) -> NDArray[np.int8]:
    """Return the faces up at the first touches, the outcome once the toss has ended, (n, touches).

    Args:
        scenario: of the maps.
        heights: (n,) [m].
        spins: (n,) [rad/s].
        touches: how many.
    """
    body, rules = scenario.body, scenario.replace("ending.max_impacts", touches).rules
    faces = np.empty((len(heights), touches), dtype=np.int8)
    for row, state in zip(faces, states_of(releases(heights, spins)), strict=True):
        tossed = run(body, rules, state)
        row[: len(tossed.rows)] = tossed.rows["face"]
        row[len(tossed.rows) :] = tossed.outcome
    return faces
