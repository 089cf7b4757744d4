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

import coin_mj
from analytic.events import run as run_events
from analytic.toss import state_of
from compare.plot_style import STYLE
from compare.reproduction import Figure, Made, Progress
from models.records import Ending, Outcome
from models.scenario import Scenario

COUNT, COUNT_BOTH, SEED = 10_000, 200, 2008
"""Tosses of each coin; tosses by each engine on each floor; and the seed."""
PAPER_OFFSET = (-1e-3, -1e-3, -2e-4)
THICKNESS = 2e-3
COINS = ("ideal", "imperfect")
FLOORS = ("smooth", "coulomb, kinematic", "coulomb, energetic")
RESTITUTION = {"smooth": (0.1, 0.95), "coulomb, kinematic": (0.1, 0.7), "coulomb, energetic": (0.1, 0.95)}
AIR = {"normal": 0.8, "tangential": 0.2}
ENDS = ("heads before contact", "tails before contact", "contact")
"""Ends that both engines tell apart: MuJoCo's does not follow a coin that stays in contact."""
_SHOWN = (Outcome.HEADS, Outcome.TAILS, Outcome.EDGE, Outcome.PERPETUAL, Outcome.UNDECIDED)
_BOUNCED = {Outcome.HEADS: 0, Outcome.TAILS: 1}


class Kind(NamedTuple):
    """What a toss was drawn from."""

    coin: str
    thick: bool
    floor: str
    air: bool


@dataclass(frozen=True)
class Study:
    """Counts of tosses."""

    outcomes: dict[str, dict[str, int]]
    """By the kind of toss, and by outcome and ending."""
    both: dict[str, dict[str, list[int]]]
    """By floor and engine, of `ENDS`."""
    most_impacts: int
    """Of any toss that is decided."""
    longest: float
    """Of any toss that is decided [s]."""


def run(folder: Path, progress: Progress) -> Made:
    """Make the study: numbers.json and endings.png."""
    study = compute(COUNT, COUNT_BOTH, SEED, progress)
    (folder / "numbers.json").write_text(
        json.dumps(asdict(study), indent=1, allow_nan=False), encoding="utf-8"
    )
    with mpl.rc_context({**STYLE, "axes.grid": False}):
        draw(study).savefig(folder / "endings.png", dpi=110)
    return Made(text=text(study), failed=check(study))


def compute(count: int, count_both: int, seed: int, progress: Progress) -> Study:
    """Toss `count` coins of each of `COINS`, and `count_both` by each engine on two floors."""
    jobs = [(seed, coin, number) for coin in range(len(COINS)) for number in range(count)]
    jobs_both = [
        (seed, floor, engine, number)
        for floor, engine, number in product(FLOORS[:2], ("analytic", "mujoco"), range(count_both))
    ]
    outcomes: dict[str, Counter[str]] = {}
    both = {floor: {engine: [0, 0, 0] for engine in ("analytic", "mujoco")} for floor in FLOORS[:2]}
    most, longest = 0, 0.0
    whole = len(jobs) + len(jobs_both)
    with ProcessPoolExecutor(os.cpu_count()) as pool:
        ended = pool.map(_toss, jobs, chunksize=20)
        for done, (kind, outcome, ending, impacts, time) in enumerate(ended, start=1):
            name = f"{outcome}, {ending}"
            outcomes.setdefault(_name(kind), Counter())[name] += 1
            if outcome not in ("undecided", "perpetual"):
                most, longest = max(most, impacts), max(longest, time)
            progress(done, whole)
        ends = zip(jobs_both, pool.map(_toss_by, jobs_both), strict=True)
        for done, ((_, floor, engine, _), end) in enumerate(ends, start=len(jobs) + 1):
            both[floor][engine][end] += 1
            progress(done, whole)
    ordered = {name: dict(sorted(outcomes[name].items())) for name in sorted(outcomes)}
    return Study(outcomes=ordered, both=both, most_impacts=most, longest=longest)


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
    ended = run_events(scenario.body, scenario.rules, state_of(scenario.release))
    return kind, ended.outcome.label, ended.ending.label, len(ended.rows), ended.end_time


def _toss_by(job: tuple[int, str, str, int]) -> int:
    """Toss a thick ideal coin in air by one of the engines; give the number of its end in `ENDS`."""
    seed, floor, engine, number = job
    rng = np.random.default_rng([seed, FLOORS.index(floor), len(engine), number])
    scenario = Scenario.model_validate(
        {
            "coin": {"mass": 2e-3, "radius": 1.25e-2, "thickness": THICKNESS},
            "air": AIR,
            "floor": {"contact": floor.partition(", ")[0], "restitution": 0.7, "friction": 0.3},
            "release": _release(rng),
        }
    )
    if engine == "mujoco":
        return _BOUNCED.get(coin_mj.toss(scenario).outcome, 2)
    ended = run_events(scenario.body, scenario.rules, state_of(scenario.release))
    bounced = len(ended.contacts) == 0 and ended.ending != Ending.LYING
    return _BOUNCED.get(ended.outcome, 2) if bounced else 2


def _name(kind: Kind) -> str:
    return ", ".join(
        (kind.coin, "thick" if kind.thick else "thin", kind.floor, "air" if kind.air else "vacuum")
    )


def from_json(saved: str) -> Study:
    """Read a study from its numbers.json."""
    return Study(**json.loads(saved))


def share(study: Study, outcome: str, within: Iterable[str] = ()) -> tuple[int, int]:
    """Count the tosses of an outcome, and all, of the kinds whose names have all words of `within`."""
    words = list(within)
    kinds = [ends for name, ends in study.outcomes.items() if all(word in name.split(", ") for word in words)]
    of_outcome = sum(n for ends in kinds for end, n in ends.items() if end.startswith(f"{outcome}, "))
    return of_outcome, sum(sum(ends.values()) for ends in kinds)


def probability(counts: dict[str, list[int]]) -> float:
    """Give the probability by chance of ends that differ so much between the engines, by a χ² test."""
    test: Any = chi2_contingency([counts["analytic"], counts["mujoco"]])
    return float(test.pvalue)


def check(study: Study) -> tuple[str, ...]:
    """Give the claims that the counts don't bear out."""
    undecided, whole = share(study, "undecided")
    undecided_in_air, in_air = share(study, "undecided", ["air"])
    claims = {
        "only in vacuum a coin goes on for ever": share(study, "perpetual", ["air"])[0] == 0,
        "in air fewer than 1 toss in 1000 stays undecided": 1000 * undecided_in_air < in_air,
        "fewer than 1 toss in 50 stays undecided": 50 * undecided < whole,
        "the engines' ends differ no more than by chance": all(
            probability(counts) > 1e-3 for counts in study.both.values()
        ),
    }
    return tuple(claim for claim, holds in claims.items() if not holds)


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
        number, whole = share(study, outcome.label)
        lines.append(f"| {outcome.label} | {number} of {whole} | {100 * number / whole:.2f} |")
    number, whole = share(study, "perpetual", ["vacuum"])
    lines.append(f"| perpetual, of those in vacuum | {number} of {whole} | {100 * number / whole:.2f} |")
    lines += [
        "",
        f"A toss that was decided took at most {study.most_impacts} impacts and {study.longest:.0f} s.",
        "",
        f"| floor, engine | {' | '.join(ENDS)} |",
        "|---|---|---|---|",
    ]
    for floor, counts in study.both.items():
        lines += [f"| {floor}, {engine} | {' | '.join(map(str, n))} |" for engine, n in counts.items()]
        lines.append(f"| {floor}: probability by chance | {probability(counts):.2f} | | |")
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
    title="how thousands of random tosses end, and whether both engines bounce alike",
    seconds=4000,
    files=("numbers.json", "endings.png"),
    run=run,
)
