"""Fig. 4 and section 2: the angle between angular momentum and normal, and the faces that it keeps."""

from functools import partial

import numpy as np
from matplotlib.figure import Figure
from scipy.spatial.transform import Rotation

from cointoss import analytic, coin_mj
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREY, ORANGE, PALE, SKY, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.parts import Air, EndingCriteria, Release
from cointoss.models.reading import load
from cointoss.models.records import Array, States
from cointoss.models.scenario import Scenario, vector

AIR = Air(normal=0.8, tangential=0.2)
CASES = {
    "ideal, vacuum": ("fig4_ideal", Air(), BLUE),
    "ideal, air": ("fig4_ideal", AIR, SKY),
    "imperfect, vacuum": ("fig4_imperfect", Air(), VERMILION),
}
KEPT = 1e-8
"""An angle that changes less stays [degrees]."""
CHANGED = 0.1
"""One that changes more does not [degrees]."""
DURATION, SAMPLES = 0.5, 400
"""Of a random toss [s], and how often its face is sampled."""
MUJOCO_TOSSES = 10
TURNS = 4000
"""Samples of one turn of the normal about the angular momentum."""
DIACONIS = np.radians(79.95), 0.51
"""The angle ψ and the probability of the first side there, by Diaconis, Holmes and Montgomery 2007."""


def make(progress: Progress, count: int = 1000) -> Result:
    """Follow γ in three flights; toss `count` coins from flat, and as many from any attitude, at random."""
    followed = {name: _follow(load(file), air) for name, (file, air, _) in CASES.items()}
    progress(1, 4)
    rng = np.random.default_rng(4)
    flat, leaning = (_random_tosses(rng, count, anyhow) for anyhow in (False, True))
    progress(2, 4)
    psi, counted, by_mujoco = _first_side()
    progress(3, 4)
    swing = {name: [float(np.ptp(gamma)) for gamma in gammas] for name, (_, *gammas) in followed.items()}
    below, below_leaning = (tosses["gamma"] < np.pi / 4 for tosses in (flat, leaning))
    changed, changed_leaning = (
        int(np.sum((tosses["lowest"] < 0) & chosen))
        for tosses, chosen in ((flat, below), (leaning, below_leaning))
    )
    foretold = np.abs(leaning["L"][:, 2]) > np.sin(leaning["gamma"])
    apart = max(tosses["apart"].max() for tosses in (flat, leaning))
    claims = (
        _about_gamma("without air the ideal coin keeps γ", swing["ideal, vacuum"], constant=True),
        _about_gamma("with air it does not", swing["ideal, air"], constant=False),
        _about_gamma("γ of the imperfect coin changes", swing["imperfect, vacuum"], constant=False),
        Claim(
            claim="the ideal coin with γ < π/4 never changes its face (if released flat)",
            analytic=(
                f"{changed} of {below.sum()} random tosses change it; n_z within {apart:.0e} of the closed "
                "form"
            ),
            mujoco=f"n_z within {_mujoco_apart(flat):.0e} of the closed form in {MUJOCO_TOSSES} tosses",
            criteria=[
                Criterion("tosses that change it", changed, "=", 0, "never"),
                Criterion("tosses with γ < π/4", below.sum(), ">", count / 4, "about half of them are"),
                Criterion("n_z off the closed form", apart, "<", 1e-9, "rounding"),
            ],
        ),
        Claim(
            claim="the ideal coin with γ < π/4 never changes its face (as printed, however released)",
            analytic=(
                f"{changed_leaning} of {below_leaning.sum()} random tosses from any attitude change it; the "
                "angular momentum must lie within π/2 - γ of the vertical, which is right for "
                f"{np.mean(foretold == (leaning['lowest'] > 0)):.1%} of all {count}"
            ),
            criteria=[Criterion("tosses that change it", changed_leaning, "=", 0, "never")],
            expected=False,
        ),
        Claim(
            claim=f"the first side has p = {DIACONIS[1]} at ψ = {np.degrees(DIACONIS[0]):.2f}° (section 1)",
            analytic=(
                f"{counted[-1]:.4f} of a turn; p(ψ) in closed form {first_side(DIACONIS[0]):.4f}, at other "
                f"angles within {np.abs(counted - first_side(psi)).max():.0e}"
            ),
            mujoco=f"{by_mujoco:.4f}",
            criteria=[
                Criterion(
                    "counted off the closed form",
                    np.abs(counted - first_side(psi)).max(),
                    "<",
                    2 / TURNS,
                    "one sample at each change of face",
                ),
                Criterion(
                    "MuJoCo off the analytic engine", abs(by_mujoco - counted[-1]), "<", 2 / TURNS, "as above"
                ),
                Criterion(
                    "closed form off the printed p",
                    float(abs(first_side(DIACONIS[0]) - DIACONIS[1])),
                    "<",
                    5e-5,
                    "p = 0.5100 to four places",
                ),
            ],
        ),
    )
    data = {
        f"{name}, {part}": row
        for name, rows in followed.items()
        for part, row in zip(("time", "analytic", "MuJoCo"), rows, strict=True)
    }
    for name, tosses in (("flat", flat), ("leaning", leaning)):
        data |= {f"{name}, {part}": tosses[part] for part in ("gamma", "lowest")}
    data |= {"psi": psi, "counted": counted}
    progress(4, 4)
    return Result(claims=claims, data=data)


def first_side(psi: Array | float) -> Array:
    """Return the probability that the first side is up; Diaconis, Holmes and Montgomery 2007, theorem 2.

    The ideal coin is released flat, and caught after a time that leaves every phase of its turn about the
    angular momentum as likely.

    Args:
        psi: ψ, between normal and angular momentum, from 0 to π/2 [rad].
    """
    cotangent = np.minimum(1 / np.tan(psi), 1)
    return 1 / 2 + np.arcsin(cotangent**2) / np.pi


def _about_gamma(claim: str, swing: list[float], *, constant: bool) -> Claim:
    by_analytic, mujoco = swing
    return Claim(
        claim=claim,
        analytic=f"γ changes by {by_analytic:.2g}°",
        mujoco=f"by {mujoco:.2g}°",
        criteria=[
            Criterion(
                "largest change [°]", max(by_analytic, mujoco), "<", KEPT, "rounding and MuJoCo's steps"
            )
            if constant
            else Criterion("least change [°]", min(by_analytic, mujoco), ">", CHANGED, "what a picture shows")
        ],
    )


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


def _draw(data: dict[str, Array]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Fig. 4",
    title="the angle between angular momentum and normal, and the faces that it keeps",
    assumed=(
        "The paper gives no release; here flat, (0, 40, 30) rad/s. It says of γ < π/4 no more than that, and "
        "means a coin released flat, as Diaconis, Holmes and Montgomery do."
    ),
    seconds=15,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, count=300),
)
