"""Fig. 2: Keller's map: which side of a coin is up when it is caught at the height of its release."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from cointoss import Scenario, coin_mj, load
from cointoss.study import HEADS, INK, TAILS, Progress
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.kellers_map import FASTEST, HIGHEST, caught, middles, thrown

FACES = ListedColormap([TAILS, HEADS])
COLUMNS = ("analytic", "MuJoCo", "the condition printed")


def make(progress: Progress, size: int = 96) -> Findings:
    """Return the map tossed in every pixel by the analytic engine, and for every spin by MuJoCo.

    Args:
        progress: called after each spin.
        size: pixels along each axis, even: then none lies on a boundary.
    """
    spins, speeds = middles(FASTEST, size), middles(HIGHEST, size)
    by_analytic, mujoco = np.empty((size, size)), np.empty((size, size))
    scenario = load("fig2")
    for column, spin in enumerate(spins):
        by_analytic[:, column] = caught(scenario, thrown(scenario, np.full(size, spin), speeds))
        tossed = coin_mj.toss(_toss(scenario, spin, HIGHEST))
        mujoco[:, column] = tossed.sample(2 * speeds).normal[:, 2]
        progress(column + 1, size)
    turns = np.outer(speeds, spins)
    # The first side is up within a quarter of a turn of a whole number of turns.
    expected = np.abs(turns - np.round(turns)) < 0.25
    printed = np.floor(turns) % 2 == 0
    maps = dict(zip(COLUMNS, (by_analytic > 0, mujoco > 0, printed), strict=True))
    wrong, right, off = zip(
        *(
            (
                int(np.sum((heights > 0) != expected)),
                np.mean((heights > 0) == printed),
                np.abs(heights - np.cos(2 * np.pi * turns)).max(),
            )
            for heights in (by_analytic, mujoco)
        ),
        strict=True,
    )
    return Findings(
        data=maps,
        wrong=wrong,
        all_wrong=sum(wrong),
        right_as_printed=right,
        least=min(right),
        off=np.array(off),
        pixels=size * size,
    )


def _toss(scenario: Scenario, spin: float, speed: float) -> Scenario:
    """Return Keller's toss with ω_0/π [1/s] and v_0/g [s]."""
    velocity, w = (0.0, 0.0, speed * scenario.gravity), (spin * np.pi, 0.0, 0.0)
    tossed = scenario.replace("release.velocity", velocity, "release.angular_velocity", w)
    return tossed.replace("ending.max_time", 2.01 * speed)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.5))
    spin = np.linspace(FASTEST / 500, FASTEST, 500)
    for axes, name in zip(picture.subplots(1, 3, sharey=True), COLUMNS, strict=True):
        axes.imshow(
            data[name],
            cmap=FACES,
            origin="lower",
            extent=(0, FASTEST, 0, HIGHEST),
            aspect="auto",
            interpolation="nearest",
        )
        for turns in np.arange(0.25, FASTEST * HIGHEST, 0.5):
            axes.plot(spin, turns / spin, color=INK, linewidth=0.9)
        axes.set(title=name, xlabel="ω₀/π [1/s]", xlim=(0, FASTEST), ylim=(0, HIGHEST))
        axes.grid(visible=False)
    picture.axes[0].set(ylabel="v₀/g [s]")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
