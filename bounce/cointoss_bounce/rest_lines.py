"""What one geom does at rest on another, in lines."""

from math import isnan

from cointoss_bounce.pair import PairBounce
from cointoss_bounce.pair_rest import PairRest


def rest_lines(found: PairBounce) -> str:
    """Return whether a geom lies still on the other, creeps and rocks, or why that was not measured."""
    rest = found.rest
    if rest is None:
        return f"rest        not measured: {found.no_rest}"
    return "\n".join(
        [
            f"rest        {_rest(rest)}",
            f"creep       {_creep(rest, found)}",
            f"rocking     {_rocking(rest)}",
        ]
    )


def _rest(rest: PairRest) -> str:
    # A margin holds the geoms apart.
    deep = f"{1e6 * abs(rest.depth):.3g} um {'deep' if rest.depth >= 0 else 'above the other'}"
    if rest.hop:
        return f"never still: it hops on, by {1e6 * rest.hop:.3g} um, {deep} in the mean"
    if rest.sinking:
        does = "sinks" if rest.sinking > 0 else "rises"
        return f"{does} {1e6 * abs(rest.sinking):.3g} um/s, {deep} in the mean"
    does = "rolls away" if rest.rolls else "moves along the other geom" if rest.drift else "lies still"
    return f"{does}, {deep}"


def _rocking(rest: PairRest) -> str:
    if rest.rocking:
        return f"leans to and fro by up to {rest.rocking:.2g} rad"
    return "none, but it turns as it rolls" if rest.rolls else "none"


def _creep(rest: PairRest, found: PairBounce) -> str:
    if rest.drift:
        return f"{1e6 * rest.drift:.3g} um/s along the other geom"
    if rest.slope and isnan(rest.slip):
        slope = f"on a slope of {rest.slope:g} it does not stay on the other geom"
    elif rest.slope:
        slope = (
            f"on a slope of {rest.slope:g} the points that touch slip at {1e6 * rest.slip:.2g} um/s, "
            "in proportion to the slope"
        )
    elif found.condim == 1:
        slope = "condim 1 has no friction: it slides down every slope"
    else:
        slope = "no slope was tried"
    return f"none under the model's gravity; {slope}"
