"""A claim of section 2: a coin that bounces is less fair than one that lands softly or is caught."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.analytic.flight.integrated_flight import sample_flight
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREY, INK, VERMILION
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import jackknife, mean
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.hands import releases_of_hands
from cointoss.compare.reproduction.setups.release_arrays import chosen, states_of
from cointoss.models.laws import ContactLaw
from cointoss.models.parts import EndingCriteria, Floor
from cointoss.models.reading import load
from cointoss.models.records import Array, Face
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario

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


def make(progress: Progress, hands: int = 1000, each: int = 20, tosses_mujoco: int = 300) -> Result:
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
    together = {key: mean(shares, "hands") for key, shares in heads.items()}
    plain, all_axes = ASIDE
    smooth, rough = FLOORS
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
                    f"bias {bounced} less that otherwise (spin {kind})",
                    _less_fair(
                        [heads[kind, landing] for landing in LANDINGS[:2]],
                        heads[kind, bounced],
                        lambda shares: bias_of_hands(shares, each),
                    ),
                    ">",
                    0,
                    "the larger of a catch's and a soft landing's",
                )
                for kind in ASIDE
                for bounced in FLOORS
            ],
            expected=False,
        ),
        Claim(
            claim="bouncing is less fair than a soft landing or a catch (all hands together)",
            analytic=(
                "a coin that spins about all axes, on a smooth floor, shows the side first up in "
                f"{together[all_axes, smooth].value:.1%} of the tosses, on a soft floor "
                f"{together[all_axes, LANDINGS[1]].value:.1%}, caught "
                f"{together[all_axes, LANDINGS[0]].value:.1%}: smooth impacts keep the angular momenta about "
                "the normal and the vertical"
            ),
            mujoco=f"{heads_few[0]:.1%} of {len(few)} tosses on a smooth floor, {heads_few[1]:.1%} analytic",
            criteria=[_off_half_more(heads, all_axes, smooth)],
        ),
        Claim(
            claim="bouncing is less fair than a soft landing or a catch (all hands together, rough floor)",
            analytic=(
                f"with friction μ = 0.2 it shows it in {together[all_axes, rough].value:.1%}; a coin that "
                f"spins about one axis in {together[plain, smooth].value:.1%} on a smooth floor"
            ),
            criteria=[_off_half_more(heads, all_axes, rough)],
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


def _less_fair(others: Sequence[Array], bounced: Array, measure: Callable[[Array], float]) -> Estimate:
    """Return a measure of unfairness after bouncing less its largest without, with a jackknife over hands."""

    def excess(kept: NDArray[np.bool_]) -> float:
        return measure(bounced[kept]) - max(measure(shares[kept]) for shares in others)

    return jackknife(excess, len(bounced), "hands")


def _off_half_more(heads: dict[tuple[str, str], Array], kind: str, bounced: str) -> Criterion:
    """Return how much farther all hands together are off 1/2 after bouncing, as a criterion."""
    return Criterion(
        f"off 1/2 {bounced}, less that otherwise",
        _less_fair(
            [heads[kind, landing] for landing in LANDINGS[:2]],
            heads[kind, bounced],
            lambda shares: abs(float(shares.mean()) - 1 / 2),
        ),
        ">",
        0,
        "the larger of a catch's and a soft landing's",
    )


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(9, 4.2))
    bins = np.linspace(0, 1, 22)
    grid = picture.subplots(len(ASIDE), len(LANDINGS), sharex=True, sharey=True)
    for row, kind in zip(grid, ASIDE, strict=True):
        for axes, landing in zip(row, LANDINGS, strict=True):
            shares = data[f"{kind}, {landing}"]
            axes.hist(shares, bins.tolist(), color=VERMILION if landing in FLOORS else BLUE)
            axes.axvline(0.5, color=GREY, linewidth=0.8)
            axes.axvline(shares.mean(), color=INK, linestyle="--", linewidth=1)
        row[0].set_ylabel(f"spin {kind}\nhands")
    for axes, landing in zip(grid[0], LANDINGS, strict=True):
        axes.set_title(landing)
    for axes in grid[-1]:
        axes.set(xlabel="a hand's part of heads", xlim=(0, 1), xticks=(0, 0.5, 1))
    return picture


REPRODUCTION = Reproduction(
    paper="Claims of section 2",
    title="how fair hands are when the coin is caught, lands softly, or bounces",
    assumed=(
        "The paper gives no measure of fairness. Here hands toss from 0.8 to 1.2 m, upwards at 1 to 3 m/s, "
        "with 20 to 60 rad/s, each with its own habit, from which its tosses differ by 5 %; the coin is the "
        "thin ideal one of Fig. 29, heads up, 7° from flat, and in the second case turns at up to 10 rad/s "
        "about its other axes too. Soft: the face up at the first touch. Caught: that at the height of "
        "release. Dashed: the mean over the hands."
    ),
    seconds=120,
    make=make,
    draw={"figure": _draw},
    quick_seconds=10,
    quick=partial(make, hands=100, each=10, tosses_mujoco=20),
)
