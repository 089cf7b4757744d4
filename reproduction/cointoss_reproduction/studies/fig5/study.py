"""Figs 5-7: a British 2-pound coin bounces: stills by MuJoCo, and what it does there."""

import numpy as np
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from cointoss import Face, Scenario, analytic, coin_mj, load
from cointoss.study import (
    ANALYTIC,
    COMPONENTS,
    GREY,
    MUJOCO,
    Array,
    Progress,
    common_prefix,
    rows_of,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import faces_after
from cointoss_reproduction.studies.fig5.stills import stills

ROWS, COLUMNS = 3, 5
BEFORE = 0.02
"""How long before the first impact the stills begin, and how long after the sixth they end [s]."""
SHOWN_IMPACTS, IMPACTS = 6, 10
"""The number of impacts that the stills show, and that both engines follow."""
SLIDES = 0.01
"""A speed of the contact point that counts as sliding [m/s]."""
SPREAD, SEED = 5e-2, 5
"""Largest change of each angle of attitude at release [rad]."""


def make(progress: Progress, count: int = 2000) -> Findings:
    """Toss the coin by both engines, draw it, and toss it `count` times from slightly other attitudes."""
    scenario = load("fig5")
    begun = scenario.replace("ending.max_impacts", IMPACTS)
    by_analytic, mujoco = analytic.toss(begun), coin_mj.toss(begun)
    progress(1, 3)
    last = mujoco.impacts.time[SHOWN_IMPACTS - 1] + BEFORE
    states = mujoco.sample(np.linspace(mujoco.impacts.time[0] - BEFORE, last, ROWS * COLUMNS))
    drawn = stills(scenario, states)
    progress(2, 3)
    nearby = _nearby(scenario, count)
    first, last_seen = (faces_after(nearby, n - 1) == Face.HEADS for n in (1, IMPACTS))
    tosses = (by_analytic, mujoco)
    impacts = [(toss.impacts, toss.trusted_impacts) for toss in tosses]
    largest = np.array([np.abs(each.angular_velocity_after[:n]).max(axis=0) for each, n in impacts])
    # Along the floor, of the contact point.
    slips = [np.linalg.norm(each.contact_velocity_after[:n, :2], axis=1) for each, n in impacts]
    t = np.linspace(0, last, 1500)
    progress(3, 3)
    return Findings(
        data={
            "time": t,
            "analytic": by_analytic.sample(t).position,
            "MuJoCo": mujoco.sample(t).position,
            "impacts": by_analytic.impacts.time[by_analytic.impacts.time < last],
            "stills, time": states.time,
            "stills": np.array(drawn),  # or why there are none
        },
        agreed=common_prefix(by_analytic.sequence, mujoco.sequence),
        sequences=[toss.sequence for toss in tosses],
        trusted=mujoco.trusted_impacts,
        faces=min(len(set(toss.sequence[: toss.trusted_impacts])) for toss in tosses),
        spins=[", ".join(f"{spin:.0f}" for spin in spins) for spins in largest],
        least_spin=largest.min(),
        sliding=[
            f"after {np.sum(slip > SLIDES)} of {len(slip)} trusted impacts, at up to {slip.max():.2g} m/s"
            for slip in slips
        ],
        slip=min(slip.max() for slip in slips),
        no_stills=f"; no stills: {drawn}" if isinstance(drawn, str) else "",
        first=first,
        last=last_seen,
        tails=[share(~first), share(~last_seen)],
        heads=share(last_seen),
    )


def _nearby(scenario: Scenario, count: int) -> Array:
    """Return the scenario `count` times, the attitude at release turned a little at random, (count, m)."""
    rng = np.random.default_rng(SEED)
    turned = Rotation.from_rotvec(rng.uniform(-SPREAD, SPREAD, (count, 3)))
    attitude = Rotation.from_quat(scenario.release.attitude, scalar_first=True) * turned
    fields = [f"release.quaternion.{name}" for name in COMPONENTS["release.quaternion"]]
    return rows_of(scenario, count, dict(zip(fields, attitude.as_quat(scalar_first=True).T, strict=True)))


def _draw(data: Data) -> Figure:
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
