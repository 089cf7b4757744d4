"""How long maps of many tosses take, from what a toss costs."""

from collections.abc import Mapping

from cointoss.compare.output.tables import table

TOSSES = (1e6, 1e9, 1e12)
CORES = (2, 16, 128, 1024)


def map_times(costs: Mapping[str, float]) -> str:
    """Return the times of maps as a table in Markdown.

    Args:
        costs: processor time of a toss, by its kind [s].
    """
    tosses = [f"{number:.0e}".replace("e+0", "e").replace("e+", "e") for number in TOSSES]
    return table(
        ["toss, cores", *(f"{number} tosses" for number in tosses)],
        [
            [f"{name}, {cores}", *(_duration(number * cost / cores) for number in TOSSES)]
            for name, cost in costs.items()
            for cores in CORES
        ],
    )


def _duration(seconds: float) -> str:
    """Return a time in the largest unit of which it has one or more."""
    for unit, length in (("years", 365.25 * 86400), ("days", 86400), ("h", 3600), ("min", 60)):
        if seconds >= length:
            return (
                f"{seconds / length:.2g} {unit}"
                if seconds < 100 * length
                else f"{seconds / length:.0f} {unit}"
            )
    return f"{seconds:.2g} s"
