"""A field fitted to counts of edges as text for a person: its value, the verdict, and each thickness."""

import math

from cointoss.compare.fitting.answer import end_of
from cointoss.compare.fitting.edge_fit import EdgeFit
from cointoss.compare.metrics.estimates import in_words, share_of


def as_lines(found: EdgeFit) -> str:
    """Return a fit of edges as text."""
    value, low, high = found.value.ends
    unit = f" [{found.span.printed_unit}]" if found.span.unit else ""
    interval = f"  99 % [{low:.4g}, {high:.4g}]{end_of(found)}" if math.isfinite(low) else ""
    seen = found.edges
    counts = zip(seen.thickness * 1000, seen.edge.tolist(), seen.tosses.tolist(), found.shares, strict=True)
    rows = [
        f"{mm:14.4g}  {tosses:6d}  {in_words(share_of(edge, tosses), '.1f', 100):18}  {100 * share:.1f}"
        for mm, edge, tosses, share in counts
    ]
    head = "thickness [mm]  tosses  edge seen [%]       fitted [%]"
    left = (
        f"left out    {100 * found.left_out:.2g} % of the tosses: they end neither on a face nor on the edge"
    )
    verdict = [found.verdict, left] if found.left_out else [found.verdict]
    meaning = "edge: share of the tosses that end on the edge; in brackets 99 % intervals"
    return "\n".join([f"{found.span.field}{unit}  {value:.4g}{interval}", *verdict, "", head, *rows, meaning])
