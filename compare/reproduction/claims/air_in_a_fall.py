"""Claims of sections 4.2 and 5.1: what the air does to a falling coin, over 20 cm and over 50 m."""

from types import ModuleType

import numpy as np
from matplotlib.figure import Figure

from cointoss import analytic, coin_mj
from cointoss.analytic.runs import run
from cointoss.analytic.toss import state_at_release
from cointoss.coin_mj.toss import impacts_of
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import share
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, GREY, VERMILION
from cointoss.compare.reproduction.declared import Data, Findings, declared
from cointoss.compare.reproduction.setups.planar_maps import SPINS, case, planar_rows
from cointoss.models.batch import states_of
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
AIR_DENSITY, AIR_VISCOSITY = 1.204, 1.516e-5
"""Of the air at 20 °C: ρ [kg/m³] and the kinematic ν [m²/s]."""
DISC_DRAG = 1.17
"""C_D of a disc broadside on, at Reynolds numbers above 10³; Hoerner, Fluid-Dynamic Drag (1965)."""
TERMINAL_TIMES = {0.0: 40.0, 1.0: 8.0}
"""In which the coin comes within a part in 10³ of its terminal speed, by the exponent b [s]."""


def make(progress: Progress, count: int = 4000) -> Findings:
    """Let `count` spinning coins fall from each height in air and in vacuum, and single ones without spin."""
    spins = np.random.default_rng(SEED).uniform(*SPINS, count)
    rows = []
    for done, height in enumerate(FALLS.tolist(), start=1):
        rows.append(landing_shifts(height, spins))
        progress(done, len(FALLS) + 1)
    later, turned, aside = np.array([row[:3] for row in rows]).T
    found = Findings(later=later, turned=np.degrees(turned), aside=aside, changed=[row[3] for row in rows])
    found.bounced = _bounced(spins)
    drops = {name: _tilts(analytic, name, FALLS) for name in DROPPED}
    by_mujoco = {name: _tilts(coin_mj, name, FALLS[LONG:]) for name in DROPPED}
    found.reversals = {
        name: [turning_points(tilt) for tilt in tilts] for name, (_, tilts, _) in drops.items()
    }
    found.reversals_mujoco = {name: turning_points(tilts[0]) for name, (_, tilts, _) in by_mujoco.items()}
    found.glided = drops[IDEAL][2][LONG]
    found.terminal = [_terminal(engine, b) for engine in (analytic, coin_mj) for b in TERMINAL_TIMES]
    progress(len(FALLS) + 1, len(FALLS) + 1)
    coin = load("fig3_flat").coin
    area = np.pi * coin.radius**2
    found.real = np.sqrt(2 * coin.mass * 9.81 / (AIR_DENSITY * DISC_DRAG * area))
    landing = np.sqrt(2 * 9.81 * 1.86)
    found.reynolds = [2 * r * v / AIR_VISCOSITY for r, v in ((0.01, 10.0), (coin.radius, landing))]
    found.stokes = AIR_VISCOSITY / (2 * coin.radius) / 9.81
    found.mujoco_apart, found.glided_mujoco = _mujoco_apart(spins), by_mujoco[IDEAL][2][0]
    found.limit, found.terminal_off = 0.02 * FALLS[LONG], abs(found.terminal[0] / found.real - 1)
    of_imperfect = found.reversals[IMPERFECT]
    found.turns_back = ", ".join(f"{of_imperfect[i]} times in {FALLS[i]:g} m" for i in (3, 5, 6, 7))
    found.data = {
        "height": FALLS,
        "later": later,
        "turned": turned,
        "aside": aside,
        "changed": np.array([one.value for one in found.changed]),
    }
    for name, (times, tilts, _) in drops.items():
        found.data |= {f"{name}, time": times[-1], f"{name}, tilt": tilts[-1]}
    return found


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
        states = states_of(planar_rows(scenario, np.full_like(spins, height), spins))
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
    heights = np.full_like(spins, FALLS[HAND])
    air, vacuum = (
        analytic.toss_rows(planar_rows(case(air=air), heights, spins)).outcome for air in (True, False)
    )
    return share(air != vacuum)


def _mujoco_apart(spins: Array) -> float:
    """Return how far MuJoCo's landings in air are from the analytic engine's, in time [s] or place [m]."""
    apart = []
    for w in spins[:MUJOCO_TOSSES].tolist():
        release = Release(position=(0.0, 0.0, float(FALLS[HAND])), angular_velocity=(w, 0.0, 0.0))
        scenario = _one_touch(case(air=True)).replace("release", release)
        landed = run(scenario.body, scenario.rules, state_at_release(release)).rows[0]
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


def _draw(data: Data) -> Figure:
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
