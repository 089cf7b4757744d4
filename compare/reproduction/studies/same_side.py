"""Does a coin land on the side it started from? 350,757 flips, and what is left of it after bounces."""

from dataclasses import dataclass, replace
from functools import partial
from itertools import product

import numpy as np
from matplotlib.figure import Figure

from cointoss.compare.engines import Engine
from cointoss.compare.metrics.first_side import TOUCHES, first_side
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, GREY, INK, ORANGE, VERMILION
from cointoss.compare.output.tables import table
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import jackknife, share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.general_coins import CoinClass
from cointoss.compare.reproduction.setups.same_side_fit import (
    NODES,
    Flips,
    by_wobble,
    chance_of_spread,
    fit_freely,
    fit_wobble,
    freely,
    interval,
    log_likelihood,
    read_flips,
)
from cointoss.models.hand import Hand
from cointoss.models.records import Array

SEED = 2025
TOUCH_NAMES = ("first touch", *(f"touch {n + 1}" for n in TOUCHES[1:]))
CHIS, HEIGHTS = (0.2, 0.5, 0.8), (0.3, 1.0)
COLORS = dict(zip(CHIS, (GREEN, BLUE, ORANGE), strict=True))
PSI = 60
"""Of a coin that wobbles much [deg]."""
CHI, PEOPLE = 0.5, "as of people"
"""Of the floor on which people's tosses bounce, and the name of their ψ."""
SMOOTH, ROUGH = FLOORS = ("smooth", "rough, μ = 0.2")
CLOSE, SMALL = 0.01, 0.05
"""A share that is another within a per cent, or nearly."""


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
class SameSide:
    """What the flips say, and what the engines add."""

    same: Estimate
    """Share of the flips caught with the side up that was up at the release."""
    heads_more: Estimate
    """That of flips that started heads up, less that of the others."""
    rms_angle: Estimate
    """Root of the mean square of 90° - ψ over people [deg]."""
    spread_by_wobble: float
    """Standard deviation of p over people that it makes."""
    spread: Estimate
    """That of people whose p is normal, whatever makes it."""
    gain: float
    """Logarithm of the likelihood of the first, less that of the second."""
    chance: float
    """That people as modelled differ among each other as much as those who flipped."""
    people: list[Estimate]
    """p of each person."""
    bounced: list[Bounced]


def make(progress: Progress, count: int = 3000, people: int = 8000, mujoco: int = 400) -> Result:
    """Fit ψ to the flips, then let hands toss onto floors."""
    flips, rng = read_flips(), np.random.default_rng(SEED)
    wobble, free = fit_wobble(flips), fit_freely(flips)
    rms, (mean, spread) = float(wobble.parameters[0]), free.parameters
    bounds = np.degrees(interval(lambda x: log_likelihood(flips, by_wobble(x)), rms, rms / 4, rms * 4))
    free_bounds = interval(
        lambda x: log_likelihood(flips, freely(mean, x)), float(spread), spread / 4, spread * 4
    )
    wobbling = {height: Hand(height=height, psi=np.radians(PSI)) for height in HEIGHTS}
    everybody = Hand(psi=np.pi / 2, psi_scatter=rms)
    jobs = [
        (floor, chi, hand, f"{PSI}°", count, Engine.ANALYTIC)
        for floor, chi, hand in product(FLOORS, CHIS, wobbling.values())
    ]
    jobs += [(floor, CHI, everybody, PEOPLE, people, Engine.ANALYTIC) for floor in FLOORS]
    jobs += [(floor, CHI, wobbling[HEIGHTS[0]], f"{PSI}°", mujoco, Engine.MUJOCO) for floor in FLOORS]
    bounced = []
    for job in jobs:
        bounced.append(_bounced(*job, rng))
        progress(len(bounced), len(jobs))
    found = SameSide(
        same=jackknife(
            lambda kept: flips.same[kept].sum() / flips.flips[kept].sum(), len(flips.flips), "people"
        ),
        heads_more=jackknife(
            lambda kept: (
                flips.heads_same[kept].sum() / flips.heads[kept].sum()
                - flips.tails_same[kept].sum() / flips.tails[kept].sum()
            ),
            len(flips.flips),
            "people",
        ),
        rms_angle=_of_people(flips, np.degrees(rms), bounds),
        spread_by_wobble=float(wobble.probabilities.std()),
        spread=_of_people(flips, spread, free_bounds),
        gain=wobble.log_likelihood - free.log_likelihood,
        chance=chance_of_spread(flips, wobble.probabilities, rng),
        people=[
            share(np.arange(flipped) < same, "flips")
            for same, flipped in zip(flips.same, flips.flips, strict=True)
        ],
        bounced=bounced,
    )
    return result(found)


def _of_people(flips: Flips, value: float, bounds: Array) -> Estimate:
    return Estimate(float(value), float(bounds[0]), float(bounds[1]), len(flips.flips), "people")


def result(found: SameSide) -> Result:
    """Return the study's table and claims."""
    return Result(claims=claims(found), data=found, tables=tables(found))


def _bounced(
    floor: str, chi: float, hand: Hand, psi: str, count: int, engine: Engine, rng: np.random.Generator
) -> Bounced:
    """Toss a hand's releases onto a floor, and count the first side up."""
    kind = CoinClass(thick=True, imperfect=False, air=True, coulomb=floor == ROUGH)
    scenario = kind.scenario.replace("floor.restitution", chi)
    start = hand.releases(scenario.body, rng, count)
    found = first_side(scenario, start, engine)
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


def tables(found: SameSide) -> str:
    """Return the tables, in Markdown."""
    return "\n\n".join(
        [
            "How often the side up at the release is up, with 99 % intervals:",
            table(
                ["engine, floor, restitution, height, ψ", *TOUCH_NAMES, "at rest"],
                [
                    [f"{one.engine}, {one.name}", *map(_percent, [*one.touches, one.end])]
                    for one in found.bounced
                ],
            ),
        ]
    )


def _percent(found: Estimate) -> str:
    return f"{found.value:.1%} [{found.low:.1%}, {found.high:.1%}]"


def claims(found: SameSide) -> list[Claim]:
    """Return the claims of those who flipped, and of the engines."""
    (people_smooth,) = of(found, Engine.ANALYTIC, PEOPLE, SMOOTH)
    smooth = of(found, Engine.ANALYTIC, f"{PSI}°", SMOOTH)
    rough = of(found, Engine.ANALYTIC, f"{PSI}°", ROUGH)
    return [
        Claim(
            claim="a caught coin shows the side it started with more often (Bartoš et al. 2025)",
            criteria=[Criterion("share of the same side", found.same, ">", 0.5, "a fair toss")],
        ),
        Claim(
            claim="it does so in 51 % (Diaconis, Holmes and Montgomery 2007)",
            criteria=[
                Criterion("share less 0.51", _less(found.same, 0.51), "within ±", CLOSE, "to the per cent")
            ],
        ),
        Claim(
            claim="one spread of the angle ψ over people explains how much they differ",
            analytic=(
                f"90° - ψ with a root mean square of {found.rms_angle.value:.1f}° "
                f"[{found.rms_angle.low:.1f}, {found.rms_angle.high:.1f}], half-normal over people, makes a "
                f"standard deviation of p of {found.spread_by_wobble:.4f}; people whose p is normal have "
                f"{found.spread.value:.4f} [{found.spread.low:.4f}, {found.spread.high:.4f}], two parameters "
                f"where this has one, and a likelihood smaller by e^{found.gain:.0f}"
            ),
            criteria=[
                Criterion("chance of people as different", found.chance, ">", 0.01, "not excluded"),
                Criterion("gain in the logarithm of the likelihood", found.gain, ">", 0, "the better model"),
            ],
        ),
        Claim(
            claim="heads and tails do not differ in it",
            criteria=[
                Criterion(
                    "share that starts heads less that which starts tails",
                    found.heads_more,
                    "within ±",
                    CLOSE,
                    "to the per cent",
                )
            ],
        ),
        Claim(
            claim="on a smooth floor a balanced coin that wobbles much ends on the side it started from",
            analytic=(
                "neither floor nor impacts turn it about its normal, or about the vertical: the angular "
                "momenta about both keep their signs, and at rest the two axes are one"
            ),
            mujoco="; ".join(_percent(one.end) for one in of(found, Engine.MUJOCO, f"{PSI}°", SMOOTH)),
            criteria=[Criterion(f"share at rest ({one.name})", one.end, ">", 0.99, "all") for one in smooth],
        ),
        Claim(
            claim="on a smooth floor bounces make the bias of people's tosses larger",
            analytic=f"{_percent(people_smooth.touches[0])} at the first touch",
            criteria=[
                Criterion("share of the same side at rest", people_smooth.end, ">", 0.55, "a per cent")
            ],
        ),
        Claim(
            claim=f"on a rough floor nothing of the bias is left at χ = {CHIS[-1]:g}",
            analytic=_at_rest(rough, CHIS[-1]),
            criteria=[
                Criterion(f"share less 1/2 ({one.name})", _less(one.end, 0.5), "within ±", SMALL, "small")
                for one in rough
                if one.chi == CHIS[-1]
            ],
        ),
        Claim(
            claim=f"on a rough floor most of the bias is left at χ = {CHIS[0]:g}",
            analytic=_at_rest(rough, CHIS[0]),
            mujoco="; ".join(
                f"{_percent(one.end)} ({one.name})" for one in of(found, Engine.MUJOCO, f"{PSI}°", ROUGH)
            ),
            criteria=[
                Criterion(f"share ({one.name})", one.end, ">", 0.6, "that of a catch, 0.608")
                for one in rough
                if one.chi == CHIS[0]
            ],
        ),
    ]


def _at_rest(tossed: list[Bounced], chi: float) -> str:
    return "; ".join(
        f"{_percent(one.touches[0])} at the first touch, {_percent(one.end)} at rest ({one.name})"
        for one in tossed
        if one.chi == chi
    )


def _less(found: Estimate, number: float) -> Estimate:
    return replace(found, value=found.value - number, low=found.low - number, high=found.high - number)


def draw(found: SameSide) -> Figure:
    """Draw the people beside the model, and what bounces leave of the bias."""
    picture = Figure(figsize=(11, 4.2))
    people, bounces = picture.subplots(1, 2)
    ranked = sorted(found.people, key=lambda one: one.value)
    at = (np.arange(len(ranked)) + 0.5) / len(ranked)
    for x, one in zip(at, ranked, strict=True):
        people.plot([x, x], [one.low, one.high], color=GREY, linewidth=1)
    people.plot(at, [one.value for one in ranked], "o", color=INK, markersize=3, label="a person, 99 %")
    x = (np.arange(NODES) + 0.5) / NODES
    for end, style in ((found.rms_angle.low, ":"), (found.rms_angle.value, "-"), (found.rms_angle.high, ":")):
        label = f"ψ = 90° ± {end:.0f}° over people" if style == "-" else None
        people.plot(x, by_wobble(float(np.radians(end))), style, color=VERMILION, label=label)
    people.axhline(0.5, color=GREY, linewidth=0.8)
    people.set(
        title="48 people, 350,757 flips",
        xlabel="part of the people below",
        ylabel="share caught with the first side up",
        ylim=(0.45, 0.64),
    )
    people.legend(loc="upper left")
    steps = np.arange(len(TOUCHES) + 1)
    for floor, style in ((SMOOTH, "-"), (ROUGH, "--")):
        for one in of(found, Engine.ANALYTIC, f"{PSI}°", floor):
            if one.height == HEIGHTS[0]:
                values = [each.value for each in (*one.touches, one.end)]
                label = f"χ = {one.chi:g}" if floor == SMOOTH else None
                bounces.plot(steps, values, style, color=COLORS[one.chi], marker="o", label=label)
        (one,) = of(found, Engine.ANALYTIC, PEOPLE, floor)
        values = [each.value for each in (*one.touches, one.end)]
        bounces.plot(steps, values, style, color=INK, marker="s", label="people" if floor == SMOOTH else None)
    bounces.axhline(0.5, color=GREY, linewidth=0.8)
    bounces.set(
        title=f"after bounces, ψ = {PSI}° and people: smooth —, rough – –",
        ylabel="share with the first side up",
        ylim=(0.45, 1.02),
    )
    bounces.set_xticks(steps, [*TOUCH_NAMES, "at rest"])
    bounces.legend(loc="upper left")
    return picture


REPRODUCTION = Reproduction(
    title="whether a coin lands on the side it started from: 350,757 flips, and what bounces do to it",
    seconds=240,
    make=make,
    read=lambda folder: result(read_numbers(folder, SameSide)),
    draw={"same-side": draw},
    quick_seconds=20,
    quick=partial(make, count=200, people=300, mujoco=20),
)
