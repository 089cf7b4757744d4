"""A scenario tossed by both engines."""

from cointoss import Scenario, Toss, analytic, coin_mj

ENGINES = {"analytic": analytic.toss, "MuJoCo": coin_mj.toss}


def by_both(case: Scenario) -> dict[str, Toss]:
    """Return the toss of a scenario by each engine."""
    return {engine: toss(case) for engine, toss in ENGINES.items()}


def first_touch(tosses: dict[str, Toss]) -> float:
    """Return when the first of some tosses touches the floor, where states are those after the impact [s]."""
    return min(float(toss.impacts.time[0]) for toss in tosses.values())
