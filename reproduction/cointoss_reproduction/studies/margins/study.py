"""How far is a toss from the boundary? The smallest change of its release that changes its outcome."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from cointoss import analytic, load
from cointoss.study import (
    BLUE,
    GREEN,
    GREY,
    INK,
    MANY,
    ORANGE,
    QUANTITIES,
    VERMILION,
    Array,
    Codes,
    Estimate,
    Progress,
    ReleaseQuantity,
    code_digest,
    in_words,
    paragraphs,
    quantile,
    rows_from_states,
    scenario_of_row,
    share,
    smallest_changes,
    table,
)
from cointoss_reproduction.frame import parts
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows

SEED = 316
COUNT = 120
"""Tosses of the general coin."""
PLANAR = 1000
"""Tosses of the planar coin."""
PROOFS = 200
"""The first of them whose margin is proved from below too."""
FAMILY = CoinClass(thick=True, imperfect=True, air=True, coulomb=False)
"""Whose releases the general coin has."""
HEIGHT = QUANTITIES[0]
HAND = 1.0
"""An ordinary hand's accuracy in height [mm]."""
ACCURACIES = (1.0, 1e-3, 1e-6)
"""At which P(margin < ε) is compared with f(ε) [mm]."""
PARTS = (0.01, 0.1, 0.5, 0.9)
"""Of the tosses, whose largest margins are given."""
KINDS = {"height": INK, "velocity": BLUE, "attitude": ORANGE, "spin": GREEN}
"""Of quantities, and their colours."""
STYLES = ("-", "--", ":")
"""Of the axes."""


@dataclass(frozen=True)
class Margins:
    """The margins of random tosses, without their signs; -1 where none up to 1 SI unit was found."""

    general: dict[str, list[float]]
    """Of the general coin, by quantity, in its unit."""
    planar: list[float]
    """Of the planar coin, in height [mm]."""
    proved: list[float]
    """Lower bounds of the first of these margins, proved [mm]; 0 where there is none."""
    uncertain: dict[str, list[bool]]
    """Whether a release ε higher, or ε lower, of those tosses has another outcome, by ε in mm."""


def compute(
    progress: Progress, kept: Path, count: int = COUNT, planar: int = PLANAR, proofs: int = PROOFS
) -> Margins:
    """Find the margins of random tosses; what an interrupted computation found is not searched again.

    Args:
        progress: called after each quantity.
        kept: folder of what is done.
        count: tosses of the general coin.
        planar: tosses of the planar coin.
        proofs: of their margins from below.
    """
    drawn = rows_from_states(load("zloty"), FAMILY.starts(count))
    general: dict[str, list[float]] = {}
    steps = len(QUANTITIES) + 2
    for done, quantity in enumerate(QUANTITIES):
        general[quantity.name] = _kept_margins(kept, drawn, quantity, "zloty")
        progress(done + 1, steps)
    flat = draw_planar(planar)
    found = _kept_margins(kept, flat, HEIGHT, "planar")
    uncertain = {f"{one:g}": uncertain_within(flat, one / HEIGHT.factor).tolist() for one in ACCURACIES}
    progress(steps - 1, steps)
    from cointoss_reproduction.precision.proved_change import proved_change

    proved = [
        proved_change(scenario_of_row(flat[i]), HEIGHT, found[i] / HEIGHT.factor) * HEIGHT.factor
        for i in range(proofs)
    ]
    progress(steps, steps)
    return Margins(general=general, planar=found, proved=proved, uncertain=uncertain)


def draw_planar(count: int) -> Array:
    """Draw tosses in vacuum, uniform in height and spin, flat, at rest but for the spin, as rows, (n, 46)."""
    rng = np.random.default_rng(SEED)
    return planar_rows(case(air=False), rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count))


def found_margins(rows: Array, quantity: ReleaseQuantity) -> Array:
    """Return the margins of tosses along a quantity, in its unit, without their signs, (n,)."""
    found = smallest_changes(rows, quantity, outcomes=_outcomes, search=MANY)
    return np.abs(found) * quantity.factor


def _outcomes(rows: Array) -> Codes:
    return analytic.toss_rows(rows).outcome


def _kept_margins(kept: Path, rows: Array, quantity: ReleaseQuantity, name: str) -> list[float]:
    """Return the margins that an earlier computation kept, or find them and keep them."""

    def compute_part() -> parts.Part:
        return {"margins": found_margins(rows, quantity)}

    made_by = code_digest()
    part = parts.kept(kept, f"{made_by}, {name}, {quantity.name}, {len(rows)}", compute_part)
    margins = part["margins"]
    return np.where(np.isfinite(margins), margins, -1.0).tolist()


def uncertain_within(rows: Array, accuracy: float) -> NDArray[np.bool_]:
    """Return whether a release that much higher, or lower, has another outcome, (n,).

    Args:
        rows: of the tosses, (n, 46).
        accuracy: ε [m].
    """
    several = [HEIGHT.change(rows, np.full(len(rows), by)) for by in (0.0, accuracy, -accuracy)]
    own, above, below = _outcomes(np.concatenate(several)).reshape(3, -1)
    return (above != own) | (below != own)


def sizes_of(margins: Sequence[float]) -> Array:
    """Return margins with infinity where none was found, (n,)."""
    sizes = np.array(margins)
    return np.where(sizes < 0, np.inf, sizes)


def below(margins: Sequence[float], accuracy: float) -> Estimate:
    """Return P(margin < ε), or as a margin that was found is an upper bound, what it is at least."""
    return share(sizes_of(margins) <= accuracy)


def not_proved_above(proved: Sequence[float], accuracy: float) -> Estimate:
    """Return what P(margin < ε) is at most: the part of the margins that are not proved to be above ε."""
    return share(np.array(proved) < accuracy)


def measures(found: Margins) -> dict[str, Any]:
    """Return what the claims name: by coin, the share of tosses whose margin a hand's accuracy exceeds."""
    tossed = {
        "the paper's zloty in air, χ = 0.8": found.general["height"],
        "the planar coin in vacuum, χ = 0.6": found.planar,
    }
    return {"coins": {name: {"small": below(margins, HAND)} for name, margins in tossed.items()}}


def tables(found: Margins) -> str:
    """Return the tables, in Markdown."""
    general = []
    for quantity in QUANTITIES:
        sizes = sizes_of(found.general[quantity.name])
        shown = [_words(quantile(sizes, part)) for part in PARTS]
        general.append([f"{quantity.name} [{quantity.unit}]", *shown, f"{np.mean(np.isinf(sizes)):.1%}"])
    planar = [
        [
            f"{one:g}",
            *(
                in_words(part, ".3f")
                for part in (
                    below(found.planar, one),
                    not_proved_above(found.proved, one),
                    share(found.uncertain[f"{one:g}"]),
                )
            ),
        ]
        for one in ACCURACIES
    ]
    half, tenth = 1 / np.median(parts_proved(found)), 1 / np.quantile(parts_proved(found), 0.1)
    return paragraphs(
        f"The margins of {len(found.general[HEIGHT.name])} random tosses of the paper's zloty in air, "
        "χ = 0.8: this part of all tosses has a smaller one than",
        table(["what varies", *(f"{part:.0%}" for part in PARTS), "none found"], general),
        f"{len(found.planar)} random planar tosses in vacuum, χ = 0.6, along height:",
        table("ε [mm] | P(margin ≤ ε), at least | at most, as proved | f(ε)", planar),
        f"The margin of {len(found.proved)} of them is proved from below, half of them to a part of "
        f"1/{half:.0f} of what was found or better, a tenth only to 1/{tenth:.0f} or worse.",
    )


def parts_proved(found: Margins) -> Array:
    """Return the parts of the margins found that are proved, (n,)."""
    return np.array(found.proved) / sizes_of(found.planar[: len(found.proved)])


def _words(found: Estimate) -> str:
    value, low, high = ("none" if np.isinf(x) else f"{x:.2g}" for x in (found.value, found.low, found.high))
    return f"{value} [{'0' if np.isneginf(found.low) else low}, {high}]"


def draw(found: Margins) -> Figure:
    """Draw the distribution functions of both coins."""
    picture = Figure(figsize=(11, 4.6))
    left, right = picture.subplots(1, 2, sharey=True)
    for quantity in QUANTITIES:
        kind = quantity.name.split(" ")[0]
        number = [other.name for other in QUANTITIES if other.name.startswith(kind)].index(quantity.name)
        sizes = sizes_of(found.general[quantity.name]) / quantity.factor
        _steps(right, sizes, color=KINDS[kind], linestyle=STYLES[number], label=quantity.name)
    si = 1 / HEIGHT.factor
    _steps(left, sizes_of(found.planar) * si, color=INK, label="P(margin < ε)")
    _steps(left, np.array(found.proved) * si, color=GREY, label="at most, as proved")
    points = [share(found.uncertain[f"{one:g}"]) for one in ACCURACIES]
    left.errorbar(
        [one * si for one in ACCURACIES],
        [point.value for point in points],
        yerr=np.transpose([(point.value - point.low, point.high - point.value) for point in points]),
        fmt="o",
        color=VERMILION,
        label="f(ε), at both ends only",
    )
    left.set(title="planar coin in vacuum, χ = 0.6", xlabel="margin in height [m]")
    left.set(ylabel="part of the tosses with a smaller margin")
    right.set(title="the paper's zloty in air, χ = 0.8", xlabel="margin [m, m/s, rad or rad/s]")
    right.set(ylim=(0, 1.02))
    for axes in (left, right):
        axes.set(xscale="log", xlim=(1e-14, 1))
        axes.axvline(HAND * si, color=GREY, linewidth=0.8)
        axes.annotate(
            "a hand's 1 mm", (HAND * si, 0.03), rotation=90, ha="right", va="bottom", color=GREY, fontsize=9
        )
        axes.legend(loc="upper left", fontsize=8)
    return picture


def _steps(axes, sizes: Array, **style) -> None:
    x = np.sort(sizes)
    axes.step(x[np.isfinite(x)], (np.arange(len(x)) + 1)[np.isfinite(x)] / len(x), where="post", **style)


REPRODUCTION = recorded(
    __name__, compute, record=Margins, measures=measures, tables=tables, draw={"margins": draw}
)
