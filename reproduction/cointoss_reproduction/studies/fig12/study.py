"""Fig. 12: the 1D coin, in plane motion by eqs (40)-(48) and by both engines."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from cointoss import Air, Scenario, States, load
from cointoss.study import ANALYTIC, MUJOCO, PALE, Array, parting_time, rotation_matrix
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both, first_touch

STYLES = {"analytic": (ANALYTIC, "-", 4), "MuJoCo": (MUJOCO, ".", 10)}
"""For the path by each engine: its colour, its line, and every how many samples one is drawn."""
COINS = {"imperfect": "fig12_imperfect", "ideal": "fig12_ideal"}
IMPACTS = 4
"""The motion is followed until this one."""
THROUGH = IMPACTS - 1
OFF_THE_AXIS = (-1e-3, -1e-3, 0.0)
"""A mass centre that makes J_ξη ≠ 0 [m]."""
DRAWN = 40
"""How often the coin is drawn."""


def fall(coin: str) -> Iterator[Rows]:
    """Let a 1D coin fall and bounce by both engines, and by eq. (48) until it lands.

    Yields:
        How far each engine leaves the plane [r, rad] and eq. (48) [m, rad]; its path; and the ends of the
        coin at equal intervals [m].
    """
    case = load(coin).replace("ending.max_impacts", IMPACTS)
    tosses = by_both(case)
    t = np.linspace(0, min(toss.impacts.time[-1] for toss in tosses.values()), 600)[:-1]
    falling = t[t < first_touch(tosses)]
    exact = _plane_motion(case, falling)
    for engine, toss in tosses.items():
        states = toss.sample(t)
        off, turned = _apart(toss.sample(falling), exact)
        out = _out_of_plane(case, states)
        yield {"engine": engine, "out_of_plane": out, "off_m": off, "off_rad": turned}
        drawn = states.position[:: STYLES[engine][2]]
        yield pd.DataFrame({"engine": engine, "y": drawn[:, 1], "z": drawn[:, 2]})
    edges = _edges(case, tosses["analytic"].sample(np.linspace(0, t[-1], DRAWN)))
    for number, ends in enumerate(edges):
        yield pd.DataFrame({"edge": number, "y": ends[:, 0], "z": ends[:, 1]})


def tilt() -> Iterator[dict[str, Any]]:
    """Let a coin with J_ξη ≠ 0 fall without air.

    Yields:
        How far ξ tilts by each engine [degrees], and when it passes 1° [s].
    """
    scenario = load(COINS["imperfect"])
    case = scenario.replace("coin.center_of_mass", OFF_THE_AXIS, "air", Air(), "ending.max_impacts", 1)
    tosses = by_both(case)
    t = np.linspace(0, first_touch(tosses), 400)[:-1]
    for engine, toss in tosses.items():
        tilted = np.degrees(np.abs(np.arcsin(_axes(toss.sample(t))[:, 2, 0])))
        yield {"engine": engine, "tilt": tilted.max(), "parted": parting_time(t, tilted, 1.0)}


def _axes(states: States) -> Array:
    """Return the rotation matrices of states, (n, 3, 3)."""
    return np.array([rotation_matrix(tuple(e)) for e in states.quaternion])


def _out_of_plane(case: Scenario, states: States) -> float:
    """Return how far C, in radii, and ξ, in radians, leave the plane yz and the x axis."""
    xi = _axes(states)[:, :, 0]
    return float(
        max(np.abs(states.position[:, 0]).max() / case.coin.radius, np.hypot(xi[:, 1], xi[:, 2]).max())
    )


def _plane_motion(case: Scenario, t: Array) -> Array:
    """Integrate eqs (40) and (48) in y, z and ϑ, in the linear air of `models.drag`; (n, 3) [m, m, rad]."""
    drag, g, m = case.body.drag, case.gravity, case.coin.mass
    eta_C, J_xi = case.coin.center_of_mass[1], case.coin.inertia_about_C[0, 0]

    def rate(_: float, state: Array) -> list[float]:
        _, _, theta, v_y, v_z, turn = state
        cosine, sine = np.cos(theta), np.sin(theta)
        along = v_y * cosine + v_z * sine
        across = -v_y * sine + v_z * cosine - turn * eta_C
        f_eta, f_zeta = -drag.force_tangential * along, -drag.force_normal * across
        f_y, f_z = f_eta * cosine - f_zeta * sine, f_eta * sine + f_zeta * cosine
        moment = -drag.moment_tangential * turn - eta_C * f_zeta
        return [v_y, v_z, turn, f_y / m, f_z / m - g, moment / J_xi]

    release = case.release
    angles = release.angles or (0.0, 0.0, 0.0)
    start = [*release.position[1:], angles[1], *release.velocity[1:], release.angular_velocity[0]]
    found = solve_ivp(rate, (0, t[-1]), start, method="DOP853", t_eval=t, rtol=1e-13, atol=1e-14)
    return found.y[:3].T


def _apart(states: States, exact: Array) -> tuple[float, float]:
    """Return how far states are from `exact` at most: of C [m], and in the attitude [rad]."""
    e0, e1 = states.quaternion[:, 0], states.quaternion[:, 1]
    # Modulo whole turns.
    turned = np.angle(np.exp(1j * (2 * np.arctan2(e1, e0) - exact[:, 2])))
    return float(np.abs(states.position[:, 1:] - exact[:, :2]).max()), float(np.abs(turned).max())


def _edges(case: Scenario, states: States) -> Array:
    """Return the ends of the coin in the plane yz, (n, 2, 2) [m]."""
    eta = _axes(states)[:, 1:, 1]
    B = states.position[:, 1:] - case.coin.center_of_mass[1] * eta
    return np.stack([B - case.coin.radius * eta, B + case.coin.radius * eta], axis=1)


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(9, 3.8))
    coins = cells.dropna(subset=["y"]).groupby("coin", sort=False)
    for axes, (name, coin) in zip(picture.subplots(1, 2, sharey=True), coins, strict=True):
        for _, ends in coin.groupby("edge"):
            axes.plot(100 * ends["y"], 100 * ends["z"], color=PALE, linewidth=1.6)
        for engine, path in coin.groupby("engine"):
            color, line, _ = STYLES[str(engine)]
            axes.plot(100 * path["y"], 100 * path["z"], line, color=color, markersize=4, label=f"C, {engine}")
        axes.set(title=f"{name} coin", xlabel="y [cm]", ylabel="z [cm]", aspect="equal")
    picture.axes[0].legend()
    return picture


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    return {"off": pd.DataFrame(cells.groupby("engine")[["off_m", "off_rad"]].max()).T}


REPRODUCTION = study(
    __name__, Cells(fall, {"coin": COINS}), Cells(tilt, {}), found=_found, draw={"figure": _draw}
)
