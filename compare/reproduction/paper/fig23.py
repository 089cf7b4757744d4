"""Fig. 23: the mass centres of four models of the coin after collisions, by both engines while trusted."""

import itertools

import numpy as np
from matplotlib.figure import Figure

from cointoss import analytic, coin_mj
from cointoss.compare.metrics.sequences import common_prefix
from cointoss.compare.metrics.trajectories import distance
from cointoss.compare.output.progress import Progress
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.paper.fig18 import MODELS
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.models.parts import Air
from cointoss.models.reading import load
from cointoss.models.records import Array, Toss
from cointoss.models.scenario import Scenario

AIR = Air(normal=0.8, tangential=0.2)
IMPACTS = 6
"""That are followed."""
REAL, SIMPLEST = "3D imperfect", "2D ideal"
LEFT_OUT = 0.5
"""The picture leaves out so much of the way down to the first impact [s]."""


def make(progress: Progress) -> Result:
    """Toss the four coins of Fig. 20 by both engines, for some impacts."""
    pairs: dict[str, tuple[Toss, Toss]] = {}
    for done, (name, (file, _)) in enumerate(MODELS.items(), start=1):
        case = _up_to(load(file), IMPACTS)
        pairs[name] = analytic.toss(case), coin_mj.toss(case)
        progress(done, len(MODELS))
    by_analytic = {name: pair[0] for name, pair in pairs.items()}
    horizons = {name: _horizon(pair) for name, pair in pairs.items()}
    first = min(toss.impacts.time[0] for toss in by_analytic.values())
    shared = min(toss.end_time for toss in by_analytic.values())
    before = _largest_distance(by_analytic, np.linspace(0, first, 200)[:-1])
    after = _largest_distance(by_analytic, np.linspace(first, shared, 400))
    apart = {
        name: float(distance(*(toss.sample(np.linspace(0, horizons[name], 600)) for toss in pair)).max())
        for name, pair in pairs.items()
    }
    real, simplest = by_analytic[REAL], by_analytic[SIMPLEST]
    alike = common_prefix(real.sequence, simplest.sequence)
    times = np.linspace(first, shared, 400)
    strayed = float(distance(real.sample(times), simplest.sample(times)).max())
    radius = real.scenario.coin.radius
    faces = ", ".join(toss.sequence for toss in by_analytic.values())
    claims = (
        Claim(
            claim="after collisions the four coins take different paths",
            analytic=(
                f"{1e3 * before:.1f} mm apart up to the first impact, {1e2 * after:.0f} cm within "
                f"{shared - first:.2f} s after it; faces {faces}"
            ),
            mujoco=(
                f"within {1e3 * max(apart.values()):.2g} mm of the analytic engine while both are trusted, "
                f"{', '.join(str(min(t.trusted_impacts for t in pair)) for pair in pairs.values())} impacts"
            ),
            criteria=[
                Criterion(
                    "distance after the first impact [m]", after, ">", 10 * before, "ten times that before it"
                ),
                Criterion(
                    "MuJoCo off the analytic engine [m]",
                    max(apart.values()),
                    "<",
                    0.1 * radius,
                    "r/10, while both are trusted",
                ),
            ],
        ),
        Claim(
            claim="the ideal thin coin is sufficient for the real one (section 5.1), after collisions too",
            analytic=(
                f"in this toss it shows {alike} of {IMPACTS} faces as the 3D imperfect coin does, and is up "
                f"to {1e2 * strayed:.0f} cm from it"
            ),
            criteria=[
                Criterion("faces alike from the start on", alike, "=", IMPACTS, "all that were followed"),
                Criterion("largest distance [m]", strayed, "<", radius, "r"),
            ],
            expected=False,
        ),
    )
    data: dict[str, Array] = {}
    for name, (toss, by_mujoco) in pairs.items():
        t = np.linspace(0, toss.end_time, 1500)
        trusted = np.linspace(0, horizons[name], 60)
        data |= {f"{name}, time": t, f"{name}, analytic": toss.sample(t).position}
        data |= {f"{name}, trusted": trusted, f"{name}, MuJoCo": by_mujoco.sample(trusted).position}
    return Result(claims=claims, data=data)


def _up_to(scenario: Scenario, impacts: int) -> Scenario:
    return scenario.replace("air", AIR, "ending.max_impacts", impacts)


def _horizon(pair: tuple[Toss, Toss]) -> float:
    """Return the time of the first impact that not both engines trust, or of the end [s]."""
    trusted = min(toss.trusted_impacts for toss in pair)
    return float(min(toss.impacts.time[trusted] if trusted < IMPACTS else toss.end_time for toss in pair))


def _largest_distance(tosses: dict[str, Toss], times: Array) -> float:
    """Return the largest distance of any two mass centres at any of these times [m]."""
    paths = [toss.sample(times) for toss in tosses.values()]
    return float(max(distance(p, q).max() for p, q in itertools.combinations(paths, 2)))


def _draw(data: dict[str, Array]) -> Figure:
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


REPRODUCTION = Reproduction(
    paper="Fig. 23",
    title="the mass centres of four models of the coin after collisions",
    assumed=(
        "The paper gives neither release nor floor; here those of Fig. 20, a hand's toss in air onto a "
        "smooth floor, restitution 0.8. That the paths part does not hang on it; how soon does."
    ),
    seconds=10,
    make=make,
    draw={"figure": _draw},
)
