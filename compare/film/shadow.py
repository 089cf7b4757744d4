"""The shadow of a coin on the floor below it, as light from straight above casts it."""

# The MuJoCo wheel describes no types.
# pyright: reportAttributeAccessIssue=false

import math

import mujoco
import numpy as np

from cointoss.models.parts import Coin

THICKNESS = 0.01
"""How far the shadow stands above the floor, in the coin's radii: neither is drawn through the other."""
DARKNESS = 0.2
"""The darkness of each of its two sides, through both of which the floor is seen."""


def add_shadow(scene: mujoco.MjvScene, data: mujoco.MjData, coin: Coin) -> None:
    """Add the shadow of a coin to a scene that has room for it.

    It is drawn as an ellipse, which takes a fiftieth of the time of a renderer's map of shadows.
    """
    x, y, _ = data.body("coin").xpos
    n_x, n_y, n_z = data.body("coin").xmat.reshape(3, 3)[:, 2]
    level = math.hypot(n_x, n_y)
    along = coin.radius * abs(n_z) + coin.thickness / 2 * level
    c, s = (n_x / level, n_y / level) if level > 0 else (1.0, 0.0)
    axes = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    geom = scene.geoms[scene.ngeom]
    kind, rgba = mujoco.mjtGeom.mjGEOM_CYLINDER, np.array([0, 0, 0, DARKNESS], np.float32)
    mujoco.mjv_initGeom(geom, kind, np.zeros(3), np.array([x, y, 0]), axes.ravel(), rgba)
    geom.size[:] = along, coin.radius, THICKNESS * coin.radius
    scene.ngeom += 1
