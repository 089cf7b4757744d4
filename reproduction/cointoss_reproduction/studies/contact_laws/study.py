"""When each contact law adds energy, pulls on the coin, leaves the friction cone, or has no solution."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import pandas as pd

from cointoss import ContactLaw, Flag, Impacts, RestitutionKind, load
from cointoss.study import Array, Body, Rules, raised_flags
from cointoss_reproduction.frame.cells import Cells, Rows
from cointoss_reproduction.frame.study import study
from cointoss_reproduction.studies.contact_laws.random_impacts import draw_states
from cointoss_reproduction.studies.contact_laws.single_impacts import strike
from cointoss_reproduction.studies.contact_laws.thresholds import onset_of_gain, onset_without_solution

SEED = 2008
SHARP, ROUGH, SLIDING, KINEMATIC = (
    "(a) sharp_edge",
    "(c) perfectly_rough",
    "(f) sliding_friction",
    "coulomb, kinematic",
)
LAWS = {
    **{
        f"({letter}) {law}": (law, RestitutionKind.KINEMATIC)
        for letter, law in zip(
            "abcdef", (law for law in ContactLaw if law != ContactLaw.COULOMB), strict=True
        )
    },
    KINEMATIC: (ContactLaw.COULOMB, RestitutionKind.KINEMATIC),
    "coulomb, energetic": (ContactLaw.COULOMB, RestitutionKind.ENERGETIC),
}
COINS = {
    "thin ideal": (0.0, (0.0, 0.0, 0.0)),
    "thick ideal": (2e-3, (0.0, 0.0, 0.0)),
    "thin imperfect": (0.0, (-1e-3, -1e-3, 0.0)),
    "thick imperfect": (2e-3, (-1e-3, -1e-3, -2e-4)),
}
"""Thickness and mass centre of the coins; the last is the paper's, section 5.1."""
ALL = "all"
"""The name of all coins together."""
RESTITUTIONS = {f"χ = {tenth / 10:g}": tenth / 10 for tenth in range(1, 11)}
SUFFICIENT = tuple(round(0.05 * step, 2) for step in range(61))
"""Frictions of floors in whose cone impulses may lie."""
FRICTIONS = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
"""Frictions with which onsets are searched."""
UNSOLVED = (0.5, 1.0, 1.5, 2.0, 3.0)
"""Frictions with which sliding_friction may have no solution."""
SEARCH_ERROR = 1e-7
IDEAL_LEAST = math.sqrt(5) / 3 - SEARCH_ERROR
"""Least restitution at which sharp_edge adds energy to an ideal coin, less that."""


def body_of(coin: str) -> Body:
    """Return one of `COINS`, without air."""
    thickness, center = COINS[coin]
    scenario = load("fig18_3d_ideal")
    return scenario.replace("coin.thickness", thickness, "coin.center_of_mass", center).body


def rules_of(name: str) -> Rules:
    """Return the rules of one of `LAWS`."""
    law, kind = LAWS[name]
    return load("fig18_3d_ideal").rules._replace(law=law, restitution_kind=kind)


@dataclass(frozen=True, eq=False)
class Drawn:
    """The impacts drawn for one coin."""

    body: Body
    states: Array
    friction: Array
    """The friction of each impact, drawn from 0 to 1, (n,)."""


@cache
def drawn_impacts(count: int, seed: int = SEED) -> dict[str, Drawn]:
    """Draw impacts, the same number for each of `COINS`."""
    rng = np.random.default_rng(seed)
    bodies = {name: body_of(name) for name in COINS}
    rules, each = rules_of(KINEMATIC), count // len(COINS)
    states = {name: draw_states(body, rules, each, rng) for name, body in bodies.items()}
    return {name: Drawn(body, states[name], rng.uniform(0, 1, each)) for name, body in bodies.items()}


def impacts(law: str, count: int = 20_000, seed: int = SEED) -> Iterator[Rows]:
    """Try a law on `count` random impacts at every restitution, a quarter of them of each coin."""
    drawn, rules = drawn_impacts(count, seed), rules_of(law)
    tried = [
        _struck(rules, one, chi).assign(restitution=at, coin=coin)
        for at, chi in RESTITUTIONS.items()
        for coin, one in drawn.items()
    ]
    whole: Any = pd.concat(tried)
    for at, of_coins in whole.groupby("restitution", sort=False):
        for coin, some in ((ALL, of_coins), *of_coins.groupby("coin", sort=False)):
            changes = {"median": some.change[some.gains].median(), "largest": some.change.max()}
            flagged = {name: int(some[name].sum()) for name in ("gains", "pulls", "leaves", "unsolved")}
            yield {
                "restitution": at,
                "chi": RESTITUTIONS[at],
                "coin": coin,
                "impacts": len(some),
                **flagged,
                **changes,
            }
    yield pd.DataFrame({"mu": SUFFICIENT, "within": [np.mean(whole.needed <= mu) for mu in SUFFICIENT]})
    by_restitution = whole.groupby("restitution")[["pulls", "leaves"]].mean()
    yield {
        "largest_change": whole.change.max(),
        "most_pulls": by_restitution.pulls.max(),
        "most_leave": by_restitution.leaves.max(),
        "for_half": whole.needed.quantile(0.5, interpolation="higher"),
        "for_most": whole.needed.quantile(0.95, interpolation="higher"),
        "no_solution": whole.unsolved.mean(),
    }


def _struck(rules: Rules, drawn: Drawn, chi: float) -> pd.DataFrame:
    """Return what a law does in each of the impacts of a coin."""
    found, solved = strike(drawn.body, rules, drawn.states, restitution=chi, friction=drawn.friction)
    raised = raised_flags(found, drawn.friction)
    return pd.DataFrame(
        {
            "gains": raised[Flag.GAINS_ENERGY],
            "pulls": raised[Flag.PULLS],
            "leaves": raised[Flag.LEAVES_CONE],
            "unsolved": ~solved,
            "change": found.energy_change / (found.energy - found.energy_change),
            "needed": friction_needed(found),
        }
    )


def friction_needed(found: Impacts) -> Array:
    """Return |S_t|/S_z, the least μ whose cone holds the impulse, (n,); infinite where S_z <= 0."""
    along, up = np.hypot(found.impulse[:, 0], found.impulse[:, 1]), found.impulse[:, 2]
    return np.where(up > 0, along / np.where(up > 0, up, 1.0), math.inf)


def gaining(law: str, coin: str) -> dict[str, float]:
    """Return the least restitution at which a law adds energy to a coin in some impact."""
    return {"gains_from": onset_of_gain(body_of(coin), rules_of(law), 0.0, SEED)}


def unsolvable(coin: str) -> dict[str, float]:
    """Return the least friction with which sliding_friction has no solution in some impact of a coin."""
    return {"unsolved_from": onset_without_solution(body_of(coin), rules_of(SLIDING), SEED)}


def unsolved(friction: float, count: int = 20_000) -> dict[str, Any]:
    """Return for how many of the random impacts sliding_friction has no solution."""
    rules, drawn = rules_of(SLIDING), drawn_impacts(count).values()
    solved = [strike(one.body, rules, one.states, restitution=1.0, friction=friction)[1] for one in drawn]
    return {"without": 1 - np.mean(solved)}


def gaining_with_friction(law: str, friction: float) -> Iterator[dict[str, Any]]:
    """Return the least restitution at which a law adds energy to the thin ideal coin, both ways."""
    onset, exact = (
        onset_of_gain(body_of("thin ideal"), rules_of(law), friction, SEED),
        CLOSED_FORMS[law](friction),
    )
    yield {"by": "search", "onset": onset, "off": onset - exact}
    yield {"by": "closed form", "onset": exact}


def kane_onset(mu: float) -> float:
    """Return the least restitution at which coulomb, kinematic, adds energy to the thin ideal coin.

    The coin comes down with the slip that a blow straight up at A would leave it without,
    χ² = 1 - K_zν²/(K_νν K_zz), and must stick once slip has stopped, |K_zν| <= μ K_νν. At a tilt ϑ with
    t = tan ϑ, m K_νν = (1 + 5 t²)/(1 + t²), m K_zz = (5 + t²)/(1 + t²) and m |K_zν| = 4 t/(1 + t²): best is
    t = 1, which sticks for μ >= 2/3, and below that the least t > 1 that does.

    Args:
        mu: coefficient of friction μ > 0.
    """
    t = 1.0 if mu >= 2 / 3 else (2 + math.sqrt(4 - 5 * mu * mu)) / (5 * mu)
    return math.sqrt(1 - (4 * t) ** 2 / ((1 + 5 * t * t) * (5 + t * t)))


def sliding_onset(mu: float) -> float:
    """Return the least restitution at which sliding_friction adds energy to the thin ideal coin.

    Slip that all but rests is driven on: (1 - χ)/(1 + χ) = μ (μ K_νν + |K_zν|)/(K_zz + μ |K_zν|), with K as
    in `kane_onset`, largest at (5 μ² - 1) t² + 12 μ t + 5 - μ² = 0. From μ = 1/√5 on it adds energy at every
    restitution, to a coin that comes down upright.

    Args:
        mu: coefficient of friction μ >= 0.
    """
    left = 1 - 5 * mu * mu
    if left <= 0:
        return 0.0
    t = (6 * mu + math.sqrt(36 * mu * mu + left * (5 - mu * mu))) / left
    ratio = mu * (mu * (1 + 5 * t * t) + 4 * t) / (5 + t * t + 4 * mu * t)
    return (1 - ratio) / (1 + ratio)


CLOSED_FORMS = {SLIDING: sliding_onset, KINEMATIC: kane_onset}


def found(cells: pd.DataFrame) -> dict[str, float]:
    """Return the largest share of random impacts that add energy below the onset that was searched."""
    onsets = cells[cells.gains_from.notna()].set_index(["law", "coin"]).gains_from
    of_laws = {SHARP: SHARP, ROUGH: ROUGH, KINEMATIC: ROUGH}
    tried = cells[cells.law.isin(of_laws) & cells.coin.isin(COINS) & cells.impacts.notna()]
    own = zip(tried.law.map(of_laws), tried.coin, strict=True)
    below = tried.chi < [onsets[law, coin] for law, coin in own]
    return {"below_onset": (tried.gains / tried.impacts)[below].max()}


REPRODUCTION = study(
    __name__,
    Cells(impacts, {"law": tuple(LAWS)}),
    Cells(gaining, {"law": (SHARP, ROUGH), "coin": tuple(COINS)}),
    Cells(unsolvable, {"coin": tuple(COINS)}),
    Cells(gaining_with_friction, {"law": tuple(CLOSED_FORMS), "friction": FRICTIONS}),
    Cells(unsolved, {"friction": UNSOLVED}),
    found=found,
)
