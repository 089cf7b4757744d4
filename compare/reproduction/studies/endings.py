"""How thousands of random tosses end, by coin, floor and air, and how far both engines agree in it."""

import json
import os
from collections import Counter
from collections.abc import Iterable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, dataclass
from itertools import product
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure as Picture
from scipy.stats import chi2_contingency

import analytic
import coin_mj
from compare.output.style import STYLE
from compare.reproduction.runner import Figure, Made, Progress
from models.records import Ending, Outcome
from models.releases import Releases
from models.scenario import Release, Scenario

COUNT, COUNT_MUJOCO, SEED = 10_000, 5_000, 2008
"""Tosses of each coin by the paper's mechanics, and by MuJoCo; and the seed."""
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
class Study:
    """Counts of tosses."""

    outcomes: Counts
    """By the paper's mechanics."""
    mujoco: Counts
    """Of other tosses on `BY_BOTH`, by MuJoCo with the settings of many tosses."""
    most_impacts: int
    """Of any toss that the paper's mechanics decides."""
    longest: float
    """Of any of those [s]."""


def run(folder: Path, progress: Progress) -> Made:
    """Make the study: numbers.json and endings.png."""
    study = compute(COUNT, COUNT_MUJOCO, SEED, progress)
    (folder / "numbers.json").write_text(
        json.dumps(asdict(study), indent=1, allow_nan=False), encoding="utf-8"
    )
    with mpl.rc_context({**STYLE, "axes.grid": False}):
        draw(study).savefig(folder / "endings.png", dpi=110)
    return Made(text=text(study), failed=check(study))


def compute(count: int, count_mujoco: int, seed: int, progress: Progress) -> Study:
    """Toss `count` coins of each of `COINS` by the paper's mechanics, and `count_mujoco` by MuJoCo."""
    jobs = [(seed, coin, number) for coin in range(len(COINS)) for number in range(count)]
    jobs_mujoco = [(seed + 1, coin, number) for coin in range(len(COINS)) for number in range(count_mujoco)]
    outcomes: dict[str, Counter[str]] = {}
    mujoco: dict[str, Counter[str]] = {}
    most, longest = 0, 0.0
    whole = len(jobs) + len(jobs_mujoco)
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        ended = pool.map(_toss, jobs, chunksize=20)
        for done, (kind, outcome, ending, impacts, time) in enumerate(ended, start=1):
            outcomes.setdefault(_name(kind), Counter())[f"{outcome}, {ending}"] += 1
            if outcome not in ("undecided", "perpetual"):
                most, longest = max(most, impacts), max(longest, time)
            progress(done, whole)
        ended = pool.map(toss_by_mujoco, jobs_mujoco, chunksize=20)
        for done, (kind, outcome, ending) in enumerate(ended, start=len(jobs) + 1):
            mujoco.setdefault(_name(kind), Counter())[f"{outcome}, {ending}"] += 1
            progress(done, whole)
    return Study(outcomes=_ordered(outcomes), mujoco=_ordered(mujoco), most_impacts=most, longest=longest)


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
    return kind, outcome.label, ending.label, int(ended.impacts[0]), float(ended.end_time[0])


def toss_by_mujoco(job: tuple[int, int, int]) -> tuple[Kind, str, str]:
    """Toss a coin on one of the floors `BY_BOTH` by MuJoCo; give the kind, the outcome and the ending."""
    rng = np.random.default_rng(job)
    kind, scenario = draw_toss(rng, COINS[job[1]])
    while kind.floor not in BY_BOTH:
        kind, scenario = draw_toss(rng, COINS[job[1]])
    ended = coin_mj.toss_many(scenario, _only(scenario.release))
    return kind, Outcome(ended.outcome[0]).label, Ending(ended.ending[0]).label


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


def from_json(saved: str) -> Study:
    """Read a study from its numbers.json."""
    return Study(**json.loads(saved))


def share(outcomes: Counts, outcome: str, within: Iterable[str] = ()) -> tuple[int, int]:
    """Count the tosses of an outcome, and all, of the kinds whose names have all of `within`."""
    words = list(within)
    kinds = [ends for name, ends in outcomes.items() if all(f", {word}, " in f", {name}, " for word in words)]
    of_outcome = sum(n for ends in kinds for end, n in ends.items() if end.startswith(f"{outcome}, "))
    return of_outcome, sum(sum(ends.values()) for ends in kinds)


def by_both(study: Study, within: Iterable[str]) -> dict[str, list[int]]:
    """Count the tosses of each outcome shown, by engine, of the kinds whose names have all of `within`."""
    words = list(within)
    engines = {"analytic": study.outcomes, "mujoco": study.mujoco}
    return {
        engine: [share(outcomes, outcome.label, words)[0] for outcome in _SHOWN]
        for engine, outcomes in engines.items()
    }


def probability(counts: dict[str, list[int]]) -> float:
    """Give the probability by chance of ends that differ so much between the engines, by a χ² test."""
    met = np.array([counts["analytic"], counts["mujoco"]])
    test: Any = chi2_contingency(met[:, met.any(axis=0)])
    return float(test.pvalue)


def check(study: Study) -> tuple[str, ...]:
    """Give the claims that the counts don't bear out."""
    both = {"analytic": study.outcomes, "mujoco": study.mujoco}
    claims = {
        "only in vacuum a coin goes on for ever": all(
            share(outcomes, "perpetual", ["air"])[0] == 0 for outcomes in both.values()
        ),
        "at most 1 toss in 10,000 stays undecided": all(
            10_000 * number <= whole
            for number, whole in (share(outcomes, "undecided") for outcomes in both.values())
        ),
        "in air the engines' ends differ no more than by chance": all(
            probability(by_both(study, words)) > 1e-3
            for words in (*([floor, "air"] for floor in BY_BOTH), *([name] for name in _in_air(study)))
        ),
    }
    return tuple(claim for claim, holds in claims.items() if not holds)


def _in_air(study: Study) -> list[str]:
    return [name for name in study.mujoco if name.endswith(", air")]


def _rows(study: Study) -> Iterator[tuple[str, list[float]]]:
    for name, ends in study.outcomes.items():
        number = sum(ends.values())
        parts = [sum(n for end, n in ends.items() if end.startswith(f"{o.label}, ")) for o in _SHOWN]
        yield f"{name} ({number})", [100 * part / number for part in parts]


def text(study: Study) -> str:
    """Give the tables, in Markdown."""
    lines = [
        f"| coin, floor, air (tosses) | {' | '.join(f'{o.label} [%]' for o in _SHOWN)} |",
        "|---" * (len(_SHOWN) + 1) + "|",
    ]
    lines += [f"| {name} | {' | '.join(f'{part:.2f}' for part in parts)} |" for name, parts in _rows(study)]
    lines += ["", "| of all | tosses | share [%] |", "|---|---|---|"]
    for outcome in _SHOWN:
        number, whole = share(study.outcomes, outcome.label)
        lines.append(f"| {outcome.label} | {number} of {whole} | {100 * number / whole:.2f} |")
    number, whole = share(study.outcomes, "perpetual", ["vacuum"])
    lines.append(f"| perpetual, of those in vacuum | {number} of {whole} | {100 * number / whole:.2f} |")
    lines += [
        "",
        f"A toss that was decided took at most {study.most_impacts} impacts and {study.longest:.0f} s.",
        "",
        f"| by MuJoCo (tosses) | {' | '.join(f'{o.label} [%]' for o in _SHOWN)} | probability by chance |",
        "|---" * (len(_SHOWN) + 2) + "|",
    ]
    pooled = {f"{floor}, {medium}": [floor, medium] for floor, medium in product(BY_BOTH, MEDIA)}
    for name, words in {**{name: [name] for name in study.mujoco}, **pooled}.items():
        counts = by_both(study, words)
        number = sum(counts["mujoco"])
        parts = [f"{100 * n / number:.2f}" for n in counts["mujoco"]]
        lines.append(f"| {name} ({number}) | {' | '.join(parts)} | {probability(counts):.2g} |")
    number, whole = share(study.mujoco, "undecided")
    lines += ["", f"MuJoCo leaves {number} of {whole} undecided."]
    return "\n".join(lines)


def draw(study: Study) -> Picture:
    """Draw the shares of the outcomes as bars."""
    rows = list(_rows(study))[::-1]
    picture = Picture(figsize=(9, 0.28 * len(rows) + 1.2))
    axes = picture.subplots()
    left = np.zeros(len(rows))
    looks = ("#0072B2", "#56B4E9", "#E69F00", "#009E73", "#000000")
    for i, (outcome, color) in enumerate(zip(_SHOWN, looks, strict=True)):
        parts = np.array([shares[i] for _, shares in rows])
        axes.barh([name for name, _ in rows], parts, left=left, color=color, label=outcome.label)
        left += parts
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of the tosses [%]")
    axes.margins(y=0.01)
    picture.legend(loc="outside upper center", ncols=len(_SHOWN))
    return picture


FIGURE = Figure(
    title="how thousands of random tosses end, and whether both engines end them alike",
    seconds=3200,
    files=("numbers.json", "endings.png"),
    run=run,
)
