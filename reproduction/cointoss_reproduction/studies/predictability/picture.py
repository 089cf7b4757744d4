"""What the study of predictability shows: f over accuracy and restitution, and its slope."""

from itertools import product
from math import log10, sqrt
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.colors import BoundaryNorm
from matplotlib.figure import Figure
from scipy.constants import hbar

from cointoss.study import BLUE, GREEN, GREY, INK, ORANGE, PURPLE, Array
from cointoss_reproduction.setups.planar_maps import case

COLORS = {0.0: GREY, 0.3: GREEN, 0.6: BLUE, 0.8: ORANGE, 0.9: PURPLE}
"""Restitutions whose curves are drawn."""
STYLES = {"smooth, vacuum": "-", "smooth, air": "--", "rough, vacuum": ":"}


def quantum_width() -> float:
    """Return sqrt(ħ t/m) of the coin, t the time of its first fall from the middle height [m]."""
    scenario = case(air=False)
    fall = sqrt(2 * scenario.release.position[2] / scenario.gravity)
    return sqrt(hbar * fall / scenario.coin.mass)


def draw(cells: pd.DataFrame) -> Figure:
    """Draw f over accuracy and restitution, and its slope."""
    along_height = cells.query("quantity == 'height'")
    smooth = along_height.query("floor == 'smooth, vacuum'")
    f = smooth.pivot_table("share", index="chi", columns="accuracy").iloc[:, ::-1]
    accuracies, chi = f.columns.to_numpy(dtype=float), f.index.to_numpy(dtype=float)
    x, certain = np.log10(accuracies), log10(0.01)
    picture = Figure(figsize=(11, 5.6))
    grid = picture.add_gridspec(2, 5)
    map_axes, share_axes, slope_axes = (
        picture.add_subplot(part) for part in (grid[:, :3], grid[0, 3:], grid[1, 3:])
    )
    bands = [-30, -6, -5, -4, -3, -2, -1, log10(0.5), 0.2]
    logs = np.log10(np.maximum(f, 1e-29))
    shade = map_axes.contourf(x, chi, logs, levels=bands, cmap="YlOrBr", norm=BoundaryNorm(bands, 256))
    lines = map_axes.contour(x, chi, logs, levels=[certain], colors=INK, linewidths=2, linestyles="solid")
    map_axes.clabel(lines, fmt={certain: "99% predictable"}, fontsize=11)
    names = {1e-3: "a hand", 1e-6: "1 µm", 1e-9: "1 nm", quantum_width(): "quantum width √(ħt/m)"}
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
    for (floor, style), (chi, color) in product(STYLES.items(), COLORS.items()):
        case_of = along_height.query(f"floor == '{floor}' and chi == {chi}")
        if len(case_of) == 0:
            continue
        label = f"χ = {chi:g}" if style == "-" else None
        mean = case_of["share"].to_numpy(dtype=float)
        share_axes.loglog(accuracies, mean, style, color=color, label=label)
        middles, slopes = _smoothed_slopes(accuracies, mean)
        slope_axes.semilogx(middles, slopes, style, color=color, label=label)
    share_axes.set(title="f(ε)", ylim=(1e-16, 2))
    slope_axes.set(title="its slope α", ylim=(0, 1.15))
    slope_axes.set(xlabel="ε [m]; smooth —, air – –, rough ···")
    slope_axes.axhline(1, color=GREY, linewidth=0.8)
    share_axes.legend(fontsize=8)
    for axes in (share_axes, slope_axes):
        axes.invert_xaxis()
    return picture


def _smoothed_slopes(accuracies: Array, f: Array) -> tuple[Array, Array]:
    """Return the slope of f over three decades, or over six below 1e-12 m, by the middle accuracy."""
    spans = [(k, k + (3 if k < 9 else 6)) for k in range(len(f) - 3) if k + (3 if k < 9 else 6) < len(f)]
    middles = [sqrt(accuracies[i] * accuracies[j]) for i, j in spans]
    return np.array(middles), np.array([log10(f[i] / f[j]) / (j - i) for i, j in spans])
