"""What the study of predictability shows: its tables and its picture."""

from math import log10, sqrt
from typing import Any

import numpy as np
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure

from cointoss.study import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, Array, in_words, paragraphs, table
from cointoss_reproduction.setups.uncertain_shares import ACCURACIES
from cointoss_reproduction.studies.predictability.record import (
    AIR,
    FINE,
    HAND,
    NEARLY_SMOOTH,
    PREDICTABLE,
    ROUGH,
    SMOOTH,
    WINDOWS,
    Case,
    Predictability,
    accuracy_for,
    parting,
    smooth_from,
)

COLORS = {0.0: GREY, 0.3: GREEN, 0.6: BLUE, 0.8: ORANGE, 0.9: PURPLE}
"""Restitutions whose curves are drawn."""


def tables(found: Predictability) -> str:
    """Return the tables, in Markdown."""
    cases = found.cases
    shown = list(cases[0].known)
    windows = WINDOWS[: len(cases[0].slopes)]
    head = "floor, restitution, what varies"
    shares = [[one.name, *(in_words(one.known[x], ".2g") for x in shown)] for one in cases]
    slopes = [[one.name, *(in_words(slope, ".2f") for slope in one.slopes)] for one in cases]
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
            [_parting_row(one) for one in cases if one.parted[-1] < PREDICTABLE],
        ),
        "Share of all boundaries within ε at which a coin lands flat, not one that stands upright:",
        table(
            ["restitution: at ε =", *(f"{x:.0e}" for x in shown)],
            [
                [f"χ = {one.chi:g}", *(in_words(one.flat[x], ".0%") if x in one.flat else "-" for x in shown)]
                for one in found.of(SMOOTH)
            ],
        ),
        f"The coin's quantum width √(ħ t/m) is {found.quantum_width:.1e} m.",
    )


def _parting_row(one: Case) -> list[str]:
    distribution = parting(one)
    return [
        one.name,
        f"{distribution.mean:.1f}",
        f"{distribution.spread:.1f}",
        f"{distribution.smooth_from:.0e}",
        _power(smooth_from(one)),
        f"{one.shares[-1] / one.parted[-1]:.2f}",
        f"{one.energy:.2f}",
    ]


def _power(accuracy: float) -> str:
    if np.isnan(accuracy):
        return f"below {ACCURACIES[-1]:.0e}"
    return f"{accuracy:.0e}" if accuracy < np.inf else f"above {ACCURACIES[0]:.0e}"


def draw(found: Predictability) -> Figure:
    """Draw f over accuracy and restitution, and its slope."""
    cases = found.of(SMOOTH)
    f = np.array([one.shares for one in cases])
    accuracies = ACCURACIES[: f.shape[1]]
    x = np.log10(accuracies)
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
    for one in [one for one in found.cases if one.quantity == "height" and one.chi in COLORS]:
        color, style = COLORS[one.chi], {SMOOTH: "-", AIR: "--", ROUGH: ":"}[one.floor]
        label = f"χ = {one.chi:g}" if one.floor == SMOOTH else None
        mean = np.array(one.shares)
        share_axes.loglog(accuracies, mean, style, color=color, label=label)
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
