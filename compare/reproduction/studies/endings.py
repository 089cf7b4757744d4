"""How thousands of random tosses end, by coin, floor and air, and how far both engines agree in it."""

import os
from collections import Counter
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from scipy.stats import chi2_contingency

from cointoss import analytic, coin_mj
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import GREY, OUTCOMES
from cointoss.compare.output.tables import table
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.saving import read_numbers
from cointoss.models.parts import Release
from cointoss.models.records import Ending, Outcome
from cointoss.models.releases import Releases
from cointoss.models.scenario import Scenario

COUNT, COUNT_MUJOCO, SEED = 10_000, 5_000, 2008
"""Tosses of each coin by the analytic engine, and by MuJoCo; and the seed."""
LEAST_PROBABLE = 1e-3
"""By chance one of ten tests falls below it once in a hundred runs."""
PAPER_OFFSET = (-1e-3, -1e-3, -2e-4)
THICKNESS = 2e-3
COINS = ("ideal", "imperfect")
FLOORS = ("smooth", "coulomb, kinematic", "coulomb, energetic")
RESTITUTION = {"smooth": (0.1, 0.95), "coulomb, kinematic": (0.1, 0.7), "coulomb, energetic": (0.1, 0.95)}
AIR = {"normal": 0.8, "tangential": 0.2}
BY_BOTH, MEDIA = FLOORS[:2], ("air", "vacuum")
"""Floors that MuJoCo realises, and what is between them and the hand."""
_SHOWN = (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE, Outcome.PERPETUAL, Outcome.UNDECIDED)


Counts = dict[str, dict[str, int]]
"""By the kind of toss, and by outcome and ending."""


class Kind(NamedTuple):
    """What a toss was drawn from."""

    coin: str
    thick: bool
    floor: str
    air: bool


@dataclass(frozen=True)
class EndingCounts:
    """How many tosses ended how."""

    outcomes: Counts
    """By the analytic engine."""
    mujoco: Counts
    """Of other tosses on `BY_BOTH`, by MuJoCo with the settings of many tosses."""
    most_impacts: int
    """Of any toss that the analytic engine decides."""
    longest: float
    """Of any of those [s]."""


def result(counts: EndingCounts) -> Result:
    """Return the study's tables and claims."""
    return Result(claims=claims(counts), data=counts, tables=tables(counts))


def compute(count: int, count_mujoco: int, seed: int, progress: Progress) -> EndingCounts:
    """Toss `count` coins of each of `COINS` by the analytic engine, and `count_mujoco` by MuJoCo."""
    jobs = [(seed, coin, number) for coin in range(len(COINS)) for number in range(count)]
    jobs_mujoco = [(seed + 1, coin, number) for coin in range(len(COINS)) for number in range(count_mujoco)]
    outcomes: dict[str, Counter[str]] = {}
    mujoco: dict[str, Counter[str]] = {}
    most, longest = 0, 0.0
    whole = len(jobs) + len(jobs_mujoco)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ended = pool.map(_toss, jobs)
        for done, (kind, outcome, ending, impacts, time) in enumerate(ended, start=1):
            outcomes.setdefault(_name(kind), Counter())[f"{outcome}, {ending}"] += 1
            if outcome not in ("undecided", "perpetual"):
                most, longest = max(most, impacts), max(longest, time)
            progress(done, whole)
        ended = pool.map(toss_by_mujoco, jobs_mujoco)
        for done, (kind, outcome, ending) in enumerate(ended, start=len(jobs) + 1):
            mujoco.setdefault(_name(kind), Counter())[f"{outcome}, {ending}"] += 1
            progress(done, whole)
    return EndingCounts(
        outcomes=_ordered(outcomes), mujoco=_ordered(mujoco), most_impacts=most, longest=longest
    )


def _ordered(counts: dict[str, Counter[str]]) -> Counts:
    return {name: dict(sorted(counts[name].items())) for name in sorted(counts)}


def draw_toss(rng: np.random.Generator, coin: str) -> tuple[Kind, Scenario]:
    """Draw a toss from a hand's height: thick or thin coin, floor, air, restitution, friction and release."""
    kind = Kind(coin, bool(rng.integers(2)), FLOORS[rng.integers(3)], bool(rng.integers(2)))
    offset = np.array(PAPER_OFFSET) if coin == "imperfect" else np.zeros(3)
    if not kind.thick:
        offset[2] = 0.0
    law, _, restitution_kind = kind.floor.partition(", ")
    described: dict[str, Any] = {
        "coin": {
            "mass": 2e-3,
            "radius": 1.25e-2,
            "thickness": THICKNESS if kind.thick else 0.0,
            "center_of_mass": offset.tolist(),
        },
        "air": AIR if kind.air else {},
        "floor": {
            "contact": law,
            "restitution": rng.uniform(*RESTITUTION[kind.floor]),
            "friction": rng.uniform(0.05, 0.8),
            "restitution_kind": restitution_kind or "kinematic",
        },
        "release": _release(rng),
    }
    return kind, Scenario.model_validate(described)


def _release(rng: np.random.Generator) -> dict[str, Any]:
    e = rng.normal(size=4)
    return {
        "position": [0.0, 0.0, rng.uniform(0.05, 0.6)],
        "velocity": rng.uniform(-0.3, 0.3, 3).tolist(),
        "quaternion": (e / np.linalg.norm(e)).tolist(),
        "angular_velocity": rng.uniform(-40, 40, 3).tolist(),
    }


def _toss(job: tuple[int, int, int]) -> tuple[Kind, str, str, int, float]:
    kind, scenario = draw_toss(np.random.default_rng(job), COINS[job[1]])
    ended = analytic.toss_many(scenario, _only(scenario.release))
    outcome, ending = Outcome(ended.outcome[0]), Ending(ended.ending[0])
    return kind, str(outcome), str(ending), int(ended.impacts[0]), float(ended.end_time[0])


def toss_by_mujoco(job: tuple[int, int, int]) -> tuple[Kind, str, str]:
    """Return kind, outcome and ending of a toss by MuJoCo on one of the floors `BY_BOTH`."""
    rng = np.random.default_rng(job)
    kind, scenario = draw_toss(rng, COINS[job[1]])
    while kind.floor not in BY_BOTH:
        kind, scenario = draw_toss(rng, COINS[job[1]])
    ended = coin_mj.toss_many(scenario, _only(scenario.release))
    return kind, str(Outcome(ended.outcome[0])), str(Ending(ended.ending[0]))


def _only(release: Release) -> Releases:
    return Releases(
        position=np.array([release.position]),
        velocity=np.array([release.velocity]),
        quaternion=np.array([release.attitude]),
        angular_velocity=np.array([release.angular_velocity]),
    )


def _name(kind: Kind) -> str:
    return ", ".join(
        (kind.coin, "thick" if kind.thick else "thin", kind.floor, "air" if kind.air else "vacuum")
    )


def share(outcomes: Counts, outcome: str, within: Iterable[str] = ()) -> tuple[int, int]:
    """Count the tosses of an outcome, and all, of the kinds whose names have all of `within`."""
    words = list(within)
    kinds = [ends for name, ends in outcomes.items() if all(f", {word}, " in f", {name}, " for word in words)]
    of_outcome = sum(n for ends in kinds for end, n in ends.items() if end.startswith(f"{outcome}, "))
    return of_outcome, sum(sum(ends.values()) for ends in kinds)


def by_both(counts: EndingCounts, within: Iterable[str]) -> dict[str, list[int]]:
    """Count the tosses of each outcome shown, by engine, of the kinds whose names have all of `within`."""
    words = list(within)
    engines = {"analytic": counts.outcomes, "mujoco": counts.mujoco}
    return {
        engine: [share(outcomes, str(outcome), words)[0] for outcome in _SHOWN]
        for engine, outcomes in engines.items()
    }


def probability(counts: dict[str, list[int]]) -> float:
    """Return the probability by chance of ends that differ so much between the engines, by a χ² test."""
    met = np.array([counts["analytic"], counts["mujoco"]])
    test: Any = chi2_contingency(met[:, met.any(axis=0)])
    return float(test.pvalue)


def claims(counts: EndingCounts) -> tuple[Claim, ...]:
    """Return the claims of the counts."""
    engines = (counts.outcomes, counts.mujoco)
    undecided = [number / whole for number, whole in (share(one, "undecided") for one in engines)]
    pooled = [*([floor, "air"] for floor in BY_BOTH), *([name] for name in _in_air(counts))]
    return (
        Claim(
            claim="only in vacuum a coin goes on for ever",
            criteria=[
                Criterion(
                    "perpetual tosses in air",
                    sum(share(one, "perpetual", ["air"])[0] for one in engines),
                    "=",
                    0,
                    "none",
                )
            ],
        ),
        Claim(
            claim="at most 1 toss in 10,000 stays undecided",
            criteria=[Criterion("larger share of both engines", max(undecided), "≤", 1e-4, "1 in 10,000")],
            expected=False,
        ),
        Claim(
            claim="in air the engines' ends differ no more than by chance",
            criteria=[
                Criterion(
                    f"least probability of {len(pooled)} χ² tests",
                    min(probability(by_both(counts, words)) for words in pooled),
                    ">",
                    LEAST_PROBABLE,
                    "by chance one falls below it once in a hundred runs",
                )
            ],
        ),
    )


def _in_air(counts: EndingCounts) -> list[str]:
    return [name for name in counts.mujoco if name.endswith(", air")]


def _rows(counts: EndingCounts) -> Iterator[tuple[str, list[float]]]:
    for name, ends in counts.outcomes.items():
        number = sum(ends.values())
        parts = [sum(n for end, n in ends.items() if end.startswith(f"{o}, ")) for o in _SHOWN]
        yield f"{name} ({number})", [100 * part / number for part in parts]


def tables(counts: EndingCounts) -> str:
    """Return the tables, in Markdown."""
    shown = [f"{outcome} [%]" for outcome in _SHOWN]
    parts = []
    for outcome in _SHOWN:
        number, whole = share(counts.outcomes, str(outcome))
        parts.append([str(outcome), f"{number} of {whole}", f"{100 * number / whole:.2f}"])
    number, whole = share(counts.outcomes, "perpetual", ["vacuum"])
    parts.append(["perpetual, of those in vacuum", f"{number} of {whole}", f"{100 * number / whole:.2f}"])
    pooled = {f"{floor}, {medium}": [floor, medium] for floor, medium in product(BY_BOTH, MEDIA)}
    by_mujoco = []
    for name, words in {**{name: [name] for name in counts.mujoco}, **pooled}.items():
        ends = by_both(counts, words)
        tosses = sum(ends["mujoco"])
        shares = [f"{100 * n / tosses:.2f}" for n in ends["mujoco"]]
        by_mujoco.append([f"{name} ({tosses})", *shares, f"{probability(ends):.2g}"])
    number, whole = share(counts.mujoco, "undecided")
    return "\n\n".join(
        [
            table(
                ["coin, floor, air (tosses)", *shown],
                [[name, *(f"{part:.2f}" for part in parts)] for name, parts in _rows(counts)],
            ),
            table(["of all", "tosses", "share [%]"], parts),
            f"A toss that was decided took at most {counts.most_impacts} impacts and {counts.longest:.0f} s.",
            table(["by MuJoCo (tosses)", *shown, "probability by chance"], by_mujoco),
            f"MuJoCo leaves {number} of {whole} undecided.",
        ]
    )


def draw(counts: EndingCounts) -> Figure:
    """Draw the shares of the outcomes as bars."""
    rows = list(_rows(counts))[::-1]
    picture = Figure(figsize=(9, 0.28 * len(rows) + 1.2))
    axes = picture.subplots()
    names, left = [name for name, _ in rows], np.zeros(len(rows))
    for i, outcome in enumerate(_SHOWN):
        parts = np.array([shares[i] for _, shares in rows])
        axes.barh(
            names,
            parts,
            left=left,
            color=OUTCOMES[outcome],
            edgecolor=GREY,
            linewidth=0.4,
            label=str(outcome),
        )
        left += parts
    axes.grid(visible=False)
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of the tosses [%]")
    axes.margins(y=0.01)
    picture.legend(loc="outside upper center", ncols=len(_SHOWN))
    return picture


REPRODUCTION = Reproduction(
    title="how thousands of random tosses end, and whether both engines end them alike",
    seconds=3200,
    make=lambda progress: result(compute(COUNT, COUNT_MUJOCO, SEED, progress)),
    read=lambda folder: result(read_numbers(folder, EndingCounts)),
    draw={"endings": draw},
)
