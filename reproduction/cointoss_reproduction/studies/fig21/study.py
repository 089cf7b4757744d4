"""Figs 21-22: the scaled thin coin in air: speed, acceleration, tilt, and the vertical force of the air."""

import numpy as np
from matplotlib.figure import Figure

from cointoss import Air, Scenario, States, analytic, coin_mj, load
from cointoss.study import BLUE, GREY, Array, Progress, distance, force_and_moment, rotation_matrix
from cointoss_reproduction.frame.declared import Data, Findings, declared

SHOWN = 6.0
"""How long the picture follows the fall [s]."""
FIGURES = ("21(a)", "21(b)", "22(a)", "22(b)")
COLUMNS = ("speed [m/s]", "acceleration [m/s²]", "cos θ", "f_rz [N]")


def make(progress: Progress) -> Findings:
    """Let the coin fall without and with air; MuJoCo follows it with air."""
    found = Findings()
    with_air = load("fig21")
    without = with_air.replace("air", Air())
    fallen, still, mujoco = analytic.toss(with_air), analytic.toss(without), coin_mj.toss(with_air)
    found.t_end = min(float(toss.impacts.time[0]) for toss in (fallen, mujoco))
    # At the touch itself the state is that after the impact.
    t = np.linspace(0, found.t_end, 2001)[:-1]
    t_0 = np.linspace(0, float(still.impacts.time[0]), 1001)[:-1]
    path = fallen.sample(t)
    shown, shown_0 = _columns(with_air, path), _columns(without, still.sample(t_0))
    progress(1, 1)
    cosine = shown[:, 2]
    found.turns = turns = t[1:-1][np.diff(np.sign(np.diff(cosine))) != 0]
    found.swings = np.diff(turns)
    found.growth = np.diff(found.swings)
    found.last = abs(path.angular_velocity[-1, 0])
    found.apart = float(distance(path, mujoco.sample(t)).max())
    found.acceleration = shown[:, 1]
    found.swing, found.swing_without = np.ptp(shown[:, 1]), np.ptp(shown_0[:, 1])
    found.data = {"time": t, "columns": shown, "time without air": t_0, "columns without air": shown_0}
    return found


def _columns(scenario: Scenario, path: States) -> Array:
    """Return the `COLUMNS` of a path, (n, 4)."""
    rows = []
    for v, e, w in zip(path.velocity, path.quaternion, path.angular_velocity, strict=True):
        R = np.array(rotation_matrix(tuple(e)))
        f, _ = force_and_moment(scenario.body, tuple(R.T @ v), tuple(w))
        force = R @ np.array(f)
        a = force / scenario.coin.mass - [0, 0, scenario.gravity]
        rows.append([np.linalg.norm(v), np.linalg.norm(a), R[2, 2], force[2]])
    return np.array(rows)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(8, 4.6))
    for number, (axes, name) in enumerate(zip(picture.subplots(2, 2).flat, COLUMNS, strict=True)):
        for media, style, color, label in (
            (" without air", ":", GREY, "without air"),
            ("", "-", BLUE, "in air"),
        ):
            t = data[f"time{media}"]
            shown = t <= SHOWN
            axes.plot(t[shown], data[f"columns{media}"][shown, number], style, color=color, label=label)
        axes.set(xlabel="time [s]", ylabel=name, xlim=(0, SHOWN))
        axes.set_title(f"Fig. {FIGURES[number]}", loc="left")
    picture.axes[0].legend(loc="upper left")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
