"""Fig. 28: the two kinds of impacts that change the coin's face, distinguished by rule and counted."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from analytic.events import run
from analytic.toss import state_of
from coin_mj.toss import impacts_of
from compare.output.progress import Progress
from compare.output.style import BLUE, VERMILION
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.runner import Reproduction, Result
from models.reading import load
from models.records import Array
from models.scenario import Scenario

SEED = 28
SOFTER = 0.8
"""A ratio of medians below this is a difference."""
SPREAD = 0.2
"""Part by which height and spin of the tosses differ from those of Fig. 24(a)."""


def make(progress: Progress, count: int = 4000, count_mujoco: int = 60) -> Result:
    """Toss coins like that of Fig. 24(a) by both engines, and sort their changes of face."""
    rng = np.random.default_rng(SEED)
    scenarios = [_scenario(rng) for _ in range(count)]
    # Of the last impact before each change: its impulse and the angular momentum that it gives.
    after_row, after_one = [], []
    for done, scenario in enumerate(scenarios, start=1):
        rows = run(scenario.body, scenario.rules, state_of(scenario.release)).rows
        turned = (rows["angular_velocity_after"] - rows["angular_velocity_before"]) @ np.array(
            scenario.body.inertia
        )
        given = np.column_stack([np.linalg.norm(rows["impulse"], axis=1), np.linalg.norm(turned, axis=1)])
        row, one = changes(rows["face"])
        after_row.append(given[row])
        after_one.append(given[one])
        progress(done, count + count_mujoco)
    by_mujoco = [0, 0]
    for done, scenario in enumerate(scenarios[:count_mujoco], start=1):
        kinds = changes(impacts_of(scenario).face)
        by_mujoco = [n + len(kind) for n, kind in zip(by_mujoco, kinds, strict=True)]
        progress(count + done, count + count_mujoco)
    data = {"after a row": np.concatenate(after_row), "after one": np.concatenate(after_one)}
    soft, hard = data.values()
    whole = len(soft) + len(hard)
    share = len(soft) / whole
    error = np.sqrt(share * (1 - share) / whole)
    (S_soft, L_soft), (S_hard, L_hard) = np.median(soft, axis=0), np.median(hard, axis=0)
    claims = (
        Claim(
            claim="the face changes more often after a row of impacts on one face than after a single one",
            analytic=f"{len(soft)} of {whole} changes, {share:.1%} ± {error:.1%}, in {count} tosses",
            mujoco=f"{by_mujoco[0]} of {sum(by_mujoco)} in {count_mujoco} tosses",
            criteria=[
                Criterion(
                    "share after a row", share, ">", 0.5 + 3 * error, "a half and three standard errors"
                )
            ],
        ),
        Claim(
            claim="the first kind comes from soft impacts, the second from strong ones",
            analytic=f"median impulse {1e3 * S_soft:.2f} mN s after a row, {1e3 * S_hard:.2f} mN s after one",
            criteria=[
                Criterion(
                    "median impulse, soft over strong", S_soft / S_hard, "<", SOFTER, "a fifth less is seen"
                )
            ],
        ),
        Claim(
            claim="the first kind transfers little angular momentum, the second much",
            analytic=f"median {1e6 * L_soft:.1f} µN m s after a row, {1e6 * L_hard:.1f} µN m s after one",
            criteria=[
                Criterion(
                    "median angular momentum, little over much",
                    L_soft / L_hard,
                    "<",
                    SOFTER,
                    "a fifth less is seen",
                )
            ],
            expected=False,
        ),
    )
    return Result(claims=claims, data=data)


def _scenario(rng: np.random.Generator) -> Scenario:
    scenario = load("fig24a")
    height, *spins = rng.uniform(-SPREAD, SPREAD, 4)
    w = (40 * spins[0], 40.15 * (1 + spins[1]), 40 * spins[2])
    return scenario.replace("release.position", (0.0, 0.0, 0.4 * (1 + height)), "release.angular_velocity", w)


def changes(faces: NDArray[np.int8]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return the last impacts before the face changes, by the kind of change.

    Args:
        faces: up at the touches, (n,).

    Returns:
        Numbers of the impacts from 0: those that end a row on one face, and single ones.
    """
    last = np.flatnonzero(np.diff(faces))
    lengths = np.diff(np.concatenate([[-1], last]))
    return last[lengths > 1], last[lengths == 1]


def _draw(data: dict[str, Array]) -> Figure:
    picture = Figure(figsize=(9, 3.2))
    panels = zip(
        picture.subplots(1, 2), (1e3, 1e6), ("impulse [mN s]", "angular momentum given [µN m s]"), strict=True
    )
    for column, (axes, unit, label) in enumerate(panels):
        bins = np.linspace(0, unit * max(np.quantile(d[:, column], 0.99) for d in data.values()), 40)
        for (name, given), color in zip(data.items(), (BLUE, VERMILION), strict=True):
            axes.hist(unit * given[:, column], bins.tolist(), histtype="step", color=color, label=name)
        axes.set(xlabel=f"last impact before the change: {label}", ylabel="changes")
    picture.axes[0].legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Fig. 28",
    title="two kinds of impacts that change the face, counted",
    assumed=(
        "The paper gives no tosses; here those of Fig. 24(a) with height and spins up to 20 % off. Its rule "
        "is taken at its word: a face that was up at two or more impacts in a row changes by the first kind, "
        "one that was up at a single impact by the second."
    ),
    seconds=60,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=400, count_mujoco=6),
)
