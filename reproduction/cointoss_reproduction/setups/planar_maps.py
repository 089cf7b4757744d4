"""The maps of Figs 29 to 31: faces of the planar thin coin over its release height and spin."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from cointoss import Air, Scenario, analytic, coin_mj, load
from cointoss.study import (
    BLUE,
    PLACE,
    VERMILION,
    Answers,
    Array,
    MapAxis,
    OutcomeCodes,
    draw_panel,
    rows_from_states,
)
from cointoss_reproduction.setups.releases import released

HEIGHTS, SPINS = (0.2, 0.6), (20.0, 60.0)
"""Ranges of the axes: release height [m] and spin about ξ [rad/s]."""
HEIGHT = MapAxis(name="height", unit="m", start=HEIGHTS[0], stop=HEIGHTS[1])
SPIN = MapAxis(name="spin", unit="rad/s", start=SPINS[0], stop=SPINS[1])
MEDIA = {"air": BLUE, "vacuum": VERMILION}
toss_rows_by_mujoco = partial(coin_mj.toss_rows, settings=coin_mj.FINE)
"""MuJoCo's tosses where single ones are compared."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Grid:
    """Points of a map: every spin with every height."""

    heights: Array
    """The heights, (x) [m]."""
    spins: Array
    """The spins, (y) [rad/s]."""

    def rows(self, scenario: Scenario) -> Array:
        """Return the tosses of all points, line by line, as rows, (y x, m)."""
        z, w = (part.ravel() for part in np.meshgrid(self.heights, self.spins))
        return planar_rows(scenario, z, w)

    @property
    def shape(self) -> tuple[int, int]:
        """Shape of a map, (y, x)."""
        return len(self.spins), len(self.heights)


def whole_grid(points: int) -> Grid:
    """Return the grid of a whole map with a given number of points along each side."""
    return Grid(heights=np.linspace(*HEIGHTS, points), spins=np.linspace(*SPINS, points))


def lines_of(faces: NDArray[np.int8]) -> list[str]:
    """Return the lines of a map as text, a letter for each outcome: a for 0."""
    return ["".join(chr(ord("a") + face) for face in line) for line in faces.tolist()]


def map_of(lines: Iterable[str]) -> NDArray[np.int8]:
    """Return the map that has been written as lines."""
    return np.array([[ord(letter) - ord("a") for letter in line] for line in lines], dtype=np.int8)


def draw_titled(
    axes: Axes, faces: OutcomeCodes, title: str, *, x: MapAxis = HEIGHT, y: MapAxis = SPIN
) -> None:
    """Draw a map into `axes`, below a title."""
    draw_panel(axes, faces, x=x, y=y)
    axes.set_title(title)
    axes.grid(visible=False)


def planar_rows(scenario: Scenario, heights: Array, spins: Array) -> Array:
    """Return tosses of a coin released flat, heads up, at rest but for its spin about ξ, as rows, (n, m).

    Args:
        scenario: what is tossed.
        heights: of the releases, (n,) [m].
        spins: about ξ, (n,) [rad/s].
    """
    return rows_from_states(scenario, released(heights, spin=np.outer(spins, (1, 0, 0))))


def case(*, air: bool, restitution: float = 0.6, max_impacts: int | None = None) -> Scenario:
    """Return the scenario of the maps.

    Args:
        air: whether there is any.
        restitution: χ.
        max_impacts: the number of impacts that ends a toss, by default the scenario's.
    """
    scenario = load("fig29")
    medium, most = scenario.air if air else Air(), max_impacts or scenario.ending.max_impacts
    return scenario.replace("air", medium, "floor.restitution", restitution, "ending.max_impacts", most)


def final_faces(scenario: Scenario, grid: Grid) -> OutcomeCodes:
    """Return the map of the outcomes, (y, x)."""
    return analytic.toss_rows(grid.rows(scenario)).outcome.reshape(grid.shape)


def faces_after(
    rows: Array, impacts: int, toss_rows: Callable[[Array], Answers] = analytic.toss_rows
) -> NDArray[np.int8]:
    """Return the face up at the touch after some impacts, the outcome where a toss ended before, (n,).

    Args:
        rows: of the tosses, (n, m).
        impacts: how many.
        toss_rows: the engine's.
    """
    shorter = rows.copy()
    shorter[:, PLACE["ending.max_impacts"]] = impacts + 1
    return toss_rows(shorter).after(impacts)


LANDINGS: dict[str, Callable[[Array], NDArray[np.int8]]] = {
    "soft floor": lambda rows: faces_after(rows, 0),
    "bouncing": lambda rows: analytic.toss_rows(rows).outcome,
}
"""How tosses of rows end, (n, m) to (n,): at their first touch, or after their bounces."""


def touched_faces(scenario: Scenario, heights: Array, spins: Array, touches: int) -> NDArray[np.int8]:
    """Return the faces up at the first touches, the outcome once the toss has ended, (n, touches).

    Args:
        scenario: of the maps.
        heights: (n,) [m].
        spins: (n,) [rad/s].
        touches: how many.
    """
    rows = planar_rows(scenario, heights, spins)
    return np.column_stack([faces_after(rows, impacts) for impacts in range(touches)])
