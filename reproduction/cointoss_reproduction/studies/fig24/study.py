"""Figs 24-26: six tosses released 10 micrometres apart: paths, sequences, and how fast they part."""

import itertools

import numpy as np
from matplotlib.figure import Figure

from cointoss import Face, Toss, analytic, coin_mj, load
from cointoss.study import (
    BLUE,
    GREEN,
    HEADS,
    ORANGE,
    PALE,
    PURPLE,
    SKY,
    TAILS,
    VERMILION,
    Array,
    Progress,
    common_prefix,
    mean,
    share,
)
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.fig24_readings import (
    APART,
    CLUSTER,
    MARK,
    NEARBY,
    PRINTED,
    READINGS,
    clusters_as_printed,
    marked,
    printed_heights,
    sequences,
    shared,
)
from cointoss_reproduction.studies.fig24.scores import draw_scores

COLORS = (BLUE, VERMILION, GREEN, PURPLE, ORANGE, SKY)


SEED = 24
SHOWN = "ideal, 2 mm, smooth"
"""The reading whose paths are drawn."""
SEARCHES = 4000
"""Searches through all readings at random heights, for how good the best is by chance."""
DETAIL = (1.0, 1.5)
"""Times of Fig. 25 [s]."""


def make(progress: Progress, random: int = 16) -> Findings:
    """Toss the six coins by both engines, and all readings of them, also from `random` other heights."""
    found = Findings()
    by_analytic: dict[str, Toss] = {}
    mujoco: dict[str, Toss] = {}
    whole = len(PRINTED) + len(READINGS)
    for done, letter in enumerate(PRINTED, start=1):
        scenario = load(f"fig24{letter}")
        by_analytic[letter], mujoco[letter] = analytic.toss(scenario), coin_mj.toss(scenario)
        progress(done, whole)
    rng = np.random.default_rng(SEED)
    scores, by_chance, clustering = {}, [], []
    for done, reading in enumerate(READINGS, start=len(PRINTED) + 1):
        printed = sequences(reading.scenario, printed_heights())
        scores[reading.name] = sum(shared(printed))
        if clusters_as_printed(printed):
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
    found.short_of = sum(
        agreed[letter] < min(trusted[letter], mujoco[letter].trusted_impacts) for letter in PRINTED
    )
    first = min(
        next((i for i, (a, b) in enumerate(zip(p.sequence, q.sequence, strict=False)) if a != b), 99)
        for p, q in itertools.combinations(by_analytic.values(), 2)
    )
    lengths = {letter: len(text.replace(MARK, "")) for letter, text in PRINTED.items()}
    # A search takes one of a reading's random heights, and keeps the best of all readings.
    chance = np.array([rng.choice(one, SEARCHES) for one in by_chance])
    found.best = max(scores, key=scores.__getitem__)
    found.as_good = share(chance.max(axis=0) >= scores[found.best], "searches")
    times = np.concatenate([toss.impacts.time for toss in by_analytic.values()])
    shown = np.concatenate([np.diff(toss.impacts.time) for toss in by_analytic.values()])
    later = np.concatenate([toss.impacts.time[1:] for toss in by_analytic.values()])
    hidden = shown[(later > DETAIL[0]) & (later < DETAIL[1])] < CLUSTER
    found.first, found.fold = first + 1, 10 ** np.median(growth)
    found.agreed, found.trusted = _listed(agreed), _listed(trusted)
    found.different = len({toss.sequence for toss in by_analytic.values()})
    found.growth, found.hidden = mean(growth, "impacts"), share(hidden, "impacts")
    found.impacts, found.readings, found.printed = len(times), len(READINGS), len(PRINTED)
    found.scores, found.faces = scores, sum(lengths.values())
    found.best_by_chance = chance.max(axis=0).mean()
    found.shown_by_chance = chance[list(scores).index(SHOWN)].mean()
    found.by_mujoco = ", ".join(f"({a}) {toss.sequence}" for a, toss in mujoco.items())
    found.number_clustering, found.clustering = len(clustering), "; ".join(clustering)
    found.trusted_whole = sum(trusted[a] >= lengths[a] for a in PRINTED)
    found.data = _paths(by_analytic) | {
        "growth": growth,
        "scores": np.array(list(scores.values())),
        "clustering": np.array([name in clustering for name in scores]),
        "by chance": chance,
    }
    return found


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


def _paths(tosses: dict[str, Toss]) -> Data:
    data: Data = {}
    for letter, toss in tosses.items():
        t = np.linspace(0, toss.end_time, 3000)
        data |= {f"({letter}) time": t, f"({letter}) position": toss.sample(t).position}
        data |= {f"({letter}) impacts": toss.impacts.time, f"({letter}) faces": toss.impacts.face}
    return data


def _draw(data: Data) -> Figure:
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
    chance, names = data["by chance"], ("begins as printed", "other")
    bins = (np.arange(0, 64, 4) - 0.5).tolist()
    draw_scores(score, data["scores"], data["clustering"], names, chance, bins)
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


REPRODUCTION = declared(__name__, make, draw={"figure": _draw})
