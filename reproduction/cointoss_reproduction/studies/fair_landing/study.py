"""A claim of section 2: a coin that bounces is less fair than one that lands softly or is caught."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from cointoss import ContactLaw, Face, Floor, Scenario, analytic, load
from cointoss.study import Array, rows_from_states
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.setups.estimates import jackknife, mean, scatter_of_shares
from cointoss_reproduction.setups.hands import states_of_hands
from cointoss_reproduction.setups.kellers_map import caught
from cointoss_reproduction.setups.planar_maps import faces_after, toss_rows_by_mujoco

SEED = 2
SPREAD = 0.05
"""The relative standard deviation of the tosses of one hand."""
ONE_AXIS, ALL_AXES = "about one axis", "about all axes"
ASIDE = {ONE_AXIS: 0.0, ALL_AXES: 10.0}
"""Spins about ξ and ζ of the two kinds of tosses, at most [rad/s]."""
SMOOTH, ROUGH = "bounced, smooth floor", "bounced, rough floor"
FLOORS = {
    SMOOTH: Floor(restitution=0.6, contact=ContactLaw.SMOOTH),
    ROUGH: Floor(restitution=0.6, contact=ContactLaw.COULOMB, friction=0.2),
}
CAUGHT, SOFT = "caught", "soft floor"
BINS = np.linspace(0, 1, 22)
"""Ends of the classes of a hand's share of heads."""


def landed(spin: str, hands: int = 1000, each: int = 20) -> Iterator[Rows]:
    """Let hands toss a thin ideal coin, and end each toss in four ways."""
    scenario, tossed = load("fig29"), _tossed(spin, hands, each)
    faces = {
        CAUGHT: np.where(caught(scenario, tossed) > 0, Face.HEADS, Face.TAILS),
        SOFT: faces_after(rows_from_states(scenario, tossed), 0),
        **{
            name: analytic.toss_rows(_rows(scenario, floor, tossed)).outcome for name, floor in FLOORS.items()
        },
    }
    heads = {name: np.mean((face == Face.HEADS).reshape(hands, each), axis=1) for name, face in faces.items()}

    def less_fair(landing: str, measure: Callable[[Array], float]) -> Any:
        """Return a measure of unfairness less its largest without bounces, with a jackknife over hands."""

        def excess(kept: NDArray[np.bool_]) -> float:
            return measure(heads[landing][kept]) - max(measure(heads[one][kept]) for one in (CAUGHT, SOFT))

        return jackknife(excess, hands, "hands") if landing in FLOORS else None

    for name, shares in heads.items():
        yield {
            "landing": name,
            "together": mean(shares, "hands"),
            "bias": scatter_of_shares(shares, each),
            "more_biased": less_fair(name, lambda some: scatter_of_shares(some, each)),
            "farther_off": less_fair(name, lambda some: abs(float(some.mean()) - 1 / 2)),
        }
        middles = BINS[:-1] + (BINS[1] - BINS[0]) / 2
        yield pd.DataFrame({"landing": name, "part": middles, "hands": np.histogram(shares, BINS)[0]})


def landed_by_mujoco(hands: int = 1000, each: int = 20, tosses_mujoco: int = 300) -> dict[str, Any]:
    """Return how many first faces the engines find alike, and the heads of both on a smooth floor."""
    scenario, tossed = load("fig29"), _tossed(ALL_AXES, hands, each)
    few = tossed[:: len(tossed) // tosses_mujoco]
    first, smooth = rows_from_states(scenario, few), _rows(scenario, FLOORS[SMOOTH], few)
    same = faces_after(first, 0, toss_rows_by_mujoco) == faces_after(first, 0)
    by_mujoco, by_analytic = (
        np.mean(toss_rows(smooth).outcome == Face.HEADS)
        for toss_rows in (toss_rows_by_mujoco, analytic.toss_rows)
    )
    return {"same": np.sum(same), "few": len(few), "by_mujoco": by_mujoco, "by_analytic": by_analytic}


def _tossed(spin: str, hands: int, each: int) -> Array:
    """Return the states at release of one kind of tosses, which are drawn one kind after the other."""
    rng = np.random.default_rng(SEED)
    drawn = {
        kind: states_of_hands(rng, hands, each, spread=SPREAD, aside=aside) for kind, aside in ASIDE.items()
    }
    return drawn[spin]


def _rows(scenario: Scenario, floor: Floor, states: Array) -> Array:
    return rows_from_states(scenario.replace("floor", floor), states)


REPRODUCTION = study(__name__, Cells(landed, {"spin": tuple(ASIDE)}), Cells(landed_by_mujoco, {}))
