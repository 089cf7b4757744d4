"""Claims of sections 4.2 and 5.1: what the air does to a falling coin, over 20 cm and over 50 m."""

from functools import partial
from types import ModuleType
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.analytic.events import run
from cointoss.analytic.toss import state_of
from cointoss.coin_mj.toss import impacts_of
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, GREY, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.planar_maps import SPINS, case, releases
from cointoss.models.parts import EndingCriteria, Release
from cointoss.models.reading import load
from cointoss.models.records import Array
from cointoss.models.scenario import Scenario

FALLS = np.array([0.2, 0.4, 1.0, 1.86, 5.0, 10.0, 20.0, 50.0])
"""Heights of release [m]; the hand's 0.4 m, and the 1.86 m of the drops of section 2."""
HAND, LONG = 1, 7
"""The fall from a hand and the longest one, of `FALLS`."""
SEED = 51
MUJOCO_TOSSES = 8
DROPPED = IDEAL, IMPERFECT = "fig3_tilted", "fig3_tilted_imperfect"
"""The coins dropped without spin."""
TILT = np.pi / 4
"""Of the coin dropped without spin, as in Fig. 3(d)-(f)."""
SAMPLES = 4000
"""Of a fall."""
NEGLIGIBLE = 0.01
"""A share of the tosses that can be neglected."""
AIR_DENSITY, AIR_VISCOSITY = 1.204, 1.516e-5
"""Of the air at 20 °C: ρ [kg/m³] and the kinematic ν [m²/s]."""
DISC_DRAG = 1.17
"""C_D of a disc broadside on, at Reynolds numbers above 10³; Hoerner, Fluid-Dynamic Drag (1965)."""
TERMINAL_TIMES = {0.0: 40.0, 1.0: 8.0}
"""In which the coin comes within a part in 10³ of its terminal speed, by the exponent b [s]."""


def make(progress: Progress, count: int = 4000) -> Result:
    """Let `count` spinning coins fall from each height in air and in vacuum, and single ones without spin."""
    spins = np.random.default_rng(SEED).uniform(*SPINS, count)
    rows = []
    for done, height in enumerate(FALLS.tolist(), start=1):
        rows.append(landing_shifts(height, spins))
        progress(done, len(FALLS) + 1)
    later, turned, aside = np.array([row[:3] for row in rows]).T
    changed = [row[3] for row in rows]
    bounced = _bounced(spins)
    drops = {name: _tilts(analytic, name, FALLS) for name in DROPPED}
    by_mujoco = {name: _tilts(coin_mj, name, FALLS[LONG:]) for name in DROPPED}
    reversals = {name: [turning_points(tilt) for tilt in tilts] for name, (_, tilts, _) in drops.items()}
    reversals_mujoco = {name: turning_points(tilts[0]) for name, (_, tilts, _) in by_mujoco.items()}
    glided = drops[IDEAL][2][LONG]
    terminal = [_terminal(engine, b) for engine in (analytic, coin_mj) for b in TERMINAL_TIMES]
    progress(len(FALLS) + 1, len(FALLS) + 1)
    coin = load("fig3_flat").coin
    area = np.pi * coin.radius**2
    real = np.sqrt(2 * coin.mass * 9.81 / (AIR_DENSITY * DISC_DRAG * area))
    landing = np.sqrt(2 * 9.81 * 1.86)
    reynolds = [2 * r * v / AIR_VISCOSITY for r, v in ((0.01, 10.0), (coin.radius, landing))]
    stokes = AIR_VISCOSITY / (2 * coin.radius) / 9.81
    claims = (
        Claim(
            claim="over a small fall the air can be neglected (the landing)",
            analytic=(
                f"from {FALLS[HAND]:g} m the coin lands {1e3 * later[HAND]:.1f} ms later, "
                f"{np.degrees(turned[HAND]):.1f}° short of its turns and {1e3 * aside[HAND]:.2f} mm aside; "
                f"{changed[HAND].value:.1%} of the tosses land on another face"
            ),
            mujoco=f"lands within {_mujoco_apart(spins):.0e} s and m of the analytic engine",
            criteria=[Criterion("share on another face", changed[HAND], "<", NEGLIGIBLE, "one toss in 100")],
            expected=False,
        ),
        Claim(
            claim="over a small fall the air can be neglected (the final face, after bouncing with χ = 0.6)",
            analytic=f"from {FALLS[HAND]:g} m it changes {bounced.value:.1%} of the outcomes",
            criteria=[Criterion("share of other outcomes", bounced, "<", NEGLIGIBLE, "one toss in 100")],
            expected=False,
        ),
        Claim(
            claim="the path leaves the vertical only a little",
            analytic=(
                f"a spinning coin lands {100 * aside[HAND]:.2g} cm aside from {FALLS[HAND]:g} m, "
                f"{100 * aside[LONG]:.2g} cm from {FALLS[LONG]:g} m; one that keeps 45° glides "
                f"{glided:.1f} m"
            ),
            mujoco=f"glides {by_mujoco[IDEAL][2][0]:.1f} m",
            criteria=[
                Criterion(
                    f"aside of a spinning coin from {FALLS[LONG]:g} m [m]",
                    aside[LONG],
                    "<",
                    0.02 * FALLS[LONG],
                    "2 % of the fall",
                )
            ],
        ),
        Claim(
            claim="from tens of metres the coin flutters like a leaf (the ideal coin)",
            analytic=(
                f"dropped at 45° it keeps its tilt: it turns back {reversals[IDEAL][LONG]} times in "
                f"{FALLS[LONG]:g} m, for the air gives an ideal coin no moment but against its spin"
            ),
            mujoco=f"{reversals_mujoco[IDEAL]} times",
            criteria=[Criterion("turns back", reversals[IDEAL][LONG], ">", 0, "a flutter is some")],
            expected=False,
        ),
        Claim(
            claim="from tens of metres the coin flutters like a leaf (the imperfect coin)",
            analytic=(
                "dropped at 45° it swings its heavy side down and turns back "
                + ", ".join(f"{reversals[IMPERFECT][i]} times in {FALLS[i]:g} m" for i in (3, 5, 6, 7))
            ),
            mujoco=f"{reversals_mujoco[IMPERFECT]} times in {FALLS[LONG]:g} m",
            criteria=[Criterion("turns back", reversals[IMPERFECT][LONG], ">", 5, "a flutter goes on")],
        ),
        Claim(
            claim="linear air with λ_n = 0.8 is a real coin's (section 2): broadside it sinks as fast",
            analytic=(
                f"its terminal speed is {terminal[0]:.1f} m/s; a real disc's with C_D = {DISC_DRAG:g} is "
                f"{real:.1f} m/s; read as quadratic (b = 1) λ_n = 0.8 gives {terminal[1]:.1f} m/s"
            ),
            mujoco=f"{terminal[2]:.1f} and {terminal[3]:.1f} m/s",
            criteria=[
                Criterion(
                    "terminal speed over the real one, less 1",
                    abs(terminal[0] / real - 1),
                    "<",
                    0.2,
                    "C_D is known to about a tenth",
                )
            ],
            expected=False,
        ),
        Claim(
            claim="Re reaches 10⁴, at 10 m/s with r = 1 cm",
            analytic=(
                f"{reynolds[0]:.2g}; {reynolds[1]:.2g} at the end of the drops from 1.86 m, and above 1 from "
                f"{1e6 * stokes:.0f} µs on, where resistance grows faster than v"
            ),
            criteria=[
                Criterion("Re", reynolds[0], ">", 1e4 / 2, "half of it"),
                Criterion("Re", reynolds[0], "<", 1e4 * 2, "twice it: an order of magnitude"),
            ],
        ),
    )
    data: dict[str, NDArray[Any]] = {
        "height": FALLS,
        "later": later,
        "turned": turned,
        "aside": aside,
        "changed": np.array([one.value for one in changed]),
    }
    for name, (times, tilts, _) in drops.items():
        data |= {f"{name}, time": times[-1], f"{name}, tilt": tilts[-1]}
    return Result(claims=claims, data=data)


def landing_shifts(height: float, spins: Array) -> tuple[float, float, float, Estimate]:
    """Compare coins that fall from one height in air with the same in vacuum, up to the first touch.

    Args:
        height: of the release [m].
        spins: about ξ, (n,) [rad/s].

    Returns:
        Medians of how much later [s], how much less turned [rad] and how far aside [m] they land, and the
        share that lands on another face.
    """
    rows = []
    for air in (True, False):
        scenario = _one_touch(case(air=air))
        start = releases(np.full_like(spins, height), spins)
        states = [np.array([0, 0, height, 0, 0, 0, 1.0, 0, 0, 0, *w]) for w in start.angular_velocity]
        rows.append(np.array([run(scenario.body, scenario.rules, y).rows[0] for y in states]))
    air, vacuum = rows
    body = case(air=True).body
    rate = body.drag.moment_tangential / body.inertia[0][0]
    # About a fixed axis the spin dies out exponentially.
    turned = spins * (vacuum["time"] - (1 - np.exp(-rate * air["time"])) / rate)
    return (
        float(np.median(air["time"] - vacuum["time"])),
        float(np.median(np.abs(turned))),
        float(np.median(np.hypot(air["position"][:, 0], air["position"][:, 1]))),
        share(air["face"] != vacuum["face"]),
    )


def _one_touch(scenario: Scenario) -> Scenario:
    return scenario.replace("ending", EndingCriteria(max_impacts=1))


def _bounced(spins: Array) -> Estimate:
    """Return the share of the tosses from a hand's height whose final face the air changes."""
    start = releases(np.full_like(spins, FALLS[HAND]), spins)
    air, vacuum = (analytic.toss_many(case(air=air), start).outcome for air in (True, False))
    return share(air != vacuum)


def _mujoco_apart(spins: Array) -> float:
    """Return how far MuJoCo's landings in air are from the analytic engine's, in time [s] or place [m]."""
    apart = []
    for w in spins[:MUJOCO_TOSSES].tolist():
        release = Release(position=(0.0, 0.0, float(FALLS[HAND])), angular_velocity=(w, 0.0, 0.0))
        scenario = _one_touch(case(air=True)).replace("release", release)
        landed = run(scenario.body, scenario.rules, state_of(release)).rows[0]
        found = impacts_of(scenario)
        apart += [abs(found.time[0] - landed["time"]), np.abs(found.position[0] - landed["position"]).max()]
    return float(max(apart))


def _tilts(engine: ModuleType, name: str, falls: Array) -> tuple[list[Array], list[Array], list[float]]:
    """Drop a coin at 45° without spin from each height.

    Returns:
        Times [s] and angles between normal and vertical [rad] of each fall, and how far aside it ends [m].
    """
    scenario = _one_touch(load(name))
    times, tilts, aside = [], [], []
    for height in falls.tolist():
        release = Release(position=(0.0, 0.0, height), angles=(0.0, TILT, 0.0))
        toss = engine.toss(scenario.replace("release", release))
        # At the touch itself the state is that after the impact.
        t = np.linspace(0, toss.impacts.time[0], SAMPLES)[:-1]
        times.append(t)
        tilts.append(np.arccos(np.clip(toss.sample(t).normal[:, 2], -1, 1)))
        aside.append(float(np.hypot(*toss.impacts.position[0][:2])))
    return times, tilts, aside


def turning_points(tilt: Array) -> int:
    """Count how often a tilt turns back by more than rounding."""
    steps = np.diff(tilt)
    signs = np.sign(steps[np.abs(steps) > 1e-9])
    return int(np.sum(signs[1:] != signs[:-1]))


def _terminal(engine: ModuleType, exponent: float) -> float:
    """Return the speed of a long fall broadside on [m/s]."""
    scenario = load("fig3_flat")
    release, ending = Release(position=(0.0, 0.0, 5000.0)), EndingCriteria(max_time=TERMINAL_TIMES[exponent])
    falling = scenario.replace("air.exponent", exponent, "release", release, "ending", ending)
    return float(-engine.toss(falling).sample(TERMINAL_TIMES[exponent]).velocity[0, 2])


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(10, 3.4))
    shifts, faces, flutter = picture.subplots(1, 3)
    height = data["height"]
    for values, label, color in (
        (data["later"], "later [s]", BLUE),
        (data["turned"], "less turned [rad]", VERMILION),
        (data["aside"], "aside [m]", GREEN),
    ):
        shifts.loglog(height, values, "o-", color=color, label=label)
    shifts.set(title="how the air shifts the landing", xlabel="fall [m]")
    shifts.legend(loc="lower right", borderpad=0)
    shifts.set_ylim(1e-7, None)
    faces.semilogx(height, data["changed"], "o-", color=BLUE)
    faces.axhline(0.5, color=GREY, linewidth=0.8)
    faces.set(title="landings on another face", xlabel="fall [m]", ylabel="part of the tosses", ylim=(0, 1))
    for name, label, color in (
        (IDEAL, "ideal", BLUE),
        (IMPERFECT, "imperfect", VERMILION),
    ):
        flutter.plot(data[f"{name}, time"], np.degrees(data[f"{name}, tilt"]), color=color, label=label)
    flutter.set(title=f"dropped at 45° from {FALLS[LONG]:g} m", xlabel="time [s]", ylabel="tilt [°]")
    flutter.set_ylim(0, 180)
    flutter.legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Claims of sections 4.2 and 5.1",
    title="the air over a small fall and a long one: landing, drift, flutter, terminal speed",
    assumed=(
        "A small fall is that of Fig. 24, 0.4 m; the spinning coins are the thin ones of Fig. 29 with 20 to "
        "60 rad/s, dropped flat; those without spin are the thick ones of Fig. 3, dropped at 45°. A coin "
        "flutters when its tilt turns back. The real disc's drag is ρ C_D A v²/2 in air of 20 °C."
    ),
    seconds=20,
    make=make,
    draw={"figure": _draw},
    quick_seconds=8,
    quick=partial(make, count=200),
)
