"""Figs 18-20: four models of the coin in free fall, without and with air, and MuJoCo's coin over them."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import analytic, coin_mj, load
from cointoss.study import Progress, attitude_angle, distance
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

SAME = 1e-9 * 0.0125
"""Paths nearer to each other are the same, but for rounding [m]."""
REFERENCE = "3D ideal"
"""The coin that the others are compared with in the picture."""
STYLES = {"vacuum": ":", "air": "-"}
ROUNDING = 1e-13
"""The least distance that is drawn [mm]."""


def make(progress: Progress) -> Findings:
    """Toss the four coins in vacuum and in air, by both engines, until the first of them lands."""
    data: Data = {}
    found = Findings(data=data, apart={}, by_mujoco={})
    for medium, air in MEDIA.items():
        cases = {name: load(file).replace("air", air) for name, (file, _) in MODELS.items()}
        pairs = {name: (analytic.toss(case), coin_mj.toss(case)) for name, case in cases.items()}
        t = np.linspace(0, min(toss.impacts.time[0] for pair in pairs.values() for toss in pair), 400)
        paths = {name: toss.sample(t) for name, (toss, _) in pairs.items()}
        data[f"{medium}, time"] = t
        for name, path in paths.items():
            data |= {f"{medium}, {name}, position": path.position, f"{medium}, {name}, normal": path.normal}
        found.apart[medium] = max(distance(paths["3D ideal"], path).max() for path in paths.values())
        found.by_mujoco[medium] = (
            f"within {max(distance(paths[name], pairs[name][1].sample(t)).max() for name in MODELS):.1g} m "
            f"and {max(attitude_angle(paths[name], pairs[name][1].sample(t)).max() for name in MODELS):.1g} "
            "rad of the analytic engine"
        )
        progress(1 + list(MEDIA).index(medium), len(MEDIA))
    found.time = t = data["air, time"]
    v = np.array(load("fig18_3d_ideal").release.velocity)
    ballistic = np.outer(t, v) - np.outer(t**2, [0, 0, 9.81 / 2]) + [0, 0, 1]
    found.held_back = np.linalg.norm(data["air, 3D ideal, position"] - ballistic, axis=1).max()
    found.part = found.held_back / np.linalg.norm(np.diff(ballistic, axis=0), axis=1).sum()
    return found


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(10, 3.8))
    paths, apart, tilts = picture.subplots(1, 3)
    for medium, style in STYLES.items():
        x, _, z = data[f"{medium}, {REFERENCE}, position"].T
        paths.plot(100 * x, z, style, color=MODELS[REFERENCE][1], label=f"in {medium}")
    paths.set(title=f"path of the {REFERENCE} coin", xlabel="x [cm]", ylabel="z [m]")
    paths.legend()
    for name, (_, color) in MODELS.items():
        if name == REFERENCE:
            continue
        for medium, style in STYLES.items():
            off, leaning = (
                data[f"{medium}, {name}, {part}"] - data[f"{medium}, {REFERENCE}, {part}"]
                for part in ("position", "normal")
            )
            t, distance = data[f"{medium}, time"], np.linalg.norm(off, axis=1)
            apart.semilogy(t, np.maximum(1e3 * distance, ROUNDING), style, color=color)
            # Between unit vectors, of the chord between them.
            angle = 2 * np.arcsin(np.minimum(np.linalg.norm(leaning, axis=1) / 2, 1))
            if medium == "air":
                tilts.plot(t, np.degrees(angle), color=color, label=name)
    apart.set(title=f"distance from the {REFERENCE} coin", xlabel="time [s]", ylabel="mass centres [mm]")
    tilts.set(title=f"angle to the {REFERENCE} coin, in air", xlabel="time [s]", ylabel="normals [°]")
    tilts.legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
