"""Figs 24-26: six tosses released 10 micrometres apart: paths, sequences, and how fast they part."""

import itertools
from functools import partial
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, coin_mj
from cointoss.compare.metrics.sequences import common_prefix
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import (
    BLUE,
    GREEN,
    HEADS,
    INK,
    ORANGE,
    PALE,
    PURPLE,
    SKY,
    TAILS,
    VERMILION,
)
from cointoss.compare.reproduction.claim import Claim, Criterion
from cointoss.compare.reproduction.estimates import mean, share
from cointoss.compare.reproduction.result import Reproduction, Result
from cointoss.compare.reproduction.setups.fig24_readings import (
    CLUSTER,
    MARK,
    PRINTED,
    READINGS,
    clusters_as_printed,
    marked,
    printed_heights,
    sequences,
    shared,
)
from cointoss.models.reading import load
from cointoss.models.records import Array, Face, Toss

COLORS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)


NEARBY = (0.39, 0.41)
"""Random heights of the first of six tosses, which share what chance shares [m]."""
APART = 1e-5 * np.arange(6)
"""Heights of the six tosses above the first [m]."""
SEED = 24
SHOWN = "ideal, 2 mm, smooth"
"""The reading whose paths are drawn."""
SEARCHES = 4000
"""Searches through all readings at random heights, for how good the best is by chance."""
DETAIL = (1.0, 1.5)
"""Times of Fig. 25 [s]."""


def make(progress: Progress, random: int = 16) -> Result:
    """Toss the six coins by both engines, and all readings of them, also from `random` other heights."""
    by_analytic, mujoco = {}, {}
    whole = len(PRINTED) + len(READINGS)
    for done, letter in enumerate(PRINTED, start=1):
        scenario = load(f"fig24{letter}")
        by_analytic[letter], mujoco[letter] = analytic.toss(scenario), coin_mj.toss(scenario)
        progress(done, whole)
    rng = np.random.default_rng(SEED)
    scores, by_chance, clustering = {}, [], []
    for done, reading in enumerate(READINGS, start=len(PRINTED) + 1):
        found = sequences(reading.scenario, printed_heights())
        scores[reading.name] = sum(shared(found))
        if clusters_as_printed(found):
            clustering.append(reading.name)
        by_chance.append(
            [sum(shared(sequences(reading.scenario, low + APART))) for low in rng.uniform(*NEARBY, random)]
        )
        progress(done, whole)
    growth = _growth(by_analytic)
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
    lengths = {letter: len(text.replace(MARK, "")) for letter, text in PRINTED.items()}
    # A search takes one of a reading's random heights, and keeps the best of all readings.
    chance = np.array([rng.choice(one, SEARCHES) for one in by_chance])
    best = max(scores, key=scores.__getitem__)
    as_good = share(chance.max(axis=0) >= scores[best], "searches")
    times = np.concatenate([toss.impacts.time for toss in by_analytic.values()])
    shown = np.concatenate([np.diff(toss.impacts.time) for toss in by_analytic.values()])
    later = np.concatenate([toss.impacts.time[1:] for toss in by_analytic.values()])
    hidden = shown[(later > DETAIL[0]) & (later < DETAIL[1])] < CLUSTER
    claims = (
        Claim(
            claim="tosses 10 µm apart differ strongly after a few impacts (Figs 24, 26)",
            analytic=(
                f"six different paths; the first difference of a face at impact {first + 1}; a difference "
                f"grows {10 ** np.median(growth):.1f}-fold per impact in the median"
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
                Criterion(
                    "growth of a difference per impact, mean log10",
                    mean(growth, "impacts"),
                    ">",
                    0,
                    "it grows",
                ),
            ],
        ),
        Claim(
            claim="some collisions are not visible in the scale of Fig. 24, but in Fig. 25",
            analytic=f"{len(times)} impacts in the six tosses",
            criteria=[
                Criterion(
                    f"share that follow another within {CLUSTER:g} s, from {DETAIL[0]:g} to {DETAIL[1]:g} s",
                    share(hidden, "impacts"),
                    ">",
                    0.1,
                    "some",
                )
            ],
        ),
        Claim(
            claim="the sequences are those printed",
            analytic=(
                f"of {len(READINGS)} readings of coin and floor the best shares {scores[best]} of "
                f"{sum(lengths.values())} leading faces ({best}), and so good a best comes by chance, from "
                f"random heights near 0.4 m, in {as_good.value:.0%} of all searches, whose best share "
                f"{chance.max(axis=0).mean():.0f} on average; the paths shown share {scores[SHOWN]}, "
                f"and at random heights {chance[list(scores).index(SHOWN)].mean():.0f}"
            ),
            mujoco=", ".join(f"({a}) {toss.sequence}" for a, toss in mujoco.items()),
            missing="the paper names neither coin nor floor law of Fig. 24, nor its g",
            expected=None,
        ),
        Claim(
            claim="the impacts come in clusters as printed: one, then three (∘ separates clusters)",
            analytic=(
                f"in {len(clustering)} of {len(READINGS)} readings all six tosses begin H∘HHH∘: "
                + "; ".join(clustering)
            ),
            missing="the paper names neither coin nor floor law of Fig. 24, nor its g",
            expected=None,
        ),
        Claim(
            claim="each printed symbol could be computed in double precision",
            analytic=f"symbols that its own errors cannot have changed: {_listed(trusted)}",
            mujoco=f"{short_of} of 6 differ from the analytic engine where both are trusted",
            criteria=[
                Criterion(
                    "sequences trusted to their end",
                    sum(trusted[a] >= lengths[a] for a in PRINTED),
                    "=",
                    len(PRINTED),
                    "all that are printed",
                )
            ],
            expected=False,
        ),
    )
    data = _paths(by_analytic) | {
        "growth": growth,
        "scores": np.array(list(scores.values())),
        "clustering": np.array([name in clustering for name in scores]),
        "by chance": chance,
    }
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


def _paths(tosses: dict[str, Toss]) -> dict[str, NDArray[Any]]:
    data: dict[str, NDArray[Any]] = {}
    for letter, toss in tosses.items():
        t = np.linspace(0, toss.end_time, 3000)
        data |= {f"({letter}) time": t, f"({letter}) position": toss.sample(t).position}
        data |= {f"({letter}) impacts": toss.impacts.time, f"({letter}) faces": toss.impacts.face}
    return data


def _draw(data: dict[str, NDArray[Any]]) -> Figure:
    picture = Figure(figsize=(11, 8.5))
    halves = picture.add_gridspec(1, 2, width_ratios=(2.1, 1))
    paths, others = (picture.add_subfigure(half) for half in halves)
    grid = paths.subplots(len(PRINTED), 2, sharex="col", width_ratios=(1.4, 1))
    for row, letter, color in zip(grid, PRINTED, COLORS, strict=True):
        t, z = data[f"({letter}) time"], data[f"({letter}) position"][:, 2]
        times, faces = data[f"({letter}) impacts"], data[f"({letter}) faces"]
        for axes in row:
            axes.plot(t, 100 * z, color=color, linewidth=1)
            for face, shade in ((Face.HEADS, HEADS), (Face.TAILS, TAILS)):
                at = times[faces == face]
                axes.plot(at, 0 * at - 1.5, "|", color=shade, markersize=9, markeredgewidth=1.2)
            axes.set_ylim(-4, None)
        row[0].set(ylabel="z [cm]", xlim=(0, 2.4))
        row[0].set_title(f"({letter}) {marked(times, faces)}", fontsize=9)
        row[1].set(xlim=DETAIL, ylim=(-4, 16))
        row[1].set_title(f"printed: {PRINTED[letter]}", fontsize=9)
    for axes, name in zip(grid[-1], ("Fig. 24: time [s]", "Fig. 25: time [s]"), strict=True):
        axes.set_xlabel(name)
    plan, score = others.subplots(2, 1)
    for letter, color in zip(PRINTED, COLORS, strict=True):
        x, _, z = data[f"({letter}) position"].T
        plan.plot(1e3 * x, 100 * z, color=color, linewidth=1, label=f"({letter})")
    plan.set(title="Fig. 26", xlabel="x [mm]", ylabel="z [cm]")
    plan.legend()
    scores, clusters, chance = data["scores"], data["clustering"], data["by chance"]
    bins = (np.arange(0, 64, 4) - 0.5).tolist()
    score.hist(
        [scores[clusters], scores[~clusters]],
        bins,
        stacked=True,
        color=[VERMILION, SKY],
        label=["begins as printed", "other"],
    )
    weights = np.full(chance.size, len(scores) / chance.size)
    score.hist(chance.ravel(), bins, weights=weights, histtype="step", color=INK, label="at random heights")
    best = np.quantile(chance.max(axis=0), (0.05, 0.95))
    score.axvspan(*best, color=PALE, alpha=0.4, linewidth=0)
    score.annotate(
        "best by\nchance, 90 %",
        (best.mean(), 0.5),
        (0, 0),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        ha="center",
        fontsize=8,
    )
    score.set(xlabel="leading faces shared with the printed 94", ylabel="readings of coin and floor")
    score.legend()
    return picture


REPRODUCTION = Reproduction(
    paper="Figs 24-26",
    title="six tosses 10 µm apart: paths, sequences, how far to trust them",
    assumed=(
        "Coin, floor law and g are unsaid; the paths are those of the ideal coin of 2 mm on a smooth floor, "
        "g = 9.81 m/s². A reading is one of six coins (ideal, the paper's imperfect one, or a tenth of its "
        "offset; 2 mm or thin) on a floor of one of seven laws, with friction from 0.05 to 0.5. The paper "
        "does not explain its ∘: as some collisions occur in small time intervals, it is read as the flight "
        "between two clusters of impacts."
    ),
    seconds=120,
    make=make,
    draw={"figure": _draw},
    quick_seconds=15,
    quick=partial(make, random=2),
)
