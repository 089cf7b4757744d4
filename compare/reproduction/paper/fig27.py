"""Figs 27 and 32: the map from rim point to rim point of a lossless coin, and its Lyapunov exponent."""

import numpy as np
from matplotlib.figure import Figure

from analytic.events import run
from analytic.toss import state_of
from coin_mj.toss import impacts_of
from compare.metrics.lyapunov import divergence, growth_by_tangent, mean_and_error
from compare.output.progress import Progress
from compare.output.style import BLUE, VERMILION
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.runner import Reproduction, Result
from models.reading import load
from models.records import Array
from models.scenario import Air, Scenario

PRINTED = {"air": (0.024, 316), "vacuum": (0.08, 700)}
"""The paper's exponents and numbers of collisions."""
FIRST = 100
"""Impacts of the first part of the transient."""
OTHERS, SEED = 30, 27
FOLLOWED = 12
"""Impacts over which neighbours in the time series are followed."""


def make(progress: Progress) -> Result:
    """Follow the coin in air and in vacuum; MuJoCo's coin too."""
    with_air = load("fig27")
    cases = {"air": with_air, "vacuum": with_air.replace("air", Air())}
    data: dict[str, Array] = {}
    found, mujoco = {}, {}
    for done, (medium, scenario) in enumerate(cases.items(), start=1):
        angles = _angles(run(scenario.body, scenario.rules, state_of(scenario.release)).rows["point"])
        growth = growth_by_tangent(scenario)
        by_mujoco = _angles(impacts_of(_shorter(scenario)).point)
        curve = divergence(angles, 1, FOLLOWED)
        data |= {f"{medium}, angle": angles, f"{medium}, growth": growth, f"{medium}, series": curve}
        found[medium] = mean_and_error(growth)
        mujoco[medium] = f"{len(by_mujoco)} impacts; its series gives {_slope(by_mujoco):.2f}"
        progress(done, len(cases))
    lasting, others = len(data["air, angle"]), _other_spins(with_air)
    data["impacts with other spins"] = others
    of_first = mean_and_error(data["air, growth"][:FIRST])
    (in_vacuum, scatter), (in_air, scatter_air) = found["vacuum"], found["air"]
    series = {medium: _slope(data[f"{medium}, angle"]) for medium in cases}
    at_first = {medium: data[f"{medium}, series"][1] - data[f"{medium}, series"][0] for medium in cases}
    claims = (
        Claim(
            claim="without air, with χ = 1, the map is chaotic: its largest exponent is positive (Fig. 32)",
            analytic=f"{in_vacuum:.2f} ± {scatter:.2f} per impact, from the tangent map over 700 impacts",
            mujoco=mujoco["vacuum"],
            criteria=[Criterion("exponent per impact", in_vacuum, ">", 3 * scatter, "three standard errors")],
        ),
        Claim(
            claim="with air the chaos is transient (Fig. 27)",
            analytic=(
                f"{of_first[0]:.2f} ± {of_first[1]:.2f} per impact over the first {FIRST} impacts, "
                f"{in_air:.2f} ± {scatter_air:.2f} over all"
            ),
            mujoco=mujoco["air"],
            criteria=[
                Criterion(
                    f"exponent over the first {FIRST} impacts",
                    of_first[0],
                    ">",
                    3 * of_first[1],
                    "three standard errors",
                ),
                Criterion("over all", in_air, "<", of_first[0], "that over the first"),
            ],
        ),
        Claim(
            claim="with air the coin comes to rest after 316 collisions",
            analytic=f"{lasting} impacts; with {OTHERS} other spins {others.min()} to {others.max()}",
            mujoco=mujoco["air"].split(";")[0],
            criteria=[
                # One count is chaotic: another rounding gives another one.
                Criterion(
                    "printed count off the mean over other spins, in their standard deviations",
                    abs(PRINTED["air"][1] - others.mean()) / others.std(ddof=1),
                    "<",
                    2,
                    "19 of 20 spins are nearer",
                )
            ],
        ),
        Claim(
            claim="the exponents are 0.024 with air and 0.08 without",
            analytic=(
                f"{in_air:.2f} and {in_vacuum:.2f} per impact by the tangent map; the series of angles "
                f"gives {at_first['air']:.1f} and {at_first['vacuum']:.1f} over one impact, "
                f"{series['air']:.2f} and {series['vacuum']:.2f} over {FOLLOWED}: neighbours part at once"
            ),
            criteria=[
                Criterion(
                    f"off the printed exponent in {medium}",
                    abs(found[medium][0] - PRINTED[medium][0]),
                    "<",
                    3 * found[medium][1],
                    "three standard errors",
                )
                for medium in cases
            ],
            expected=False,
        ),
    )
    return Result(claims=claims, data=data)


def _other_spins(scenario: Scenario) -> Array:
    """Count the impacts of `OTHERS` tosses with random spins."""
    counts = []
    for spin in np.random.default_rng(SEED).uniform(-40, 40, (OTHERS, 3)):
        other = scenario.replace("release.angular_velocity", spin)
        counts.append(len(run(other.body, other.rules, state_of(other.release)).rows))
    return np.array(counts)


def _shorter(scenario: Scenario) -> Scenario:
    """Return the scenario with half the impacts: MuJoCo's take longer, and show the same."""
    return scenario.replace("ending.max_impacts", scenario.rules.max_impacts // 2)


def _angles(points: Array) -> Array:
    return np.arctan2(points[:, 1], points[:, 0])


def _slope(angles: Array) -> float:
    return float(np.polyfit(np.arange(FOLLOWED + 1), divergence(angles, 1, FOLLOWED), 1)[0])


def _draw(data: dict[str, Array]) -> Figure:
    picture = Figure(figsize=(9, 6))
    for row, (medium, color) in enumerate((("air", BLUE), ("vacuum", VERMILION))):
        angles = data[f"{medium}, angle"]
        rim = picture.add_subplot(2, 3, 3 * row + 1, projection="polar")
        rim.plot(angles, np.ones_like(angles), ".", color=color, markersize=3)
        rim.set(ylim=(0, 1.15), yticks=[], title=f"in {medium}: rim points")
        back = picture.add_subplot(2, 3, 3 * row + 2)
        turned = np.degrees(angles) % 360
        back.plot(turned[:-1], turned[1:], ".", color=color, markersize=3)
        back.set(xlabel="φ(n) [°]", ylabel="φ(n + 1) [°]", aspect="equal", xlim=(0, 360), ylim=(0, 360))
        growing = picture.add_subplot(2, 3, 3 * row + 3)
        growing.plot(np.cumsum(data[f"{medium}, growth"]) / np.log(10), color=color)
        growing.set(xlabel="impact", ylabel="log10 of the growth of a change")
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 27, 32",
    title="the map from rim point to rim point and its largest Lyapunov exponent",
    assumed=(
        "Coin, height and spins are unsaid, as is how the exponents were found; here the thin coin of Fig. "
        "24 with three spins. The number of impacts in air hardly depends on the spins, so 316 does not show "
        "which they were; the exponents are far from the printed ones by each method."
    ),
    seconds=30,
    make=make,
    draw={"figure": _draw},
)
