"""A claim of section 2: a coin that bounces is less fair than one that lands softly or is caught."""

from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import analytic
import coin_mj
from analytic.flight.integrated_flight import sample_flight
from compare.output.progress import Progress
from compare.output.style import BLUE, GREY, VERMILION
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.runner import Reproduction, Result
from compare.reproduction.setups.hands import releases_of_hands
from compare.reproduction.setups.release_arrays import chosen, states_of
from models.laws import ContactLaw
from models.reading import load
from models.records import Array, Face
from models.releases import Releases
from models.scenario import EndingCriteria, Floor, Scenario

SEED = 2
SPREAD = 0.05
"""Of the tosses of one hand, relative."""
ASIDE = {"about one axis": 0.0, "about all axes": 10.0}
"""Spins about ξ and ζ of the two kinds of tosses, at most [rad/s]."""
FLOORS = {
    "bounced, smooth floor": Floor(restitution=0.6, contact=ContactLaw.SMOOTH),
    "bounced, rough floor": Floor(restitution=0.6, contact=ContactLaw.COULOMB, friction=0.2),
}
LANDINGS = ("caught", "soft floor", *FLOORS)


def make(progress: Progress, hands: int = 300, each: int = 15, tosses_mujoco: int = 300) -> Result:
    """Let hands toss a thin ideal coin with two kinds of spin, and end each toss in four ways."""
    scenario = load("fig29")
    rng = np.random.default_rng(SEED)
    heads: dict[tuple[str, str], Array] = {}
    whole = len(ASIDE) * len(LANDINGS) + 1
    first_faces, tossed = np.empty(0, dtype=np.int8), None
    for kind, aside in ASIDE.items():
        tossed = releases_of_hands(rng, hands, each, spread=SPREAD, aside=aside)
        first_faces = _landed(scenario, tossed)
        faces = [_caught(scenario, tossed), first_faces]
        faces += [analytic.toss_many(_on(scenario, floor), tossed).outcome for floor in FLOORS.values()]
        for landing, face in zip(LANDINGS, faces, strict=True):
            heads[kind, landing] = np.mean((face == Face.HEADS).reshape(hands, each), axis=1)
            progress(len(heads), whole)
    assert tossed is not None
    every = slice(None, None, len(tossed) // tosses_mujoco)
    few = chosen(tossed, every)
    same = int(
        np.sum(coin_mj.toss_many(_once(scenario), few, settings=coin_mj.FINE).last_face == first_faces[every])
    )
    ended = coin_mj.toss_many(_on(scenario, next(iter(FLOORS.values()))), few, settings=coin_mj.FINE).outcome
    by_analytic = analytic.toss_many(_on(scenario, next(iter(FLOORS.values()))), few).outcome
    heads_few = [float(np.mean(outcomes == Face.HEADS)) for outcomes in (ended, by_analytic)]
    progress(whole, whole)
    bias = {key: bias_of_hands(shares, each) for key, shares in heads.items()}
    error = max(float(np.std(shares)) for shares in heads.values()) / np.sqrt(hands)
    plain, all_axes = ASIDE
    smooth, rough = FLOORS
    of_soft = max(_off_half(heads[all_axes, landing]) for landing in LANDINGS[:2])
    claims = (
        Claim(
            claim="bouncing is less fair than a soft landing or a catch (a hand's bias)",
            analytic=(
                "heads is off 1/2 by, in the root of the mean square over the hands: "
                + "; ".join(
                    f"spin {kind} "
                    + ", ".join(f"{bias[kind, landing]:.2f} {landing}" for landing in LANDINGS)
                    for kind in ASIDE
                )
            ),
            mujoco=f"{same} of {len(few)} first touches as the analytic engine",
            criteria=[
                Criterion(
                    "least bias after bouncing",
                    min(bias[kind, bounced] for kind in ASIDE for bounced in FLOORS),
                    ">",
                    max(bias[kind, landing] for kind in ASIDE for landing in LANDINGS[:2]),
                    "the largest of the others",
                )
            ],
            expected=False,
        ),
        Claim(
            claim="bouncing is less fair than a soft landing or a catch (all hands together)",
            analytic=(
                "a coin that spins about all axes, on a smooth floor, shows the side first up in "
                f"{heads[all_axes, smooth].mean():.1%} of the tosses, on a soft floor "
                f"{heads[all_axes, LANDINGS[1]].mean():.1%}, caught "
                f"{heads[all_axes, LANDINGS[0]].mean():.1%} (± {error:.1%}): smooth impacts keep the angular "
                "momenta about the normal and the vertical"
            ),
            mujoco=f"{heads_few[0]:.1%} of {len(few)} tosses on a smooth floor, {heads_few[1]:.1%} analytic",
            criteria=[
                Criterion(
                    "off 1/2, smooth floor",
                    _off_half(heads[all_axes, smooth]),
                    ">",
                    of_soft,
                    "caught or on a soft floor",
                )
            ],
        ),
        Claim(
            claim="bouncing is less fair than a soft landing or a catch (all hands together, rough floor)",
            analytic=(
                f"with friction μ = 0.2 it shows it in {heads[all_axes, rough].mean():.1%}; a coin that "
                f"spins about one axis in {heads[plain, smooth].mean():.1%} on a smooth floor (± {error:.1%})"
            ),
            criteria=[
                Criterion(
                    "off 1/2, rough floor",
                    _off_half(heads[all_axes, rough]),
                    ">",
                    of_soft,
                    "caught or on a soft floor",
                )
            ],
            expected=False,
        ),
    )
    data: dict[str, NDArray[Any]] = {
        f"{kind}, {landing}": shares for (kind, landing), shares in heads.items()
    }
    return Result(claims=claims, data=data)


def _on(scenario: Scenario, floor: Floor) -> Scenario:
    return scenario.replace("floor", floor)


def _landed(scenario: Scenario, tossed: Releases) -> NDArray[np.int8]:
    """Return the face up at the first touch, where a floor without restitution keeps the coin, (n,)."""
    return analytic.toss_many(_once(scenario), tossed).last_face


def _once(scenario: Scenario) -> Scenario:
    return scenario.replace("ending", EndingCriteria(max_impacts=1))


def _caught(scenario: Scenario, tossed: Releases) -> NDArray[np.int8]:
    """Return the face up when a coin in vacuum would be back at the height of its release, (n,)."""
    faces, state = [], np.empty((1, 13))
    for start in states_of(tossed):
        sample_flight(scenario.body, start, 0.0, np.array([2 * start[5] / scenario.gravity]), state)
        e = state[0, 6:10]
        faces.append(Face.HEADS if e[1] ** 2 + e[2] ** 2 < 1 / 2 else Face.TAILS)
    return np.array(faces, dtype=np.int8)


def bias_of_hands(shares: Array, each: int) -> float:
    """Return the root of the mean square of p - 1/2 over the hands, less what counting adds.

    Args:
        shares: of heads of each hand, (hands,).
        each: tosses that they were counted in.
    """
    by_chance = shares * (1 - shares) / (each - 1)
    return float(np.sqrt(max(np.mean((shares - 1 / 2) ** 2 - by_chance), 0)))


def _off_half(shares: Array) -> float:
    return float(abs(shares.mean() - 1 / 2))


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(9, 3.4))
    for axes, kind in zip(picture.subplots(1, 2, sharey=True), ASIDE, strict=True):
        for row, landing in enumerate(LANDINGS):
            shares = np.sort(data[f"{kind}, {landing}"])
            # Side by side in their order, that none hides another.
            axes.plot(shares, row + np.linspace(-0.35, 0.35, len(shares)), ".", color=BLUE, markersize=4)
            axes.plot([shares.mean()] * 2, [row - 0.42, row + 0.42], color=VERMILION)
        axes.axvline(0.5, color=GREY, linewidth=0.8)
        axes.set(title=f"spin {kind}", xlabel="part of heads", xlim=(-0.02, 1.02))
        axes.set_yticks(range(len(LANDINGS)), [landing.replace(", ", ",\n") for landing in LANDINGS])
    picture.axes[0].invert_yaxis()
    return picture


REPRODUCTION = Reproduction(
    paper="Claims of section 2",
    title="how fair hands are when the coin is caught, lands softly, or bounces",
    assumed=(
        "The paper gives no measure of fairness. Here hands toss from 0.8 to 1.2 m, upwards at 1 to 3 m/s, "
        "with 20 to 60 rad/s, each with its own habit, from which its tosses differ by 5 %; the coin is the "
        "thin ideal one of Fig. 29, heads up, 7° from flat, and in the second case turns at up to 10 rad/s "
        "about its other axes too. Soft: the face up at the first touch. Caught: that at the height of "
        "release. Dots are hands, lines their mean."
    ),
    seconds=55,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, hands=100, each=10, tosses_mujoco=20),
)
