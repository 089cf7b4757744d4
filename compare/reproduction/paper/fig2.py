"""Fig. 2: Keller's map: which side of a coin is up when it is caught at the height of its release."""

from functools import partial

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

from cointoss import coin_mj
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.analytic.toss import state_of
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import HEADS, INK, TAILS
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.reading import load
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

FASTEST, HIGHEST = 20.0, 0.25
"""Ends of the axes: ω_0/π [1/s] and v_0/g [s]."""
FACES = ListedColormap([TAILS, HEADS])
COLUMNS = ("analytic", "MuJoCo", "the condition printed")


def make(progress: Progress, size: int = 96) -> Result:
    """Return the map tossed in every pixel by the analytic engine, and for every spin by MuJoCo.

    Args:
        progress: called after each spin.
        size: pixels along each axis, even: then none lies on a boundary.
    """
    spins = (np.arange(size) + 0.5) * FASTEST / size
    speeds = (np.arange(size) + 0.5) * HIGHEST / size
    by_analytic, mujoco = np.empty((size, size)), np.empty((size, size))
    scenario = load("fig2")
    for column, spin in enumerate(spins):
        by_analytic[:, column] = [_caught(_toss(scenario, spin, speed)) for speed in speeds]
        thrown = _toss(scenario, spin, HIGHEST)
        mujoco[:, column] = coin_mj.toss(thrown).sample(2 * speeds).normal[:, 2]
        progress(column + 1, size)
    turns = np.outer(speeds, spins)
    # The first side is up within a quarter of a turn of a whole number of turns.
    expected = np.abs(turns - np.round(turns)) < 0.25
    printed = np.floor(turns) % 2 == 0
    wrong = [int(np.sum((heights > 0) != expected)) for heights in (by_analytic, mujoco)]
    right_as_printed = np.mean((by_analytic > 0) == printed), np.mean((mujoco > 0) == printed)
    claims = (
        Claim(
            claim="hyperbolas bound the regions; rightly ω_0 v_0/(π g) = (2k + 1)/4",
            analytic=f"{wrong[0]} of {size * size} pixels on the wrong side",
            mujoco=f"{wrong[1]} of {size * size}",
            criteria=[
                Criterion("pixels on the wrong side", sum(wrong), "=", 0, "no pixel lies on a boundary")
            ],
        ),
        Claim(
            claim="the first side is up for 2j < n < 2j + 1, with boundaries ω_0 v_0/(π g) = j (as printed)",
            analytic=f"{right_as_printed[0]:.0%} of the pixels",
            mujoco=f"{right_as_printed[1]:.0%}",
            criteria=[
                Criterion(
                    "least share of the pixels", min(right_as_printed), "=", 1, "none lies on a boundary"
                )
            ],
            expected=False,
        ),
        Claim(
            claim="the coin turns as Keller's does: n_z = cos(2 π n)",
            analytic=f"within {np.abs(by_analytic - np.cos(2 * np.pi * turns)).max():.0e}",
            mujoco=f"{np.abs(mujoco - np.cos(2 * np.pi * turns)).max():.0e}",
            criteria=[
                Criterion(
                    "largest difference of n_z",
                    max(
                        np.abs(heights - np.cos(2 * np.pi * turns)).max() for heights in (by_analytic, mujoco)
                    ),
                    "<",
                    1e-8,
                    "rounding and MuJoCo's steps",
                )
            ],
        ),
    )
    data = {
        "spin over pi": spins,
        "speed over g": speeds,
        COLUMNS[0]: by_analytic > 0,
        COLUMNS[1]: mujoco > 0,
        COLUMNS[2]: printed,
    }
    return Result(claims=claims, data=data)


def _toss(scenario: Scenario, spin: float, speed: float) -> Scenario:
    """Return Keller's toss with ω_0/π [1/s] and v_0/g [s]."""
    velocity, w = (0.0, 0.0, speed * scenario.gravity), (spin * np.pi, 0.0, 0.0)
    thrown = scenario.replace("release.velocity", velocity, "release.angular_velocity", w)
    return thrown.replace("ending.max_time", 2.01 * speed)


def _caught(case: Scenario) -> float:
    """Return n_z when the coin is back at the height of its release, by the analytic engine."""
    times, states = np.array([2 * case.release.velocity[2] / case.gravity]), np.empty((1, 13))
    sample_flight(case.body, state_of(case.release), 0.0, times, states)
    e = states[0, 6:10]
    return 1 - 2 * (e[1] ** 2 + e[2] ** 2)


def _draw(data: dict[str, Array]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Fig. 2",
    title="Keller's map: the side up at the catch, and the hyperbolas that bound it",
    assumed=(
        "Thin ideal coin, released flat, caught at the height of release; gold where it comes up as it "
        "started; lines at ω₀ v₀/(π g) = (2k + 1)/4. MuJoCo's coin is tossed once for each ω₀, at the "
        "largest v₀, and sampled 2 v₀/g after its release for each v₀, on which its turning does not "
        "depend. The captions of the paper contradict each other on black and white."
    ),
    seconds=30,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, size=32),
)
