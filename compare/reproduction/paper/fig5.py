"""Figs 5-7: a British 2-pound coin bounces: stills by MuJoCo, and what it does there."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure as Picture
from scipy.spatial.transform import Rotation

import analytic
import coin_mj
from compare.film.stills import stills
from compare.metrics.sequences import common_prefix
from compare.reproduction.findings import Finding, Result, paper_figure
from compare.reproduction.runner import Progress
from models.reading import load
from models.records import Array, Face, Toss
from models.releases import Releases
from models.scenario import Scenario

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
    ours, mujoco = analytic.toss(begun), coin_mj.toss(begun)
    progress(1, 3)
    last = mujoco.impacts.time[SHOWN_IMPACTS - 1] + BEFORE
    states = mujoco.sample(np.linspace(mujoco.impacts.time[0] - BEFORE, last, ROWS * COLUMNS))
    drawn = stills(scenario, states)
    progress(2, 3)
    nearby = _nearby(scenario, count)
    first, last_seen = (
        analytic.toss_many(_up_to(scenario, n), nearby).after(n - 1) == Face.HEADS for n in (1, IMPACTS)
    )
    agreed = common_prefix(ours.sequence, mujoco.sequence)
    findings = (
        Finding(
            claim="the coin rotates around all possible axes",
            ours=f"spins of up to {_spins(ours)} rad/s about ξ, η, ζ after its impacts",
            mujoco=f"{_spins(mujoco)} rad/s" + (f"; no stills: {drawn}" if isinstance(drawn, str) else ""),
            holds=all(_largest_spins(toss).min() > TURNS for toss in (ours, mujoco)),
        ),
        Finding(
            claim="it slides on the floor",
            ours=_sliding(ours),
            mujoco=_sliding(mujoco),
            holds=all(_slip(toss).max() > SLIDES for toss in (ours, mujoco)),
        ),
        Finding(
            claim="it can change its side between successive collisions",
            ours=f"{ours.sequence}…",
            mujoco=f"{mujoco.sequence}…; {agreed} faces as ours, {mujoco.trusted_impacts} trusted",
            holds=all(len(set(toss.sequence[: toss.trusted_impacts])) == 2 for toss in (ours, mujoco)),
        ),
        Finding(
            claim="bouncing makes the final side depend sensitively on the attitude",
            ours=(
                f"of {count} tosses with angles changed by up to {SPREAD:g} rad {first.mean():.0%} show "
                f"heads at the first touch, {last_seen.mean():.0%} at impact {IMPACTS} or in the end"
            ),
            holds=bool(first.mean() in (0, 1) and 0.1 < last_seen.mean() < 0.9),
        ),
    )
    t = np.linspace(0, last, 1500)
    data: dict[str, Array] = {
        "time": t,
        "ours": ours.sample(t).position,
        "MuJoCo": mujoco.sample(t).position,
        "impacts": ours.impacts.time[ours.impacts.time < last],
        "stills, time": states.time,
        "stills": np.zeros(0) if isinstance(drawn, str) else drawn,
    }
    problem = drawn if isinstance(drawn, str) else ""
    progress(3, 3)
    return Result(findings=findings, draw=partial(_draw, data, problem), data=data)


def _up_to(scenario: Scenario, impacts: int) -> Scenario:
    return scenario.replace("ending.max_impacts", impacts)


def _largest_spins(toss: Toss) -> Array:
    return np.abs(toss.impacts.angular_velocity_after[: toss.trusted_impacts]).max(axis=0)


def _spins(toss: Toss) -> str:
    return ", ".join(f"{spin:.0f}" for spin in _largest_spins(toss))


def _slip(toss: Toss) -> Array:
    """Give the speed along the floor of the contact point after the trusted impacts, (n,) [m/s]."""
    return np.linalg.norm(toss.impacts.contact_velocity_after[: toss.trusted_impacts, :2], axis=1)


def _sliding(toss: Toss) -> str:
    slip = _slip(toss)
    return f"after {np.sum(slip > SLIDES)} of {len(slip)} trusted impacts, at up to {slip.max():.2g} m/s"


def _nearby(scenario: Scenario, count: int) -> Releases:
    """Give the scenario's release `count` times, its attitude turned a little at random."""
    release, rng = scenario.release, np.random.default_rng(SEED)
    turned = Rotation.from_rotvec(rng.uniform(-SPREAD, SPREAD, (count, 3)))
    attitude = Rotation.from_quat(release.attitude, scalar_first=True) * turned
    return Releases(
        position=np.tile(release.position, (count, 1)),
        velocity=np.tile(release.velocity, (count, 1)),
        quaternion=attitude.as_quat(scalar_first=True),
        angular_velocity=np.tile(release.angular_velocity, (count, 1)),
    )


def _draw(data: dict[str, Array], problem: str) -> Picture:
    picture = Picture(figsize=(8, 6.4))
    grid = picture.add_gridspec(2, 1, height_ratios=(3, 1))
    gallery, below = picture.add_subfigure(grid[0]), picture.add_subfigure(grid[1])
    if problem:
        gallery.text(0.5, 0.5, f"no stills: {problem}", ha="center", va="center", wrap=True)
    else:
        for axes, still, time in zip(
            gallery.subplots(ROWS, COLUMNS).flat, data["stills"], data["stills, time"], strict=True
        ):
            axes.imshow(still)
            axes.set_title(f"{1e3 * (time - data['impacts'][0]):.0f} ms", fontsize=8)
            axes.axis("off")
    axes = below.subplots()
    touched = data["impacts"][0]
    for name, color, line in (("ours", "#0072B2", "-"), ("MuJoCo", "#D55E00", ":")):
        axes.plot(1e3 * (data["time"] - touched), 1e3 * data[name][:, 2], line, color=color, label=name)
    axes.plot(1e3 * (data["impacts"] - touched), 0 * data["impacts"], "|", color="#5b6675")
    axes.set(xlabel="time since the first impact [ms]", ylabel="z of C [mm]", xlim=(-60, None), ylim=(0, 60))
    axes.legend()
    return picture


FIGURE = paper_figure(
    paper="Figs 5-7",
    title="stills of a 2-pound coin that bounces: it turns, slides, and changes its side",
    assumed=(
        "Coin: 12.0 g, 28.4 mm across, 2.5 mm thick, by its specification. Release, restitution, friction "
        "and air are unsaid; here a light toss, 0.6, Coulomb's 0.2, and the air of the 1 zloty coin."
    ),
    seconds=15,
    make=make,
    quick_seconds=10,
    quick=partial(make, count=200),
)
