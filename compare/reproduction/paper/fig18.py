"""Figs 18-20: four models of the coin in free fall, without and with air, and MuJoCo's coin over them."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import analytic, coin_mj
from cointoss.compare.metrics.trajectories import attitude_angle, distance
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, SKY, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.parts import Air
from cointoss.models.reading import load
from cointoss.models.records import Array

MODELS = {
    "3D imperfect": ("fig18_3d_imperfect", GREEN),
    "3D ideal": ("fig18_3d_ideal", BLUE),
    "2D imperfect": ("fig18_2d_imperfect", SKY),
    "2D ideal": ("fig18_2d_ideal", VERMILION),
}
MEDIA = {"vacuum": Air(), "air": Air(normal=0.8, tangential=0.2)}
NEGLIGIBLE = 0.02
"""A part of the way that can be neglected."""
SAME = 1e-9
"""Paths nearer to each other than this part of r are the same, but for rounding."""


REFERENCE = "3D ideal"
"""The coin that the others are compared with in the picture."""
STYLES = {"vacuum": ":", "air": "-"}
ROUNDING = 1e-13
"""The least distance that is drawn [mm]."""


def make(progress: Progress) -> Result:
    """Toss the four coins in vacuum and in air, by both engines, until the first of them lands."""
    data: dict[str, Array] = {}
    between, by_mujoco = {}, {}
    for medium, air in MEDIA.items():
        cases = {name: load(file).replace("air", air) for name, (file, _) in MODELS.items()}
        pairs = {name: (analytic.toss(case), coin_mj.toss(case)) for name, case in cases.items()}
        t = np.linspace(0, min(toss.impacts.time[0] for pair in pairs.values() for toss in pair), 400)
        paths = {name: toss.sample(t) for name, (toss, _) in pairs.items()}
        data[f"{medium}, time"] = t
        for name, path in paths.items():
            data |= {f"{medium}, {name}, position": path.position, f"{medium}, {name}, normal": path.normal}
        between[medium] = max(distance(paths["3D ideal"], path).max() for path in paths.values())
        by_mujoco[medium] = (
            f"within {max(distance(paths[name], pairs[name][1].sample(t)).max() for name in MODELS):.1g} m "
            f"and {max(attitude_angle(paths[name], pairs[name][1].sample(t)).max() for name in MODELS):.1g} "
            "rad of the analytic engine"
        )
        progress(1 + list(MEDIA).index(medium), len(MEDIA))
    t = data["air, time"]
    v = np.array(load("fig18_3d_ideal").release.velocity)
    ballistic = np.outer(t, v) - np.outer(t**2, [0, 0, 9.81 / 2]) + [0, 0, 1]
    held_back = np.linalg.norm(data["air, 3D ideal, position"] - ballistic, axis=1).max()
    way = np.linalg.norm(np.diff(ballistic, axis=0), axis=1).sum()
    claims = (
        Claim(
            claim="without air the mass centres of the four coins move on one parabola (Figs 18, 19)",
            analytic=f"at most {between['vacuum']:.1g} m apart",
            mujoco=by_mujoco["vacuum"],
            criteria=[
                Criterion("largest distance [m]", between["vacuum"], "<", SAME * 0.0125, "1e-9 r: rounding")
            ],
        ),
        Claim(
            claim="in air the four mass centres take paths of their own (Fig. 20)",
            analytic=f"up to {1e3 * between['air']:.1f} mm apart in {t[-1]:.2f} s",
            mujoco=by_mujoco["air"],
            criteria=[Criterion("largest distance [m]", between["air"], ">", 1e-3, "a millimetre is seen")],
        ),
        Claim(
            claim="over a small fall the air can be neglected",
            analytic=(
                f"the ideal coin ends {1e3 * held_back:.1f} mm from the parabola, {held_back / way:.1%} of "
                "its way"
            ),
            criteria=[
                Criterion(
                    "part of the way that the air holds back",
                    held_back / way,
                    "<",
                    NEGLIGIBLE,
                    "2 % of a way can be neglected",
                )
            ],
        ),
    )
    return Result(claims=claims, data=data)


def _draw(data: dict[str, Array]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Figs 18-20",
    title="free fall of four models of the coin, without and with air",
    assumed=(
        "The paper gives no release; here a hand's toss with all three spins. That the parabola is one in "
        "vacuum and the paths part in air does not hang on it; how far they part does."
    ),
    seconds=10,
    make=make,
    draw={"figure": _draw},
)
