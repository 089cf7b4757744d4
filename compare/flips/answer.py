"""A hand fitted to counts as text for a person: each person's share and ψ, their scatter, and the verdict."""

import math

from cointoss.compare.flips.hand_fit import HandFit
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import in_words
from cointoss.compare.output.answer import counted

DEGREE = math.degrees(1)


def as_lines(found: HandFit) -> str:
    """Return a fit of a hand as text."""
    shares = (in_words(one.share, ".1f", 100) if one.share.count else "none" for one in found.people)
    psi = (_in_degrees(one.psi) for one in found.people)
    flips, same = found.flips.flips.sum(), found.flips.same.sum()
    rows = [
        ["person", "flips", "same side [%]", "psi [deg], 99 %"],
        *zip(found.flips.people, map(str, found.flips.flips), shares, psi, strict=True),
    ]
    if found.scatter:
        rows.append(["all", str(flips), f"{100 * same / flips:.2f}", _around(found.scatter)])
    widths = [max(len(row[i]) for row in rows) for i in range(2)]
    lines = [f"{row[0]:{widths[0]}}  {row[1]:>{widths[1]}}  {row[2]:18}  {row[3]}" for row in rows]
    meaning = "same side: how often the side that was up at the release came up; in brackets 99 % intervals"
    return "\n".join([*lines, meaning, "", found.verdict])


def _in_degrees(psi: Estimate) -> str:
    if math.isnan(psi.value):
        return "not determined"
    return in_words(psi, ".1f", DEGREE) if math.isfinite(psi.low) else f"{psi.value * DEGREE:.1f}"


def _around(scatter: Estimate) -> str:
    over = counted(scatter.count, "person").replace("persons", "people")
    return f"90 with a scatter of {_in_degrees(scatter)} over {over}"
