"""Fig. 23: the mass centres of four models of the coin after collisions, by both engines while trusted."""

import itertools

import numpy as np
from matplotlib.figure import Figure

from cointoss import Scenario, Toss, analytic, coin_mj, load
from cointoss.study import Array, Progress, common_prefix, distance
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.free_fall import MEDIA, MODELS

IMPACTS = 6
"""That are followed."""
REAL, SIMPLEST = "3D imperfect", "2D ideal"
LEFT_OUT = 0.5
"""The picture leaves out so much of the way down to the first impact [s]."""


def make(progress: Progress) -> Findings:
    """Toss the four coins of Fig. 20 by both engines, for some impacts."""
    data: Data = {}
    found = Findings(data=data)
    pairs: dict[str, tuple[Toss, Toss]] = {}
    for done, (name, (file, _)) in enumerate(MODELS.items(), start=1):
        case = _up_to(load(file), IMPACTS)
        pairs[name] = analytic.toss(case), coin_mj.toss(case)
        progress(done, len(MODELS))
    by_analytic = {name: pair[0] for name, pair in pairs.items()}
    horizons = {name: _horizon(pair) for name, pair in pairs.items()}
    first = min(toss.impacts.time[0] for toss in by_analytic.values())
    shared = min(toss.end_time for toss in by_analytic.values())
    found.before = _largest_distance(by_analytic, np.linspace(0, first, 200)[:-1])
    found.after = _largest_distance(by_analytic, np.linspace(first, shared, 400))
    apart = {
        name: float(distance(*(toss.sample(np.linspace(0, horizons[name], 600)) for toss in pair)).max())
        for name, pair in pairs.items()
    }
    found.mujoco = max(apart.values())
    real, simplest = by_analytic[REAL], by_analytic[SIMPLEST]
    found.alike = common_prefix(real.sequence, simplest.sequence)
    times = np.linspace(first, shared, 400)
    found.strayed = float(distance(real.sample(times), simplest.sample(times)).max())
    found.radius = real.scenario.coin.radius
    found.faces = ", ".join(toss.sequence for toss in by_analytic.values())
    found.seconds = shared - first
    found.trusted = ", ".join(str(min(t.trusted_impacts for t in pair)) for pair in pairs.values())
    found.ten_times, found.tenth = 10 * found.before, 0.1 * found.radius
    for name, (toss, by_mujoco) in pairs.items():
        t = np.linspace(0, toss.end_time, 1500)
        trusted = np.linspace(0, horizons[name], 60)
        data |= {f"{name}, time": t, f"{name}, analytic": toss.sample(t).position}
        data |= {f"{name}, trusted": trusted, f"{name}, MuJoCo": by_mujoco.sample(trusted).position}
    return found


def _up_to(scenario: Scenario, impacts: int) -> Scenario:
    return scenario.replace("air", MEDIA["air"], "ending.max_impacts", impacts)


def _horizon(pair: tuple[Toss, Toss]) -> float:
    """Return the time of the first impact that not both engines trust, or of the end [s]."""
    trusted = min(toss.trusted_impacts for toss in pair)
    return float(min(toss.impacts.time[trusted] if trusted < IMPACTS else toss.end_time for toss in pair))


def _largest_distance(tosses: dict[str, Toss], times: Array) -> float:
    """Return the largest distance of any two mass centres at any of these times [m]."""
    paths = [toss.sample(times) for toss in tosses.values()]
    return float(max(distance(p, q).max() for p, q in itertools.combinations(paths, 2)))


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.6))
    side, height = picture.subplots(1, 2, sharey=True)
    for name, (_, color) in MODELS.items():
        t, trusted = data[f"{name}, time"], data[f"{name}, trusted"]
        x, _, z = 100 * data[f"{name}, analytic"][t > LEFT_OUT].T
        x_mujoco, _, z_mujoco = 100 * data[f"{name}, MuJoCo"][trusted > LEFT_OUT].T
        side.plot(x, z, color=color, label=name)
        side.plot(x_mujoco, z_mujoco, "o", color=color, markersize=3)
        height.plot(t[t > LEFT_OUT], z, color=color)
        height.plot(trusted[trusted > LEFT_OUT], z_mujoco, "o", color=color, markersize=3)
    side.set(xlabel="x [cm]", ylabel="z [cm]")
    height.set(xlabel="time [s]")
    side.legend(title="dots: MuJoCo, while trusted")
    return picture


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
