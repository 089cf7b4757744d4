"""Figs 21-22: the scaled thin coin in air: speed, acceleration, tilt, and the vertical force of the air."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure as Picture

import analytic
import coin_mj
from analytic.air.force import force_and_moment
from compare.metrics.trajectories import distance
from compare.reproduction.findings import Finding, Result, paper_figure
from compare.reproduction.runner import Progress
from models.attitude import rotation_matrix
from models.reading import load
from models.records import Array, States
from models.scenario import Air, Scenario

SHOWN = 6.0
"""How long the picture follows the fall [s]."""
COLUMNS = ("speed [m/s]", "acceleration [m/s²]", "cos θ", "f_rz [N]")


def make(progress: Progress) -> Result:
    """Let the coin fall without and with air; MuJoCo follows it with air."""
    with_air = load("fig21")
    without = with_air.replace("air", Air())
    fallen, still, mujoco = analytic.toss(with_air), analytic.toss(without), coin_mj.toss(with_air)
    t_end = min(float(toss.impacts.time[0]) for toss in (fallen, mujoco))
    # At the touch itself the state is that after the impact.
    t = np.linspace(0, t_end, 2001)[:-1]
    t_0 = np.linspace(0, float(still.impacts.time[0]), 1001)[:-1]
    path = fallen.sample(t)
    shown, shown_0 = _columns(with_air, path), _columns(without, still.sample(t_0))
    progress(1, 1)
    cosine = shown[:, 2]
    turns = t[1:-1][np.diff(np.sign(np.diff(cosine))) != 0]
    swings = np.diff(turns)
    last = path.angular_velocity[-1, 0]
    apart = float(distance(path, mujoco.sample(t)).max())
    findings = (
        Finding(
            claim="in air speed and acceleration oscillate, without it they are straight lines (Fig. 21)",
            ours=(
                f"acceleration swings between {shown[:, 1].min():.2f} and {shown[:, 1].max():.2f} m/s²; "
                f"without air within {np.ptp(shown_0[:, 1]):.1g} of g"
            ),
            mujoco=f"within {apart:.1g} m of ours in {t_end:.1f} s",
            holds=bool(np.ptp(shown[:, 1]) > 0.1 and np.ptp(shown_0[:, 1]) < 1e-9),
        ),
        Finding(
            claim="the tilt changes slower and slower, and becomes constant (Fig. 22)",
            ours=(
                f"{len(turns)} turning points of cos θ, {swings[0]:.2f} s apart at first and "
                f"{swings[-1]:.2f} s at last; θ̇ falls from 20 to {abs(last):.1g} rad/s"
            ),
            holds=bool(np.all(np.diff(swings) > 0) and abs(last) < 1e-3),
        ),
    )
    data = {"time": t, "columns": shown, "time without air": t_0, "columns without air": shown_0}
    return Result(findings=findings, draw=partial(_draw, data), data=data)


def _columns(scenario: Scenario, path: States) -> Array:
    """Give the `COLUMNS` of a path, (n, 4)."""
    rows = []
    for v, e, w in zip(path.velocity, path.quaternion, path.angular_velocity, strict=True):
        R = np.array(rotation_matrix(tuple(e)))
        f, _ = force_and_moment(scenario.body, tuple(R.T @ v), tuple(w))
        force = R @ np.array(f)
        a = force / scenario.coin.mass - [0, 0, scenario.gravity]
        rows.append([np.linalg.norm(v), np.linalg.norm(a), R[2, 2], force[2]])
    return np.array(rows)


def _draw(data: dict[str, Array]) -> Picture:
    picture = Picture(figsize=(8, 4.6))
    for number, (axes, name) in enumerate(zip(picture.subplots(2, 2).flat, COLUMNS, strict=True)):
        without = data["columns without air"][:, number]
        axes.plot(data["time without air"], without, ":", color="#9aa4b0", linewidth=1, label="without")
        axes.plot(data["time"], data["columns"][:, number], color="#0072B2", label="in air")
        axes.set(xlabel="time [s]", ylabel=name, xlim=(0, SHOWN))
    picture.axes[0].legend()
    return picture


FIGURE = paper_figure(
    paper="Figs 21-22",
    title="the scaled coin in air: its speed oscillates, its tilt becomes constant",
    assumed=(
        "Height and spin are unsaid; here 200 m and 20 rad/s, enough for a few turns. The paper's caption "
        "swaps solid and dotted lines."
    ),
    seconds=10,
    make=make,
)
