"""Figs 18-20: four models of the coin in free fall, without and with air, and MuJoCo's coin over them."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from cointoss import Air, States, load
from cointoss.study import Array, attitude_angle, distance
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

REFERENCE = "3D ideal"
"""The coin that the others are compared with."""
ROUNDING = 1e-13
"""The least distance that is drawn [mm]."""


def fall(medium: Air) -> Iterator[Rows]:
    """Toss the four coins by both engines, until the first of them lands.

    Yields:
        How far each is from the ideal one, and MuJoCo from the analytic engine [m, rad]; how far the ideal
        one is held back [m] and until when [s]; the path of that, and distance [mm] and angle [°] of others.
    """
    tosses = {name: by_both(load(file).replace("air", medium)) for name, file in MODELS.items()}
    t = np.linspace(0, min(map(first_touch, tosses.values())), 400)
    paths = {name: both["analytic"].sample(t) for name, both in tosses.items()}
    ideal = paths[REFERENCE]
    ballistic = _ballistic(t)
    held_back = np.linalg.norm(ideal.position - ballistic, axis=1).max()
    yield {
        "held_back": held_back,
        "part": held_back / np.linalg.norm(np.diff(ballistic, axis=0), axis=1).sum(),
        "end": t[-1],
    }
    for name, path in paths.items():
        mujoco = tosses[name]["MuJoCo"].sample(t)
        off = distance(ideal, path)
        yield {
            "model": name,
            "apart": off.max(),
            "off_m": distance(path, mujoco).max(),
            "off_rad": attitude_angle(path, mujoco).max(),
        }
        yield _curve(name, t, path, off, ideal)


def _ballistic(t: Array) -> Array:
    """Return where the ideal coin would be without air, (n, 3) [m]."""
    v = np.array(load("fig18_3d_ideal").release.velocity)
    return np.outer(t, v) - np.outer(t**2, [0, 0, 9.81 / 2]) + [0, 0, 1]


def _curve(name: str, t: Array, path: States, off: Array, ideal: States) -> pd.DataFrame:
    # Between unit vectors, of the chord between them.
    chord = np.linalg.norm(path.normal - ideal.normal, axis=1)
    angle = np.degrees(2 * np.arcsin(np.minimum(chord / 2, 1)))
    at = {"x": 100 * path.position[:, 0], "z": path.position[:, 2]}
    far = {"distance": np.maximum(1e3 * off, ROUNDING), "angle": angle}
    return pd.DataFrame({"model": name, "time": t, **(at if name == REFERENCE else far)}).iloc[::8]


REPRODUCTION = study(__name__, Cells(fall, {"medium": MEDIA}))
