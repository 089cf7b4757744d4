"""Is coin tossing predictable? The share of tosses left uncertain, by accuracy and restitution."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import log, log10, sqrt
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from scipy.constants import hbar

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import in_words, share_of
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, GREY, INK, ORANGE, PURPLE
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.precision.branching import Branches
from cointoss.compare.reproduction.precision.planar_state import HEIGHT, SPIN, TILT
from cointoss.compare.reproduction.setups.planar_maps import case
from cointoss.compare.reproduction.setups.study import study
from cointoss.compare.reproduction.setups.uncertain_shares import (
    ACCURACIES,
    LEAST,
    exponent,
    kept_run,
    of_groups,
)
from cointoss.compare.reproduction.threads import all_cores
from cointoss.models.records import Array

SEED = 2014
POPULATION = 400
"""Intervals of a run at each level but the first."""
FOLLOWED = 8
"""Boundaries of a run that are followed at each ε, on a smooth floor in vacuum."""
SMOOTH, AIR, ROUGH = "smooth, vacuum", "smooth, air", "rough, vacuum"
CHIS = {
    SMOOTH: (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
    AIR: (0.3, 0.6, 0.8),
    ROUGH: (0.3, 0.6),
}
"""By floor and medium. A rough floor adds energy above χ = √5/3, and a face is then never settled."""
RUNS = {SMOOTH: 3, AIR: 2, ROUGH: 4}
"""Independent runs of each case; in air a toss takes longest."""
FEW = 4
"""Above `NONE`, where nearly all tosses are uncertain and each takes long, so many times fewer intervals."""
NONE = 0.85
"""Restitution above which a toss is unpredictable."""
OTHERS = {"spin": SPIN, "tilt": TILT}
"""Other quantities of the release, in rad/s and rad, and their rows in a state."""
SHOWN = {0.0: GREY, 0.3: GREEN, 0.6: BLUE, 0.8: ORANGE, 0.9: PURPLE}
"""Restitutions whose curves are drawn, and their colours."""
FEWEST = 5
"""Groups of ancestors whose boundaries are counted."""
CHI = 0.6
"""At which these vary; the paper's."""
BOUNCY = 0.9
"""At this restitution a coin bounces long."""
WINDOWS = ((1e-3, 1e-6), (1e-6, 1e-9), (1e-9, 1e-12), (1e-12, 1e-18), (1e-18, 1e-24))
"""α is the slope between two accuracies [m]."""
CEILING = 0.75
"""f where three tosses have nothing to do with each other: the chance that fair coins do not all agree."""
HAND, FINE, QUANTUM, LAST = 1e-3, 1e-9, 1e-16, 1e-24
"""Of accuracies [m]: a hand's, an atom's size, about `quantum_width`, and the finest here."""
PREDICTABLE = 0.01
"""At most this share uncertain: 99 % of all tosses are predictable."""
NEARLY_SMOOTH, FRACTAL = 0.9, 0.8
"""α above the one is all but a smooth boundary's, below the other a fractal's."""


@dataclass(frozen=True)
class Case:
    """What was tossed, and what was found of each group of ancestors at each of `ACCURACIES`."""

    floor: str
    chi: float
    quantity: str
    """What varies: height, spin or tilt."""
    shares: list[list[float]]
    """f, by group."""
    whole: list[list[float]]
    """All weight, by group."""
    parted: list[list[float]]
    """Share of the tosses that part from one ε away, by group."""
    energy: list[list[float]]
    """That is left where they part, times this share [m g r], by group."""
    boundaries: list[list[int]]
    """Boundaries that were followed, by group."""
    flat: list[list[int]]
    """Those of them at which a coin lands flat, by group."""
    tosses: int
    undecided: int

    @property
    def name(self) -> str:
        """Floor, medium, restitution, and what varies."""
        return f"{self.floor}, χ = {self.chi:g}, {self.quantity}"


@dataclass(frozen=True)
class Predictability:
    """All cases."""

    cases: list[Case]
    quantum_width: float
    """sqrt(ħ t/m) of the coin, t the time of its first fall from the middle height [m]."""


def compute(
    progress: Progress,
    parts: Path,
    runs: Mapping[str, int] = RUNS,
    population: int = POPULATION,
    chis: Mapping[str, Sequence[float]] = CHIS,
    levels: int = len(ACCURACIES),
) -> Predictability:
    """Run the branching for every case; what an interrupted computation finished is not run again.

    Args:
        progress: called after each run.
        parts: folder of what is done.
        runs: independent runs of each case, by floor.
        population: intervals at each level.
        chis: restitutions by floor.
        levels: how many of `ACCURACIES`.
    """
    asked = [(floor, chi, "height") for floor in chis for chi in chis[floor]]
    asked += [(SMOOTH, CHI, quantity) for quantity in OTHERS]
    jobs = [(one, number) for number in range(max(runs.values())) for one in asked if number < runs[one[0]]]
    found: dict[tuple[str, float, str], list[Branches]] = {one: [] for one in asked}
    with all_cores() as pool:
        made = pool.map(lambda job: run_once(parts, *job, population=population, levels=levels), jobs)
        for done, ((one, _), run) in enumerate(zip(jobs, made, strict=True), start=1):
            found[one].append(run)
            progress(done, len(jobs))
    scenario = case(air=False)
    fall = sqrt(2 * scenario.release.position[2] / scenario.gravity)
    return Predictability(
        cases=[_case(*one, found[one]) for one in asked],
        quantum_width=sqrt(hbar * fall / scenario.coin.mass),
    )


def _case(floor: str, chi: float, quantity: str, runs: list[Branches]) -> Case:
    return Case(
        floor,
        chi,
        quantity,
        shares=np.vstack([run.shares for run in runs]).tolist(),
        whole=np.vstack([run.whole for run in runs]).tolist(),
        parted=np.vstack([run.parted for run in runs]).tolist(),
        energy=np.vstack([run.energy for run in runs]).tolist(),
        boundaries=np.vstack([run.boundaries for run in runs]).tolist(),
        flat=np.vstack([run.flat for run in runs]).tolist(),
        tosses=sum(run.tosses for run in runs),
        undecided=sum(run.undecided for run in runs),
    )


def run_once(
    parts: Path, asked: tuple[str, float, str], number: int, *, population: int, levels: int
) -> Branches:
    """Run the branching once for one case: releases uniform in height and spin, flat, at rest but for it."""
    floor, chi, quantity = asked
    scenario = case(air=floor == AIR, restitution=chi)
    if floor == ROUGH:
        scenario = scenario.replace("floor.contact", "perfectly_rough")
    row = OTHERS.get(quantity, HEIGHT)
    seed = SEED, number, list(CHIS).index(floor), round(100 * chi), row
    name = f"{floor}, {chi:g}, {quantity}"
    return kept_run(
        parts,
        name,
        scenario,
        seed,
        row=row,
        levels=levels,
        population=population // FEW if chi > NONE else population,
        followed=FOLLOWED if floor == SMOOTH and row == HEIGHT else 0,
    )


def share_at(one: Case, accuracy: float) -> Estimate:
    """Return f at one of `ACCURACIES`; the interval is one of its logarithm."""
    level = _level(accuracy)
    found = _of_groups(one, lambda f: log10(max(f[level], LEAST)))
    value, low, high = (10 ** min(x, log10(CEILING)) for x in (found.value, found.low, found.high))
    return Estimate(value, low, high, found.count, found.counted)


def slope_between(one: Case, first: float, last: float) -> Estimate:
    """Return α between two of `ACCURACIES`."""
    start, end = _level(first), _level(last)
    return _of_groups(one, lambda f: exponent(f, start, end - start))


def _of_groups(one: Case, statistic: Callable[[Array], float]) -> Estimate:
    """Return a statistic of f at each accuracy, with a jackknife's interval over the groups."""
    found = np.hstack([one.shares, one.whole])
    return of_groups(found, lambda means: statistic(np.divide(*np.split(means, 2))))


def _level(accuracy: float) -> int:
    return int(np.argmin(np.abs(np.log10(ACCURACIES) - log10(accuracy))))


def mean_shares(one: Case) -> Array:
    """Return f at each of `ACCURACIES`, from all groups."""
    return np.minimum(np.mean(one.shares, axis=0) / np.mean(one.whole, axis=0), CEILING)


def parted_shares(one: Case) -> Array:
    """Return the share of the tosses that part from one ε away, at each of `ACCURACIES`, from all groups."""
    return np.minimum(np.mean(one.parted, axis=0) / np.mean(one.whole, axis=0), 1.0)


@dataclass(frozen=True)
class Parting:
    """How -log10 of the accuracy at which a toss parts from its neighbour is distributed over tosses."""

    mean: float
    spread: float
    """Its standard deviation."""

    @property
    def smooth_from(self) -> float:
        """The accuracy from which on α would be nearly 1, were the distribution normal [m].

        The logarithm of a normal distribution's tail falls by (x - mean)/spread² over each unit of x.
        """
        return float(10 ** -(self.mean + NEARLY_SMOOTH * self.spread**2 * log(10)))


def parting(one: Case) -> Parting:
    """Return it from the shares that part; tosses that part above the first accuracy count as if at it."""
    x, survival = -np.log10(ACCURACIES[: len(one.shares[0])]), parted_shares(one)
    mean = np.trapezoid(survival, x)
    # The trapezoidal rule, corrected at its end for steps of a decade (Euler and Maclaurin).
    square = 2 * np.trapezoid((x - x[0]) * survival, x) + survival[0] / 6
    return Parting(
        mean=float(x[0] + mean),
        spread=sqrt(max(float(square - mean**2), 0.0)),
    )


def accuracy_for(one: Case, share: float) -> float:
    """Return the accuracy at which f falls to a share, interpolated; infinite or NaN beyond all [m]."""
    f = mean_shares(one)
    below = np.flatnonzero(f <= share)
    if len(below) == 0 or below[0] == 0:
        return float("nan" if len(below) == 0 else "inf")
    sides = [below[0], below[0] - 1]
    return float(10 ** np.interp(log10(share), np.log10(f[sides]), np.log10(ACCURACIES[sides])))


def smooth_from(one: Case) -> float:
    """Return the first accuracy of `WINDOWS` from which on α is nearly 1 in all; NaN if none is [m]."""
    slopes = [slope_between(one, *window).value for window in WINDOWS]
    rough = [i for i, slope in enumerate(slopes) if slope < NEARLY_SMOOTH]
    first = rough[-1] + 1 if rough else 0
    return WINDOWS[first][0] if first < len(WINDOWS) else float("nan")


def of(found: Predictability, floor: str, quantity: str = "height") -> list[Case]:
    """Return the cases of a floor and medium, by restitution."""
    return [one for one in found.cases if (one.floor, one.quantity) == (floor, quantity)]


def tables(found: Predictability) -> str:
    """Return the tables, in Markdown."""
    cases = found.cases
    windows = [window for window in WINDOWS if window[1] >= _last(found) * 0.9]
    shown = [x for x in (HAND, 1e-6, FINE, 1e-12, QUANTUM, 1e-20, LAST) if x >= _last(found) * 0.9]
    head = "floor, restitution, what varies"
    shares = [[one.name, *(in_words(share_at(one, x), ".2g") for x in shown)] for one in cases]
    slopes = [[one.name, *(in_words(slope_between(one, *w), ".2f") for w in windows)] for one in cases]
    accuracies = [
        [one.name, _power(accuracy_for(one, PREDICTABLE)), f"{one.tosses:,d}", str(one.undecided)]
        for one in cases
    ]
    return paragraphs(
        "The share f(ε) of tosses that ε leaves uncertain:",
        table([f"{head}: f at ε =", *(f"{x:.0e}" for x in shown)], shares),
        "The exponent α:",
        table([f"{head}: α over ε =", *(f"{x:.0e} to {y:.0e}" for x, y in windows)], slopes),
        "Accuracies:",
        table(
            f"{head} | ε for which {1 - PREDICTABLE:.0%} of the tosses are predictable | tosses | undecided",
            accuracies,
        ),
        "Where two tosses part: x = -log10 ε of the largest ε at which a toss does not part from one ε away; "
        f"were x normal over tosses, α would be above {NEARLY_SMOOTH} from the ε in the fourth column on:",
        table(
            f"{head} | mean x | standard deviation of x | α > {NEARLY_SMOOTH}, were it normal | found | "
            "f over the share that part, at the finest ε | energy left where they part [m g r]",
            [_parting_row(one) for one in cases if parted_shares(one)[-1] < PREDICTABLE],
        ),
        "Share of all boundaries within ε at which a coin lands flat, not one that stands upright:",
        table(
            ["restitution: at ε =", *(f"{x:.0e}" for x in shown)],
            [_flat_row(one, shown) for one in of(found, SMOOTH)],
        ),
        f"The coin's quantum width √(ħ t/m) is {found.quantum_width:.1e} m.",
    )


def _parting_row(one: Case) -> list[str]:
    distribution, last = parting(one), len(one.shares[0]) - 1
    energy = np.sum(one.energy, axis=0)[last] / np.sum(one.parted, axis=0)[last]
    return [
        one.name,
        f"{distribution.mean:.1f}",
        f"{distribution.spread:.1f}",
        f"{distribution.smooth_from:.0e}",
        _power(smooth_from(one)),
        f"{mean_shares(one)[last] / parted_shares(one)[last]:.2f}",
        f"{energy:.2f}",
    ]


def _flat_row(one: Case, accuracies: Sequence[float]) -> list[str]:
    shares = [flat_share(one, x) for x in accuracies]
    return [f"χ = {one.chi:g}", *(in_words(x, ".0%") if x else "-" for x in shares)]


def flat_share(one: Case, accuracy: float) -> Estimate | None:
    """Return the part of the boundaries at an accuracy, and at its neighbours, at which a coin lands flat.

    None where too few were resolved.
    """
    near = slice(max(_level(accuracy) - 1, 0), _level(accuracy) + 2)

    def part(means: Array) -> float:
        landing, of_all = np.split(means, 2)
        return float(landing[near].sum() / of_all[near].sum())

    resolved = np.array(one.boundaries)[:, near].sum(axis=1)
    if np.sum(resolved > 0) < FEWEST:
        return None
    flat, boundaries = np.sum(one.flat, axis=0)[near].sum(), np.sum(one.boundaries, axis=0)[near].sum()
    if flat in (0, boundaries):
        return share_of(int(flat), int(boundaries), "boundaries")
    found = of_groups(np.hstack([one.flat, one.boundaries]), part)
    return Estimate(found.value, max(found.low, 0.0), min(found.high, 1.0), found.count, found.counted)


def _last(found: Predictability) -> float:
    return float(ACCURACIES[len(found.cases[0].shares[0]) - 1])


def _power(accuracy: float) -> str:
    if np.isnan(accuracy):
        return f"below {ACCURACIES[-1]:.0e}"
    return f"{accuracy:.0e}" if accuracy < np.inf else f"above {ACCURACIES[0]:.0e}"


def draw(found: Predictability) -> Figure:
    """Draw f over accuracy and restitution, and its slope."""
    cases = of(found, SMOOTH)
    levels = len(cases[0].shares[0])
    x = np.log10(ACCURACIES[:levels])
    f = np.array([mean_shares(one) for one in cases])
    chi = np.array([one.chi for one in cases])
    picture = Figure(figsize=(11, 5.6))
    grid = picture.add_gridspec(2, 5)
    map_axes, share_axes, slope_axes = (
        picture.add_subplot(part) for part in (grid[:, :3], grid[0, 3:], grid[1, 3:])
    )
    bands = [-30, -6, -5, -4, -3, -2, -1, log10(0.5), 0.2]
    logs = np.log10(np.maximum(f, 1e-29))
    shade = map_axes.contourf(x, chi, logs, levels=bands, cmap="YlOrBr", norm=BoundaryNorm(bands, 256))
    lines = map_axes.contour(
        x, chi, logs, levels=[log10(PREDICTABLE)], colors=INK, linewidths=2, linestyles="solid"
    )
    map_axes.clabel(lines, fmt={log10(PREDICTABLE): f"{1 - PREDICTABLE:.0%} predictable"}, fontsize=11)
    names = {HAND: "a hand", 1e-6: "1 µm", FINE: "1 nm", found.quantum_width: "quantum width √(ħt/m)"}
    for accuracy, name in names.items():
        map_axes.axvline(log10(accuracy), color=GREY, linewidth=0.8)
        at: Any = {"xycoords": ("data", "axes fraction"), "xytext": (4, 4), "textcoords": "offset points"}
        box = {"facecolor": "white", "alpha": 0.7, "edgecolor": "none", "pad": 1}
        map_axes.annotate(name, (log10(accuracy), 0), rotation=90, va="bottom", color=INK, bbox=box, **at)
    map_axes.set_title("share of tosses that stay uncertain (smooth floor, vacuum)")
    map_axes.set(xlabel="accuracy of the release ε [m]", ylabel="restitution χ", xlim=(x[0], x[-1]))
    map_axes.set_xticks(x[::3], [f"$10^{{{value:.0f}}}$" for value in x[::3]])
    map_axes.grid(visible=False)
    bar = picture.colorbar(shade, ax=map_axes, location="bottom", aspect=40, pad=0.02)
    bar.set_ticks(bands[1:-1], labels=["1e-6", "1e-5", "1e-4", "0.1 %", "1 %", "10 %", "50 %"])
    shown = [one for one in found.cases if one.quantity == "height" and one.chi in SHOWN]
    for one in shown:
        color, style = SHOWN[one.chi], {SMOOTH: "-", AIR: "--", ROUGH: ":"}[one.floor]
        label = f"χ = {one.chi:g}" if one.floor == SMOOTH else None
        mean = mean_shares(one)
        share_axes.loglog(ACCURACIES[:levels], mean, style, color=color, label=label)
        middles, slopes = _smoothed_slopes(mean)
        slope_axes.semilogx(middles, slopes, style, color=color, label=label)
    share_axes.set(title="f(ε)", ylim=(1e-16, 2))
    slope_axes.set(title="its slope α", ylim=(0, 1.15))
    slope_axes.set(xlabel="ε [m]; smooth —, air – –, rough ···")
    slope_axes.axhline(1, color=GREY, linewidth=0.8)
    share_axes.legend(fontsize=8)
    for axes in (share_axes, slope_axes):
        axes.invert_xaxis()
    return picture


def _smoothed_slopes(f: Array) -> tuple[Array, Array]:
    """Return the slope of f over three decades, or over six below 1e-12 m, by the middle accuracy."""
    spans = [(k, k + (3 if k < 9 else 6)) for k in range(len(f) - 3) if k + (3 if k < 9 else 6) < len(f)]
    middles = [sqrt(ACCURACIES[i] * ACCURACIES[j]) for i, j in spans]
    return np.array(middles), np.array([log10(f[i] / f[j]) / (j - i) for i, j in spans])


def measures(found: Predictability) -> dict[str, Any]:
    """Return what the claims name."""
    by_key = {(one.floor, one.chi): one for one in found.cases if one.quantity == "height"}
    smooth, bouncy = by_key[SMOOTH, CHI], by_key.get((SMOOTH, BOUNCY))
    fits = [window for window in WINDOWS if window[1] >= _last(found) * 0.9]
    last, end = fits[-1]
    return {
        "end": end,
        "last": last,
        "hand_end": WINDOWS[0][1],
        "soft": slope_between(by_key[SMOOTH, 0.0], *WINDOWS[0]),
        "floors": {
            floor: {
                "alpha": slope_between(by_key[floor, CHI], last, end),
                "share": share_at(by_key[floor, CHI], QUANTUM),
                "headline": _headline(smooth, last, end) if floor == SMOOTH else "",
            }
            for floor in (SMOOTH, AIR, ROUGH)
        },
        "alphas": {
            f"α from {first:.0e} to {second:.0e} m": slope_between(smooth, first, second)
            for first, second in (WINDOWS[1], (last, end))
        },
        "bouncy": {SMOOTH: {"share": share_at(bouncy, QUANTUM)}} if bouncy else {},
    }


def _headline(one: Case, last: float, end: float) -> str:
    """Return what was found of the dispute, in a few sentences."""
    f, fine = mean_shares(one), accuracy_for(one, PREDICTABLE)
    return (
        f"They are smooth, but nobody can see it. At χ = {one.chi:g} the share of uncertain tosses falls as "
        f"ε^{slope_between(one, *WINDOWS[1]).value:.2f} at 1 µm, and down to {end:.0e} m still as "
        f"ε^{slope_between(one, last, end).value:.2f}; smooth boundaries have ε^1. Released within 1 mm, "
        f"{f[_level(HAND)]:.0%} of the tosses are uncertain; within 1 nm, {f[_level(FINE)]:.1%}. For 99% of "
        f"them to be predictable the release must be exact to {fine:.0e} m. On a floor without restitution "
        "the boundaries are smooth at every accuracy."
    )


REPRODUCTION = study(
    __name__,
    compute,
    record=Predictability,
    measures=measures,
    tables=tables,
    draw={"predictability": draw},
)
