"""How far is a toss from the boundary? The smallest change of its release that changes its outcome."""

from typing import Any

import numpy as np
import pandas as pd
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
    ReleaseQuantity,
    in_words,
    rows_from_states,
    share,
    smallest_changes,
    table,
)
from cointoss_reproduction.frame.cells import Cells, column
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.frame.tables import paragraphs
from cointoss_reproduction.setups.estimates import quantile
from cointoss_reproduction.setups.general_coins import CoinClass
from cointoss_reproduction.setups.planar_maps import HEIGHTS, SPINS, case, planar_rows

SEED = 316
COUNT = 120
"""The number of tosses of the general coin."""
PLANAR = 1000
"""The number of tosses of the planar coin."""
FAMILY = CoinClass(thick=True, imperfect=True, air=True, coulomb=False)
"""The class of coins whose releases the general coin has."""
HEIGHT = QUANTITIES[0]
HAND = 1.0
"""An ordinary hand's accuracy in height [mm]."""
ACCURACIES = (1.0, 1e-3, 1e-6)
"""The accuracies at which P(margin < ε) is compared with f(ε) [mm]."""
PARTS = (0.01, 0.1, 0.5, 0.9)
"""The parts of the tosses whose largest margins are given."""
KINDS = {"height": INK, "velocity": BLUE, "attitude": ORANGE, "spin": GREEN}
"""The kinds of quantities, and their colours."""
STYLES = ("-", "--", ":")
"""The line styles of the axes."""


PLANAR_HEIGHT = "height of the planar coin"
COINS = {
    "the paper's zloty in air, χ = 0.8": HEIGHT.name,
    "the planar coin in vacuum, χ = 0.6": PLANAR_HEIGHT,
}
"""And what of them a hand's accuracy is compared with."""


def general(quantity: ReleaseQuantity, count: int = COUNT) -> pd.DataFrame:
    """Return the margins of `count` random tosses of the general coin, in the quantity's unit."""
    return pd.DataFrame(
        {"margin": found_margins(rows_from_states(load("zloty"), FAMILY.starts(count)), quantity)}
    )


def of_planar(quantity: ReleaseQuantity, planar: int = PLANAR) -> pd.DataFrame:
    """Return the margins of random tosses of the planar coin, in the quantity's unit.

    Beside them is at each of `ACCURACIES` whether the toss is uncertain.

    Args:
        quantity: of the release.
        planar: the number of tosses.
    """
    rows = draw_planar(planar)
    uncertain = {_uncertain(one): uncertain_within(rows, quantity, one) for one in ACCURACIES}
    return pd.DataFrame({"margin": found_margins(rows, quantity), **uncertain})


def draw_planar(count: int) -> Array:
    """Draw tosses in vacuum, uniform in height and spin, flat, at rest but for the spin, as rows, (n, m)."""
    rng = np.random.default_rng(SEED)
    return planar_rows(case(air=False), rng.uniform(*HEIGHTS, count), rng.uniform(*SPINS, count))


def found_margins(rows: Array, quantity: ReleaseQuantity) -> Array:
    """Return the margins of tosses, in the quantity's unit, NaN where none up to 1 SI unit is found, (n,)."""
    changes = smallest_changes(rows, quantity, outcomes=_outcomes, search=MANY)
    return np.where(np.isfinite(changes), np.abs(changes) * quantity.factor, np.nan)


def _outcomes(rows: Array) -> Codes:
    return analytic.toss_rows(rows).outcome


def uncertain_within(rows: Array, quantity: ReleaseQuantity, accuracy: float) -> NDArray[np.bool_]:
    """Return whether a release changed by an accuracy, up or down, has another outcome, (n,).

    Args:
        rows: of the tosses, (n, m).
        quantity: what changes.
        accuracy: ε [the quantity's unit].
    """
    changes = [np.full(len(rows), by / quantity.factor) for by in (0.0, accuracy, -accuracy)]
    own, above, below = _outcomes(np.concatenate([quantity.change(rows, by) for by in changes])).reshape(
        3, -1
    )
    return (above != own) | (below != own)


def _uncertain(accuracy: float) -> str:
    return f"uncertain within {accuracy:g} mm"


def sizes_of(cells: pd.DataFrame, quantity: str) -> Array:
    """Return the margins along a quantity, infinite where none was found, (n,)."""
    return cells.loc[cells["quantity"] == quantity, "margin"].fillna(np.inf).to_numpy()


def shares_within(cells: pd.DataFrame, accuracy: float) -> tuple[Estimate, Estimate]:
    """Return what P(margin ≤ ε) of the planar coin is at least, and f(ε)."""
    return (
        share(sizes_of(cells, PLANAR_HEIGHT) <= accuracy),
        share(column(cells, _uncertain(accuracy))),
    )


def found(cells: pd.DataFrame) -> dict[str, Any]:
    """Return what the claims name, by coin the share of margins below a hand's accuracy; and the tables."""
    small = {coin: {"small": share(sizes_of(cells, quantity) <= HAND)} for coin, quantity in COINS.items()}
    sizes = {f"{one.name} [{one.unit}]": sizes_of(cells, one.name) for one in QUANTITIES}
    rows = [
        [name, *(_words(quantile(found, part)) for part in PARTS), f"{np.mean(np.isinf(found)):.1%}"]
        for name, found in sizes.items()
    ]
    tables = paragraphs(
        f"The margins of {len(sizes_of(cells, HEIGHT.name))} random tosses of the paper's zloty in air, "
        "χ = 0.8: this part of all tosses has a smaller one than",
        table(["what varies", *(f"{part:.0%}" for part in PARTS), "none found"], rows),
        f"{len(sizes_of(cells, PLANAR_HEIGHT))} random planar tosses in vacuum, χ = 0.6, along height:",
        table(
            "ε [mm] | P(margin ≤ ε), at least | f(ε)",
            [
                [f"{one:g}", *(in_words(part, ".3f") for part in shares_within(cells, one))]
                for one in ACCURACIES
            ],
        ),
    )
    return {"coins": small, "tables": tables}


def _words(found: Estimate) -> str:
    value, low, high = ("none" if np.isinf(x) else f"{x:.2g}" for x in (found.value, found.low, found.high))
    return f"{value} [{'0' if np.isneginf(found.low) else low}, {high}]"


def draw(cells: pd.DataFrame) -> Figure:
    """Draw the distribution functions of both coins."""
    picture = Figure(figsize=(11, 4.6))
    left, right = picture.subplots(1, 2, sharey=True)
    for quantity in QUANTITIES:
        kind = quantity.name.split(" ")[0]
        number = [other.name for other in QUANTITIES if other.name.startswith(kind)].index(quantity.name)
        sizes = sizes_of(cells, quantity.name) / quantity.factor
        _steps(right, sizes, color=KINDS[kind], linestyle=STYLES[number], label=quantity.name)
    si = 1 / HEIGHT.factor
    _steps(left, sizes_of(cells, PLANAR_HEIGHT) * si, color=INK, label="P(margin < ε)")
    points = [shares_within(cells, one)[-1] for one in ACCURACIES]
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


REPRODUCTION = study(
    __name__,
    Cells(general, {"quantity": {one.name: one for one in QUANTITIES}}),
    Cells(of_planar, {"quantity": {PLANAR_HEIGHT: HEIGHT}}),
    found=found,
    draw={"margins": draw},
)
