"""Section 5.3: the accuracy ε of a release against the width W of the stripes of the basins."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic
from cointoss.study import GREY, Array, Estimate, Progress, mean_share, ratio_of_medians
from cointoss_reproduction.frame.declared import Data, Findings, declared
from cointoss_reproduction.setups.planar_maps import HEIGHTS, LANDINGS, SPINS, case, faces_after, planar_rows

SEED = 53
LADDER = np.geomspace(1e-10, 0.1, 91)
"""Steps of the height by which a boundary is sought, 10 in a decade [m]."""
RATIOS = 10.0 ** np.arange(-2, 5)
"""ε over W."""
W_100, TEN = RATIOS[0], RATIOS[3]
WIDEST = 0.1
"""Largest ε [m]: the release must stay above the floor."""
HAND = 1e-3
"""An accuracy that a hand may reach [m]."""
FEWEST = 5
"""Tosses from which a ratio is given."""
NONE = Estimate(np.nan, np.nan, np.nan, 0)
"""Of fewer."""


def make(progress: Progress, centers: int = 200, count: int = 60) -> Findings:
    """Measure the stripe of each random release, and toss within ε of it."""
    rng = np.random.default_rng(SEED)
    heights, spins = rng.uniform(*HEIGHTS, centers), rng.uniform(*SPINS, centers)
    data: Data = {"ratio": RATIOS}
    found = Findings(data=data, at_hand={})
    alike: dict[str, list[Estimate]] = {}
    for landing in LANDINGS:
        width = stripe_widths(landing, heights, spins)
        progress(2 * len(found.at_hand) + 1, 2 * len(LANDINGS))
        rows = []
        for ratio in RATIOS:
            within = width * ratio <= WIDEST
            shares = _alike(landing, heights, spins, np.where(within, width * ratio, 0), count, rng)
            rows.append(mean_share(shares[within], "releases") if within.sum() >= FEWEST else NONE)
        alike[landing] = rows
        data |= {f"{landing}, width": width, f"{landing}, alike": np.array([one.value for one in rows])}
        found.at_hand[landing] = mean_share(
            _alike(landing, heights, spins, np.full(centers, HAND), count, rng), "releases"
        )
        progress(2 * len(found.at_hand), 2 * len(LANDINGS))
    soft, bouncing = (data[f"{landing}, width"] for landing in LANDINGS)
    found.bounced = dict(zip(RATIOS.tolist(), alike["bouncing"], strict=True))
    found.off_half = {r: one - 1 / 2 for r, one in found.bounced.items() if r >= 10 and one.count}
    found.median, found.tenth = np.median(bouncing), np.quantile(bouncing, 0.1)
    found.soft = np.median(soft)
    found.ends = _listed(data["bouncing, alike"])
    found.ratio = ratio_of_medians(bouncing, soft, rng, "releases")
    return found


def _listed(alike: Array) -> str:
    """Return what part ends as meant for each ratio from 1 on that could be tossed, in words."""
    listed = [(ratio, share) for ratio, share in zip(RATIOS, alike, strict=True) if ratio >= 1 and share >= 0]
    return ", ".join(f"{ratio:,.0f} W {share:.0%}" for ratio, share in listed)


def _faces(landing: str, heights: Array, spins: Array) -> NDArray[np.int8]:
    rows = planar_rows(case(air=True), heights, spins)
    return faces_after(rows, 0) if landing == "soft floor" else analytic.toss_rows(rows).outcome


def stripe_widths(landing: str, heights: Array, spins: Array) -> Array:
    """Return how far apart the boundaries above and below releases are, as `LADDER` finds them, (n,) [m].

    Args:
        landing: one of `LANDINGS`.
        heights: of the releases, (n,) [m].
        spins: about ξ, (n,) [rad/s].
    """
    steps = np.concatenate([[0.0], LADDER, -LADDER])
    tossed = heights[:, None] + steps
    faces = _faces(landing, tossed.ravel(), np.repeat(spins, len(steps))).reshape(tossed.shape)
    other = (faces[:, 1:] != faces[:, :1]).reshape(len(heights), 2, len(LADDER))
    found = np.where(other.any(axis=2), LADDER[np.argmax(other, axis=2)], LADDER[-1])
    return found.sum(axis=1)


def _alike(
    landing: str, heights: Array, spins: Array, accuracy: Array, count: int, rng: np.random.Generator
) -> Array:
    """Return for each release which part of `count` tosses within its accuracy ends as itself, (n,)."""
    aimed = _faces(landing, heights, spins)
    tossed = heights[:, None] + accuracy[:, None] * rng.uniform(-1, 1, (len(heights), count))
    faces = _faces(landing, tossed.ravel(), np.repeat(spins, count)).reshape(tossed.shape)
    return np.mean(faces == aimed[:, None], axis=1)


def _draw(data: Data) -> Figure:
    picture = Figure(figsize=(9, 3.4))
    alike, widths = picture.subplots(1, 2)
    _draw_alike(alike, data)
    _draw_widths(widths, data)
    return picture


def _draw_opening(draw: Callable[[Axes, Data], None]) -> Callable[[Any], Figure]:
    """Return what draws one half of the picture for the opening of the page."""

    def opening(data: Data) -> Figure:
        picture = Figure(figsize=(4.4, 3.2))
        draw(picture.subplots(), data)
        return picture

    return opening


def _draw_alike(axes: Axes, data: Data) -> None:
    for landing, color in LANDINGS.items():
        axes.semilogx(data["ratio"], data[f"{landing}, alike"], "o-", color=color, label=landing)
    axes.axhline(0.5, color=GREY, linewidth=0.8)
    axes.set(xlabel="accuracy over width, ε/W", ylabel="part that ends as meant", ylim=(0, 1.03))
    axes.legend(loc="lower left")


def _draw_widths(axes: Axes, data: Data) -> None:
    for landing, color in LANDINGS.items():
        width = np.sort(data[f"{landing}, width"])
        axes.semilogx(width, np.arange(1, len(width) + 1) / len(width), color=color, label=landing)
    axes.axvline(HAND, color=GREY, linewidth=0.8)
    axes.annotate("a hand's ε", (HAND, 0.02), (-3, 0), textcoords="offset points", ha="right")
    axes.set(xlabel="width W of a release's stripe [m]", ylabel="part of the releases below", ylim=(0, 1.03))
    axes.legend(loc="upper left")


REPRODUCTION = declared(
    __name__,
    make,
    draw={
        "figure": _draw,
        "below-the-width": _draw_opening(_draw_widths),
        "above-the-width": _draw_opening(_draw_alike),
    },
)
