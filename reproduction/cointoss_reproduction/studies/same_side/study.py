"""Does a coin land on the side it started from? 350,757 flips, and what is left of it after bounces."""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import Engine, Hand
from cointoss.study import (
    BLUE,
    GREEN,
    GREY,
    INK,
    ORANGE,
    TOUCHES,
    VERMILION,
    Array,
    Estimate,
    Progress,
    first_side,
    in_words,
    jackknife,
    paragraphs,
    rows_from_states,
    share,
    share_of,
    table,
)
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.studies.same_side.people import (
    EXPONENTIAL,
    NORMAL,
    WOBBLING,
    Flips,
    PeopleFit,
    chance_of_spread,
    fit,
    interval,
    log_likelihoods,
    quantiles,
    read_flips,
    spread_of,
    without,
)

SEED = 2025
TOUCH_NAMES = ("first touch", *(f"touch {n + 1}" for n in TOUCHES[1:]))
CHIS, HEIGHTS = (0.2, 0.5, 0.8), (0.3, 1.0)
COLORS = dict(zip(CHIS, (GREEN, BLUE, ORANGE), strict=True))
PSI = 60
"""Of a coin that wobbles much [deg]."""
MUCH = f"{PSI}°"
CHI, PEOPLE = 0.5, "as of people"
"""Of the floor on which people's tosses bounce, and the name of their ψ."""
SMOOTH, ROUGH = FLOORS = ("smooth", "rough, μ = 0.2")
CLOSE, SMALL = 0.01, 0.05
"""A share that is another within a per cent, or nearly."""
FAMILIES = {"wobble, |90° - ψ| half-normal": WOBBLING, "p normal": NORMAL, "p - 1/2 exponential": EXPONENTIAL}
"""How p may be distributed over people."""


@dataclass(frozen=True)
class Bounced:
    """How often the side up at the release is up at a touch, and in the end."""

    floor: str
    chi: float
    height: float
    psi: str
    engine: str
    touches: list[Estimate]
    """After 0, 1, 2, ... impacts."""
    end: Estimate
    """Of the tosses that end on a face."""

    @property
    def name(self) -> str:
        """Floor, restitution, height and wobble."""
        return f"{self.floor}, χ = {self.chi:g}, {self.height:g} m, ψ = {self.psi}"


@dataclass(frozen=True)
class Model:
    """A distribution of p over people, beside that which wobble makes."""

    name: str
    parameters: int
    """How many are fitted."""
    first: Estimate
    """The first: the spread of 90° - ψ [rad], or of p."""
    spread: float
    """Standard deviation of p over people."""
    behind: float
    """Logarithm of the likelihood of wobble, less that of this."""
    behind_without: list[float]
    """The same, each person left out in turn, (n,)."""
    behind_in_prediction: float
    """The same, of each person's counts by what was fitted to the others', summed."""
    chance: float
    """That people as modelled differ among each other as much as those who flipped."""


@dataclass(frozen=True)
class SameSide:
    """What the flips say, and what the engines add."""

    same: Estimate
    """Share of the flips caught with the side up that was up at the release."""
    heads_more: Estimate
    """That of flips that started heads up, less that of the others."""
    rms_angle: Estimate
    """Root of the mean square of 90° - ψ over people [deg]."""
    models: list[Model]
    """Of `FAMILIES`, wobble first."""
    people: list[Estimate]
    """p of each person."""
    bounced: list[Bounced]


def compute(progress: Progress, count: int = 3000, people: int = 8000, mujoco: int = 400) -> SameSide:
    """Fit ψ to the flips, then let hands toss onto floors."""
    flips, rng = read_flips(), np.random.default_rng(SEED)
    fits = [fit(flips, people_as) for people_as in FAMILIES.values()]
    wobbling = {height: Hand(height=height, psi=np.radians(PSI)) for height in HEIGHTS}
    everybody = Hand(psi=np.pi / 2, psi_scatter=float(fits[0].parameters[0]))
    jobs = [
        (floor, chi, hand, MUCH, count, Engine.ANALYTIC)
        for floor, chi, hand in product(FLOORS, CHIS, wobbling.values())
    ]
    jobs += [(floor, CHI, everybody, PEOPLE, people, Engine.ANALYTIC) for floor in FLOORS]
    jobs += [(floor, CHI, wobbling[HEIGHTS[0]], MUCH, mujoco, Engine.MUJOCO) for floor in FLOORS]
    bounced = []
    for job in jobs:
        bounced.append(_bounced(*job, rng))
        progress(len(bounced), len(jobs))

    models = _models(flips, fits, rng)
    rms = models[0].first

    def of_people(share_of_kept: Callable[[NDArray[np.bool_]], float]) -> Estimate:
        return jackknife(share_of_kept, len(flips.flips), "people")

    return SameSide(
        same=of_people(lambda kept: flips.same[kept].sum() / flips.flips[kept].sum()),
        heads_more=of_people(
            lambda kept: (
                flips.heads_same[kept].sum() / flips.heads[kept].sum()
                - flips.tails_same[kept].sum() / flips.tails[kept].sum()
            )
        ),
        rms_angle=Estimate(
            float(np.degrees(rms.value)),
            float(np.degrees(rms.low)),
            float(np.degrees(rms.high)),
            rms.count,
            rms.counted,
        ),
        models=models,
        people=[
            share_of(int(same), int(flipped), "flips")
            for same, flipped in zip(flips.same, flips.flips, strict=True)
        ],
        bounced=bounced,
    )


def _models(flips: Flips, fits: list[PeopleFit], rng: np.random.Generator) -> list[Model]:
    """Compare distributions of p with the first: by all people, without each, and by prediction of each."""
    others = [without(flips, person) for person in range(len(flips.flips))]
    refitted = [[fit(counts, found.people) for counts in others] for found in fits]
    left: Array = np.array([[one.log_likelihood for one in each] for each in refitted])
    predicted = [
        sum(log_likelihoods(flips, found.people, one.parameters)[person] for person, one in enumerate(each))
        for found, each in zip(fits, refitted, strict=True)
    ]
    return [
        Model(
            name=name,
            parameters=len(found.parameters),
            first=_first_parameter(flips, found),
            spread=spread_of(found),
            behind=fits[0].log_likelihood - found.log_likelihood,
            behind_without=(left[0] - left[i]).tolist(),
            behind_in_prediction=float(predicted[0] - predicted[i]),
            chance=chance_of_spread(flips, found, rng),
        )
        for i, (name, found) in enumerate(zip(FAMILIES, fits, strict=True))
    ]


def _first_parameter(flips: Flips, found: PeopleFit) -> Estimate:
    low, high = interval(flips, found)
    return Estimate(float(found.parameters[0]), float(low), float(high), len(flips.flips), "people")


def _bounced(
    floor: str, chi: float, hand: Hand, psi: str, count: int, engine: Engine, rng: np.random.Generator
) -> Bounced:
    """Toss a hand's releases onto a floor, and count the first side up."""
    kind = CoinClass(thick=True, imperfect=False, air=True, coulomb=floor == ROUGH)
    scenario = kind.scenario.replace("floor.restitution", chi)
    found = first_side(rows_from_states(scenario, hand.states(scenario.body, rng, count)), engine)
    return Bounced(
        floor=floor,
        chi=chi,
        height=hand.height,
        psi=psi,
        engine=engine.value,
        touches=[share(flags) for flags in found.touches],
        end=share(found.at_rest),
    )


def of(found: SameSide, engine: Engine, psi: str, floor: str) -> list[Bounced]:
    """Return what was tossed by an engine, with a wobble, onto a floor."""
    return [one for one in found.bounced if (one.engine, one.psi, one.floor) == (engine, psi, floor)]


def measures(found: SameSide) -> dict[str, Any]:
    """Return what the claims name."""
    (people,) = of(found, Engine.ANALYTIC, PEOPLE, SMOOTH)
    wobble, normal, exponential = found.models
    rough = of(found, Engine.ANALYTIC, MUCH, ROUGH)
    bouncy, dull = ([one for one in rough if one.chi == chi] for chi in (CHIS[-1], CHIS[0]))
    by_mujoco = of(found, Engine.MUJOCO, MUCH, ROUGH)
    return {
        "same": found.same,
        "off_51": found.same - 0.51,
        "rms": in_words(found.rms_angle, ".1f").replace(" ", "° ", 1),
        "wobble": wobble,
        "normal": normal,
        "spread": in_words(normal.first, ".4f"),
        "exponential": exponential,
        "chance": wobble.chance,
        "gain": normal.behind,
        "gain_without": min(normal.behind_without),
        "exponential_without": min(exponential.behind_without),
        "heads_more": found.heads_more,
        "smooth": {one.name: one.end for one in of(found, Engine.ANALYTIC, MUCH, SMOOTH)},
        "smooth_mujoco": "; ".join(_percent(one.end) for one in of(found, Engine.MUJOCO, MUCH, SMOOTH)),
        "people_first": _percent(people.touches[0]),
        "people_end": people.end,
        "bouncy": {one.name: one.end - 0.5 for one in bouncy},
        "bouncy_words": _at_rest(bouncy),
        "dull": {one.name: one.end for one in dull},
        "dull_words": _at_rest(dull),
        "dull_mujoco": "; ".join(f"{_percent(one.end)} ({one.name})" for one in by_mujoco),
    }


def _at_rest(tossed: list[Bounced]) -> str:
    return "; ".join(
        f"{_percent(one.touches[0])} at the first touch, {_percent(one.end)} at rest ({one.name})"
        for one in tossed
    )


def tables(found: SameSide) -> str:
    """Return the tables, in Markdown."""
    rows = [[f"{one.engine}, {one.name}", *map(_percent, [*one.touches, one.end])] for one in found.bounced]
    models = [
        [
            one.name,
            str(one.parameters),
            f"{one.spread:.4f}",
            f"{0 - one.behind:.1f}",
            f"{0 - min(one.behind_without):.1f}",
            f"{0 - one.behind_in_prediction:.1f}",
            f"{one.chance:.2f}",
        ]
        for one in found.models
    ]
    return paragraphs(
        "How p may be distributed over people, by the logarithm of the likelihood less that of wobble:",
        table(
            "over people | parameters | standard deviation of p | all 48 | "
            "nearest, one person left out | each predicted from the others | chance of people as different",
            models,
        ),
        "How often the side up at the release is up, with 99 % intervals:",
        table(["engine, floor, restitution, height, ψ", *TOUCH_NAMES, "at rest"], rows),
    )


def _percent(found: Estimate) -> str:
    return in_words(found, ".1%")


def draw(found: SameSide) -> Figure:
    """Draw the people beside the model, and what bounces leave of the bias."""
    picture = Figure(figsize=(11, 4.2))
    people, bounces = picture.subplots(1, 2)
    ranked = sorted(found.people, key=lambda one: one.value)
    at = (np.arange(len(ranked)) + 0.5) / len(ranked)
    for x, one in zip(at, ranked, strict=True):
        people.plot([x, x], [one.low, one.high], color=GREY, linewidth=1)
    people.plot(at, [one.value for one in ranked], "o", color=INK, markersize=3, label="a person, 99 %")
    x = (np.arange(1000) + 0.5) / 1000
    for end, style in ((found.rms_angle.low, ":"), (found.rms_angle.value, "-"), (found.rms_angle.high, ":")):
        label = f"ψ = 90° ± {end:.0f}° over people" if style == "-" else None
        people.plot(x, quantiles(WOBBLING, np.radians([end]), x), style, color=VERMILION, label=label)
    exponential = np.array([found.models[-1].first.value])
    people.plot(x, quantiles(EXPONENTIAL, exponential, x), "--", color=BLUE, label="p - 1/2 exponential")
    people.axhline(0.5, color=GREY, linewidth=0.8)
    people.set_title("48 people, 350,757 flips")
    people.set(
        xlabel="part of the people below", ylabel="share caught with the first side up", ylim=(0.45, 0.64)
    )
    people.legend(loc="upper left")
    steps = np.arange(len(TOUCHES) + 1)
    for floor, style in ((SMOOTH, "-"), (ROUGH, "--")):
        for one in of(found, Engine.ANALYTIC, MUCH, floor):
            if one.height == HEIGHTS[0]:
                values = [each.value for each in (*one.touches, one.end)]
                label = f"χ = {one.chi:g}" if floor == SMOOTH else None
                bounces.plot(steps, values, style, color=COLORS[one.chi], marker="o", label=label)
        (one,) = of(found, Engine.ANALYTIC, PEOPLE, floor)
        values = [each.value for each in (*one.touches, one.end)]
        bounces.plot(steps, values, style, color=INK, marker="s", label="people" if floor == SMOOTH else None)
    bounces.axhline(0.5, color=GREY, linewidth=0.8)
    bounces.set_title(f"after bounces, ψ = {PSI}° and people: smooth —, rough – –")
    bounces.set(ylabel="share with the first side up", ylim=(0.45, 1.02))
    bounces.set_xticks(steps, [*TOUCH_NAMES, "at rest"])
    bounces.legend(loc="upper left")
    return picture


REPRODUCTION = recorded(
    __name__, compute, record=SameSide, measures=measures, tables=tables, draw={"same-side": draw}
)
