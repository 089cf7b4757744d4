"""Figs 5-7: a British 2-pound coin bounces: stills by MuJoCo, and what it does there."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from cointoss import analytic, coin_mj
from cointoss.compare.film.stills import stills
from cointoss.compare.metrics.sequences import common_prefix
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import ANALYTIC, GREY, MUJOCO
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.estimates import share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.reading import load
from cointoss.models.records import Array, Face, Toss
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario

ROWS, COLUMNS = 3, 5
BEFORE = 0.02
"""The stills begin so long before the first impact, and end so long after the sixth [s]."""
SHOWN_IMPACTS, IMPACTS = 6, 10
"""That the stills show, and that both engines follow."""
TURNS = 10.0
"""A spin that counts as one [rad/s]."""
SLIDES = 0.01
"""A speed of the contact point that counts as sliding [m/s]."""
SPREAD, SEED = 5e-2, 5
"""Largest change of each angle of attitude at release [rad]."""


def make(progress: Progress, count: int = 2000) -> Result:
    """Toss the coin by both engines, draw it, and toss it `count` times from slightly other attitudes."""
    scenario = load("fig5")
    begun = _up_to(scenario, IMPACTS)
    by_analytic, mujoco = analytic.toss(begun), coin_mj.toss(begun)
    progress(1, 3)
    last = mujoco.impacts.time[SHOWN_IMPACTS - 1] + BEFORE
    states = mujoco.sample(np.linspace(mujoco.impacts.time[0] - BEFORE, last, ROWS * COLUMNS))
    drawn = stills(scenario, states)
    progress(2, 3)
    nearby = _nearby(scenario, count)
    first, last_seen = (
        analytic.toss_many(_up_to(scenario, n), nearby).after(n - 1) == Face.HEADS for n in (1, IMPACTS)
    )
    agreed = common_prefix(by_analytic.sequence, mujoco.sequence)
    claims = (
        Claim(
            claim="the coin rotates around all possible axes",
            analytic=f"spins of up to {_spins(by_analytic)} rad/s about ξ, η, ζ after its impacts",
            mujoco=f"{_spins(mujoco)} rad/s" + (f"; no stills: {drawn}" if isinstance(drawn, str) else ""),
            criteria=[
                Criterion(
                    "least of the largest spins [rad/s]",
                    min(_largest_spins(toss).min() for toss in (by_analytic, mujoco)),
                    ">",
                    TURNS,
                    "that counts as turning",
                )
            ],
        ),
        Claim(
            claim="it slides on the floor",
            analytic=_sliding(by_analytic),
            mujoco=_sliding(mujoco),
            criteria=[
                Criterion(
                    "largest slip [m/s]",
                    min(_slip(toss).max() for toss in (by_analytic, mujoco)),
                    ">",
                    SLIDES,
                    "that counts as sliding",
                )
            ],
        ),
        Claim(
            claim="it can change its side between successive collisions",
            analytic=f"{by_analytic.sequence}…",
            mujoco=f"{mujoco.sequence}…; {agreed} faces alike, {mujoco.trusted_impacts} trusted",
            criteria=[
                Criterion(
                    "different faces up at trusted impacts",
                    min(len(set(toss.sequence[: toss.trusted_impacts])) for toss in (by_analytic, mujoco)),
                    "=",
                    2,
                    "heads and tails",
                )
            ],
        ),
        Claim(
            claim="bouncing makes the final side depend sensitively on the attitude",
            analytic=(
                f"of {count} tosses with angles changed by up to {SPREAD:g} rad {first.mean():.0%} show "
                f"heads at the first touch, {last_seen.mean():.0%} at impact {IMPACTS} or in the end"
            ),
            criteria=[
                Criterion(
                    "share of tails at the first touch",
                    share(~first),
                    "<",
                    0.01,
                    "without bouncing it hardly depends on it",
                ),
                Criterion(f"share of tails at impact {IMPACTS}", share(~last_seen), ">", 0.1, "both come up"),
                Criterion(f"share of heads at impact {IMPACTS}", share(last_seen), ">", 0.1, "both come up"),
            ],
        ),
    )
    t = np.linspace(0, last, 1500)
    data: dict[str, NDArray[Any]] = {
        "time": t,
        "analytic": by_analytic.sample(t).position,
        "MuJoCo": mujoco.sample(t).position,
        "impacts": by_analytic.impacts.time[by_analytic.impacts.time < last],
        "stills, time": states.time,
        "stills": np.array(drawn),  # or why there are none
    }
    progress(3, 3)
    return Result(claims=claims, data=data)


def _up_to(scenario: Scenario, impacts: int) -> Scenario:
    return scenario.replace("ending.max_impacts", impacts)


def _largest_spins(toss: Toss) -> Array:
    return np.abs(toss.impacts.angular_velocity_after[: toss.trusted_impacts]).max(axis=0)


def _spins(toss: Toss) -> str:
    return ", ".join(f"{spin:.0f}" for spin in _largest_spins(toss))


def _slip(toss: Toss) -> Array:
    """Return the speed along the floor of the contact point after the trusted impacts, (n,) [m/s]."""
    return np.linalg.norm(toss.impacts.contact_velocity_after[: toss.trusted_impacts, :2], axis=1)


def _sliding(toss: Toss) -> str:
    slip = _slip(toss)
    return f"after {np.sum(slip > SLIDES)} of {len(slip)} trusted impacts, at up to {slip.max():.2g} m/s"


def _nearby(scenario: Scenario, count: int) -> Releases:
    """Return the scenario's release `count` times, its attitude turned a little at random."""
    release, rng = scenario.release, np.random.default_rng(SEED)
    turned = Rotation.from_rotvec(rng.uniform(-SPREAD, SPREAD, (count, 3)))
    attitude = Rotation.from_quat(release.attitude, scalar_first=True) * turned
    return Releases(
        position=np.tile(release.position, (count, 1)),
        velocity=np.tile(release.velocity, (count, 1)),
        quaternion=attitude.as_quat(scalar_first=True),
        angular_velocity=np.tile(release.angular_velocity, (count, 1)),
    )


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(8, 6.4))
    grid = picture.add_gridspec(2, 1, height_ratios=(3, 1))
    gallery, below = picture.add_subfigure(grid[0]), picture.add_subfigure(grid[1])
    if data["stills"].ndim == 0:
        gallery.text(0.5, 0.5, f"no stills: {data['stills']}", ha="center", va="center", wrap=True)
    else:
        for axes, still, time in zip(
            gallery.subplots(ROWS, COLUMNS).flat, data["stills"], data["stills, time"], strict=True
        ):
            axes.imshow(still)
            axes.set_title(f"{1e3 * (time - data['impacts'][0]):.0f} ms", fontsize=8)
            axes.axis("off")
    axes = below.subplots()
    touched = data["impacts"][0]
    for name, color, line in (("analytic", ANALYTIC, "-"), ("MuJoCo", MUJOCO, ":")):
        axes.plot(1e3 * (data["time"] - touched), 1e3 * data[name][:, 2], line, color=color, label=name)
    axes.plot(1e3 * (data["impacts"] - touched), 0 * data["impacts"], "|", color=GREY)
    axes.set(xlabel="time since the first impact [ms]", ylabel="z of C [mm]", xlim=(-60, None), ylim=(0, 60))
    axes.legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 5-7",
    title="stills of a 2-pound coin that bounces: it turns, slides, and changes its side",
    assumed=(
        "Coin: 12.0 g, 28.4 mm across, 2.5 mm thick, by its specification. Release, restitution, friction "
        "and air are unsaid; here a light toss, 0.6, Coulomb's 0.2, and the air of the 1 zloty coin."
    ),
    seconds=15,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=200),
)
