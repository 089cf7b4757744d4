"""A claim of section 1: a nickel lands on its edge once in 6,000 tosses; which coin is fair three ways?"""

from typing import Any

import numpy as np
from scipy.optimize import brentq

from cointoss import Outcome
from cointoss.study import Estimate, difference, in_words, share_of
from cointoss_reproduction.frame.declared import listed
from cointoss_reproduction.frame.recorded import recorded
from cointoss_reproduction.setups.edge_classes import DIAMETRAL, HANDS, PUBLISHED, edge_of_die
from cointoss_reproduction.setups.edge_record import ANGLE, QUICK, SOLID_ANGLE, SQUARE, EdgeRecord, record_of
from cointoss_reproduction.setups.edge_thrown import QUOTED, fitted_floor
from cointoss_reproduction.setups.ends import Ends, alike, ended_as, together, tosses
from cointoss_reproduction.studies.edge.pages import draw, fair, holds, on_edge, percent, tables

_ROOT: Any = brentq(lambda aspect: edge_of_die(aspect) - 1 / 3, 0.1, 2)
DIE = float(_ROOT)
"""h/D at which Pender and Uhrin's die is on edge in a third of its throws."""
ROLLING_ON = "edge, standing"
"""How a coin ends that rolls on its edge for ever."""
LEAST_PROBABLE = 1e-3
"""Below this p-value the engines differ."""


def measures(record: EdgeRecord) -> dict[str, Any]:
    """Return what the claims of the papers are decided by, and what explains why they hold or do not."""
    nickels = {wobble: record.nickel[wobble]["as said"] for wobble in HANDS}
    plain, people = nickels.values()
    of_angle = record.curves[DIAMETRAL]["0"][f"{ANGLE:.6g}"]
    thin, rod = (
        {
            wobble: on_edge(together(list(curve.values())[at] for curve in record.curves[wobble].values()))
            for wobble in HANDS
        }
        for at in (0, -1)
    )
    square = {
        "the analytic engine": [curve["1"] for curve in record.curves[DIAMETRAL].values()],
        "MuJoCo": [counts["mujoco"] for name, counts in record.engines.items() if SQUARE in name],
    }
    chis = list(record.curves[DIAMETRAL])
    middle = chis[len(chis) // 2]
    chi, chance = fitted_floor(record.thrown)
    fairest = {wobble: fair(record, wobble, middle) for wobble in HANDS}
    by_share = sorted(
        (on_edge(ends).value, f"{percent(on_edge(ends))} ({wobble}, {factor})", on_edge(ends))
        for wobble, by_factor in record.nickel.items()
        for factor, ends in by_factor.items()
    )
    agreeing = [words for _, words, edge in by_share if holds(edge, PUBLISHED)]
    return {
        "thrown_chi": in_words(chi, ".2f"),
        "thrown_chance": chance,
        "thrown_plain": [percent(on_edge(record.thrown["χ = 0.1, about a diameter"][h])) for h in QUOTED],
        "one_in": [_one_in(ends) for ends in nickels.values()],
        "over": {wobble: on_edge(ends) / PUBLISHED for wobble, ends in nickels.items()},
        "rarest": by_share[0][1],
        "commonest": by_share[-1][1],
        "agreeing": " and of ".join(agreeing) or "none",
        "curves": len(chis),
        "agreeing_die": _agreeing_die(record),
        "die_less": fairest[DIAMETRAL] - DIE,
        "more": difference(_flags(people), _flags(plain)),
        "rolling": share_of(
            record.free.get(ROLLING_ON, 0), ended_as(record.free, Outcome.EDGE), "tosses on edge"
        ),
        "touched": {turned: touch.touched - 1 / 3 for turned, touch in record.touches.items()},
        "let_go": {turned: touch.let_go - 1 / 3 for turned, touch in record.touches.items()},
        "energy": record.touches[DIAMETRAL].energy,
        "no_rebound": on_edge(of_angle) - 1 / 3,
        "middle": middle,
        "aspects": {
            source: {
                "aspect": aspect,
                "less": {wobble: one - aspect for wobble, one in fairest.items()},
            }
            for aspect, source in ((SOLID_ANGLE, "von Neumann's solid angle"), (ANGLE, "the angle"))
        },
        "thinnest": {
            wobble: {"edge": edge, "known": True if wobble == DIAMETRAL else None}
            for wobble, edge in thin.items()
        },
        "rod": rod,
        "heads": _heads(record) - 1 / 2,
        "square": {engine: on_edge(together(ends)) - 1 / 2 for engine, ends in square.items() if ends},
        "tests": len(record.engines),
        "least": min(alike(counts.values()) for counts in record.engines.values()),
        "runs": 1 / (1 - (1 - LEAST_PROBABLE) ** len(record.engines)),
    }


def _agreeing_die(found: EdgeRecord) -> str:
    """Return at how many h/D the share on edge of a die is within the interval found, by χ, in words."""
    held = {
        f"χ = {chi}": sum(holds(on_edge(ends), edge_of_die(float(aspect))) for aspect, ends in curve.items())
        for chi, curve in found.curves[DIAMETRAL].items()
    }
    return listed(held, "d")


def _heads(found: EdgeRecord) -> Estimate:
    """Return the share of heads among all nickels that end on a face."""
    ends = together(ends for by_factor in found.nickel.values() for ends in by_factor.values())
    heads, tails = (ended_as(ends, outcome) for outcome in (Outcome.HEADS, Outcome.TAILS))
    return share_of(heads, heads + tails)


def _flags(ends: Ends) -> Any:
    return np.arange(tosses(ends)) < ended_as(ends, Outcome.EDGE)


def _one_in(ends: Ends) -> str:
    part = on_edge(ends)
    return f"{percent(part)} of {part.count:,d}, 1 in {1 / part.value:,.0f}" if part.value else "none"


REPRODUCTION = recorded(
    __name__,
    record_of,
    record=EdgeRecord,
    measures=measures,
    tables=tables,
    draw={"figure": draw},
    quick={"sizes": QUICK},
)
