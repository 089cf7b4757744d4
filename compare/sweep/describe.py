"""Maps in a few lines of text, and how far two agree."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from cointoss.compare.basins.agreement import Agreement, Share
from cointoss.compare.metrics.margin import ReleaseQuantity
from cointoss.compare.sweep.layout import Layout, is_untrusted, trust_layer
from cointoss.compare.sweep.store import Store
from cointoss.models.records import Array, Outcome

AWAY = 2.0
"""A pixel is away from the boundaries where all within this distance have its outcome [pixels]."""


def described(path: Path, layout: Layout, kept: Store) -> Iterator[str]:
    """Yield what a whole map has, as text: shares of outcomes, margins, and how much can be trusted."""
    how = layout.how
    yield describe_map(path, layout, kept.counts("outcome", len(Outcome)))
    if how.margin is not None:
        yield describe_margins(how.quantity, kept.whole("margin"))
    if how.trust:
        most = 1 if how.after is None else how.after + 1
        yield describe_trust(how.after, kept.counts(trust_layer(how.after), most + 1))


def describe_map(path: Path, layout: Layout, counts: NDArray[np.int64]) -> str:
    """Return a map as text: where it is, what it is of, and the share of each outcome, by their counts."""
    (ny, nx), after = layout.batch.shape, layout.how.after
    shown = "" if after is None else f"face at touch {after + 1}, or "
    lines = [
        f"map        {path}",
        f"engine     {layout.how.engine}",
        f"tosses     {nx} by {ny}: {shown}final outcome",
        "shares     of these tosses:",
        *(
            f"{outcome:11}{100 * counts[outcome] / counts.sum():.3f} %"
            for outcome in Outcome
            if counts[outcome] or outcome in (Outcome.HEADS, Outcome.TAILS)
        ),
    ]
    return "\n".join(lines)


def describe_margins(quantity: ReleaseQuantity, margins: Array) -> str:
    """Return the sizes of the margins of a map along a quantity, (y, x) [its unit], as text."""
    unit, most, sizes = quantity.unit, quantity.factor, np.abs(margins)
    few, middle = np.quantile(sizes, [0.1, 0.5], method="lower")
    return "\n".join(
        [
            f"margin     along {quantity.name}: median {middle:.3g} {unit}, a tenth below {few:.3g} {unit}",
            "           (the least change of this quantity that changes the outcome of a toss)",
            f"           {100 * np.isinf(sizes).mean():.3f} % without one up to {most:g} {unit}",
        ]
    )


def describe_trust(after: int | None, counts: NDArray[np.int64]) -> str:
    """Return as text how much of a map can be trusted.

    Args:
        after: how many impacts, of a map of the touch after them; None of final outcomes.
        counts: how many pixels have 0, 1, 2, ... trusted impacts, or an outcome uncertain and certain, (n,).
    """
    untrusted = is_untrusted(after, np.arange(len(counts), dtype=np.int32))
    share = 100 * counts[untrusted].sum() / counts.sum()
    if after is None:
        return f"untrusted  {share:.3f} %: the engine's own errors may have decided the outcome"
    why = f"impact {after + 1} is not trusted, or the toss ended before"
    few, middle = np.searchsorted(np.cumsum(counts), counts.sum() * np.array([0.1, 0.5]))
    return "\n".join(
        [
            f"trusted    median {middle} impacts, a tenth at most {few}",
            "           (leading impacts of a toss that the engine's own errors can't have changed)",
            f"untrusted  {share:.3f} %: {why}",
        ]
    )


def describe_agreement(measured: Agreement) -> str:
    """Return how far two maps agree as text."""
    return "\n".join(
        [
            f"agreement  {percent(measured.away)} more than {AWAY:g} pixels from the boundaries of the first",
            f"           {percent(measured.near)} nearer to the boundaries",
            "           (pixels for which both engines have the same outcome)",
            f"           {measured.undecided} pixels are undecided in one or both",
        ]
    )


def percent(share: Share) -> str:
    """Return the share of the pixels compared that agree as text."""
    part = share.fraction
    return f"none of {share.compared}" if part is None else f"{100 * part:.3f} % of {share.compared}"
