"""Figs 24-26: six tosses released 10 micrometres apart: paths, sequences, and how fast they part."""

import itertools
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cointoss import Toss, analytic, load
from cointoss.study import HEADS, INK, PALE, SKY, TAILS, VERMILION, Array, common_prefix, share
from cointoss_reproduction.frame.cells import Cells, Rows, column
from cointoss_reproduction.frame.selection import COLORS
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.both_engines import by_both
from cointoss_reproduction.setups.estimates import mean
from cointoss_reproduction.setups.fig24_readings import (
    APART,
    CLUSTER,
    MARK,
    NEARBY,
    PRINTED,
    READINGS,
    Reading,
    clusters_as_printed,
    marked,
    printed_heights,
    sequences,
    shared,
)

SEED = 24
SHOWN = "ideal, 2 mm, smooth"
"""The reading whose paths are drawn."""
SEARCHES = 4000
"""Number of searches through all readings at random heights: they show how good the best is by chance."""
DETAIL = (1.0, 1.5)
"""The times that Fig. 25 shows [s]."""
SEQUENCES, NUMBER = len(PRINTED), len(READINGS)
SAMPLES = 300
"""The number of samples of a path that is drawn."""


def toss(letter: str) -> Iterator[Rows]:
    """Toss one of the six coins by both engines.

    Yields:
        The faces by each engine and how many are alike, trusted and printed; each touch [s]; the path [m];
        log10 of the growth per impact of the difference from the next of the six.
    """
    tossed, mujoco = by_both(load(f"fig24{letter}")).values()
    yield {
        "sequence": tossed.sequence,
        "mujoco": mujoco.sequence,
        "agreed": common_prefix(tossed.sequence, mujoco.sequence),
        "trusted": tossed.trusted_impacts,
        "trusted_mujoco": mujoco.trusted_impacts,
        "printed": len(PRINTED[letter].replace(MARK, "")),
        "title": marked(tossed.impacts.time, tossed.impacts.face),
    }
    yield pd.DataFrame({"touch": tossed.impacts.time, "face": [*tossed.sequence]})
    t = np.linspace(0, tossed.end_time, SAMPLES)
    x, _, z = tossed.sample(t).position.T.round(6)
    yield pd.DataFrame({"time": t.round(5), "x": x, "z": z})
    following = dict(itertools.pairwise(PRINTED))
    if letter in following:
        yield pd.DataFrame({"growth": _growth(tossed, analytic.toss(load(f"fig24{following[letter]}")))})


def _growth(p: Toss, q: Toss) -> Array:
    """Return the growth per impact of the difference of two tosses' contact points, as log10, (n,)."""
    n = common_prefix(p.sequence, q.sequence)
    apart = np.linalg.norm(p.impacts.point[:n] - q.impacts.point[:n], axis=1)
    before, after = apart[:-1], apart[1:]
    small = (before > 0) & (before < 1e-3) & (after > 0)
    return np.log10(after[small] / before[small])


def read(reading: Reading, random: int = 16) -> Iterator[Rows]:
    """Yield how many printed faces a reading shares, at the printed heights and at random ones."""
    printed = sequences(reading.scenario, printed_heights())
    yield {"score": sum(shared(printed)), "clusters": int(clusters_as_printed(printed))}
    number = READINGS.index(reading)
    heights = np.random.default_rng(SEED).uniform(*NEARBY, (number + 1) * random)[-random:]
    by_chance = [sum(shared(sequences(reading.scenario, low + APART))) for low in heights]
    yield pd.DataFrame({"by_chance": by_chance})


def _found(cells: pd.DataFrame) -> dict[str, Any]:
    scores = dict(zip(*(column(cells, name, "score.notna()") for name in ("reading", "score")), strict=True))
    agreed, trusted, mujoco, printed = (
        column(cells, name) for name in ("agreed", "trusted", "trusted_mujoco", "printed")
    )
    chance = _by_chance(cells)
    best_by_chance = chance.max(axis=0)
    first = min(
        next((i for i, (a, b) in enumerate(zip(p, q, strict=False)) if a != b), 99)
        for p, q in itertools.combinations(column(cells, "sequence"), 2)
    )
    gaps = cells.groupby("letter")["touch"].diff()
    in_detail = gaps.notna() & cells["touch"].between(*DETAIL, inclusive="neither")
    growth = column(cells, "growth")
    clustering = column(cells, "reading", "clusters == 1")
    best = max(scores, key=scores.__getitem__)
    return {
        "first": first + 1,
        "fold": 10 ** np.median(growth),
        "growth": mean(growth, "impacts"),
        "different": len(set(column(cells, "sequence"))),
        "agreed": ", ".join(map(str, agreed)),
        "trusted": ", ".join(map(str, trusted)),
        "short_of": int(np.sum(agreed < np.minimum(trusted, mujoco))),
        "trusted_whole": int(np.sum(trusted >= printed)),
        "by_mujoco": ", ".join(f"({a}) {b}" for a, b in zip(PRINTED, column(cells, "mujoco"), strict=True)),
        "hidden": share(np.array(gaps[in_detail] < CLUSTER), "impacts"),
        "impacts": len(column(cells, "touch")),
        "faces": int(printed.sum()),
        "best": best,
        "scores": scores,
        "as_good": share(best_by_chance >= scores[best], "searches"),
        "best_by_chance": best_by_chance.mean(),
        "shown_by_chance": chance[list(scores).index(SHOWN)].mean(),
        "number_clustering": len(clustering),
        "clustering": "; ".join(clustering),
    }


def _by_chance(cells: pd.DataFrame) -> Array:
    """Return the scores of searches, each at one of a reading's random heights, (readings, searches)."""
    readings = cells.groupby("reading", sort=False)["by_chance"]
    scores = [one.dropna().to_numpy(dtype=int) for _, one in readings]
    rng = np.random.default_rng(SEED)
    rng.uniform(size=sum(map(len, scores)))  # gave the heights
    return np.array([rng.choice(one, SEARCHES) for one in scores])


def _draw(cells: pd.DataFrame) -> Figure:
    picture = Figure(figsize=(11, 8.5))
    halves = picture.add_gridspec(1, 2, width_ratios=(2.1, 1))
    paths, others = (picture.add_subfigure(half) for half in halves)
    grid = paths.subplots(len(PRINTED), 2, sharex="col", width_ratios=(1.4, 1))
    plan, score = others.subplots(2, 1)
    for row, color, (letter, of) in zip(grid, COLORS, cells.groupby("letter"), strict=False):
        for axes in row:
            axes.plot(of["time"], 100 * of["z"], color=color, linewidth=1)
            for face, shade in (("H", HEADS), ("T", TAILS)):
                at = of.loc[of["face"] == face, "touch"]
                axes.plot(at, 0 * at - 1.5, "|", color=shade, markersize=9, markeredgewidth=1.2)
        row[0].set(ylabel="z [cm]", xlim=(0, 2.4), ylim=(-4, None), xlabel="Fig. 24: time [s]")
        row[0].set_title(f"({letter}) {of['title'].dropna().item()}", fontsize=9)
        row[1].set(xlim=DETAIL, ylim=(-4, 16), xlabel="Fig. 25: time [s]")
        row[1].set_title(f"printed: {PRINTED[str(letter)]}", fontsize=9)
        plan.plot(1e3 * of["x"], 100 * of["z"], color=color, linewidth=1, label=f"({letter})")
    for axes in grid.flat:
        axes.label_outer()
    plan.set(title="Fig. 26", xlabel="x [mm]", ylabel="z [cm]")
    plan.legend()
    _draw_scores(score, cells)
    return picture


def _draw_scores(axes: Axes, cells: pd.DataFrame) -> None:
    """Draw how often the readings have each score, and how often at random heights, scaled to as many."""
    bins = (np.arange(0, 64, 4) - 0.5).tolist()
    kinds = [column(cells, "score", f"clusters == {begins}") for begins in (1, 0)]
    axes.hist(kinds, bins, stacked=True, color=[VERMILION, SKY], label=["begins as printed", "other"])
    chance = _by_chance(cells)
    weights = np.full(chance.size, len(chance) / chance.size)
    axes.hist(chance.ravel(), bins, weights=weights, histtype="step", color=INK, label="at random heights")
    best = np.quantile(chance.max(axis=0), (0.05, 0.95))
    axes.axvspan(*best, color=PALE, alpha=0.4, linewidth=0, label="best by chance, 90 %")
    axes.set(xlabel="leading faces shared with the printed 94", ylabel="readings of coin and floor")
    axes.legend()


REPRODUCTION = study(
    __name__,
    Cells(toss, {"letter": tuple(PRINTED)}),
    Cells(read, {"reading": {one.name: one for one in READINGS}}),
    found=_found,
    draw={"figure": _draw},
)
