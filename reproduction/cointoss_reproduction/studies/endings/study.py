"""How thousands of random tosses end, by coin, floor and air, and how far both engines agree in it."""

from collections import Counter, defaultdict
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from matplotlib.figure import Figure

from cointoss import Outcome, Scenario, analytic, coin_mj
from cointoss.study import GREY, OUTCOMES, Answers, Array, Progress, chance_alike, paragraphs, row_of, table
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.ends import Ends, counted, ended_as, together, tosses
from cointoss_reproduction.setups.general_coins import AIR, paper_coin

COUNT, COUNT_MUJOCO, SEED = 10_000, 5_000, 2008
"""Tosses of each coin by the analytic engine, and by MuJoCo; and the seed."""
BLOCK = 1000
"""Tosses that are made together."""
LEAST_PROBABLE = 1e-3
"""By chance one of ten tests falls below it once in a hundred runs."""
COINS = ("ideal", "imperfect")
FLOORS = ("smooth", "coulomb, kinematic", "coulomb, energetic")
RESTITUTION = {"smooth": (0.1, 0.95), "coulomb, kinematic": (0.1, 0.7), "coulomb, energetic": (0.1, 0.95)}
BY_BOTH, MEDIA = FLOORS[:2], ("air", "vacuum")
"""Floors that MuJoCo realises, and what is between them and the hand."""
_SHOWN = (*(outcome for outcome in Outcome if outcome != Outcome.UNDECIDED), Outcome.UNDECIDED)


Counts = dict[str, Ends]
"""By the kind of toss."""


class TossKind(NamedTuple):
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


def compute(
    progress: Progress, count: int = COUNT, count_mujoco: int = COUNT_MUJOCO, seed: int = SEED
) -> EndingCounts:
    """Toss `count` coins of each of `COINS` by the analytic engine, and `count_mujoco` by MuJoCo."""
    outcomes: dict[str, Counter[str]] = defaultdict(Counter)
    mujoco: dict[str, Counter[str]] = defaultdict(Counter)
    most, longest, done = 0, 0.0, 0
    whole = len(COINS) * (count + count_mujoco)
    for kinds, ended in _tossed(seed, count, draw_toss, analytic.toss_rows):
        _count(outcomes, kinds, ended)
        decided = ~np.isin(ended.outcome, (Outcome.UNDECIDED, Outcome.PERPETUAL, Outcome.TRANSIENT))
        most = max(most, int(ended.impacts[decided].max(initial=0)))
        longest = max(longest, float(ended.end_time[decided].max(initial=0.0)))
        progress(done := done + len(kinds), whole)
    for kinds, ended in _tossed(seed + 1, count_mujoco, draw_for_both, coin_mj.toss_rows):
        _count(mujoco, kinds, ended)
        progress(done := done + len(kinds), whole)
    return EndingCounts(_ordered(outcomes), _ordered(mujoco), most, longest)


def _ordered(counts: dict[str, Counter[str]]) -> Counts:
    return {name: dict(sorted(counts[name].items())) for name in sorted(counts)}


def draw_toss(rng: np.random.Generator, coin: str) -> tuple[TossKind, Scenario]:
    """Draw a toss from a hand's height: thick or thin coin, floor, air, restitution, friction and release."""
    kind = TossKind(coin, bool(rng.integers(2)), FLOORS[rng.integers(3)], bool(rng.integers(2)))
    law, _, restitution_kind = kind.floor.partition(", ")
    described: dict[str, Any] = {
        "coin": paper_coin(thick=kind.thick, imperfect=coin == "imperfect"),
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


def draw_for_both(rng: np.random.Generator, coin: str) -> tuple[TossKind, Scenario]:
    """Draw a toss on one of the floors `BY_BOTH`; see `draw_toss`."""
    kind, scenario = draw_toss(rng, coin)
    while kind.floor not in BY_BOTH:
        kind, scenario = draw_toss(rng, coin)
    return kind, scenario


def _tossed(
    seed: int,
    count: int,
    draw: Callable[[np.random.Generator, str], tuple[TossKind, Scenario]],
    toss_rows: Callable[[Array], Answers],
) -> Iterator[tuple[list[str], Answers]]:
    """Toss each of `COINS`, `BLOCK` at a time, and yield the kinds of the tosses and how they ended."""
    for (i, coin), first in product(enumerate(COINS), range(0, count, BLOCK)):
        numbers = range(first, min(first + BLOCK, count))
        drawn = [draw(np.random.default_rng((seed, i, number)), coin) for number in numbers]
        yield [_name(kind) for kind, _ in drawn], toss_rows(np.array([row_of(case) for _, case in drawn]))


def _count(counts: dict[str, Counter[str]], kinds: list[str], ended: Answers) -> None:
    """Add how tosses ended to the counts of their kinds."""
    for kind in set(kinds):
        counts[kind].update(counted(ended, np.array(kinds) == kind))


def _name(kind: TossKind) -> str:
    return ", ".join(
        (kind.coin, "thick" if kind.thick else "thin", kind.floor, "air" if kind.air else "vacuum")
    )


def within(outcomes: Counts, *words: str) -> Ends:
    """Return the ends of all kinds of tosses whose names have all of the words."""
    return together(
        ends for name, ends in outcomes.items() if all(f", {word}, " in f", {name}, " for word in words)
    )


def by_both(counts: EndingCounts, *words: str) -> list[list[int]]:
    """Return how many tosses have each of the outcomes shown, by engine; see `within` for the words."""
    return [_shown(within(outcomes, *words)) for outcomes in (counts.outcomes, counts.mujoco)]


def _shown(ends: Ends) -> list[int]:
    return [ended_as(ends, outcome) for outcome in _SHOWN]


def measures(counts: EndingCounts) -> dict[str, Any]:
    """Return what the claims name."""
    engines = [within(counts.outcomes), within(counts.mujoco)]
    pooled = [
        *((floor, "air") for floor in BY_BOTH),
        *((name,) for name in counts.mujoco if name.endswith(", air")),
    ]
    return {
        "perpetual": sum(
            ended_as(within(one, "air"), Outcome.PERPETUAL) for one in (counts.outcomes, counts.mujoco)
        ),
        "undecided": max(ended_as(ends, Outcome.UNDECIDED) / tosses(ends) for ends in engines),
        "tests": len(pooled),
        "probability": min(chance_alike(by_both(counts, *words)) for words in pooled),
    }


def _rows(counts: EndingCounts) -> Iterator[tuple[str, list[float]]]:
    for name, ends in counts.outcomes.items():
        yield f"{name} ({tosses(ends)})", [100 * part / tosses(ends) for part in _shown(ends)]


def tables(counts: EndingCounts) -> str:
    """Return the tables, in Markdown."""
    shown = [f"{outcome} [%]" for outcome in _SHOWN]
    by_mujoco = within(counts.mujoco)
    of_all = [(str(outcome), within(counts.outcomes), outcome) for outcome in _SHOWN]
    of_all.append(("perpetual, of those in vacuum", within(counts.outcomes, "vacuum"), Outcome.PERPETUAL))
    parts = [(name, ended_as(ends, end), tosses(ends)) for name, ends, end in of_all]
    pooled = {f"{floor}, {medium}": (floor, medium) for floor, medium in product(BY_BOTH, MEDIA)}
    rows = []
    for name, words in {**{name: (name,) for name in counts.mujoco}, **pooled}.items():
        both = by_both(counts, *words)
        number = sum(both[1])
        shares = [f"{100 * n / number:.2f}" for n in both[1]]
        rows.append([f"{name} ({number})", *shares, f"{chance_alike(both):.2g}"])
    return paragraphs(
        table(
            ["coin, floor, air (tosses)", *shown],
            [[name, *(f"{part:.2f}" for part in parts)] for name, parts in _rows(counts)],
        ),
        table(
            "of all | tosses | share [%]",
            [[name, f"{part} of {whole}", f"{100 * part / whole:.2f}"] for name, part, whole in parts],
        ),
        f"A toss that was decided took at most {counts.most_impacts} impacts and {counts.longest:.0f} s.",
        table(["by MuJoCo (tosses)", *shown, "probability by chance"], rows),
        f"MuJoCo leaves {ended_as(by_mujoco, Outcome.UNDECIDED)} of {tosses(by_mujoco)} undecided.",
    )


def draw(counts: EndingCounts) -> Figure:
    """Draw the shares of the outcomes as bars."""
    names, shares = zip(*list(_rows(counts))[::-1], strict=True)
    picture = Figure(figsize=(9, 0.28 * len(names) + 1.2))
    axes = picture.subplots()
    left = np.zeros(len(names))
    for outcome, parts in zip(_SHOWN, np.transpose(shares), strict=True):
        style: Any = {"color": OUTCOMES[outcome], "edgecolor": GREY, "linewidth": 0.4, "label": str(outcome)}
        axes.barh(names, parts, left=left, **style)
        left += parts
    axes.grid(visible=False)
    axes.set(xlim=(0, 100), xlabel="share of the tosses [%]")
    axes.margins(y=0.01)
    picture.legend(loc="outside upper center", ncols=len(_SHOWN))
    return picture


REPRODUCTION = recorded(
    __name__, compute, record=EndingCounts, measures=measures, tables=tables, draw={"endings": draw}
)
