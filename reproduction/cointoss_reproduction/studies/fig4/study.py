"""Fig. 4 and section 2: the angle between angular momentum and normal, and the faces that it keeps."""

import numpy as np
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from cointoss import Air, EndingCriteria, Release, Scenario, States, analytic, coin_mj, load
from cointoss.study import (
    BLUE,
    GREY,
    ORANGE,
    PALE,
    SKY,
    VERMILION,
    Array,
    Progress,
    by_numba,
    sample_flight,
    vector,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared

sample_flight = by_numba(sample_flight)

AIR = Air(normal=0.8, tangential=0.2)
CASES = {
    "ideal, vacuum": ("fig4_ideal", Air(), BLUE),
    "ideal, air": ("fig4_ideal", AIR, SKY),
    "imperfect, vacuum": ("fig4_imperfect", Air(), VERMILION),
}
DURATION, SAMPLES = 0.5, 400
"""Of a random toss [s], and how often its face is sampled."""
MUJOCO_TOSSES = 10
TURNS = 4000
"""Samples of one turn of the normal about the angular momentum."""
DIACONIS = np.radians(79.95), 0.51
"""The angle ψ and the probability of the first side there, by Diaconis, Holmes and Montgomery 2007."""


def make(progress: Progress, count: int = 1000) -> Findings:
    """Follow γ in three flights; toss `count` coins from flat, and as many from any attitude, at random."""
    found = Findings()
    followed = {name: _follow(load(file), air) for name, (file, air, _) in CASES.items()}
    progress(1, 4)
    rng = np.random.default_rng(4)
    flat, leaning = (_random_tosses(rng, count, anyhow) for anyhow in (False, True))
    progress(2, 4)
    psi, counted, found.by_mujoco = _first_side()
    progress(3, 4)
    found.swing = np.array([[np.ptp(gamma) for gamma in gammas] for _, *gammas in followed.values()])
    below = [tosses["gamma"] < np.pi / 4 for tosses in (flat, leaning)]
    changed = [tosses["lowest"] < 0 for tosses in (flat, leaning)]
    found.below = [int(chosen.sum()) for chosen in below]
    found.changed = [int(np.sum(both & chosen)) for both, chosen in zip(changed, below, strict=True)]
    foretold = np.abs(leaning["L"][:, 2]) > np.sin(leaning["gamma"])
    found.apart = max(tosses["apart"].max() for tosses in (flat, leaning))
    found.mujoco_apart, found.quarter = _mujoco_apart(flat), count / 4
    found.foretold = np.mean(foretold == (leaning["lowest"] > 0))
    angle, p = DIACONIS
    found.psi, found.p = np.degrees(angle), p
    found.counted = counted[-1]
    found.closed_form = first_side(angle)
    found.off = np.abs(counted - first_side(psi)).max()
    found.two_samples = 2 / TURNS
    found.mujoco_off = abs(found.by_mujoco - counted[-1])
    found.printed_off = float(abs(found.closed_form - p))
    found.data = {
        f"{name}, {part}": row
        for name, rows in followed.items()
        for part, row in zip(("time", "analytic", "MuJoCo"), rows, strict=True)
    }
    for name, tosses in (("flat", flat), ("leaning", leaning)):
        found.data |= {f"{name}, {part}": tosses[part] for part in ("gamma", "lowest")}
    found.data |= {"psi": psi, "counted": counted}
    progress(4, 4)
    return found


def first_side(psi: Array | float) -> Array:
    """Return the probability that the first side is up; Diaconis, Holmes and Montgomery 2007, theorem 2.

    The ideal coin is released flat, and caught after a time that leaves every phase of its turn about the
    angular momentum as likely.

    Args:
        psi: ψ, between normal and angular momentum, from 0 to π/2 [rad].
    """
    cotangent = np.minimum(1 / np.tan(psi), 1)
    return 1 / 2 + np.arcsin(cotangent**2) / np.pi


def _follow(scenario: Scenario, air: Air) -> tuple[Array, Array, Array]:
    """Return times [s], and γ by both engines [degrees], until the coin lands."""
    case = scenario.replace("air", air, "ending", EndingCriteria(max_impacts=1))
    tosses = analytic.toss(case), coin_mj.toss(case)
    # At the touch itself the state is that after the impact.
    t = np.linspace(0, min(toss.impacts.time[0] for toss in tosses), 301)[:-1]
    by_analytic, mujoco = (np.degrees(_gamma(case, toss.sample(t))) for toss in tosses)
    return t, by_analytic, mujoco


def _gamma(case: Scenario, states: States) -> Array:
    """Return the angle between the angular momentum and the normal, (n,) [rad]."""
    L = states.angular_velocity @ case.coin.inertia_about_C
    return np.arctan2(np.hypot(L[:, 0], L[:, 1]), L[:, 2])


def _random_tosses(rng: np.random.Generator, count: int, anyhow: bool) -> dict[str, Array]:
    """Toss the ideal coin at random, flat or `anyhow`; γ is up to π/2, the turn up to 100 rad/s.

    Returns:
        For each toss its start, γ, the least |n_z| while its first side is up, or less than 0 where it turns
        over, and how far n_z is from the closed form.
    """
    scenario = load("fig4_ideal")
    J = np.diag(scenario.coin.inertia_about_C)
    gamma, turn = rng.uniform(0, np.pi / 2, count), rng.uniform(20, 100, count)
    around = rng.uniform(0, 2 * np.pi, count)
    L = np.stack([np.sin(gamma) * np.cos(around), np.sin(gamma) * np.sin(around), np.cos(gamma)], axis=1)
    w = L * (turn * J[0])[:, None] / J
    attitude = Rotation.random(count, rng=rng) if anyhow else Rotation.identity(count)
    e = attitude.as_quat(scalar_first=True)
    starts = np.hstack([np.zeros((count, 6)), e, w])
    times, states = np.linspace(0, DURATION, SAMPLES), np.empty((SAMPLES, 13))
    found = np.empty((count, 2))
    L_space = attitude.apply(L)
    n_0 = attitude.apply([0, 0, 1])
    for i in range(count):
        sample_flight(scenario.body, starts[i], 0.0, times, states)
        heights = 1 - 2 * (states[:, 7] ** 2 + states[:, 8] ** 2)
        apart = np.abs(heights - _closed_form(n_0[i], L_space[i], turn[i], times)).max()
        found[i] = (np.sign(heights[0]) * heights).min(), apart
    lowest, apart = found.T
    return {"w": w, "L": L_space, "turn": turn, "gamma": gamma, "lowest": lowest, "apart": apart}


def _closed_form(n: Array, L: Array, turn: float, times: Array) -> Array:
    """Return n_z(t) of the ideal coin without air: its normal n turns about L.

    Args:
        n: at time 0, space frame, (3,).
        L: direction of the angular momentum, space frame, (3,).
        turn: |L|/J_ξ [rad/s].
        times: (n,) [s].
    """
    along = (n @ L) * L
    return along[2] + (n - along)[2] * np.cos(turn * times) + np.cross(L, n)[2] * np.sin(turn * times)


def _mujoco_apart(tosses: dict[str, Array]) -> float:
    """Return how far n_z by MuJoCo is from the closed form in the first tosses from flat."""
    scenario, times = load("fig4_ideal"), np.linspace(0, DURATION, 50)
    apart = []
    for i in range(MUJOCO_TOSSES):
        release = Release(position=(0.0, 0.0, 2.0), angular_velocity=vector(tosses["w"][i]))
        case = scenario.replace("release", release, "ending", EndingCriteria(max_time=DURATION))
        heights = coin_mj.toss(case).sample(times).normal[:, 2]
        exact = _closed_form(np.array([0, 0, 1.0]), tosses["L"][i], tosses["turn"][i], times)
        apart.append(np.abs(heights - exact).max())
    return float(max(apart))


def _first_side() -> tuple[Array, Array, float]:
    """Count for how much of a turn the first side is up.

    Returns:
        Angles ψ [rad], the parts by the analytic engine, and that by MuJoCo at the last angle.
    """
    scenario = load("fig4_ideal")
    psi = np.array([*np.radians(np.arange(40, 90, 4)), DIACONIS[0]])
    J, turn = np.diag(scenario.coin.inertia_about_C), 60.0
    # In the middles of equal parts of the turn.
    times = (np.arange(TURNS) + 0.5) / TURNS * 2 * np.pi / turn
    counted, states = [], np.empty((TURNS, 13))
    w = np.zeros(3)
    for angle in psi:
        w = turn * J[0] * np.array([0, np.sin(angle), np.cos(angle)]) / J
        sample_flight(scenario.body, np.array([0, 0, 0, 0, 0, 0, 1.0, 0, 0, 0, *w]), 0.0, times, states)
        counted.append(np.mean(1 - 2 * (states[:, 7] ** 2 + states[:, 8] ** 2) > 0))
    release = Release(position=(0.0, 0.0, 1.0), velocity=(0.0, 0.0, 2.0), angular_velocity=vector(w))
    ending = EndingCriteria(max_time=2 * np.pi / turn)
    mujoco = coin_mj.toss(scenario.replace("release", release, "ending", ending))
    return psi, np.array(counted), float(np.mean(mujoco.sample(times).normal[:, 2] > 0))


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(10, 3.5))
    angle, heights, sides = picture.subplots(1, 3)
    for name, (_, _, color) in CASES.items():
        t = data[f"{name}, time"]
        angle.plot(t, data[f"{name}, analytic"], color=color, label=name)
        angle.plot(t[::20], data[f"{name}, MuJoCo"][::20], "o", color=color, markersize=3)
    angle.set(title="lines: analytic; dots: MuJoCo", xlabel="time [s]", ylabel="γ [°]")
    angle.legend()
    for name, color in (("leaning", ORANGE), ("flat", BLUE)):
        gamma = np.degrees(data[f"{name}, gamma"])
        heights.plot(gamma, data[f"{name}, lowest"], ".", color=color, markersize=2)
        heights.plot([], [], "o", color=color, label=f"released {name}")
    heights.axvline(45, color=GREY, linewidth=0.8)
    heights.axhline(0, color=GREY, linewidth=0.8)
    heights.set(
        title="random tosses", xlabel="γ [°]", ylabel="lowest n_z of the first side", xticks=range(0, 91, 15)
    )
    heights.legend(loc="upper right")
    psi = np.radians(np.linspace(40, 90, 300))
    sides.plot(np.degrees(psi), first_side(psi), color=PALE, label="closed form")
    sides.plot(np.degrees(data["psi"]), data["counted"], "o", color=BLUE, markersize=4, label="counted")
    sides.set(title="first side up", xlabel="ψ [°]", ylabel="p")
    sides.legend()
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
