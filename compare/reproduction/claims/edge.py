"""A claim of section 1: a nickel lands on its edge once in 6,000 tosses; which coin is fair three ways?"""

from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from cointoss.compare.output.progress import Progress
from cointoss.compare.reproduction.claim import Claim, Criterion, Estimate
from cointoss.compare.reproduction.estimates import difference, share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.compare.reproduction.setups.edge_classes import (
    DIAMETRAL,
    HANDS,
    WOBBLING,
)
from cointoss.compare.reproduction.setups.edge_pages import (
    PUBLISHED,
    alike,
    draw,
    fair,
    on_edge,
    percent,
    tables,
)
from cointoss.compare.reproduction.setups.edge_record import (
    ANGLE,
    FREE,
    FULL,
    QUICK,
    SOLID_ANGLE,
    SQUARE,
    EdgeRecord,
    Sizes,
    record_of,
)
from cointoss.compare.reproduction.setups.ends import Ends, ended_as, tosses
from cointoss.models.records import Outcome

FACTOR = 2
"""Shares that differ by less are as good as one, where a model was extrapolated."""
CLOSE, NEAR = 0.02, 0.05
"""Shares, or h/D, that are as good as one; and nearly."""
LEAST_PROBABLE = 1e-3
"""Below this p-value the engines differ."""


def make(progress: Progress, parts: Path, sizes: Sizes = FULL) -> Result:
    """Make all tosses of the study."""
    return result(record_of(sizes, progress, parts))


def result(found: EdgeRecord) -> Result:
    """Return the tables and claims."""
    return Result(claims=claims(found), data=found, tables=tables(found))


def claims(found: EdgeRecord) -> tuple[Claim, ...]:
    """Return the claims of the papers, and what explains why they hold or do not."""
    plain, people = (found.nickel[wobble]["as said"] for wobble in HANDS)
    no_rebound = found.curves[DIAMETRAL]["0"]
    thin, rod = (
        {
            wobble: _sum([list(curve.values())[at] for curve in found.curves[wobble].values()])
            for wobble in HANDS
        }
        for at in (0, -1)
    )
    square = [curve["1"] for curve in found.curves[DIAMETRAL].values()]
    free = found.nickel[WOBBLING][FREE]
    edges = ended_as(free, Outcome.EDGE)
    rolling = share(np.arange(edges) < free.get("edge, standing", 0), "tosses on edge")
    chis = list(found.curves[DIAMETRAL])
    middle = chis[len(chis) // 2]
    by_chance = 1 - (1 - LEAST_PROBABLE) ** len(found.engines)
    by_mujoco = [counts["mujoco"] for name, counts in found.engines.items() if SQUARE in name]
    return (
        Claim(
            claim="a nickel lands on its edge in about 1 of 6,000 tosses (Murray and Teare 1993)",
            analytic=f"about a diameter in {_one_in(plain)}; as people do in {_one_in(people)}",
            criteria=[
                Criterion(
                    f"share over 1/6,000 ({wobble})",
                    _over(on_edge(ends), PUBLISHED),
                    "<",
                    FACTOR,
                    "a factor of two",
                )
                for wobble, ends in zip(HANDS, (plain, people), strict=True)
            ],
            expected=False,
        ),
        Claim(
            claim="a nickel that wobbles lands on its edge more often than one that turns about a diameter",
            analytic="it comes down rolling, and rolls on its edge until it stands",
            criteria=[
                Criterion(
                    "share of people's tosses less that of the others",
                    difference(_flags(people), _flags(plain)),
                    ">",
                    0.01,
                    "a per cent",
                ),
                Criterion(
                    "of people's nickels on edge without resistance, share that rolls on for ever",
                    rolling,
                    ">",
                    0.5,
                    "most",
                ),
            ],
        ),
        Claim(
            claim=(
                "when a coin first touches, C is on the edge's side in a third of the tosses if h/D = 0.577 "
                "(turning about a diameter), or 0.354 (any attitude; von Neumann)"
            ),
            criteria=[
                Criterion(
                    f"share less 1/3 ({turned})", _less(touch.touched, 1 / 3), "within ±", NEAR, "nearly"
                )
                for turned, touch in found.touches.items()
            ],
        ),
        Claim(
            claim="let go at rest just above a floor without rebound a coin falls to the side on which C is",
            criteria=[
                Criterion(
                    f"share less 1/3 ({turned})", _less(touch.let_go, 1 / 3), "within ±", NEAR, "nearly"
                )
                for turned, touch in found.touches.items()
            ],
        ),
        Claim(
            claim="so does a coin that is tossed onto a floor without rebound (Yong and Mahadevan 2011)",
            analytic=(
                "after the first touch it still has, in the median, "
                f"{found.touches[DIAMETRAL].energy:.1f} times the energy at which it passes over its rim: "
                "the touch turns its fall into spin"
            ),
            criteria=[
                Criterion(
                    "share on edge less 1/3 (h/D = 0.577, χ = 0)",
                    _less(on_edge(no_rebound[f"{ANGLE:.6g}"]), 1 / 3),
                    "within ±",
                    NEAR,
                    "nearly",
                )
            ],
            expected=False,
        ),
        *(
            Claim(
                claim=f"the coin that is fair three ways has h/D = {aspect:.3f} ({source})",
                criteria=[
                    Criterion(
                        f"h/D found, less that ({wobble}, χ = {middle})",
                        _less(fair(found, wobble, middle), aspect),
                        "within ±",
                        NEAR,
                        "nearly",
                    )
                    for wobble in HANDS
                ],
                expected=False,
            )
            for aspect, source in ((SOLID_ANGLE, "von Neumann's solid angle"), (ANGLE, "the angle"))
        ),
        *(
            Claim(
                claim=f"the thinnest coin hardly ever lands on its edge ({wobble})",
                criteria=[Criterion("share on edge, h/D = 0.01", on_edge(ends), "<", 0.02, "none but a few")],
                expected=True if wobble == DIAMETRAL else None,
            )
            for wobble, ends in thin.items()
        ),
        Claim(
            claim=(
                "a rod nearly always lands on its side; heads come as often as tails, and a square section "
                "that turns in its plane is on its edge in half of the tosses"
            ),
            criteria=[
                *(
                    Criterion(f"share on edge, h/D = 4 ({wobble})", on_edge(ends), ">", 0.95, "all but a few")
                    for wobble, ends in rod.items()
                ),
                Criterion(
                    "heads of heads and tails, less 1/2",
                    _less(_heads(found), 1 / 2),
                    "within ±",
                    CLOSE,
                    "alike",
                ),
                *(
                    Criterion(
                        f"share on edge less 1/2, h/D = 1, by {engine}",
                        _less(on_edge(_sum(ends)), 1 / 2),
                        "within ±",
                        NEAR,
                        "alike",
                    )
                    for engine, ends in (("the analytic engine", square), ("MuJoCo", by_mujoco))
                    if ends
                ),
            ],
        ),
        Claim(
            claim="the engines' ends differ no more than by chance",
            criteria=[
                Criterion(
                    f"least p-value of {len(found.engines)} χ² tests",
                    min(map(alike, found.engines.values())),
                    ">",
                    LEAST_PROBABLE,
                    f"by chance one falls below it once in {1 / by_chance:.0f} runs",
                )
            ],
        ),
    )


def _sum(several: list[Ends]) -> Ends:
    return {
        name: sum(ends.get(name, 0) for ends in several) for name in {n for ends in several for n in ends}
    }


def _heads(found: EdgeRecord) -> Estimate:
    """Return the share of heads among all nickels that end on a face."""
    ends = _sum([ends for by_factor in found.nickel.values() for ends in by_factor.values()])
    heads, tails = (ended_as(ends, outcome) for outcome in (Outcome.HEADS, Outcome.TAILS))
    return share(np.arange(heads + tails) < heads)


def _flags(ends: Ends) -> Any:
    return np.arange(tosses(ends)) < ended_as(ends, Outcome.EDGE)


def _one_in(ends: Ends) -> str:
    part = on_edge(ends)
    return f"{percent(part)} of {part.count:,d}, 1 in {1 / part.value:,.0f}" if part.value else "none"


def _less(part: Estimate, number: float) -> Estimate:
    return Estimate(part.value - number, part.low - number, part.high - number, part.count, part.counted)


def _over(part: Estimate, number: float) -> Estimate:
    return Estimate(part.value / number, part.low / number, part.high / number, part.count, part.counted)


REPRODUCTION = Reproduction(
    paper="Section 1, Murray and Teare",
    title="how often a coin lands on its edge, and which coin does so in a third of the tosses",
    assumed=(
        "Coins as wide as a US nickel and of its metal, from thin ones to rods, tossed upwards at 2 m/s from "
        "1 m with 120 rad/s, each scattering by a tenth, flat, either side up, in the paper's air; about a "
        "diameter, or with the wobble that explains people's flips, a scatter of 10° in ψ. The floor is "
        "level and plane: Coulomb's friction, μ = 0.3, kinematic restitution, resistance to rolling and "
        "pivoting δ = p = 0.1 mm. A coin has landed on its edge when its energy can no longer tip it, or it "
        "rests there. The nickel: χ = 0.5 but where said. An interrupted run goes on where it was."
    ),
    seconds=1500,
    make=make,
    resumes=True,
    read=lambda folder: result(read_numbers(folder, EdgeRecord)),
    draw={"figure": draw},
    quick_seconds=6,
    quick=partial(make, sizes=QUICK),
)
