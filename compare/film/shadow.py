"""The shadow of a coin on the floor below it, as light from straight above casts it."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math
from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from cointoss.models.parts import Coin

THICKNESS = 0.01
"""How far the shadow stands above the floor, in the coin's radii: neither is drawn through the other."""
DARKNESS = 0.2
"""The darkness of each of its two sides, through both of which the floor is seen."""


def add_shadow(scene: mujoco.MjvScene, data: mujoco.MjData, coin: Coin) -> None:
    """Add the shadow of a coin to a scene.

    It is drawn as an ellipse, which takes a fiftieth of the time of a renderer's map of shadows.
    """
    x, y, _ = data.body("coin").xpos
    n_x, n_y, n_z = data.body("coin").xmat.reshape(3, 3)[:, 2]
    level = math.hypot(n_x, n_y)
    along = coin.radius * abs(n_z) + coin.thickness / 2 * level
    c, s = (n_x / level, n_y / level) if level > 0 else (1.0, 0.0)
    geom = add_geom(
        scene,
        mujoco.mjtGeom.mjGEOM_CYLINDER,
        (0, 0, 0, DARKNESS),
        at=(x, y, 0),
        axes=((c, -s, 0), (s, c, 0), (0, 0, 1)),
    )
    geom.size[:] = along, coin.radius, THICKNESS * coin.radius


def add_geom(
    scene: mujoco.MjvScene,
    kind: mujoco.mjtGeom,
    color: Sequence[float],
    *,
    size: ArrayLike = (0, 0, 0),
    at: ArrayLike = (0, 0, 0),
    axes: ArrayLike = ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
) -> mujoco.MjvGeom:
    """Add a geom to a scene, and return it.

    Args:
        scene: what is drawn.
        kind: of the geom.
        color: red, green, blue and opacity, each from 0 to 1.
        size: as MuJoCo takes it of this kind, (3,) [m].
        at: its place, (3,) [m].
        axes: its axes as columns, (3, 3).
    """
    geom = scene.geoms[scene.ngeom]
    scene.ngeom += 1
    numbers = (np.array(one, float).ravel() for one in (size, at, axes))
    mujoco.mjv_initGeom(geom, kind, *numbers, np.array(color, np.float32))
    return geom
