"""Figs 24-26: six tosses released 10 micrometres apart: paths, sequences, and how fast they part."""

import itertools

import numpy as np
from matplotlib.figure import Figure

import analytic
import coin_mj
from compare.metrics.sequences import common_prefix
from compare.output.progress import Progress
from compare.output.style import BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION
from compare.reproduction.claim import Claim, Criterion
from compare.reproduction.runner import Reproduction, Result
from models.reading import load
from models.records import Array, Toss

PRINTED = {
    "a": "HHHHHHHHHHTTTHH",
    "b": "HHHHHHTTHHHTTT",
    "c": "HHHHHHHHHHTTTT",
    "d": "HHHHTTTTTTTHHHHH",
    "e": "HHHHHHHTTTHHHHTTT",
    "f": "HHHHHHHHTTTHHHHHTT",
}
"""The sequences of section 5.1, without the circles between groups."""
COLORS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)


def make(progress: Progress) -> Result:
    """Toss the six coins by both engines."""
    by_analytic, mujoco = {}, {}
    for done, letter in enumerate(PRINTED, start=1):
        scenario = load(f"fig24{letter}")
        by_analytic[letter], mujoco[letter] = analytic.toss(scenario), coin_mj.toss(scenario)
        progress(done, len(PRINTED))
    growth = _growth(by_analytic)
    shared = {letter: common_prefix(by_analytic[letter].sequence, PRINTED[letter]) for letter in PRINTED}
    agreed = {
        letter: common_prefix(by_analytic[letter].sequence, mujoco[letter].sequence) for letter in PRINTED
    }
    trusted = {letter: toss.trusted_impacts for letter, toss in by_analytic.items()}
    short_of = sum(
        agreed[letter] < min(trusted[letter], mujoco[letter].trusted_impacts) for letter in PRINTED
    )
    first = min(
        next((i for i, (a, b) in enumerate(zip(p.sequence, q.sequence, strict=False)) if a != b), 99)
        for p, q in itertools.combinations(by_analytic.values(), 2)
    )
    printed = sum(map(len, PRINTED.values()))
    claims = (
        Claim(
            claim="tosses 10 µm apart differ strongly after a few impacts (Figs 24, 26)",
            analytic=(
                f"six different paths; the first difference of a face at impact {first + 1}; a difference "
                f"grows {10 ** np.median(growth):.1f}-fold per impact"
            ),
            mujoco=f"the same faces as the analytic engine for {_listed(agreed)} impacts",
            criteria=[
                Criterion(
                    "different sequences",
                    len({toss.sequence for toss in by_analytic.values()}),
                    ">",
                    1,
                    "they began alike",
                ),
                Criterion("growth of a difference per impact, log10", np.median(growth), ">", 0, "it grows"),
            ],
        ),
        Claim(
            claim="the sequences are those printed",
            analytic=f"{sum(shared.values())} of {printed} leading symbols shared: "
            + ", ".join(f"({a}) {by_analytic[a].sequence}" for a in by_analytic),
            mujoco=", ".join(f"({a}) {toss.sequence}" for a, toss in mujoco.items()),
            criteria=[
                Criterion(
                    "leading symbols shared", sum(shared.values()), "=", printed, "all that are printed"
                )
            ],
            expected=False,
        ),
        Claim(
            claim="each printed symbol could be computed in double precision",
            analytic=f"symbols that its own errors cannot have changed: {_listed(trusted)}",
            mujoco=f"{short_of} of 6 differ from the analytic engine where both are trusted",
            criteria=[
                Criterion(
                    "sequences trusted to their end",
                    sum(trusted[a] >= len(PRINTED[a]) for a in PRINTED),
                    "=",
                    len(PRINTED),
                    "all that are printed",
                )
            ],
            expected=False,
        ),
    )
    data = _paths(by_analytic) | {"growth": growth}
    return Result(claims=claims, data=data)


def _listed(numbers: dict[str, int]) -> str:
    return ", ".join(map(str, numbers.values()))


def _growth(tosses: dict[str, Toss]) -> Array:
    """Return the growth per impact of the difference of neighbours' contact points, as log10, (n,)."""
    rates = []
    for p, q in itertools.pairwise(tosses.values()):
        n = common_prefix(p.sequence, q.sequence)
        apart = np.linalg.norm(p.impacts.point[:n] - q.impacts.point[:n], axis=1)
        close = (apart > 0) & (apart < 1e-3)
        rates += [
            np.log10(b / a) for a, b, near in zip(apart, apart[1:], close, strict=False) if near and b > 0
        ]
    return np.array(rates)


def _paths(tosses: dict[str, Toss]) -> dict[str, Array]:
    data = {}
    for letter, toss in tosses.items():
        t = np.linspace(0, toss.end_time, 3000)
        data |= {f"({letter}) time": t, f"({letter}) position": toss.sample(t).position}
        data |= {f"({letter}) impacts": toss.impacts.time}
    return data


def _draw(data: dict[str, Array]) -> Figure:
    picture = Figure(figsize=(9, 6.4))
    grid = picture.add_gridspec(3, 3)
    for number, letter in enumerate(PRINTED):
        axes = picture.add_subplot(grid[number // 2, number % 2])
        t, z = data[f"({letter}) time"], data[f"({letter}) position"][:, 2]
        axes.plot(t, 100 * z, color=COLORS[number], linewidth=1)
        axes.plot(data[f"({letter}) impacts"], 0 * data[f"({letter}) impacts"], "|", color=GREY)
        axes.set(title=f"({letter})", xlabel="time [s]", ylabel="z [cm]", xlim=(0, 2.2))
    plan = picture.add_subplot(grid[:, 2])
    for number, letter in enumerate(PRINTED):
        x, _, z = data[f"({letter}) position"].T
        plan.plot(100 * x, 100 * z, color=COLORS[number], linewidth=1, label=f"({letter})")
    plan.set(title="Fig. 26", xlabel="x [cm]", ylabel="z [cm]")
    plan.legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 24-26",
    title="six tosses 10 µm apart: paths, sequences, how far to trust them",
    assumed=(
        "Coin, floor law and g are unsaid; here the ideal coin of 2 mm on a smooth floor, g = 9.81 m/s². No "
        "reading of the paper gave its sequences, so they are no test of either engine."
    ),
    seconds=15,
    make=make,
    draw={"figure": _draw},
)
