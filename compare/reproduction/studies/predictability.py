"""Is coin tossing predictable? The share of tosses left uncertain, by accuracy and restitution."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import log10, sqrt
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from scipy.constants import hbar

from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import in_words
from cointoss.compare.output.progress import Progress
from cointoss.compare.output.style import BLUE, GREEN, GREY, INK, ORANGE, PURPLE
from cointoss.compare.output.tables import paragraphs, table
from cointoss.compare.reproduction.precision.planar_state import HEIGHT, SPIN, TILT
from cointoss.compare.reproduction.precision.splitting import Replica
from cointoss.compare.reproduction.setups.planar_maps import case
from cointoss.compare.reproduction.setups.study import study
from cointoss.compare.reproduction.setups.uncertain_shares import (
    ACCURACIES,
    LEAST,
    kept_run,
    of_runs,
    slope,
)
from cointoss.compare.reproduction.threads import all_cores
from cointoss.models.records import Array

SEED = 2014
POPULATION = 60
"""Intervals at each level."""
SMOOTH, AIR, ROUGH = "smooth, vacuum", "smooth, air", "rough, vacuum"
CHIS = {
    SMOOTH: (0.0, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
    AIR: (0.3, 0.6, 0.8),
    ROUGH: (0.3, 0.6),
}
"""By floor and medium. A rough floor adds energy above χ = √5/3, and a face is then never settled."""
RUNS = {SMOOTH: 16, AIR: 8, ROUGH: 40}
"""Independent runs of the splitting for each case; in air a toss takes longest."""
OTHERS = {"spin": SPIN, "tilt": TILT}
"""Other quantities of the release, in rad/s and rad, and their rows in a state."""
SHOWN = {0.0: GREY, 0.3: GREEN, 0.6: BLUE, 0.8: ORANGE, 0.9: PURPLE}
"""Restitutions whose curves are drawn, and their colours."""
CHI = 0.6
"""At which these vary; the paper's."""
BOUNCY = 0.9
"""At this restitution a coin bounces long."""
WINDOW = 3
"""α is the slope over so many decades."""
HAND, FINE, QUANTUM, LAST = 1e-3, 1e-9, 1e-16, 1e-24
"""Of accuracies [m]: a hand's, an atom's size, about `quantum_width`, and the finest here."""
PREDICTABLE = 0.01
"""At most this share uncertain: 99 % of all tosses are predictable."""
NEARLY_SMOOTH, FRACTAL = 0.9, 0.8
"""α above the one is all but a smooth boundary's, below the other a fractal's."""


@dataclass(frozen=True)
class Case:
    """What was tossed, and the shares that each run of the splitting found."""

    floor: str
    chi: float
    quantity: str
    """What varies: height, spin or tilt."""
    shares: list[list[float]]
    """f at each of `ACCURACIES`, by run."""
    hidden: float
    """Largest part of any f that came of intervals whose ends were alike."""
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
    """Run the splitting for every case; what an interrupted computation finished is not run again.

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
    found: dict[tuple[str, float, str], list[Replica]] = {one: [] for one in asked}
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


def _case(floor: str, chi: float, quantity: str, runs: list[Replica]) -> Case:
    return Case(
        floor,
        chi,
        quantity,
        shares=[run.shares.tolist() for run in runs],
        hidden=max(run.largest_hidden for run in runs),
        tosses=sum(run.tosses for run in runs),
        undecided=sum(run.undecided for run in runs),
    )


def run_once(
    parts: Path, asked: tuple[str, float, str], number: int, *, population: int, levels: int
) -> Replica:
    """Run the splitting once for one case: releases uniform in height and spin, flat, at rest but for it."""
    floor, chi, quantity = asked
    scenario = case(air=floor == AIR, restitution=chi)
    if floor == ROUGH:
        scenario = scenario.replace("floor.contact", "perfectly_rough")
    row = OTHERS.get(quantity, HEIGHT)
    seed = SEED, number, list(CHIS).index(floor), round(100 * chi), row
    name = f"{floor}, {chi:g}, {quantity}"
    return kept_run(parts, name, scenario, seed, row=row, levels=levels, population=population)


def share_at(one: Case, accuracy: float) -> Estimate:
    """Return f at one of `ACCURACIES`; the interval is one of its logarithm, and f is at most 1."""
    level = _level(accuracy)
    found = of_runs(np.array(one.shares), lambda f: log10(max(f[level], LEAST)))
    value, low, high = (min(10**x, 1.0) for x in (found.value, found.low, found.high))
    return Estimate(value, low, high, found.count, found.counted)


def slope_from(one: Case, accuracy: float) -> Estimate:
    """Return α over `WINDOW` decades from one of `ACCURACIES` on."""
    return slope(np.array(one.shares), _level(accuracy), WINDOW)


def _level(accuracy: float) -> int:
    return int(np.argmin(np.abs(np.log10(ACCURACIES) - log10(accuracy))))


def mean_shares(one: Case) -> Array:
    """Return f at each of `ACCURACIES`, the mean of the runs."""
    return np.array(one.shares).mean(axis=0)


def accuracy_for(one: Case, share: float) -> float:
    """Return the accuracy at which f falls to a share, interpolated; infinite or NaN beyond all [m]."""
    f = mean_shares(one)
    below = np.flatnonzero(f <= share)
    if len(below) == 0 or below[0] == 0:
        return float("nan" if len(below) == 0 else "inf")
    sides = [below[0], below[0] - 1]
    return float(10 ** np.interp(log10(share), np.log10(f[sides]), np.log10(ACCURACIES[sides])))


def smooth_from(one: Case) -> float:
    """Return the accuracy from which on α over every `WINDOW` decades is nearly 1; NaN if none is [m]."""
    y = np.log10(mean_shares(one))
    slopes = (y[:-WINDOW] - y[WINDOW:]) / WINDOW
    rough = np.flatnonzero(slopes < NEARLY_SMOOTH)
    first = int(rough[-1]) + 1 if len(rough) else 0
    return float(ACCURACIES[first]) if first < len(slopes) else float("nan")


def of(found: Predictability, floor: str, quantity: str = "height") -> list[Case]:
    """Return the cases of a floor and medium, by restitution."""
    return [one for one in found.cases if (one.floor, one.quantity) == (floor, quantity)]


def tables(found: Predictability) -> str:
    """Return the tables, in Markdown."""
    cases = found.cases
    starts = ACCURACIES[: len(cases[0].shares[0]) - WINDOW : WINDOW]
    shown = [x for x in (HAND, 1e-6, FINE, 1e-12, QUANTUM, 1e-20, LAST) if x >= _last(found) * 0.9]
    head = "floor, restitution, what varies"
    shares = [[one.name, *(in_words(share_at(one, x), ".2g") for x in shown)] for one in cases]
    slopes = [[one.name, *(in_words(slope_from(one, x), ".2g") for x in starts)] for one in cases]
    accuracies = [
        [
            one.name,
            _power(accuracy_for(one, PREDICTABLE)),
            _power(smooth_from(one)),
            f"{one.hidden:.2f}",
            f"{one.tosses:,d}",
            str(one.undecided),
        ]
        for one in cases
    ]
    return paragraphs(
        "The share f(ε) of tosses that ε leaves uncertain:",
        table([f"{head}: f at ε =", *(f"{x:.0e}" for x in shown)], shares),
        f"The exponent α over {WINDOW} decades:",
        table([f"{head}: α from ε =", *(f"{x:.0e}" for x in starts)], slopes),
        "Accuracies:",
        table(
            f"{head} | ε for which {1 - PREDICTABLE:.0%} of the tosses are predictable | ε from which on "
            f"α > {NEARLY_SMOOTH} | largest hidden part of f | tosses | undecided",
            accuracies,
        ),
        f"The coin's quantum width √(ħ t/m) is {found.quantum_width:.1e} m.",
    )


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
        slopes = np.log10(mean[:-WINDOW] / mean[WINDOW:]) / WINDOW
        slope_axes.semilogx(ACCURACIES[: levels - WINDOW], slopes, style, color=color, label=label)
    share_axes.set(title="f(ε)", ylim=(1e-16, 2))
    slope_axes.set(title=f"its slope α over {WINDOW} decades", ylim=(0, 1.15))
    slope_axes.set(xlabel="ε [m]; smooth —, air – –, rough ···")
    slope_axes.axhline(1, color=GREY, linewidth=0.8)
    share_axes.legend(fontsize=8)
    for axes in (share_axes, slope_axes):
        axes.invert_xaxis()
    return picture


def measures(found: Predictability) -> dict[str, Any]:
    """Return what the claims name."""
    by_key = {(one.floor, one.chi): one for one in found.cases if one.quantity == "height"}
    last, smooth = _last(found) * 10**WINDOW, by_key[SMOOTH, CHI]
    bouncy = by_key.get((SMOOTH, BOUNCY))
    return {
        "end": _last(found),
        "last": last,
        "hand_end": HAND / 10**WINDOW,
        "soft": slope_from(by_key[SMOOTH, 0.0], HAND),
        "floors": {
            floor: {
                "alpha": slope_from(by_key[floor, CHI], last),
                "share": share_at(by_key[floor, CHI], QUANTUM),
                "headline": _headline(found, smooth) if floor == SMOOTH else "",
            }
            for floor in (SMOOTH, AIR, ROUGH)
        },
        "alphas": {
            f"α from {first:.0e} to {first / 10**WINDOW:.0e} m": slope_from(smooth, first)
            for first in (1e-6, last)
        },
        "bouncy": {SMOOTH: {"share": share_at(bouncy, QUANTUM)}} if bouncy else {},
    }


def _headline(found: Predictability, one: Case) -> str:
    """Return what was found of the dispute, in a few sentences."""
    f, fine = mean_shares(one), accuracy_for(one, PREDICTABLE)
    end = _last(found)
    return (
        f"They are smooth, but nobody can see it. At χ = {one.chi:g} the share of uncertain tosses falls as "
        f"ε^{slope_from(one, 1e-6).value:.2f} at 1 µm, and at {end:.0e} m still as "
        f"ε^{slope_from(one, end * 10**WINDOW).value:.2f}; smooth boundaries have ε^1. Released within 1 mm, "
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
