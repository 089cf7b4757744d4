"""Fig. 12: the 1D coin, in plane motion by eqs (40)-(48) and by both engines."""

import numpy as np
from matplotlib.figure import Figure
from scipy.integrate import solve_ivp

from cointoss import Air, Scenario, States, Toss, analytic, coin_mj, load
from cointoss.study import ANALYTIC, MUJOCO, PALE, Array, Progress, parting_time, rotation_matrix
from cointoss_reproduction.frame.declared import Data, Findings, declared

ENGINES = {"analytic": (ANALYTIC, "-", 1), "MuJoCo": (MUJOCO, ".", 10)}
COINS = {"imperfect": "fig12_imperfect", "ideal": "fig12_ideal"}
IMPACTS = 4
"""The motion is followed until this one."""
OFF_THE_AXIS = (-1e-3, -1e-3, 0.0)
"""A mass centre that makes J_ξη ≠ 0 [m]."""
DRAWN = 40
"""How often the coin is drawn."""


def make(progress: Progress) -> Findings:
    """Let both 1D coins fall and bounce by both engines, and by eq. (48) until they land."""
    data: Data = {}
    found = Findings(data=data)
    out_of_plane, from_eq_48 = np.zeros((2, 2)), np.zeros((2, 2, 2))
    for row, (name, file) in enumerate(COINS.items()):
        scenario = load(file)
        case = scenario.replace("ending.max_impacts", IMPACTS)
        tosses = analytic.toss(case), coin_mj.toss(case)
        t = np.linspace(0, min(toss.impacts.time[-1] for toss in tosses), 600)[:-1]
        falling = t[t < min(toss.impacts.time[0] for toss in tosses)]
        exact = _plane_motion(case, falling)
        for column, toss in enumerate(tosses):
            states = toss.sample(t)
            out_of_plane[column, row] = _out_of_plane(case, states)
            from_eq_48[column, row] = _apart(toss.sample(falling), exact)
            engine = list(ENGINES)[column]
            data |= {f"{name}, {engine}, position": states.position, f"{name}, time": t}
        data |= _edges(name, case, tosses[0], t[-1])
        progress(row + 1, 3)
    found.tilt, found.parted = _product_of_inertia()
    progress(3, 3)
    found.out_of_plane = out_of_plane
    found.through = IMPACTS - 1
    found.from_eq_48, found.distances = from_eq_48, [_distances(each) for each in from_eq_48]
    return found


def _distances(found: Array) -> str:
    return f"within {found[:, 0].max():.0e} m and {found[:, 1].max():.0e} rad until the coin lands"


def _out_of_plane(case: Scenario, states: States) -> float:
    """Return how far C, in radii, and ξ, in radians, leave the plane yz and the x axis."""
    xi = np.array([np.array(rotation_matrix(tuple(e)))[:, 0] for e in states.quaternion])
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


def _product_of_inertia() -> tuple[Array, float]:
    """Let a coin with J_ξη ≠ 0 fall without air; return how far ξ tilts by both engines [degrees], and
    when it passes 1° by the analytic one [s]."""
    scenario = load(COINS["imperfect"])
    case = scenario.replace("coin.center_of_mass", OFF_THE_AXIS, "air", Air(), "ending.max_impacts", 1)
    tosses = analytic.toss(case), coin_mj.toss(case)
    t = np.linspace(0, min(toss.impacts.time[0] for toss in tosses), 400)[:-1]
    tilts = [np.degrees(np.abs(_height_of_xi(toss.sample(t)))) for toss in tosses]
    return np.max(tilts, axis=1), parting_time(t, tilts[0], 1.0) or np.nan


def _height_of_xi(states: States) -> Array:
    e0, e1, e2, e3 = states.quaternion.T
    return np.arcsin(2 * (e1 * e3 - e0 * e2))


def _edges(name: str, case: Scenario, toss: Toss, until: float) -> dict[str, Array]:
    """Return the ends of the coin in the plane yz at equal intervals, to be drawn, (n, 2, 2) [m]."""
    states = toss.sample(np.linspace(0, until, DRAWN))
    eta = np.array([np.array(rotation_matrix(tuple(e)))[1:, 1] for e in states.quaternion])
    B = states.position[:, 1:] - case.coin.center_of_mass[1] * eta
    ends = np.stack([B - case.coin.radius * eta, B + case.coin.radius * eta], axis=1)
    return {f"{name}, edge": ends}


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.8))
    for axes, name in zip(picture.subplots(1, 2, sharey=True), COINS, strict=True):
        for ends in data[f"{name}, edge"]:
            axes.plot(*(100 * ends.T), color=PALE, linewidth=1.6)
        for engine, (color, line, part) in ENGINES.items():
            _, y, z = 100 * data[f"{name}, {engine}, position"][::part].T
            axes.plot(y, z, line, color=color, markersize=4, label=f"C, {engine}")
        axes.set(title=f"{name} coin", xlabel="y [cm]", aspect="equal")
    picture.axes[0].set_ylabel("z [cm]")
    picture.axes[0].legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
