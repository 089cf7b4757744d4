"""What counts of flips say, as text for a person: of a coin's sides, its mass centre, and a hand."""

import math
from collections.abc import Mapping, Sequence

from cointoss.compare.flips.hand_fit import HandFit
from cointoss.compare.flips.sides import Sides, together
from cointoss.compare.metrics.estimate import Estimate
from cointoss.compare.metrics.estimates import in_words
from cointoss.compare.output.answer import counted

DEGREE = math.degrees(1)


def as_lines(found: HandFit | Estimate) -> str:
    """Return a fit of a hand, or of the offset of a mass centre, as text."""
    if isinstance(found, Estimate):
        words = "no offset explains these counts" if math.isnan(found.low) else in_words(found, ".3f", 1e3)
        words = "each offset explains these counts" if math.isnan(found.value) else words
        return f"mass centre towards heads [mm], 99 %  {words}"
    shares = (in_words(one.share, ".1f", 100) if one.share.count else "none" for one in found.people)
    flips, same = found.flips.flips.sum(), found.flips.same.sum()
    rows = [
        ["person", "flips", "same side [%]", "psi [deg], 99 %"],
        *zip(
            found.flips.people,
            map(str, found.flips.flips),
            shares,
            (_in_degrees(one.psi) for one in found.people),
            strict=True,
        ),
    ]
    if found.scatter:
        over = counted(found.scatter.count, "person").replace("persons", "people")
        around = f"90 with a scatter of {_in_degrees(found.scatter)} over {over}"
        rows.append(["all", str(flips), f"{100 * same / flips:.2f}", around])
    meaning = "same side: how often the side that was up at the release came up; in brackets 99 % intervals"
    return "\n".join([*_aligned(rows), meaning, "", found.verdict])


def sides_as_lines(sides: Mapping[str, Sides]) -> str:
    """Return how often a coin showed heads in each series, and whether a fair coin does so, as text."""
    every = together(sides.values())
    rows = [
        [name, str(one.flips), in_words(one.share, ".1f", 100), f"{one.p_value:.2g}"]
        for name, one in (sides if len(sides) == 1 else {**sides, "all": every}).items()
    ]
    meaning = (
        "heads: in brackets 99 % intervals (Wilson); "
        "p: how often a fair coin is as far from one half (exact binomial test)"
    )
    return "\n".join([*_aligned([["series", "flips", "heads [%]", "p"], *rows]), meaning, "", every.verdict])


def _aligned(rows: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(len(row[i]) for row in rows) for i in range(2)]
    return [f"{row[0]:{widths[0]}}  {row[1]:>{widths[1]}}  {row[2]:18}  {row[3]}" for row in rows]


def _in_degrees(psi: Estimate) -> str:
    if math.isnan(psi.value):
        return "not determined"
    return in_words(psi, ".1f", DEGREE) if math.isfinite(psi.low) else f"{psi.value * DEGREE:.1f}"
